"""Caricature: what is told by the distance from rest, told louder or softer.

Two distances can be scaled, and they do not meet: how far an expression is from neutral, and how far a person is from
the mean of people.

Source: Thórisson 1996, Appendix A1.1 (a caricature exaggerates the important features), after Brennan 1985, Caricature
generator, Leonardo 18 (the distance from the mean of people, multiplied).
"""

from __future__ import annotations

import math

import numpy as np

from .errors import RangeError
from .parameters import Pose, Values

Numbers = float | Values

HIGHEST = 3.0
"""Beyond it most values lie at the ends of their ranges, and one expression looks like the next: our choice."""


def exaggerate(pose: Pose, amount: float) -> Pose:
    """The pose with all that expresses something ``amount`` times as far from rest; 1 is the pose itself, 0 neutral
    but for what is shut.

    Values come near to the ends of their ranges without passing them, and keep their order (``stretch``). What is shut
    stays shut. Where the eyes look stays, since twice the angle is another target; so does what brings the lips
    together, which is there or not there; and who it is.

    Raises:
        RangeError: the amount is not in 0..``HIGHEST``.
    """
    return _scale(pose, amount, "motion", pose.table.defaults)


def caricature(pose: Pose, amount: float) -> Pose:
    """The pose of a person whose shape is ``amount`` times as far from the mean of people; 0 is the mean itself.

    Colours stay, and all that moves. A face whose table tells no mean is its own.

    Source: Brennan 1985, Caricature generator, Leonardo 18.

    Raises:
        RangeError: the amount is not in 0..``HIGHEST``.
    """
    usual = [row.default if row.usual is None else row.usual for row in pose.table]
    return _scale(pose, amount, "shape", np.array(usual))


def check_amount(amount: float) -> None:
    """Nothing, when so much exaggeration can be had.

    Raises:
        RangeError: the amount is not in 0..``HIGHEST``.
    """
    if not 0.0 <= amount <= HIGHEST:
        raise RangeError(
            f"exaggeration {amount:g} is out of range — it goes from 0 to {HIGHEST:g}, and 1 leaves all as it is"
        )


def stretch(
    values: Values, amount: float, *, rest: Numbers, low: Numbers, high: Numbers, closed: Numbers = math.nan
) -> Values:
    """Values with their distance from rest multiplied, bent so that an end of the range stays where it is.

    With u = the share of the way from rest to the end, u' = a u / (1 + (a⁴ - 1) u⁴)^¼: a small distance is
    multiplied by the amount, the end is kept, and every value stays on its side of every other. Two amounts one after
    the other are their product. Less than the full distance (a < 1) is a plain multiplication, but on a way to an end
    at which something is shut. Values beyond the end stay where they are.

    Args:
        values: (N,) any values.
        amount: a, 0 or more; 1 gives the values to the bit.
        rest: (N,) or one for all: where nothing changes; ``low`` and ``high`` likewise.
        low: least value.
        high: greatest value.
        closed: the end at which something is shut; NaN for none.
    """
    if amount == 1.0:
        return values
    way = values - rest
    end = np.where(way < 0.0, low, high)
    room = np.abs(end - rest)
    share = np.where(room > 0.0, np.abs(way) / np.where(room > 0.0, room, 1.0), 1.0)
    bent = (end == closed) | (amount > 1.0)
    inside = share < 1.0
    steep = np.where(inside, 1.0 + (amount * amount * amount * amount - 1.0) * _fourth(share * inside), 1.0)
    factor = np.where(bent, np.where(inside, amount / np.sqrt(np.sqrt(steep)), 1.0), amount)
    return np.where(factor == 1.0, values, rest + way * factor)


def _fourth(share: Values) -> Values:
    square = share * share
    return square * square


def _scale(pose: Pose, amount: float, role: str, rest: Values) -> Pose:
    """The pose with the rows of a role stretched."""
    check_amount(amount)
    if amount == 1.0:
        return pose
    table = pose.table
    closed = np.array([math.nan if row.closed is None else row.closed for row in table])
    scaled = stretch(pose.values, amount, rest=rest, low=table.lows, high=table.highs, closed=closed)
    of_role = np.array([row.role == role for row in table], dtype=np.bool_)
    # Rounding alone can pass an end.
    return Pose(table, np.where(of_role, np.clip(scaled, table.lows, table.highs), pose.values))
