"""Expressions measured on ICT-FaceKit: one delta of the whole cage a row, added with the parameter as its weight.

They are what Parke's list lacks and today's vocabularies need; his own parameters have mechanisms of their own.
The rows with a ``morph`` in ``data/parameters.csv`` say which.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from mien.core import Pose
from mien.core.mesh import Points

from .table import face_rows


@cache
def muscles() -> tuple[tuple[str, str], ...]:
    """(parameter, name of the measured expression), in table order."""
    out: list[tuple[str, str]] = []
    for row in face_rows():
        if row["morph"] and row["sides"]:
            out += [(row["name"] + ".left", row["morph"] + "_L"), (row["name"] + ".right", row["morph"] + "_R")]
        elif row["morph"]:
            out.append((row["name"], row["morph"]))
    return tuple(out)


def contract_muscles(points: Points, pose: Pose, morphs: Mapping[str, Points]) -> Points:
    """Points (V, 3) m with every active expression added, in table order."""
    out = points.copy()
    for parameter, morph in muscles():
        amount = pose[parameter]
        if amount:
            out += amount * morphs[morph]
    return out


def add_sideways(points: Points, amount: float, left: Points, right: Points) -> Points:
    """Points moved ``amount`` (-1..1) of the way of one of two mirrored deltas; positive is the own left."""
    if not amount:
        return points
    return points + (amount * left if amount > 0.0 else -amount * right)
