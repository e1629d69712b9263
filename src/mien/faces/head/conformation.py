"""The shape of a head: what differs from person to person, by Parke's three mechanisms on regions of the head.

Interpolation between measured extremes is a move of the skin like an expression (``moves``). Scaling and translation
are steps that act on the posed head, the smallest region first, so that each finds its region where the pictures of
the parameters show it. A point's share of a step is fixed by where it lies on the resting head; so lips that meet go
on meeting, whatever the shape. The rows of ``data/conformation.csv`` say which parameter does what.

Source: Parke 1974, section 3.4 and figure 3.15; section 5.1 for what he wished for.
"""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.compiling import kernel
from mien.core import ParameterTable
from mien.core.mesh import Ints, Points

from .angles import turn
from .measured import Floats
from .moves import Move
from .regions import MM_PER_M, weigh_region
from .table import conformation_rows
from .units import DEG, PARKE_UNIT_M

AFFINE, LIDS, TURN = range(3)
KINDS = {"blend": AFFINE, "field": AFFINE, "scale": AFFINE, "move": AFFINE, "lids": LIDS, "turn": TURN}
FIELDS = ("blend", "field")
UNITS = {"Parke unit": PARKE_UNIT_M, "deg": DEG, "factor": 1.0, "share": 1.0}
TO_EITHER_SIDE = (("move", "x"), ("turn", "y"))
OUTWARDS = {"move": 1.0, "turn": -1.0}
"""Sign that takes what lies on the left outwards; the right mirrors it."""

RIGID = "rigid lids"
MOVE_WITH_EYE = ("lids", "eye", "face")
"""Regions whose steps the lids follow point by point; to all others an eye and its lids are one rigid piece."""


@dataclass(frozen=True)
class Step:
    """One parameter's step.

    Attributes:
        parameter: its name, with its side.
        kind: blend, field, scale, move, lids or turn.
        axes: which of x, y, z it changes; that of a turn.
        region: where it acts, or the name of a field.
        origin: (3,) m, what stays.
        side: 1 left, -1 right, 0 both.
        sign: -1 where the right side moves against the left one.
        rest: value of the parameter that changes nothing.
        gain: of the step for one unit.
    """

    parameter: str
    kind: str
    axes: str
    region: str
    origin: tuple[float, float, float]
    side: int
    sign: float
    rest: float
    gain: float


def shape_steps(centres: Points) -> tuple[Step, ...]:
    """The steps in the order in which they act; ``centres`` (2, 3) m are those of the eyes."""
    out = []
    for row in conformation_rows():
        if row["kind"] not in KINDS:
            continue
        rest = float(row["default"])
        for side, ending in ((1, ".left"), (-1, ".right")) if row["sides"] else ((0, ""),):
            sign = side * OUTWARDS[row["kind"]] if side and (row["kind"], row["axis"]) in TO_EITHER_SIDE else 1.0
            origin = _origin(row["origin"], side, centres)
            region = row["name"] + ending if row["kind"] == "blend" else row["region"]
            cells = row["kind"], row["axis"], region, origin, side, sign, rest, _gain(row)
            out.append(Step(row["name"] + ending, *cells))
    return tuple(out)


def _gain(row: Mapping[str, str]) -> float:
    """The step for one unit of a parameter."""
    rest, high = float(row["default"]), float(row["high"])
    if row["kind"] == "blend":
        return 1.0 / (high - rest)
    if row["kind"] == "scale" and row["unit"] == "Parke unit":
        return 1.0 / rest  # a size in his units scales by its ratio to rest
    return UNITS[row["unit"]]


def blend_moves(directions: Mapping[str, Points]) -> list[Move]:
    """Parke's interpolations of the shape as moves of the skin, from measured directions (V, 3) m by name."""
    steps = [step for step in shape_steps(np.zeros((2, 3))) if step.kind == "blend"]
    return [Move(step.parameter, directions[step.region], rest=step.rest, span=1.0 / step.gain) for step in steps]


def _origin(text: str, side: int, centres: Points) -> tuple[float, float, float]:
    if text == "eye":
        x, y, z = (float(value) for value in centres[0 if side > 0 else 1])
        return x, y, z
    x, y, z = (float(number) / MM_PER_M for number in text.split()) if text else (0.0, 0.0, 0.0)
    return (-x if side < 0 else x), y, z


@dataclass(frozen=True, eq=False)
class Shares:
    """What a set of points takes from each step.

    Attributes:
        starts: (K + 1,) run of entries of each step.
        rows: (E,) number of the point.
        weights: (E, 4) share of the step, and a move (3,) for one unit of it.
    """

    starts: Ints
    rows: Ints
    weights: Floats


Arrays = tuple[NDArray[Any], ...]

REMEMBERED = 8
"""Sets of steps, and shapes of what no expression moves, that are kept."""

Fields = Callable[[str], Points | None]
"""Moves (N, 3) m of a set of points for one unit of a field, by its name; None where it has none."""


def no_fields(name: str) -> Points | None:
    """None: points that no field moves."""
    return None


def shares_of(steps: Sequence[Step], points: Points, centres: Points, fields: Fields = no_fields) -> Shares:
    """The shares that resting points (N, 3) m take of steps; ``centres`` (2, 3) m are those of the eyes."""
    lids = [weigh_region(RIGID, points * (side, 1.0, 1.0)) for side in (1.0, -1.0)]
    starts, rows, weights = [0], [np.zeros(0, dtype=np.int64)], [np.zeros((0, 4))]
    for step in steps:
        entry = np.zeros((len(points), 4))
        if step.kind not in FIELDS:
            entry = _entries(step, points, centres, lids)
        elif (field := fields(step.region)) is not None:
            entry[:, 1:] = field
        near = np.flatnonzero(entry.any(axis=1))
        rows.append(near)
        weights.append(entry[near])
        starts.append(starts[-1] + len(near))
    return Shares(np.array(starts, dtype=np.int64), np.concatenate(rows), np.concatenate(weights))


class Shaper:
    """The steps of one head as arrays, made for those that a pose needs.

    Args:
        table: the head's parameters.
        centres: (2, 3) m of the eyes.
        points: sets of resting points (N, 3) m, each of which gets shares of its own, with the fields of each. No
            expression moves the last set.
    """

    def __init__(self, table: ParameterTable, centres: Points, points: Sequence[tuple[Points, Fields]]) -> None:
        self._steps, self._centres, self._points = shape_steps(centres), centres, points
        self._columns = np.array([table.index[step.parameter] for step in self._steps], dtype=np.int64)
        self._rules = np.array([(step.rest, step.gain) for step in self._steps])
        self._made: OrderedDict[tuple[int, ...], tuple[Arrays, list[Shares]]] = OrderedDict()
        self._still: OrderedDict[bytes, Points] = OrderedDict()

    def amounts(self, values: Floats) -> Floats:
        """(N, K) how far each step goes in poses (N, P)."""
        return np.asarray((values[:, self._columns] - self._rules[:, 0]) * self._rules[:, 1])

    def arrays(self, amounts: Floats) -> Arrays:
        """The steps that go somewhere as ``shape_points`` takes them.

        Amounts (N, T), kinds, axes and origins; then the shares of each set but the last.
        """
        taken = _taken(amounts)
        steps, shares = self._make(taken)
        flat = (array for each in shares[:-1] for array in (each.starts, each.rows, each.weights))
        return np.ascontiguousarray(amounts[:, list(taken)]), *steps, *flat

    def still(self, amounts: Floats) -> Points:
        """(N, 3) m, the last set as the steps of one pose (K,) leave it."""
        key = amounts.tobytes()
        if key not in self._still:
            taken = _taken(amounts[None])
            steps, shares = self._make(taken)
            points, last = self._points[-1][0].copy(), shares[-1]
            going = np.ascontiguousarray(amounts[list(taken)])
            if taken:  # to load compiled code takes longer than all else here
                shape_still(points, going, *steps, last.starts, last.rows, last.weights)
            _remember(self._still, key, points)
        return self._still[key]

    def _make(self, taken: tuple[int, ...]) -> tuple[Arrays, list[Shares]]:
        if taken not in self._made:
            steps = [self._steps[k] for k in taken]
            kinds = np.array([KINDS[step.kind] for step in steps], dtype=np.int64)
            axes = np.array([[float(axis in step.axes) for axis in "xyz"] for step in steps]).reshape(-1, 3)
            origins = np.array([step.origin for step in steps]).reshape(-1, 3)
            shares = [shares_of(steps, points, self._centres, fields) for points, fields in self._points]
            _remember(self._made, taken, ((kinds, axes, origins), shares))
        return self._made[taken]


def _taken(amounts: Floats) -> tuple[int, ...]:
    """Numbers of the steps that go somewhere in one of the poses (N, K)."""
    return tuple(int(k) for k in np.flatnonzero(amounts.any(axis=0)))


def _remember(known: OrderedDict[Any, Any], key: object, value: object) -> None:
    known[key] = value
    while len(known) > REMEMBERED:
        known.popitem(last=False)


def _entries(step: Step, points: Points, centres: Points, lids: list[Floats]) -> Floats:
    """(N, 4) share and move of every point for one step."""
    out = _take(step, points)
    if step.region not in MOVE_WITH_EYE:
        for rigid, centre in zip(lids, centres, strict=True):
            share, *move = _take(step, centre[None])[0]
            axes = np.array([float(axis in step.axes) for axis in "xyz"])
            whole = (share * (centre - step.origin) if step.kind == "scale" else np.zeros(3)) * axes + move
            near = np.flatnonzero(rigid)
            held = rigid[near, None]
            out[near, 1:] = out[near, 1:] * (1.0 - held) + held * whole
            out[near, :1] *= 1.0 - held
    return out


def _take(step: Step, points: Points) -> Floats:
    """(N, 4) share and move of points for one step, as if there were no lids."""
    side = -1.0 if step.side < 0 else 1.0
    weight = weigh_region(step.region, points * (side, 1.0, 1.0))
    if step.side:
        weight = np.where(points[:, 0] * side > 0.0, weight, 0.0)
    out = np.zeros((len(points), 4))
    if step.kind == "move":
        out[:, 1 + "xyz".index(step.axes)] = weight * step.sign
    else:
        out[:, 0] = weight * step.sign
    return out


@kernel()
def shape_points(points, steps, starts, rows, weights):
    """Change posed points (N, 3) m by all steps, one after the other.

    Args:
        points: changed.
        steps: amounts (K,), kinds, axes and origins of ``Shaper.arrays``.
        starts: rows, weights: of ``Shares``.
    """
    amounts, kinds, axes, origins = steps
    for k in range(len(amounts)):
        amount = amounts[k]
        if amount == 0.0:
            continue
        along_x, along_y, along_z = axes[k, 0], axes[k, 1], axes[k, 2]
        for entry in range(starts[k], starts[k + 1]):
            v, share = rows[entry], weights[entry, 0] * amount
            x, y, z = points[v, 0] - origins[k, 0], points[v, 1] - origins[k, 1], points[v, 2] - origins[k, 2]
            if kinds[k] == AFFINE:
                x += share * along_x * x + amount * weights[entry, 1]
                y += share * along_y * y + amount * weights[entry, 2]
                z += share * along_z * z + amount * weights[entry, 3]
            elif kinds[k] == LIDS:
                # Height and width are scaled, then projected back on the sphere (Parke 1974, section 3.1.2).
                before = x * x + y * y + z * z
                x, y = x + share * along_x * x, y + share * along_y * y
                after = x * x + y * y + z * z
                if after > 0.0:
                    back = np.sqrt(before / after)
                    x, y, z = x * back, y * back, z * back
            else:
                z, x = turn(z, x, share)
            points[v, 0], points[v, 1], points[v, 2] = x + origins[k, 0], y + origins[k, 1], z + origins[k, 2]


@kernel()
def shape_held(balls, steps, starts, rows, weights, held):
    """Fill ``held`` (3, 4) m with ``balls`` (3, 4), centres and radii of the eyes and the neck's pivot, shaped.

    A step that scales all three axes scales the radius.
    """
    amounts, kinds, axes, _ = steps
    for n in range(len(balls)):
        for axis in range(4):
            held[n, axis] = balls[n, axis]
    for k in range(len(amounts)):
        if amounts[k] != 0.0 and kinds[k] == AFFINE and axes[k, 0] * axes[k, 1] * axes[k, 2] != 0.0:
            for entry in range(starts[k], starts[k + 1]):
                held[rows[entry], 3] *= 1.0 + amounts[k] * weights[entry, 0]
    shape_points(held, steps, starts, rows, weights)


@kernel("f8[:,:], f8[:], i8[:], f8[:,:], f8[:,:], i8[:], i8[:], f8[:,:]")
def shape_still(points, amounts, kinds, axes, origins, starts, rows, weights):
    """Change points (N, 3) m that no expression moves, as ``shape_points`` does."""
    shape_points(points, (amounts, kinds, axes, origins), starts, rows, weights)
