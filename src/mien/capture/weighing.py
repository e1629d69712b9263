"""How exact clicks and corners of boards are beside one another.

Corners that a program found are many times more exact than clicks, and many times more in number: judged together, the
scatter of corners would be taken for that of clicks, good clicks for mistakes, and the points for too exact.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mien.capture.networks import Bools, Network
from mien.capture.refining import Refined
from mien.capture.snooping import Judgement, scatter


def on_boards(network: Network) -> Bools:
    """(N,) which observations are of bodies that are carried about."""
    return network.body_of > 0


def both_kinds(network: Network) -> bool:
    """Whether there are corners of boards and other clicks."""
    boards = on_boards(network)
    return bool(boards.any() and not boards.all())


def weighed(network: Network, refined: Refined, judgement: Judgement) -> Network:
    """The network with standard deviations of either kind as large as that kind scatters."""
    boards, sigmas = on_boards(network), network.sigmas.copy()
    kinds = boards[refined.equations.layout.order]
    for kind in (False, True):
        sigmas[boards == kind] *= np.sqrt(scatter(judgement, kinds == kind))
    return replace(network, sigmas=sigmas)


def remarks_on_scatter(network: Network) -> Iterator[str]:
    """How far either kind scatters, where it is not as far as told."""
    told = np.array([each.sigma_px for each in network.survey.observations])
    boards = on_boards(network)
    for kind, name in ((False, "clicks scatter"), (True, "corners of boards scatter")):
        times = network.sigmas[boards == kind] / told[boards == kind]
        if len(times) and times[0] != 1.0:
            yield f"{name} {times[0]:.2g} times as far as their sigmas say: covariances count with that"
