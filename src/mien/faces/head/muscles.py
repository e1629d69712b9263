"""Expressions measured on ICT-FaceKit: one delta of the whole cage a row, added with the parameter as its weight.

They are what Parke's list lacks and today's vocabularies need; his own parameters have mechanisms of their own.
The rows with a ``morph`` in ``data/parameters.csv`` say which.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from mien.core.mesh import Points

from .moves import Move
from .rest import REST_OPENING
from .table import face_rows

SIDEWAYS = (("jaw.side", "jawLeft", "jawRight"), ("mouth.side", "mouthLeft", "mouthRight"))
"""Parameters between two mirrored expressions; positive is the own left."""


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


def lid_moves(morphs: Mapping[str, Points]) -> list[Move]:
    """What the arcs of the lids lack: the measured wide eye, and the slide of shutting lids towards the nose."""
    out = []
    for side, letter in (("left", "L"), ("right", "R")):
        opening = f"eyelid.opening.{side}"
        for name, span in (("eyeWide", 1.0 - REST_OPENING), ("lidSlide", -REST_OPENING)):
            out.append(Move(opening, morphs[f"{name}_{letter}"], rest=REST_OPENING, span=span, one_way=True))
    return out


def muscle_moves(morphs: Mapping[str, Points]) -> list[Move]:
    """Every expression in table order, then what goes to either side, then the lids."""
    out = [Move(parameter, morphs[morph]) for parameter, morph in muscles()]
    for parameter, left, right in SIDEWAYS:
        out += [Move(parameter, morphs[left], one_way=True), Move(parameter, morphs[right], span=-1.0, one_way=True)]
    return [*out, *lid_moves(morphs)]
