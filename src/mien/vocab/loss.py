"""What is lost when a face, or another vocabulary on it, takes the names of a vocabulary."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from mien.core import Face
from mien.core.mesh import Points

from .fields import angle_deg, displacement, longest
from .loading import load_remap, next_step
from .remap import FITS, Link, whole, worst
from .vocabulary import vocabulary

Matrix = NDArray[np.float64]

MISSING = "missing"

SWEEPS = 200
"""Rounds over all names in which the shares of a combination are improved; they stand still long before."""

MOST_NAMES = 6
LEAST_GAIN_DEG = 1.0
"""A combination has so many names at most, and one that brings it no nearer than this is left out."""

FAR_DEG = 60.0
"""A combination that is as far off as this, half of the field or less, says something else."""


@dataclass(frozen=True)
class Loss:
    """What becomes of one name.

    Attributes:
        name: the name.
        fit: ``exact``, ``near`` (approximated), ``stand-in`` (it cannot be shown, something else takes its place) or
            ``missing``.
        longest: how far the point moves that moves most: mm, or a drawing's own units.
        nearest: the names that it is compared with, and how much of each: on a face the one other name that does most
            nearly the same, in another vocabulary the best combination.
        angle_deg: between its displacement field and that of ``nearest``; 0 where they do the same.
        stand_ins: of ``stand-in``, what takes its place, on the parameters of the face or the names of the vocabulary
            by whose way it goes.
    """

    name: str
    fit: str
    longest: float = 0.0
    nearest: Mapping[str, float] = field(default_factory=dict)
    angle_deg: float = 90.0
    stand_ins: tuple[Link, ...] = ()


def loss_on(name: str, face: Face) -> tuple[Loss, ...]:
    """What a face makes of each name of a vocabulary, and which other name does most nearly the same.

    Two names that do the same on a face (0 degrees) are told apart by nobody who looks at it.

    Raises:
        UnknownNameError: there is no such vocabulary.
        MienError: there is no table for the vocabulary.
    """
    fits, links = fits_on(name, face), _links(name, face)
    fields = {each: displacement(name, each, face) for each in fits}
    names, found = tuple(fields), {}
    for each, likeness in zip(names, _likeness(fields), strict=True):
        other = names[int(likeness.argmax())]
        angle = angle_deg(fields[each], fields[other])
        stand_ins = tuple(link for link in links if fits[each] == FITS[-1] and whole(link.name) == each)
        found[each] = Loss(each, fits[each], longest(fields[each]), {other: 1.0}, angle, stand_ins)
    return tuple(found.get(each, Loss(each, MISSING)) for each in vocabulary(name).names)


def fits_on(name: str, face: Face) -> dict[str, str]:
    """How well a face plays each name of a vocabulary: ``exact``, ``near`` or ``stand-in``; without those that it
    plays nothing for.

    On the way by another vocabulary, what is partly stood in for is played nearly.

    Raises:
        UnknownNameError: there is no such vocabulary.
        MienError: there is no table for the vocabulary.
    """
    step = next_step(name, face.family)
    if step == face.family:
        return dict(load_remap(name, step).on(face.parameters).fits)
    remap, below = load_remap(name, step), fits_on(step, face)
    reached: dict[str, set[str]] = {}
    for link in remap.links:
        reached.setdefault(link.name, set()).add(below.get(link.parameter, MISSING) if link.gain else FITS[0])
    return {
        each: worst(fit, found.pop() if len(found) == 1 else FITS[1])
        for each, fit in remap.fits.items()
        if (found := reached[each]) != {MISSING}
    }


def _links(name: str, face: Face) -> tuple[Link, ...]:
    step = next_step(name, face.family)
    remap = load_remap(name, step)
    return (remap.on(face.parameters) if step == face.family else remap).links


def loss_to(name: str, other: str, face: Face) -> tuple[Loss, ...]:
    """How well names of another vocabulary can say each name of this one, both played by one face.

    For each a combination of a few of the other's names, 0..1 each, whose fields add up to a near field.

    Raises:
        UnknownNameError: there is no such vocabulary.
        MienError: there is no table for a vocabulary.
    """
    wanted, given = _fields(name, face), _fields(other, face)
    found = {each: _say(each, wish, given) for each, wish in wanted.items()}
    return tuple(found.get(each, Loss(each, MISSING)) for each in vocabulary(name).names)


def _say(name: str, wish: Points, given: Mapping[str, Points]) -> Loss:
    """The loss of one name, whose field is ``wish`` (V, 3), among those of another vocabulary."""
    if not wish.any():
        return Loss(name, FITS[0], angle_deg=0.0)
    names = list(given)
    basis = np.stack([each.ravel() for each in given.values()])
    products, square = basis @ wish.ravel(), basis @ basis.T
    lengths = np.maximum(np.sqrt(np.diag(square)), 1e-12)
    chosen: list[int] = []
    shares, best, angle = np.zeros(0), np.zeros(0), 90.0
    while len(chosen) < MOST_NAMES:
        missed = products - square[:, chosen] @ shares
        chosen.append(int((missed / lengths).argmax()))
        shares = nearest_shares(square[np.ix_(chosen, chosen)], products[chosen])
        reached = angle_deg(wish, (shares @ basis[chosen]).reshape(wish.shape))
        if reached > angle - LEAST_GAIN_DEG:
            break
        best, angle = shares, reached
    if angle >= FAR_DEG:
        return Loss(name, MISSING, longest(wish))
    used = {names[n]: float(share) for n, share in zip(chosen, best, strict=False) if share > 0.0}
    return Loss(name, FITS[angle >= LEAST_GAIN_DEG], longest(wish), used, angle)


def nearest_shares(square: Matrix, products: Matrix, start: Matrix | None = None, still: float = 0.0) -> Matrix:
    """(N,) shares 0..1 of N vectors whose sum comes nearest to a wanted one.

    Args:
        square: (N, N) products of the vectors with one another.
        products: (N,) products of the vectors with the wanted one.
        start: (N,) shares to begin with; zeros, if there are none.
        still: a round that changes no share by more than this is the last.

    Source: coordinate descent for least squares with bounds; the problem is convex.
    """
    shares = [0.0] * len(products) if start is None else start.tolist()
    missed = products - square @ np.array(shares)
    sizes = np.diag(square).tolist()
    for _ in range(SWEEPS):
        farthest = 0.0
        for n, size in enumerate(sizes):
            if size > 0.0:
                better = min(max(shares[n] + float(missed[n]) / size, 0.0), 1.0)
                change = better - shares[n]
                if change:
                    missed -= square[n] * change
                    shares[n] = better
                    farthest = max(farthest, abs(change))
        if farthest <= still:
            break
    return np.array(shares)


def _fields(name: str, face: Face) -> dict[str, Points]:
    return {each: displacement(name, each, face) for each in fits_on(name, face)}


def _likeness(fields: Mapping[str, Points]) -> Matrix:
    """(N, N) cosines of the angles between fields; -1 of each with itself."""
    directions = np.stack([each.ravel() / max(float(np.linalg.norm(each)), 1e-12) for each in fields.values()])
    cosines = directions @ directions.T
    np.fill_diagonal(cosines, -1.0)
    return np.asarray(cosines)
