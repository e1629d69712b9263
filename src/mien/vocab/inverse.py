"""Values under other people's names from what a face does: the inverse of ``pose_from``, as far as there is one."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
from numpy.typing import NDArray

from mien.core import Face, Pose

from .loss import fits_on, nearest_shares
from .posing import pose_from
from .remap import FITS
from .rules import companions, load_rules, unsettle
from .vocabulary import vocabulary

Floats = NDArray[np.float64]

PRICE = 0.005
"""What the effect of a name has to bring before it is used, in shares of ranges: so few names are used, and none for
noise."""

ALIKE = 1.0 - 1e-9
"""Cosine of effects that are the same but for their size."""

STILL = 1e-3
"""Values that change by less are found."""


class Inverse:
    """Finds the values, 0..1, under the names of a vocabulary that bring a face nearest to where it is.

    Least squares over the parameters that the names move, each counted in shares of its range. What a name does is
    measured at its fullest, beside what it needs to be seen, and taken as a straight line; so it is exact for a name
    alone, and near where names share parameters. What a face only stands in for is 0. Of names that do the same, the
    one that does most of it is used, or all that do. It begins with what it found last.

    Args:
        name: of the vocabulary.
        face: of a family that has a table for it.
        without: names that are left at 0.

    Raises:
        UnknownNameError: there is no such vocabulary.
        MienError: the vocabulary has no table for this family of faces.
    """

    def __init__(self, name: str, face: Face, without: Collection[str] = ()) -> None:
        table, fits = face.parameters, fits_on(name, face)
        self.names = vocabulary(name).names
        self._defaults, self._spans = table.defaults, table.highs - table.lows
        used = [each for each in self.names if fits.get(each, FITS[-1]) != FITS[-1] and each not in without]
        groups = _strongest({each: self._effect(name, each, face) for each in used})
        self._groups = tuple(groups)
        self._effects = np.array([sum(effects, np.zeros(len(table))) for effects in groups.values()])
        self._square = self._effects @ self._effects.T
        self._price = PRICE * np.sqrt(np.diag(self._square))
        self._rules = load_rules(name)
        self._shares = np.zeros(len(groups))

    def find(self, pose: Pose) -> dict[str, float]:
        """The value of every name of the vocabulary."""
        moved = (pose.values - self._defaults) / self._spans
        self._shares = nearest_shares(self._square, self._effects @ moved - self._price, self._shares, STILL)
        found = dict.fromkeys(self.names, 0.0)
        for group, share in zip(self._groups, self._shares.tolist(), strict=True):
            found |= dict.fromkeys(group, share)
        return unsettle(found, self._rules)

    def _effect(self, name: str, each: str, face: Face) -> Floats:
        """(P,) what a name does to each parameter, in shares of its range."""
        beside = companions(name, each)
        before, after = (pose_from(name, values, face).values for values in (beside, {**beside, each: 1.0}))
        return np.asarray((after - before) / self._spans)


def _strongest(effects: Mapping[str, Floats]) -> dict[tuple[str, ...], list[Floats]]:
    """Names whose effects are the same, with them; of those that differ in size alone the greatest, without those that
    do nothing."""
    found: dict[tuple[str, ...], list[Floats]] = {}
    sizes = {name: float(np.linalg.norm(effect)) for name, effect in effects.items()}
    taken: set[str] = set()
    for name in sorted(effects, key=lambda each: -sizes[each]):
        if name in taken or not sizes[name]:
            continue
        alike = [
            each
            for each in effects
            if each not in taken and effects[each] @ effects[name] > ALIKE * sizes[each] * sizes[name]
        ]
        taken.update(alike)
        group = tuple(each for each in alike if sizes[each] > ALIKE * sizes[name])
        found[group] = [effects[each] for each in group]
    return found
