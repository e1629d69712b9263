"""Regions of the head in which a parameter of its shape acts: 1 inside, fading to exactly 0.

Regions are made of simple forms in space, so skin, teeth, tongue, hair and glasses at one place move as one: what
does not meet before does not meet after.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np

from mien.core import exact
from mien.core.mesh import Points

from .measured import Floats
from .shipped import shipped_rows
from .vectors import length

MM_PER_M = 1000.0


@cache
def region_rows() -> Mapping[str, tuple[tuple[str, str, tuple[float, ...]], ...]]:
    """Rows of ``data/regions.csv``: name -> forms, axes and numbers in millimetres; the forms are multiplied."""
    out: dict[str, list[tuple[str, str, tuple[float, ...]]]] = {}
    for row in shipped_rows("regions"):
        numbers = tuple(float(number) for number in row["numbers"].split())
        out.setdefault(row["region"], []).append((row["shape"], row["axis"], numbers))
    return {name: tuple(forms) for name, forms in out.items()}


def weigh_region(name: str, points: Points) -> Floats:
    """(N,) 0..1, how much points (N, 3) m belong to a region on the left or on the midline."""
    near, weight = np.arange(len(points)), np.ones(len(points))
    for shape, axis, numbers in region_rows()[name]:
        weight *= FORMS[shape](points[near] * MM_PER_M, axis, *numbers)
        near, weight = near[weight != 0.0], weight[weight != 0.0]
    out = np.zeros(len(points))
    out[near] = weight
    return out


def _ramp(points: Points, axis: str, start: float, end: float) -> Floats:
    """0 at ``start``, 1 at ``end`` of a coordinate."""
    return exact.smoothstep((_coordinate(points, axis) - start) / (end - start))


def _ball(points: Points, axis: str, x: float, y: float, z: float, inner: float, outer: float) -> Floats:
    """1 within the inner radius about a place, 0 beyond the outer one."""
    return exact.smoothstep((outer - length(points - np.array([x, y, z]))) / (outer - inner))


def _span(points: Points, axis: str, origin: float, start: float, full: float, fading: float, end: float) -> Floats:
    """Share of a scaling about ``origin`` that stretches only what lies between ``start`` and ``end``.

    What lies beyond the end goes along as one. The stretch is full between ``full`` and ``fading``; its sum from the
    origin on, divided by the distance from there, is the share.
    """
    way = 1.0 if end > origin else -1.0
    place = (_coordinate(points, axis) - origin) * way
    marks = [(mark - origin) * way for mark in (start, full, fading, end)]
    summed = _rising(place, marks[0], marks[1]) - _rising(place, marks[2], marks[3])
    return np.where(summed > 0.0, summed / np.maximum(place, 1e-9), 0.0)


def _rising(x: Floats, start: float, end: float) -> Floats:
    """The integral of a smooth step from 0 at ``start`` to 1 at ``end``."""
    width = end - start
    t = np.clip((x - start) / width, 0.0, 1.0)
    return width * t * t * t * (1.0 - 0.5 * t) + np.maximum(x - end, 0.0)


def _coordinate(points: Points, axis: str) -> Floats:
    column = points[:, "xyz".index(axis.strip("|"))]
    return np.abs(column) if axis.startswith("|") else column


FORMS: Mapping[str, Callable[..., Floats]] = {"ramp": _ramp, "ball": _ball, "span": _span}
