"""What a front and a side photograph show of which point, and what is known of a face beforehand."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError, UnknownNameError
from mien.core.mesh import Ints, Points

from .records import Observation, Survey

Bools = NDArray[np.bool_]

FRONT, SIDE = 0, 1
LEFT, RIGHT = ".left", ".right"
MOST_OFF_MIDLINE = 0.015
"""A point without a side lies on the midline if it lies this close to it, as a share of the widest pair's distance."""


@dataclass(frozen=True, eq=False)
class Clicks:
    """The points of a pair.

    Attributes:
        names: of the points (N,).
        seen: (2, N, 2) px from the middle of the front and of the side photograph; NaN where a point is not seen.
        sigma: (2, N) px.
        midline: (N,) which points lie in the symmetry plane.
        twins: (T, 2) numbers of points that are one another's mirror image, the left one first.
    """

    names: tuple[str, ...]
    seen: Points
    sigma: Points
    midline: Bools
    twins: Ints

    @property
    def visible(self) -> Bools:
        """(2, N) what is seen where."""
        return np.isfinite(self.seen[..., 0])

    @property
    def double(self) -> Bools:
        """(N,) which points are seen in both photographs."""
        return self.visible[FRONT] & self.visible[SIDE]

    @property
    def twin(self) -> Ints:
        """(N,) number of each point's twin; its own on the midline, -1 where it has none."""
        twin = np.where(self.midline, np.arange(len(self.names)), -1)
        twin[self.twins[:, 0]], twin[self.twins[:, 1]] = self.twins[:, 1], self.twins[:, 0]
        return twin

    @property
    def missing(self) -> Ints:
        """(N,) axis along which a point is not known, even from its twin: 2 seen from the front only, 0 from the side
        only, -1 where all is known."""
        twin = self.twin
        front, side = self.visible | np.where(twin >= 0, self.visible[:, twin], False)
        return np.where(front & side | self.midline & side, -1, np.where(front, 2, 0))

    def number(self, name: str) -> int:
        """Number of a point, or UnknownNameError."""
        if name not in self.names:
            raise UnknownNameError("point in the pair of photographs", name, self.names)
        return self.names.index(name)

    def only(self, kept: Bools) -> Clicks:
        """The clicks that are ``kept`` (2, N), of the points that are then still seen."""
        seen = np.where(kept[..., None], self.seen, np.nan)
        there: Bools = np.isfinite(seen[FRONT, :, 0]) | np.isfinite(seen[SIDE, :, 0])
        number = np.cumsum(there) - 1
        names = tuple(name for name, stays in zip(self.names, there, strict=True) if stays)
        twins = number[self.twins[there[self.twins].all(axis=1)]]
        return Clicks(names, seen[:, there], self.sigma[:, there], self.midline[there], twins)

    def blurred(self, factor: float) -> Clicks:
        """The same clicks, that many times less sure."""
        return replace(self, sigma=self.sigma * factor)


def gather(
    survey: Survey, front: str, side: str, midline: Sequence[str], twins: Mapping[str, str] | None
) -> tuple[Clicks, list[str]]:
    """The clicks of a pair of photographs, and what was assumed about them.

    Args:
        midline: points of the symmetry plane; found among points without a side where none are told.
        twins: left point -> right point; without it, names that end in ``.left`` and ``.right``.

    Raises:
        MienError: photographs that are no pair, a point clicked twice, or no word of the symmetry plane.
        UnknownNameError: a photograph or point that is not there.
    """
    _check_photographs(survey, front, side)
    found: dict[tuple[int, str], Observation] = {}
    for each in survey.observations:
        if each.photo in (front, side):
            key = (FRONT if each.photo == front else SIDE, each.point)
            if key in found:
                raise MienError(
                    f"{_place(each)}: {each.point!r} is clicked twice in {each.photo!r} — remove one of them"
                )
            found[key] = each
    names = tuple(sorted({point for _, point in found}))
    seen, sigma = np.full((2, len(names), 2), np.nan), np.ones((2, len(names)))
    middles = [0.5 * np.array(survey.photograph(name).size_px) for name in (front, side)]
    for (view, point), each in found.items():
        number = names.index(point)
        seen[view, number] = np.array([each.u, each.v]) - middles[view]
        sigma[view, number] = each.sigma_px
    numbers = {name: number for number, name in enumerate(names)}
    pairs = [(numbers[a], numbers[b]) for a, b in _twins(names, twins) if a in numbers and b in numbers]
    clicks = Clicks(names, seen, sigma, np.zeros(len(names), bool), np.array(pairs, dtype=np.int64).reshape(-1, 2))
    for name in midline:
        clicks.midline[clicks.number(name)] = True
    if (both := clicks.midline[clicks.twins].any(axis=1)).any():
        raise MienError(f"{names[clicks.twins[both][0, 0]]!r} is told to lie on the midline and to have a twin")
    remarks = [] if len(midline) else _find_midline(clicks)
    return clicks, remarks


def twin_name(name: str, twins: Mapping[str, str] | None, x: float) -> str:
    """What the mirror image of a point at ``x`` is called."""
    both = dict(twins or {})
    both |= {right: left for left, right in both.items()}
    if name in both:
        return both[name]
    for one, other in ((LEFT, RIGHT), (RIGHT, LEFT)):
        if name.endswith(one):
            return name.removesuffix(one) + other
    return name + (RIGHT if x > 0 else LEFT)


def _check_photographs(survey: Survey, front: str, side: str) -> None:
    known = {each.name for each in survey.photographs}
    for name in (front, side):
        if name not in known:
            raise UnknownNameError("photograph", name, known)
    if front == side:
        raise MienError(f"front and side are the same photograph, {front!r} — a pair needs two")
    moments = [survey.photograph(name).moment for name in (front, side)]
    if moments[0] != moments[1]:
        raise MienError(
            f"front {front!r} is of the moment {moments[0]!r}, side {side!r} of {moments[1]!r} — "
            "a pair shows one face at one moment; give both the same moment"
        )


def _place(each: Observation) -> str:
    return f"points.csv:{each.line}" if each.line else "points"


def _twins(names: Iterable[str], twins: Mapping[str, str] | None) -> list[tuple[str, str]]:
    if twins is not None:
        return sorted(twins.items())
    return [(name, name.removesuffix(LEFT) + RIGHT) for name in names if name.endswith(LEFT)]


def _find_midline(clicks: Clicks) -> list[str]:
    """Marks the points without a side that lie half way between twins in the front photograph."""
    left, right = clicks.seen[FRONT, clicks.twins[:, 0]], clicks.seen[FRONT, clicks.twins[:, 1]]
    there = np.isfinite(left[:, 0]) & np.isfinite(right[:, 0])
    if there.sum() < 2:
        raise MienError(
            'nothing tells where the symmetry plane is: name points on it (midline = ["nasion", …]), or click points '
            "of both sides in the front photograph under names that end in .left and .right"
        )
    middle, apart = 0.5 * (left + right)[there], (left - right)[there]
    normal = apart.sum(axis=0) / np.linalg.norm(apart.sum(axis=0))
    off = np.abs((clicks.seen[FRONT] - middle.mean(axis=0)) @ normal)
    sided = np.zeros(len(clicks.names), bool)
    sided[clicks.twins] = True
    sided |= [name.endswith((LEFT, RIGHT)) for name in clicks.names]
    clicks.midline[~sided & (off < MOST_OFF_MIDLINE * np.linalg.norm(apart, axis=1).max())] = True
    found = [name for name, on in zip(clicks.names, clicks.midline, strict=True) if on]
    return [f"taken for points of the symmetry plane: {', '.join(found)}"] if found else []
