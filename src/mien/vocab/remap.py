"""A remap: what each value under one set of names does to values under another."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TypeVar

import numpy as np

from mien.core import LoadError, MienError, ParameterTable, UnknownNameError
from mien.core.sparse import SparseMatrix
from mien.timeline import Track

from .tables import each_side, shipped_tables, shipped_text
from .vocabulary import vocabularies

COLUMNS = ("parameter", "gain", "source")
BLENDS = ("add", "multiply")
FITS = ("exact", "near")

Value = TypeVar("Value", float, Track)


@dataclass(frozen=True, eq=False)
class Remap:
    """Two sparse matrices from the names of a vocabulary to the parameters of a family of faces.

    A value v of a name adds ``gain * v`` to a parameter, or multiplies it by ``1 + gain * v`` (a blink shuts an eye
    however wide an expression has opened it).

    Attributes:
        title: ``vocabulary.family``, for messages.
        from_names: names that are given.
        to_names: parameters that are played.
        gains: (to, from) what is added.
        factors: (to, from) what multiplies, less 1.
        sources: where each row of the table comes from: (from, to) -> text.
        approximate: names that the parameters come near to only.
    """

    title: str
    from_names: tuple[str, ...]
    to_names: tuple[str, ...]
    gains: SparseMatrix
    factors: SparseMatrix
    sources: Mapping[tuple[str, str], str]
    approximate: frozenset[str] = frozenset()

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Column of each name that is given."""
        return {name: column for column, name in enumerate(self.from_names)}

    def apply(self, values: Mapping[str, float]) -> dict[str, float]:
        """What the values add to parameters, for those parameters that they reach.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
        """
        return {
            parameter: sum(gain * value for gain, value in parts)
            for parameter, parts in self._parts(self.gains, values).items()
        }

    def scale(self, values: Mapping[str, float]) -> dict[str, float]:
        """What parameters are to be multiplied by, for those that the values reach: the factors of all names.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
        """
        return {
            parameter: math.prod(1.0 + gain * value for gain, value in parts)
            for parameter, parts in self._parts(self.factors, values).items()
        }

    def pushes(self, values: Mapping[str, float]) -> dict[str, list[tuple[float, float]]]:
        """(gain, value) of each name that adds to a parameter, for those parameters that the values reach.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
        """
        return self._parts(self.gains, values)

    def apply_tracks(self, tracks: Mapping[str, Track]) -> dict[str, Track]:
        """Tracks of what is added to each parameter that the given tracks reach.

        Exact: sums of straight lines have a key wherever one of them has; a track that reaches a parameter alone
        keeps its change functions. Before its first key a track counts with the value of that key.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
            MienError: tracks to be added are not made of keys and straight lines.
        """
        return self._apply_tracks(self.gains, tracks, 0.0)

    def scale_tracks(self, tracks: Mapping[str, Track]) -> dict[str, Track]:
        """Tracks of what parameters are multiplied by; otherwise as ``apply_tracks``.

        Where several names multiply one parameter their gains are added up, since a product of straight lines is none.
        """
        return self._apply_tracks(self.factors, tracks, 1.0)

    def reached_by(self, names: Iterable[str]) -> tuple[str, ...]:
        """Parameters that some of the names add to, in order."""
        columns = {self._column(name) for name in names}
        rows = zip(self.to_names, _entries(self.gains), strict=True)
        return tuple(name for name, entries in rows if columns & entries.keys())

    def check(self, known_from: ParameterTable, known_to: ParameterTable) -> None:
        """Nothing, when both sets of names exist.

        Raises:
            UnknownNameError: a name on either side is in no table.
        """
        for names, table in ((self.from_names, known_from), (self.to_names, known_to)):
            for name in names:
                if name not in table:
                    raise UnknownNameError(f"name in the table {self.title!r}:", name, table.names)

    def _column(self, name: str) -> int:
        if name not in self.index:
            raise UnknownNameError(f"name in the vocabulary of {self.title!r}:", name, self.from_names)
        return self.index[name]

    def _parts(self, matrix: SparseMatrix, values: Mapping[str, Value]) -> dict[str, list[tuple[float, Value]]]:
        given = {self._column(name): value for name, value in values.items()}
        parts = (
            (name, [(gain, given[column]) for column, gain in entries.items() if column in given])
            for name, entries in zip(self.to_names, _entries(matrix), strict=True)
        )
        return {name: part for name, part in parts if part}

    def _apply_tracks(self, matrix: SparseMatrix, tracks: Mapping[str, Track], rest: float) -> dict[str, Track]:
        return {name: weigh(parts, rest, name=name) for name, parts in self._parts(matrix, tracks).items()}


def weigh(parts: list[tuple[float, Track]], rest: float = 0.0, *, name: str = "") -> Track:
    """The track ``rest`` + the sum of gain times track over the parts.

    Raises:
        MienError: there are several and one is not made of keys and straight lines.
    """
    if len(parts) == 1:
        gain, track = parts[0]
        first, last = rest + gain * track.first, rest + gain * track.last
        return Track(track.start_s, track.end_s, first, last, track.change, name)
    keys = [_straight_keys(track, name) for _, track in parts]
    times = np.unique(np.concatenate([when for when, _ in keys]))
    total = np.full(len(times), rest)
    for (gain, track), (when, values) in zip(parts, keys, strict=True):
        total += gain * np.where(times < when[0], values[0], track.evaluate(times)[0])
    return Track.from_keys(times, total, name=name)


@lru_cache(maxsize=32)
def load_remap(vocabulary: str, target: str) -> Remap:
    """The shipped remap from a vocabulary to a family of faces, or to another vocabulary.

    Raises:
        UnknownNameError: there is no such vocabulary.
        MienError: there is no table for the two.
    """
    if target not in targets(vocabulary):
        raise _no_table(vocabulary, target)
    title = f"{vocabulary}.{target}"
    return parse_remap(shipped_text(title), title=title, place=f"{title}.csv")


def next_step(vocabulary: str, family: str) -> str:
    """What the names of a vocabulary become on their way to a family of faces: the family, or another vocabulary.

    Raises:
        UnknownNameError: there is no such vocabulary.
        MienError: there is no way.
    """
    known = targets(vocabulary)
    if family in known:
        return family
    for other in known:
        if other in vocabularies() and family in families(other):
            return other
    raise _no_table(vocabulary, family)


def targets(vocabulary: str) -> tuple[str, ...]:
    """Families of faces, and other vocabularies, that a vocabulary has a table for.

    Raises:
        UnknownNameError: there is no such vocabulary.
    """
    if vocabulary not in vocabularies():
        raise UnknownNameError("vocabulary", vocabulary, vocabularies())
    parts = (name.split(".") for name in shipped_tables())
    return tuple(part[1] for part in parts if len(part) == 2 and part[0] == vocabulary)


def families(vocabulary: str) -> tuple[str, ...]:
    """Families of faces that a vocabulary can play, some of them by way of another vocabulary.

    Raises:
        UnknownNameError: there is no such vocabulary.
    """
    found = {
        family for each in targets(vocabulary) for family in (families(each) if each in vocabularies() else (each,))
    }
    return tuple(sorted(found))


def _no_table(vocabulary: str, family: str) -> MienError:
    known = families(vocabulary)
    others = "there is a table for " + " and ".join(known) if known else "it can play no family yet"
    return MienError(f"vocabulary {vocabulary!r} cannot play faces of the family {family!r} — {others}")


def parse_remap(text: str, *, title: str, place: str) -> Remap:
    """The remap in a table: lines of name, parameter, gain, blend (add, or multiply), fit (exact, or near) and source.

    A line that names a ``{side}`` stands for one of either side.

    Raises:
        LoadError: with the line at which the table goes wrong.
    """
    reader = csv.DictReader(text.splitlines())
    fields = list(reader.fieldnames or [])
    if len(fields) < 4 or not set(COLUMNS) <= set(fields):
        raise LoadError(place, f"want a name and the columns {', '.join(COLUMNS)}, got {', '.join(fields)}", line=1)
    from_names: dict[str, int] = {}
    to_names: dict[str, int] = {}
    entries: dict[str, list[tuple[int, int, float]]] = {blend: [] for blend in BLENDS}
    sources: dict[tuple[str, str], str] = {}
    approximate: set[str] = set()
    for row in reader:
        gain, blend, fit = _parse_row(row, place, reader.line_num)
        for side in each_side(row):
            name, parameter = side[fields[0]], side["parameter"]
            column = from_names.setdefault(name, len(from_names))
            entries[blend].append((to_names.setdefault(parameter, len(to_names)), column, gain))
            sources[name, parameter] = row["source"]
            approximate |= {name} if fit == FITS[1] else set()
    shape = (len(to_names), len(from_names))
    gains, factors = (_matrix(entries[blend], shape) for blend in BLENDS)
    return Remap(title, tuple(from_names), tuple(to_names), gains, factors, sources, frozenset(approximate))


def _parse_row(row: Mapping[str, str], place: str, line: int) -> tuple[float, str, str]:
    if None in row.values() or None in row:
        raise LoadError(place, f"want {len(row)} fields", line=line)
    try:
        gain = float(row["gain"])
    except ValueError:
        gain = math.nan
    if not math.isfinite(gain):
        raise LoadError(place, f"gain {row['gain']!r} is not a finite number", line=line)
    blend, fit = (_choose(row, key, choices, place, line) for key, choices in (("blend", BLENDS), ("fit", FITS)))
    return gain, blend, fit


def _choose(row: Mapping[str, str], key: str, choices: tuple[str, ...], place: str, line: int) -> str:
    """What a row says, or the first choice when it says nothing."""
    choice = row.get(key) or choices[0]
    if choice not in choices:
        raise LoadError(place, f"{key} {choice!r} is not {' or '.join(choices)}", line=line)
    return choice


def _matrix(entries: list[tuple[int, int, float]], shape: tuple[int, int]) -> SparseMatrix:
    rows = np.array([row for row, _, _ in entries], dtype=np.int64)
    columns = np.array([column for _, column, _ in entries], dtype=np.int64)
    return SparseMatrix.from_entries(rows, columns, np.array([gain for _, _, gain in entries], dtype=np.float64), shape)


@lru_cache(maxsize=64)
def _entries(matrix: SparseMatrix) -> tuple[dict[int, float], ...]:
    """(column -> weight) of each row."""
    parts = (slice(*matrix.starts[row : row + 2]) for row in range(matrix.shape[0]))
    return tuple(dict(zip(matrix.columns[part].tolist(), matrix.weights[part].tolist(), strict=True)) for part in parts)


def _straight_keys(track: Track, name: str) -> tuple[np.ndarray, np.ndarray]:
    keys = track.keys()
    if keys is None or np.any(track.change) or np.any(np.diff(keys[0]) <= 0.0):
        raise MienError(f"tracks that add up in {name!r} must be keys and straight lines without jumps")
    return keys
