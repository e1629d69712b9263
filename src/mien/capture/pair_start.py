"""Where the points of a pair are about, as measured with a ruler; and whether the two photographs are a pair at all."""

from __future__ import annotations

import math

import numpy as np

from mien.core import MienError
from mien.core.mesh import Points

from .pair_clicks import FRONT, SIDE, Clicks
from .pair_views import COUNT, DOWNWARDS, RIGHTWARDS, ROLL, SCALE, View, base_of_front, base_of_side

LEAST_AGREEMENT = 0.9
"""Of the heights in both photographs (rank correlation)."""

SIDES = {"left": 1, "right": -1}


def place_roughly(clicks: Clicks, side_from: str | None, names: tuple[str, str]) -> tuple[View, View, Points]:
    """The two cameras and all points (N, 3) by orthographic projection, in units of the front photograph's px.

    Args:
        side_from: ``left`` or ``right``, the face's own side that the side photograph was taken from; None to find it.
        names: of the photographs, for errors.

    Raises:
        MienError: front and side exchanged, mirrored photographs, heights that have nothing to do with one another.
    """
    front, side = clicks.seen
    _check_exchanged(clicks, names)
    tilt = _tilt_of_axis(clicks)
    upright = front @ np.array([[1.0, tilt], [-tilt, 1.0]]) / math.hypot(1.0, tilt)
    middle = float(np.median(_axis(upright, clicks)[:, 0]))
    x = upright[:, 0] - middle
    _check_mirrored(clicks, x, names[FRONT])
    double = clicks.double
    ratio = _ratio_of_heights(upright[double, 1], side[double, 1], names)
    sign = _side(clicks, x, side_from, names)
    origin = side[double].mean(axis=0)
    level = float(np.median(upright[double, 1] - (side[double, 1] - origin[1]) / ratio))
    y_front, y_side = level - upright[:, 1], (origin[1] - side[:, 1]) / ratio
    y = np.where(double, 0.5 * (y_front + y_side), np.where(clicks.visible[FRONT], y_front, y_side))
    z = -sign * (side[:, 0] - origin[0]) / ratio
    places = _completed(np.stack([x, y, z], axis=1), clicks)
    values = np.zeros((2, COUNT))
    values[FRONT, ROLL] = -math.atan(tilt)
    back = np.array([[1.0, -tilt], [tilt, 1.0]]) / math.hypot(1.0, tilt)
    values[FRONT, RIGHTWARDS : DOWNWARDS + 1] = np.array([middle, level]) @ back
    values[SIDE, RIGHTWARDS : DOWNWARDS + 1] = origin
    values[:, SCALE] = 0.0, math.log(ratio)
    return View(base_of_front(), values[FRONT]), View(base_of_side(sign), values[SIDE]), places


def _completed(places: Points, clicks: Clicks) -> Points:
    """The places with what is not seen of them from their twins, else in the middle of all others."""
    twin = clicks.twin
    places[clicks.midline & ~clicks.visible[FRONT], 0] = 0.0
    mirrored = np.where((twin >= 0)[:, None], places[twin] * [-1.0, 1.0, 1.0], np.nan)
    places = np.where(np.isfinite(places), places, mirrored)
    return np.where(np.isfinite(places), places, np.nanmedian(places, axis=0))


def _axis(front: Points, clicks: Clicks) -> Points:
    """(A, 2) px, what lies in the symmetry plane: midline points and the middles between twins."""
    points = np.concatenate([front[clicks.midline], front[clicks.twins].mean(axis=1)])
    points = points[np.isfinite(points[:, 0])]
    if not len(points):
        raise MienError("the front photograph shows no point of the symmetry plane and no pair of twins — click some")
    return points


def _tilt_of_axis(clicks: Clicks) -> float:
    """How far the symmetry plane goes to the right for each px that it goes down, in the front photograph."""
    axis = _axis(clicks.seen[FRONT], clicks)
    if np.ptp(axis[:, 1]) < 0.2 * np.ptp(clicks.seen[FRONT][clicks.visible[FRONT], 1]):
        return 0.0
    return _robust_slope(axis[:, 1], axis[:, 0])


def _robust_slope(x: Points, y: Points) -> float:
    """Slope of y over x that outliers do not move.

    Source: Theil 1950; Sen 1968, of pairs that lie well apart.
    """
    dx, dy = x[:, None] - x, y[:, None] - y
    apart = dx > 0.25 * np.ptp(x)
    return float(np.median(dy[apart] / dx[apart]))


def _ratio_of_heights(front: Points, side: Points, names: tuple[str, str]) -> float:
    """How much larger the face is in the side photograph."""
    if np.ptp(front) <= 0.0 or np.ptp(side) <= 0.0:
        raise MienError("all points seen in both photographs are at one height — click points from forehead to chin")
    ranks = [np.argsort(np.argsort(heights)) for heights in (front, side)]
    agreement = float(np.corrcoef(ranks[0], ranks[1])[0, 1])
    if abs(agreement) < LEAST_AGREEMENT:
        raise MienError(
            f"the heights of points in {names[FRONT]!r} and {names[SIDE]!r} do not agree (rank correlation "
            f"{agreement:.2f}, want {LEAST_AGREEMENT} or more) — is one photograph lying on its side, or do names "
            "stand for different points?"
        )
    if agreement < 0.0:
        raise MienError(f"{names[FRONT]!r} or {names[SIDE]!r} is upside down: what is high in one is low in the other")
    return _robust_slope(front, side)


def _check_exchanged(clicks: Clicks, names: tuple[str, str]) -> None:
    """An error where the midline is straight in the side photograph and bent in the front one."""
    points = clicks.seen[:, clicks.midline & clicks.double]
    if points.shape[1] < 4:
        return
    bends = []
    for u, v in points.transpose(0, 2, 1):
        line = np.polynomial.Polynomial.fit(v, u, 1)
        bends.append(float(np.median(np.abs(u - line(v)))) / float(np.std(v)))
    if bends[FRONT] > bends[SIDE]:
        raise MienError(
            f"front {names[FRONT]!r} and side {names[SIDE]!r} seem exchanged: points of the midline lie on a "
            f"straighter line in {names[SIDE]!r} — exchange them"
        )


def _check_mirrored(clicks: Clicks, x: Points, front: str) -> None:
    """An error where the left twins stand on the right."""
    apart = x[clicks.twins[:, 0]] - x[clicks.twins[:, 1]]
    apart = apart[np.isfinite(apart)]
    if len(apart) and np.mean(apart < 0.0) > 0.5:
        raise MienError(
            f"in {front!r} left points stand at the face's right: the picture is mirrored, or left and right are "
            "exchanged in the names — 'left' is the face's own left, on the right of a picture from the front"
        )
    if len(apart) and (apart < 0.0).any():
        pairs = clicks.twins[np.isfinite(x[clicks.twins]).all(axis=1)]
        one, other = (clicks.names[number] for number in pairs[np.argmin(apart)])
        raise MienError(f"in {front!r} {one!r} stands to the right of {other!r} — exchange the two names")


def _side(clicks: Clicks, x: Points, told: str | None, names: tuple[str, str]) -> int:
    """1 for a side photograph from the face's own left, -1 from its right."""
    off = clicks.double & ~clicks.midline & (np.abs(x) > 0.1 * np.nanmax(np.abs(x)))
    sides = set(SIDES.values()) if told is None else {SIDES[told]}
    if not off.any():
        if told is None:
            raise MienError(
                f"nothing tells from which side {names[SIDE]!r} was taken: all points seen in both photographs lie on "
                'the midline — tell it (side_from = "left", the face\'s own), or click points of the cheek'
            )
        return sides.pop()
    visible = 1 if np.median(x[off]) > 0.0 else -1
    facing = _facing(clicks, x)
    if facing is not None and facing != visible:
        raise MienError(
            f"{names[FRONT]!r} and {names[SIDE]!r} do not fit: the clicked half of the face is its own "
            f"{_word(visible)}, but the nose in {names[SIDE]!r} points the way it does from the {_word(facing)} — "
            "one of the two is mirrored"
        )
    if visible not in sides:
        raise MienError(
            f"{names[SIDE]!r} is told to be taken from the face's own {told}, but points of its {_word(visible)} are "
            "clicked in it — tell the other side, or leave it out"
        )
    return visible


def _word(sign: int) -> str:
    return next(word for word, each in SIDES.items() if each == sign)


def _facing(clicks: Clicks, x: Points) -> int | None:
    """From which side a nose points so, by the cheeks lying behind the midline; None where there is too little."""
    double = clicks.double
    if double.sum() < 6 or not (clicks.midline & double).any():
        return None
    u, v = clicks.seen[SIDE, double].T
    v = (v - v.mean()) / np.std(v)
    out = np.abs(x[double])
    terms = np.stack([np.ones(len(v)), v, v * v, out / out.max()], axis=1)
    slope = float(np.linalg.lstsq(terms, u, rcond=None)[0][3])
    return 1 if slope > 0.0 else -1
