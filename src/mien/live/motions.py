"""Standard motions, which Thórisson left to clients: a few keys each, in words that every face understands."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import Any

import numpy as np

from mien.core import Face, LoadError, MienError, Pose, UnknownNameError
from mien.timeline import CHANGES
from mien.vocab import pose_from, vocabulary

from .fields import LONGEST_NAME, read_list, read_number, read_text, show
from .mixing import CHANNELS
from .slices import Floats, Rows, Way

FORMAT = "mien-motions"
VERSION = 1

MOST_KEYS = 64
LONGEST_MS = 60_000.0
CHANGE = "cosine"
NEVER_MOVED = ("scene", "shape", "color")
"""Roles of rows that no motion moves."""


@dataclass(frozen=True)
class Key:
    """Where a face is at a moment of a motion; what it does not name is at rest.

    Attributes:
        at_ms: since the motion began.
        values: amounts of action units (``AU12``), channels (``head_nod``) and expressions (``happy``).
        change: how it gets there from the key before.
    """

    at_ms: float
    values: Mapping[str, float]
    change: str = CHANGE

    def to_json(self) -> dict[str, Any]:
        """The key as it stands in a file."""
        found: dict[str, Any] = {"at_ms": self.at_ms, "values": dict(self.values)}
        return found if self.change == CHANGE else found | {"change": self.change}


@dataclass(frozen=True)
class Motion:
    """A named movement that begins and ends at rest.

    Attributes:
        name: what it is called in messages.
        doc: what is seen.
        keys: by time; the last one is at rest.
    """

    name: str
    doc: str
    keys: tuple[Key, ...]

    @property
    def length_s(self) -> float:
        """Duration in seconds."""
        return self.keys[-1].at_ms / 1000.0

    def to_json(self) -> dict[str, Any]:
        """The motion as it stands in a file."""
        return {"name": self.name, "doc": self.doc, "keys": [key.to_json() for key in self.keys]}


@dataclass(frozen=True, eq=False)
class FaceMotion:
    """A motion on one face; R rows move.

    Attributes:
        rows: (R,) their numbers.
        offsets: (keys, R) how far from their defaults.
        keys: of the motion.
    """

    rows: Rows
    offsets: Floats
    keys: tuple[Key, ...]

    def ways(self, loop_s: float, strength: float = 1.0, speed: float = 1.0, *, hold: bool = False) -> Ways:
        """Row number and ways of each row that moves, in loops of a length."""
        last = len(self.keys) - (1 if hold and len(self.keys) > 1 else 0)
        ends: list[int] = []
        kept: list[int] = []
        for number, key in enumerate(self.keys[:last]):
            loop = max(1, round(key.at_ms / (1000.0 * speed * loop_s)))
            if ends and ends[-1] >= loop:  # two keys in one loop: the later one is seen
                kept[-1] = number
                continue
            ends.append(loop)
            kept.append(number)
        slices = np.diff([0, *ends]).tolist()
        return [
            (
                int(row),
                tuple(
                    Way(strength * float(self.offsets[number, column]), count, self.keys[number].change)
                    for number, count in zip(kept, slices, strict=True)
                ),
            )
            for column, row in enumerate(self.rows)
        ]


Ways = list[tuple[int, tuple[Way, ...]]]


def fit_motion(motion: Motion, face: Face) -> FaceMotion:
    """The motion on a face.

    Raises:
        UnknownNameError: the face has no such expression.
        RangeError: an amount is out of range.
    """
    table = face.parameters
    still = [row.role in NEVER_MOVED for row in table]
    offsets = np.array([_pose(key.values, face).values - table.defaults for key in motion.keys])
    offsets[:, still] = 0.0
    rows = np.flatnonzero(np.any(offsets != 0.0, axis=0))
    return FaceMotion(rows, offsets[:, rows], motion.keys)


@cache
def standard_motions() -> Mapping[str, Motion]:
    """The motions that ship, by name."""
    text = resources.files(__package__).joinpath("data", "motions.json").read_text(encoding="utf-8")
    return parse_motions(text, "motions.json")


def parse_motions(text: str, place: str) -> Mapping[str, Motion]:
    """The motions in a file, by name: ``{"format": "mien-motions", "version": 1, "motions": [...]}``.

    Raises:
        LoadError: with the motion and the key at which it goes wrong.
    """
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise LoadError(place, f"is no JSON ({error})") from None
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise LoadError(place, f"want 'format': '{FORMAT}'", hint="is this a file of motions?")
    if document.get("version") != VERSION:
        raise LoadError(place, f"version {show(document.get('version'))} is not {VERSION}")
    try:
        motions = [read_motion(each) for each in read_list("motions", document.get("motions"), 1000, fewest=1)]
    except MienError as error:
        raise LoadError(place, str(error)) from None
    found: dict[str, Motion] = {}
    for motion in motions:
        if motion.name in found:
            raise LoadError(place, f"there are two motions {motion.name!r}", hint="give one another name")
        found[motion.name] = motion
    return MappingProxyType(found)


def read_motion(value: object) -> Motion:
    """The motion in a JSON value.

    Raises:
        MienError: it is none.
    """
    fields = _fields("motion", value, ("name", "doc", "keys"))
    name = read_text("name", fields.get("name"), 1, LONGEST_NAME)
    keys: list[Key] = []
    for number, key in enumerate(read_list(f"{name}: keys", fields.get("keys"), MOST_KEYS, fewest=2)):
        keys.append(_read_key(f"{name}: key {number}", key))
        if number and keys[-1].at_ms <= keys[-2].at_ms:
            raise MienError(f"{name}: key {number} does not come after the one before")
    if keys[0].at_ms <= 0.0:
        raise MienError(f"{name}: key 0 is at 0 ms — a face needs time to get there")
    if keys[-1].values:
        raise MienError(f"{name}: the last key moves something — a motion ends at rest, with no values")
    return Motion(name, read_text(f"{name}: doc", fields.get("doc", ""), 0, 1000), tuple(keys))


def _read_key(place: str, value: object) -> Key:
    fields = _fields(place, value, ("at_ms", "values", "change"))
    change = fields.get("change", CHANGE)
    if not isinstance(change, str) or change not in CHANGES:
        raise UnknownNameError(f"{place}: change function", show(change), CHANGES)
    given = fields.get("values")
    if not isinstance(given, dict):
        raise MienError(f"{place}: want 'values' as an object of names and numbers, got {show(given)}")
    values: dict[str, float] = {}
    for name, amount in given.items():
        limits = next((table[row] for table in _tables() if name in table for row in table.resolve(name)), None)
        low, high = (limits.low, limits.high) if limits is not None else (0.0, 1.0)
        values[name] = read_number(f"{place}: {name}", amount, low, high)
    return Key(read_number(f"{place}: at_ms", fields.get("at_ms"), 0.0, LONGEST_MS, "ms"), values, change)


def _tables() -> Sequence[Any]:
    return vocabulary("facs"), vocabulary(CHANNELS)


def _fields(place: str, value: object, known: Sequence[str]) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise MienError(f"{place}: want an object, got {show(value)}")
    for name in value:
        if name not in known:
            raise UnknownNameError(f"field of {place}:", name, known)
    return value


def _pose(values: Mapping[str, float], face: Face) -> Pose:
    """The pose of a key: expressions first, action units on them, channels last."""
    units, channels = _tables()
    pose = face.neutral
    for name, amount in values.items():
        if name not in units and name not in channels:
            if name not in face.presets or face.presets[name].kind != "expression":
                expressions = [key for key, preset in face.presets.items() if preset.kind == "expression"]
                raise UnknownNameError("action unit, channel or expression", name, [*channels.names, *expressions])
            pose = pose.blend(face.neutral.replace(face.presets[name].values), amount)
    for title, table in (("facs", units), (CHANNELS, channels)):
        given = {name: amount for name, amount in values.items() if name in table}
        if given:
            pose = pose_from(title, given, face, pose)
    return pose
