"""Tables of a TOML file, read key by key: what is wrong is told with its line and key."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mien.core import LoadError, UnknownNameError
from mien.formats.cue_text import read_text

MOST = 1e9
"""What no length or size of a project is as large as."""

SHOWN = 60
"""Letters of a value that a message shows."""

_HEADER = re.compile(r"\s*\[\[?\s*(?:\"([^\"]*)\"|([\w-]+))\s*\]\]?\s*(?:#.*)?")
_KEY = re.compile(r"\s*(?:\"([^\"]*)\"|([\w-]+))\s*=")
_PLACE = re.compile(r" \(at (?:line (\d+), column \d+|end of document)\)")


@dataclass
class Keys:
    """A table whose keys are taken one after the other; those that nobody takes are mistakes.

    Attributes:
        path: of the file.
        text: all of it, to find lines in.
        values: of the table.
        name: of the table; empty of the whole file.
        number: which of the tables of that name, from 0.
    """

    path: Path
    text: str
    values: Mapping[str, Any]
    name: str = ""
    number: int = 0
    taken: list[str] = field(default_factory=list)

    def mistake(self, key: str, message: str, hint: str = "") -> LoadError:
        """The error about a key, or about the table itself where there is no such key."""
        place = f"[{self.name}] " if self.name else ""
        return LoadError(
            self.path,
            f"{place}{key}: {message}" if key else f"{place}{message}",
            line=find_line(self.text, self.name, self.number, key),
            hint=hint,
        )

    def take(self, key: str, kind: type | tuple[type, ...], wanted: str, default: Any = None) -> Any:
        """The value of a key; the default, unless that is None, where there is none.

        Raises:
            LoadError: it is of another kind, or missing.
        """
        self.taken.append(key)
        value = self.values.get(key, default)
        if value is None:
            raise self.mistake("", f"there is no {key!r}", f"want {key} = {wanted}")
        kinds = kind if isinstance(kind, tuple) else (kind,)
        if not isinstance(value, kinds) or (isinstance(value, bool) and bool not in kinds):
            raise self.mistake(key, f"want {wanted}, got {_shown(value)}")
        return value

    def string(self, key: str, default: str | None = None) -> str:
        """A text, not empty unless it may be left out."""
        value: str = self.take(key, str, "a text in double quotes", default)
        if not value.strip() and default is None:
            raise self.mistake(key, "is empty")
        return value

    def choice(self, key: str, choices: Collection[str], default: str | None = None) -> str:
        """A text that is one of some."""
        value = self.string(key, default)
        if value not in choices:
            raise self.mistake(key, str(UnknownNameError(key, value, choices)))
        return value

    def flag(self, key: str, default: bool) -> bool:
        """Yes or no."""
        value: bool = self.take(key, bool, "true or false", default)
        return value

    def count(self, key: str, least: int, most: int) -> int:
        """A whole number of a range."""
        value: int = self.take(key, int, "a whole number")
        if not least <= value <= most:
            raise self.mistake(key, f"want a number from {least} to {most}, got {_shown(value)}")
        return value

    def length(self, key: str, default: float | None = None) -> float:
        """A number above 0."""
        return self._length(key, self.take(key, (int, float), "a number", default))

    def strings(self, key: str) -> tuple[str, ...]:
        """Texts in brackets; none where the key is left out."""
        values = self.take(key, list, 'texts in brackets, ["a", "b"]', [])
        for value in values:
            if not isinstance(value, str) or not value:
                raise self.mistake(key, f'want texts in brackets, ["a", "b"], got {_shown(value)} among them')
        twice = next((value for value in values if values.count(value) > 1), None)
        if twice is not None:
            raise self.mistake(key, f"has {twice!r} more than once")
        return tuple(values)

    def lengths(self, key: str) -> dict[str, tuple[float, ...]]:
        """Numbers above 0 by name, each with its standard deviation if it was told; none where the key is left out."""
        values = self.take(key, dict, 'numbers by name, { "a" = 1.5 }', {})
        found = {}
        for name, value in values.items():
            parts = value if isinstance(value, list) and len(value) == 2 else [value]
            found[name] = tuple(self._length(f"{key}.{name}", part) for part in parts)
        return found

    def names(self, key: str) -> dict[str, str]:
        """Texts by name; none where the key is left out."""
        values = self.take(key, dict, 'texts by name, { "a" = "b" }', {})
        for name, value in values.items():
            if not isinstance(value, str) or not value:
                raise self.mistake(f"{key}.{name}", f"want a text in double quotes, got {_shown(value)}")
        return values

    def _length(self, key: str, value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self.mistake(key, f"want a number, got {_shown(value)}")
        if not 0.0 < value < MOST:  # which what is not a number is not either
            raise self.mistake(key, f"want a number above 0 that is not too large, got {_shown(value)}")
        return float(value)

    def table(self, key: str) -> Keys | None:
        """The table of that name, if there is one."""
        self.taken.append(key)
        if key not in self.values:
            return None
        values = self.values[key]
        if not isinstance(values, dict):
            raise self.mistake(key, f"want a table that begins with [{key}], got {_shown(values)}")
        return Keys(self.path, self.text, values, key)

    def tables(self, key: str) -> list[Keys]:
        """The tables of that name."""
        values = self.take(key, list, f"tables that begin with [[{key}]]", [])
        for value in values:
            if not isinstance(value, dict):
                raise self.mistake(key, f"want tables that begin with [[{key}]], got {_shown(value)} among them")
        return [Keys(self.path, self.text, value, key, number) for number, value in enumerate(values)]

    def finish(self) -> None:
        """Nothing, where all keys were taken.

        Raises:
            LoadError: one was not.
        """
        for key in self.values:
            if key not in self.taken:
                raise self.mistake(key, str(UnknownNameError("key", key, self.taken)))


def read_keys(path: Path) -> Keys:
    """The tables of a file.

    Raises:
        LoadError: it cannot be read, or is not TOML.
    """
    text = read_text(path)
    try:
        return Keys(path, text, tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        place = _PLACE.search(str(error))
        line = int(place[1]) if place and place[1] else text.count("\n")
        message = _PLACE.sub("", str(error))
        raise LoadError(
            path, f"is not TOML: {message}", line=line, hint='texts stand in double quotes, name = "smile"'
        ) from None
    except (RecursionError, ValueError) as error:  # brackets without end, numbers of thousands of digits
        raise LoadError(path, f"is not TOML: {error}") from None


def find_line(text: str, table: str, number: int, key: str) -> int | None:
    """Where a key stands in the so-manieth table of a name, from 1; where the table begins if it is not found."""
    inside, seen, begins = not table, -1, None
    for line, content in enumerate(text.splitlines(), start=1):
        if header := _HEADER.fullmatch(content):
            name = header[1] or header[2]
            seen += name == table
            inside = name == table and seen == number
            begins = line if begins is None and (inside or (not table and name == key)) else begins
        elif inside and (found := _KEY.match(content)) and (found[1] or found[2]) == key.partition(".")[0]:
            return line
    return begins


def _shown(value: object) -> str:
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, int) and abs(value) > MOST:
        return "a very large number"
    text = str(value).lower() if isinstance(value, bool) else repr(value)
    return text if len(text) <= SHOWN else f"{text[:SHOWN]}…"
