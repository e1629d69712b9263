"""What a kernel takes and gives, as a line of text: ``f8[:,:], i8[:], i8 -> i8``."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

_ARGUMENT = re.compile(r"([a-z]\d)(?:\[(:(?:,:)*)\])?")

_SCALARS = ("f8", "i8")


@dataclass(frozen=True)
class Argument:
    """One argument.

    Attributes:
        dtype: of the number, or of the array's elements.
        ndim: dimensions of a C-contiguous array; 0 is a number.
    """

    dtype: np.dtype[np.generic]
    ndim: int


@dataclass(frozen=True)
class Signature:
    """The arguments in order, and whether a whole number comes back."""

    arguments: tuple[Argument, ...]
    returns: bool


def parse_signature(text: str) -> Signature:
    """The signature in a text.

    Raises:
        ValueError: it is none.
    """
    given, arrow, result = text.partition("->")
    if arrow and result.strip() != "i8":
        raise ValueError(f"signature {text!r}: a kernel gives back i8 or nothing")
    arguments = []
    for part in re.split(r",\s+", given.strip()):
        match = _ARGUMENT.fullmatch(part.strip())
        if match is None:
            raise ValueError(f"signature {text!r}: {part!r} is neither a number like f8 nor an array like f8[:,:]")
        code, colons = match.groups()
        if not colons and code not in _SCALARS:
            raise ValueError(f"signature {text!r}: a number is f8 or i8, not {code}")
        arguments.append(Argument(np.dtype(code), colons.count(":") if colons else 0))
    return Signature(tuple(arguments), bool(arrow))
