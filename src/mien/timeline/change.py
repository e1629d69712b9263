"""Parke's four parameter change functions: how a value goes from its first to its last.

Source: Parke 1974, section 4.1. Print lost the brackets of three of them; each runs from 0 to 1 (Parke 1972 has the
cosine right).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mien.core import UnknownNameError, exact

Change = Callable[[ArrayLike], NDArray[np.float64]]


def linear(fraction: ArrayLike) -> NDArray[np.float64]:
    """The fraction itself, held in 0..1, any shape.

    Source: Parke 1974, section 4.1, PCF = FF.
    """
    return np.clip(np.asarray(fraction, dtype=np.float64), 0.0, 1.0)


def cosine(fraction: ArrayLike) -> NDArray[np.float64]:
    """(1 - cos(pi f)) / 2: slow at both ends, any shape.

    Source: Parke 1972 and 1974, section 4.1.
    """
    f = linear(fraction)
    return _to_one(f, 0.5 * (1.0 - exact.cos(f * math.pi)))


def ease_in(fraction: ArrayLike) -> NDArray[np.float64]:
    """1 - cos(pi f / 2): slow at the start, any shape.

    Source: Parke 1974, section 4.1.
    """
    f = linear(fraction)
    return _to_one(f, 1.0 - exact.cos(f * (0.5 * math.pi)))


def ease_out(fraction: ArrayLike) -> NDArray[np.float64]:
    """sin(pi f / 2): slow at the end, any shape.

    Source: Parke 1974, section 4.1.
    """
    f = linear(fraction)
    return _to_one(f, exact.sin(f * (0.5 * math.pi)))


CHANGES: Mapping[str, Change] = MappingProxyType(
    {"linear": linear, "cosine": cosine, "ease-in": ease_in, "ease-out": ease_out}
)
"""Change function of each name. New ones go to the end: tracks keep the row number."""

CHANGE_NAMES: tuple[str, ...] = tuple(CHANGES)


def change_code(name: str) -> int:
    """Row number of a change function.

    Raises:
        UnknownNameError: there is none of that name.
    """
    if name not in CHANGES:
        raise UnknownNameError("change function", name, CHANGE_NAMES)
    return CHANGE_NAMES.index(name)


def _to_one(fraction: NDArray[np.float64], share: NDArray[np.float64]) -> NDArray[np.float64]:
    # cos(pi/2) is 6e-17 in floating point, but a change that is over must be over exactly.
    return np.where(fraction >= 1.0, 1.0, share)
