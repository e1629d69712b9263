"""What is added to the resting skin: constant moves, each as much as one parameter is away from its rest.

Parke's interpolation between two sets of points is such a move: the difference of the sets, times a share.

Source: Parke 1974, section 2.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mien.core import ParameterTable
from mien.core.mesh import Ints, Points

from .measured import Floats


@dataclass(frozen=True, eq=False)
class Move:
    """One move of the skin.

    Attributes:
        parameter: what it follows.
        delta: (V, 3) m.
        share: of the delta that is added when the parameter is a span away from rest.
        rest: value of the parameter that adds nothing.
        span: negative where falling values add.
        one_way: values on the other side of rest add nothing.
    """

    parameter: str
    delta: Points
    share: float = 1.0
    rest: float = 0.0
    span: float = 1.0
    one_way: bool = False


@dataclass(frozen=True, eq=False)
class Moves:
    """Moves as arrays, in the order in which they are added.

    Attributes:
        columns: (M,) column of each move's parameter in the table.
        rules: (M, 4) rest, span, share, and 1 where the move is one-way.
        deltas: (M, 3 V) m.
    """

    columns: Ints
    rules: Floats
    deltas: Floats


def moves_of(moves: Sequence[Move], table: ParameterTable) -> Moves:
    """The moves with their parameters looked up."""
    return Moves(
        np.array([table.index[move.parameter] for move in moves], dtype=np.int64),
        np.array([(move.rest, move.span, move.share, float(move.one_way)) for move in moves]),
        np.stack([move.delta.ravel() for move in moves]),
    )
