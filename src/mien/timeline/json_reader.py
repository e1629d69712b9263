"""A JSON value that knows where it stands, so that a complaint names file and place."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import LoadError, UnknownNameError


@dataclass(frozen=True)
class Node:
    """One value in a JSON document.

    Attributes:
        value: as ``json.loads`` gives it.
        source: the document's name.
        place: the way to it, such as ``layers[2].name``; empty at the top.
    """

    value: Any
    source: str
    place: str = ""

    def error(self, message: str, hint: str = "") -> LoadError:
        """The error to raise about this value."""
        return LoadError(self.source, f"{self.place or 'document'}: {message}", hint=hint)

    def members(self, required: Sequence[str], optional: Sequence[str] = ()) -> dict[str, Node]:
        """The members of an object that may have these keys and no other.

        Raises:
            LoadError: it is no object, a key is unknown or a required one is missing.
        """
        members = dict(self.entries())
        known = [*required, *optional]
        for key in members:
            if key not in known:
                raise self.error(str(UnknownNameError("key", key, known)))
        for key in required:
            if key not in members:
                raise self.error(f"{key!r} is missing")
        return members

    def entries(self) -> Iterator[tuple[str, Node]]:
        """The members of an object with any keys, in order."""
        if not isinstance(self.value, dict):
            raise self._mismatch("an object")
        for key, value in self.value.items():
            plain = key.isidentifier()
            place = (f"{self.place}.{key}" if self.place else key) if plain else f"{self.place}[{json.dumps(key)}]"
            yield key, Node(value, self.source, place)

    def items(self, count: int | None = None) -> Iterator[Node]:
        """The elements of a list, ``count`` of them when given."""
        if not isinstance(self.value, list):
            raise self._mismatch("a list")
        if count is not None and len(self.value) != count:
            raise self.error(f"want a list of {count}, got one of {len(self.value)}")
        for number, value in enumerate(self.value):
            yield Node(value, self.source, f"{self.place}[{number}]")

    def text(self) -> str:
        """A text."""
        if not isinstance(self.value, str):
            raise self._mismatch("a text")
        return self.value

    def number(self) -> float:
        """A finite number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            raise self._mismatch("a number")
        try:
            number = float(self.value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise self._mismatch("a finite number")
        return number

    def integer(self) -> int:
        """A whole number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            raise self._mismatch("a whole number")
        return self.value

    def numbers(self) -> NDArray[np.float64]:
        """A list of finite numbers as an array (N,), read-only."""
        if not isinstance(self.value, list):
            raise self._mismatch("a list of numbers")
        array = np.empty(0)
        if set(map(type, self.value)) <= {float}:
            array = np.array(self.value, dtype=np.float64)
        if len(array) != len(self.value) or not np.all(np.isfinite(array)):
            array = np.array([item.number() for item in self.items()], dtype=np.float64)
        array.flags.writeable = False
        return array

    def _mismatch(self, wanted: str) -> LoadError:
        shown = json.dumps(self.value, ensure_ascii=False)
        return self.error(f"want {wanted}, got {shown if len(shown) <= 40 else shown[:37] + '...'}")


def parse_json(text: str, source: str) -> Node:
    """The document that a text is.

    Raises:
        LoadError: it is no JSON, or nested deeper than anything of ours.
    """
    try:
        return Node(json.loads(text), source)
    except json.JSONDecodeError as error:
        raise LoadError(source, f"is not JSON: {error.msg}", line=error.lineno) from None
    except RecursionError:
        raise LoadError(source, "is nested too deeply") from None
