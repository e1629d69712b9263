"""Keys of a JSON object that are taken one by one; what nobody takes is unknown."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, TypeVar

from mien.core import MienError, UnknownNameError

from .records import Knots, Point

Name = TypeVar("Name", bound=str)

MISSING = object()


class Fields:
    """A JSON object with its place in the file, for messages."""

    def __init__(self, value: Any, place: str) -> None:
        self.place = place
        if not isinstance(value, dict):
            raise MienError(f"{place or 'the file'}: want an object {{…}}, got {_kind(value)}")
        self._value: Mapping[str, Any] = value
        self._taken: set[str] = set()
        self._groups: dict[str, Fields] = {}

    @property
    def keys(self) -> tuple[str, ...]:
        """All keys that it has."""
        return tuple(self._value)

    def at(self, key: str) -> str:
        """Place of a key in the file."""
        return ".".join(part for part in (self.place, key) if part)

    def error(self, key: str, message: str) -> MienError:
        """What is wrong, with its place."""
        return MienError(f"{self.at(key)}: {message}")

    def done(self) -> None:
        """Nothing, when every key was asked for.

        Raises:
            UnknownNameError: a key was not.
        """
        for key in self._value:
            if key not in self._taken:
                raise UnknownNameError(f"{self.place or 'the file'}: key", key, self._taken)

    def raw(self, key: str, default: Any = MISSING) -> Any:
        """The value of a key, whatever it is."""
        self._taken.add(key)
        value = self._value.get(key, default)
        if value is MISSING:
            raise self.error(key, "is missing")
        return value

    def text(self, key: str, default: Any = MISSING) -> str:
        """A text."""
        value = self.raw(key, default)
        if not isinstance(value, str):
            raise self.error(key, f"want a text, got {_kind(value)}")
        return value

    def choice(self, key: str, choices: Sequence[Name], default: Any = MISSING) -> Name:
        """One of some texts."""
        value = self.text(key, default)
        for choice in choices:
            if value == choice:
                return choice
        raise UnknownNameError(f"{self.at(key)}:", value, choices)

    def flag(self, key: str) -> bool:
        """True or false; false where there is no such key."""
        value = self.raw(key, False)
        if not isinstance(value, bool):
            raise self.error(key, f"want true or false, got {_kind(value)}")
        return value

    def number(self, key: str, default: Any = MISSING) -> float:
        """A finite number."""
        return _number(self.raw(key, default), self.at(key))

    def point(self, key: str, default: Any = MISSING) -> Point:
        """Two numbers."""
        value = self.raw(key, default)
        if not isinstance(value, list | tuple) or len(value) != 2:
            raise self.error(key, f"want two numbers [a, b], got {_kind(value)}")
        return _number(value[0], self.at(key)), _number(value[1], self.at(key))

    def points(self, key: str) -> list[Point]:
        """Three points or more."""
        value = self.raw(key)
        if not isinstance(value, list) or len(value) < 3:
            raise self.error(key, f"want path data or at least three points [[x, y], …], got {_kind(value)}")
        return [Fields({"": each}, self.at(key)).point("") for each in value]

    def knots(self, key: str) -> Knots:
        """A number, or (place, value) pairs in order."""
        value = self.raw(key)
        if not isinstance(value, list):
            return ((0.0, self.number(key)),)
        pairs = [Fields({"": each}, self.at(key)).point("") for each in value]
        if not pairs or any(one[0] >= other[0] for one, other in pairwise(pairs)):
            raise self.error(key, "want a number, or pairs [place, value] with places in order")
        return tuple(pairs)

    def names(self, key: str) -> tuple[str, ...]:
        """A text or a list of texts; none where there is no such key."""
        value = self.raw(key, [])
        listed = value if isinstance(value, list) else [value]
        if not all(isinstance(each, str) for each in listed):
            raise self.error(key, "want a text or a list of texts")
        return tuple(listed)

    def is_group(self, key: str) -> bool:
        """Whether a key holds an object."""
        return isinstance(self._value.get(key), dict)

    def inner(self, key: str) -> Fields:
        """The object of a key; asked for twice it is the same one."""
        if key not in self._groups:
            self._groups[key] = Fields(self.raw(key), self.at(key))
        return self._groups[key]

    def group(self, key: str) -> Iterator[tuple[str, Fields]]:
        """Name and object of each key in the object of a key; none where there is no such key."""
        if key in self._value:
            inner = self.inner(key)
            yield from ((name, inner.inner(name)) for name in inner.keys)

    def lists(self, key: str) -> Iterator[tuple[str, list[Fields]]]:
        """Name and objects of each list in the object of a key."""
        if key in self._value:
            inner = self.inner(key)
            yield from ((name, list(inner.items(name))) for name in inner.keys)

    def items(self, key: str) -> Iterator[Fields]:
        """The objects in a list."""
        value = self.raw(key)
        if not isinstance(value, list):
            raise self.error(key, f"want a list […], got {_kind(value)}")
        for number, each in enumerate(value):
            yield Fields(each, f"{self.at(key)}[{number}]")


def _number(value: Any, place: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise MienError(f"{place}: want a number, got {_kind(value)}")
    if not math.isfinite(value) or abs(value) > 1e6:
        raise MienError(f"{place}: want a number within a million of 0, got {value!r:.40}")
    return float(value)


def _kind(value: Any) -> str:
    if isinstance(value, str):
        return f"the text {value!r:.40}"
    names = {dict: "an object", list: "a list", bool: "true or false", type(None): "null", int: "a number"}
    return f"{names.get(type(value), 'a number')}" + (f" {value!r:.40}" if isinstance(value, int | float) else "")
