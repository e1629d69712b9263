"""Which terms of a lens the data can bear to be asked for, and what is assumed about the others.

A term that is let go still has a wide assumption (the principal point is near the middle, the bend at the corner of the
picture some per cent), so that no lens runs away; it is let go only where the data tell more than the assumption.
"""

from __future__ import annotations

import numpy as np

from mien.capture.networks import Bools, Network
from mien.capture.projecting import LENS_TERMS
from mien.capture.refining import Refined
from mien.capture.snooping import Judgement
from mien.core.mesh import Points

PRINCIPAL_SIGMA = 0.05
"""Of the greater side: how far from the middle principal points lie."""
CROPPED, CROPPED_SIGMA = 2.5, 0.5
"""Times that: farther off only where a photograph was cropped; and then that much of the greater side."""
BEND_SIGMA = 0.15
"""Of its radius: how far a corner of the picture is moved by k1, or by k2."""
DECENTRED_SIGMA = 0.01
"""And by p1, or by p2."""
ASPECT_SIGMA = 0.05
"""How far pixels may be from squares."""
FOCAL_SIGMA = 0.5
"""Of itself: how far the focal length may be from the guess."""
TOLD = 0.25
"""Part of the assumed variance that may be left of a term that is let go."""
EVIDENT = 9.0
"""χ² of a term by which k2, decentring and aspect must differ from none: they may mimic other terms otherwise."""
ALL_TERMS = np.ones(LENS_TERMS, dtype=bool)
FIRST_TERMS = np.isin(np.arange(LENS_TERMS), (0, 3))


def assumptions(network: Network, lenses: Points) -> tuple[Points, Points]:
    """(L, 8) what is assumed about lenses, and standard deviations of that, from a guess of their focal lengths."""
    means, sigmas = np.zeros_like(lenses), np.ones_like(lenses)
    means[:, 0], means[:, 1:3] = lenses[:, 0], network.sizes / 2.0
    corner = np.linalg.norm(network.sizes, axis=1) / 2.0 / lenses[:, 0]
    sigmas[:, 0] = FOCAL_SIGMA * lenses[:, 0]
    sigmas[:, 1] = sigmas[:, 2] = PRINCIPAL_SIGMA * network.sizes.max(axis=1)
    sigmas[:, 3], sigmas[:, 4] = BEND_SIGMA / corner**2, BEND_SIGMA / corner**4
    sigmas[:, 5] = sigmas[:, 6] = DECENTRED_SIGMA / (3.0 * corner)
    sigmas[:, 7] = ASPECT_SIGMA
    return means, sigmas


def with_cropped(network: Network, lenses: Points, sigmas: Points) -> Points:
    """(L, 8) standard deviations, those of principal points wide where ``lenses`` have them far from the middle."""
    greater = network.sizes.max(axis=1)
    cropped = far_from_middle(network, lenses) > CROPPED * PRINCIPAL_SIGMA
    sigmas = sigmas.copy()
    sigmas[cropped, 1:3] = CROPPED_SIGMA * greater[cropped, None]
    return sigmas


def far_from_middle(network: Network, lenses: Points) -> Points:
    """(L,) how far principal points are from the middle, over the greater side of the photograph."""
    off = np.linalg.norm(lenses[:, 1:3] - network.sizes / 2.0, axis=1)
    return np.asarray(off / network.sizes.max(axis=1))


def left_of_assumptions(refined: Refined, judgement: Judgement) -> Points:
    """(L, 8) parts of the assumed variances that are left in the solution; 1 of terms that are held.

    Clicks that scatter less than told tell more of a lens than the equations have it.
    """
    columns = refined.equations.layout.lenses
    left = np.ones(columns.shape)
    free = columns >= 0
    left[free] = np.diag(judgement.covariances.cameras)[columns[free]] / refined.problem.lens_sigmas[free] ** 2
    return 1.0 / (1.0 + np.maximum(1.0 / left - 1.0, 0.0) / judgement.scale)


def evident_terms(refined: Refined, judgement: Judgement) -> Bools:
    """(L, 8) terms but k2, decentring and aspect where these are not told by the data, or may be 0."""
    columns, lenses = refined.equations.layout.lenses, refined.state.lenses
    covariances = judgement.covariances.cameras * judgement.scale
    told = left_of_assumptions(refined, judgement) < TOLD
    evident = np.ones(columns.shape, dtype=bool)
    for number, columns_of_lens in enumerate(columns):
        for terms in ([4], [5, 6], [7]):
            here = columns_of_lens[terms]
            if (here < 0).any():
                continue
            values, covariance = lenses[number, terms], covariances[np.ix_(here, here)]
            chi2 = float(values @ np.linalg.solve(covariance, values))
            evident[number, terms] = bool(told[number, terms].all()) and chi2 > EVIDENT * len(terms)
    return evident


def borne_terms(refined: Refined, judgement: Judgement) -> Bools:
    """(L, 8) terms among those let go that the data tell; the focal length always stays let go."""
    told = left_of_assumptions(refined, judgement) < TOLD
    for one, other in ((1, 2), (5, 6)):
        told[:, one] = told[:, other] = told[:, one] & told[:, other]
    told[:, 0] = True
    return told & refined.problem.free_terms


def freed_names(terms: Bools) -> tuple[str, ...]:
    """Names of (8,) terms as ``Lens.freed`` has them."""
    first_terms = {"focal": 0, "principal": 1, "k1": 3, "k2": 4, "decentring": 5, "aspect": 7}
    return tuple(name for name, number in first_terms.items() if terms[number])


def remarks_on_lenses(network: Network, refined: Refined, judgement: Judgement) -> list[str]:
    """What was assumed about lenses, a sentence each."""
    remarks = []
    assumed = {"principal": "its principal point for the middle", "k1": "its bend (k1) for none", "k2": "k2 for 0"}
    left = left_of_assumptions(refined, judgement)
    cropped = far_from_middle(network, refined.state.lenses)
    for number in np.unique(network.lens_of[refined.problem.active]):
        terms = refined.problem.free_terms[number]
        held = [text for name, text in assumed.items() if name not in freed_names(terms)]
        if held:
            remarks.append(f"camera {network.lenses[number]!r}: took {' and '.join(held)}; the clicks do not tell more")
        if left[number, 0] > TOLD:
            remarks.append(
                f"camera {network.lenses[number]!r}: the clicks hardly tell its focal length"
                " — add references at more depths, or photographs of the board held askew"
            )
        if cropped[number] > CROPPED * PRINCIPAL_SIGMA:
            remarks.append(
                f"camera {network.lenses[number]!r}: its axis meets the picture {100.0 * cropped[number]:.0f} % of the"
                " picture's size away from the middle, as where a photograph was cropped — take whole photographs, of"
                " which the lens is known more surely"
            )
    return remarks
