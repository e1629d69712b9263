"""The lines of a JSON text on which its values stand."""

from __future__ import annotations

import json
import re
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from .checks_faults import Place

# A text without an end takes the rest, so that no text is looked at twice.
_STRING = r'"(?:[^"\\]|\\.)*+(?:"|\Z)'
_BRACKETS = re.compile(rf"{_STRING}|[{{}}\[\]]", re.DOTALL)
_TOKENS = re.compile(rf'{_STRING}|[{{}}\[\],:]|[^\s{{}}\[\],:"]+', re.DOTALL)


@dataclass(frozen=True)
class Places:
    """Where things stand in a JSON text.

    Attributes:
        lines: of each value, from 1; of a member of an object that of its key.
        repeated: keys that their object has had before, with the line of the later one.
    """

    lines: Mapping[Place, int]
    repeated: tuple[tuple[Place, int], ...]

    def line(self, place: Place) -> int:
        """The line of a value, or of the nearest one around it that there is."""
        return next(self.lines[place[:end]] for end in range(len(place), -1, -1) if place[:end] in self.lines)


@dataclass
class _Container:
    """An object or list that has begun and not yet ended."""

    place: Place
    key: str | int | None
    keys: set[str] = field(default_factory=set)


def find_depth(text: str, limit: int) -> int | None:
    """The line on which a text, JSON or not, is nested deeper than ``limit``; None where it is nowhere."""
    depth = 0
    for match in _BRACKETS.finditer(text):
        depth += {"{": 1, "[": 1, "}": -1, "]": -1}.get(match[0], 0)
        if depth > limit:
            return text.count("\n", 0, match.start()) + 1
    return None


def find_places(text: str) -> Places:
    """Where everything stands in a text that is JSON."""
    starts = [0, *(match.end() for match in re.finditer("\n", text))]
    lines: dict[Place, int] = {}
    repeated: list[tuple[Place, int]] = []
    for offset, place, again in _walk(text):
        line = bisect_right(starts, offset)
        lines[place] = line
        if again:
            repeated.append((place, line))
    return Places(lines, tuple(repeated))


def _walk(text: str) -> Iterator[tuple[int, Place, bool]]:
    """(offset, place, whether its object has had it before) of each key, list item and the document itself."""
    inside: list[_Container] = []
    for match in _TOKENS.finditer(text):
        token = match[0]
        if token in "}]":
            inside.pop()
            continue
        place: Place = ()
        if inside:
            top = inside[-1]
            if token == ",":
                top.key = top.key + 1 if isinstance(top.key, int) else None
            if token in ",:":
                continue
            if top.key is None:
                yield _enter(top, match.start(), json.loads(token))
                continue
            place = (*top.place, top.key)
        if not inside or isinstance(inside[-1].key, int):
            yield match.start(), place, False
        if token in "{[":
            inside.append(_Container(place, None if token == "{" else 0))


def _enter(container: _Container, offset: int, key: str) -> tuple[int, Place, bool]:
    """A key of an object, which from here on stands at its value."""
    again = key in container.keys
    container.keys.add(key)
    container.key = key
    return offset, (*container.place, key), again
