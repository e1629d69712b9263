"""Hands of drawn faces: ones that several characters share, and what a hand can do.

A hand is drawn with the character, as polygons of their own that turn with no head, and is moved by motors of its own.

Source: Thórisson 1996, appendix A1 (ToonFace animates "Gandalf's face and hand"); motors and gestures are ours.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from itertools import pairwise
from typing import Any, Protocol

from mien.core import UnknownNameError

from .fields import Fields
from .motor_values import motor_values
from .records import Command, Driver, Gesture, Limits, Outline, Point, Polygon, Shift, State, Values

SLOTS = ("skin", "shade", "sleeve", "fold")
"""Colours that a shared hand is drawn in; a character names one of its own for each."""

PART = "hand"

SMALLEST, LARGEST = 0.1, 10.0

LONGEST_S = 60.0
"""Of a move, seconds."""


class Reader(Protocol):
    """What reads the polygons of a character."""

    def fill(self, fields: Fields, key: str) -> str: ...  # noqa: D102
    def polygon(self, fields: Fields, parts: Mapping[str, tuple[Driver, ...]]) -> Polygon: ...  # noqa: D102
    def drivers(self, items: list[Fields]) -> Iterator[Driver]: ...  # noqa: D102


@cache
def hand_names() -> tuple[str, ...]:
    """Names of the hands that ship, sorted."""
    folder = resources.files(__package__).joinpath("data", "hands")
    return tuple(sorted(entry.name.removesuffix(".json") for entry in folder.iterdir() if entry.name.endswith(".json")))


@cache
def _document(name: str) -> Mapping[str, Any]:
    text = resources.files(__package__).joinpath("data", "hands", f"{name}.json").read_text(encoding="utf-8")
    document: Mapping[str, Any] = json.loads(text)
    return document


@cache
def gestures() -> tuple[Gesture, ...]:
    """Poses and moves that every hand with their motors has."""
    text = resources.files(__package__).joinpath("data", "gestures.json").read_text(encoding="utf-8")
    document = json.loads(text)
    poses = (Gesture(row["name"], ((0.0, row["values"]),), row["doc"], row["source"]) for row in document["poses"])
    moves = (
        Gesture(row["name"], tuple((key["time"], key["values"]) for key in row["keys"]), row["doc"], row["source"])
        for row in document["moves"]
    )
    return (*poses, *moves)


def gestures_of(limits: Mapping[str, Limits], own: tuple[Gesture, ...] = ()) -> tuple[Gesture, ...]:
    """What a hand with some motors can do: gestures whose motors it all has, and its own instead or besides."""
    able = (each for each in gestures() if all(code in limits for _, values in each.keys for code in values))
    return tuple({each.name: each for each in (*able, *own)}.values())


@dataclass(frozen=True)
class SharedHand:
    """A shipped hand as a character has it.

    Attributes:
        name: of the hand.
        at: where its wrist is when it is raised.
        scale: its size.
        fills: the character's colour for each of ``SLOTS``.
    """

    name: str
    at: Point
    scale: float
    fills: Mapping[str, str]

    @property
    def limits(self) -> dict[str, Limits]:
        """Of its motors, which are measured by what they do."""
        document = _document(self.name)
        drivers = [*document["drivers"], *(each for row in document["polygons"] for each in row.get("drivers", ()))]
        both = {driver["motor"] for driver in drivers if "min" in driver}
        # Those that move the hand two ways rest in the middle.
        return {code: Limits(-1.0, 1.0) if code in both else Limits() for code in {each["motor"] for each in drivers}}

    @property
    def ids(self) -> tuple[str, ...]:
        """Of its polygons."""
        return tuple(row["id"] for row in _document(self.name)["polygons"])

    def drivers(self, reader: Reader) -> tuple[Driver, ...]:
        """What moves the whole hand."""
        return tuple(
            map(self._driver, reader.drivers([Fields(each, PART) for each in _document(self.name)["drivers"]]))
        )

    def polygons(self, reader: Reader, parts: Mapping[str, tuple[Driver, ...]]) -> Iterator[Polygon]:
        """What the hand is drawn with; the part of the hand is among ``parts``."""
        implied = {"kind": "free", "layer": "front", "body": True, "part": PART}
        for each in _document(self.name)["polygons"]:
            fields = Fields({**implied, **each, "fill": self.fills[each["fill"]]}, PART)
            polygon = reader.polygon(fields, parts)
            drivers = tuple(map(self._driver, polygon.drivers))
            yield replace(polygon, path=self._outline(polygon.path), drivers=drivers)

    def _outline(self, outline: Outline) -> Outline:
        return tuple(Command(each.kind, each.points * self.scale + self.at) for each in outline)

    def _driver(self, driver: Driver) -> Driver:
        return replace(driver, low=self._state(driver.low), high=self._state(driver.high))

    def _state(self, state: State | None) -> State | None:
        if isinstance(state, tuple):
            return self._outline(state)
        if isinstance(state, Shift):
            (x, y), (dx, dy), (left, top) = state.about, state.move, self.at
            about = (x * self.scale + left, y * self.scale + top)
            return replace(state, about=about, move=(dx * self.scale, dy * self.scale))
        return state


def shared_hand(fields: Fields, reader: Reader) -> SharedHand | None:
    """The shipped hand that the key ``hand`` of a character asks for; None where the character draws its own.

    Raises:
        UnknownNameError: there is no such hand or colour.
        MienError: a key is missing or of another kind.
    """
    if "use" not in fields.keys:
        return None
    name = fields.text("use")
    if name not in hand_names():
        raise UnknownNameError(f"{fields.at('use')}: hand", name, hand_names())
    scale = fields.number("scale", 1.0)
    if not SMALLEST <= scale <= LARGEST:
        raise fields.error("scale", f"{scale:g} is out of range — it goes from {SMALLEST:g} to {LARGEST:g}")
    return SharedHand(name, fields.point("at"), scale, {slot: reader.fill(fields, slot) for slot in SLOTS})


def own_gestures(fields: Fields, limits: Mapping[str, Limits]) -> Iterator[Gesture]:
    """Poses and moves that the key ``hand`` of a character gives.

    Raises:
        MienError: one of them cannot be understood.
        UnknownNameError: the character has no such motor.
    """
    for name, values in fields.group("poses"):
        yield Gesture(name, ((0.0, motor_values(values, limits)),), _doc(name), "own")
    for name, items in fields.lists("moves"):
        keys = tuple(_keys(items, limits))
        times = [time_s for time_s, _ in keys]
        if len(keys) < 2 or any(one >= other for one, other in pairwise([0.0, *times])) or times[-1] > LONGEST_S:
            raise fields.error(f"moves.{name}", f"want two keys or more whose times go up, to {LONGEST_S:g} s at most")
        yield Gesture(name, keys, _doc(name), "own")


def _keys(items: list[Fields], limits: Mapping[str, Limits]) -> Iterator[tuple[float, Values]]:
    for item in items:
        yield item.number("time"), motor_values(item.inner("values"), limits)
        item.done()


def _doc(name: str) -> str:
    return f"{name.replace('_', ' ').capitalize()}, as this hand was drawn."
