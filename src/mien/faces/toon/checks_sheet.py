"""A document whose schema faults are known, from which later checks take what is sound."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from .checks_faults import Fault, Place
from .hands import SharedHand, hand_names
from .motors import paper_codes
from .reader import PAPER_FEATURES

OUTLINES = ("path", "min", "max")


@dataclass(frozen=True, eq=False)
class Sheet:
    """A document and the faults that the schema finds in it."""

    document: Any
    faults: tuple[Fault, ...]

    @cached_property
    def _wrong(self) -> frozenset[Place]:
        return frozenset(fault.place[:end] for fault in self.faults for end in range(1, len(fault.place) + 1))

    def sound(self, *place: str | int) -> Any:
        """The value at a place, if neither it nor anything in it is against the schema; None otherwise."""
        return None if place in self._wrong else self.value(*place)

    def value(self, *place: str | int) -> Any:
        """The value at a place, None where there is none."""
        found = self.document
        for key in place:
            listed = isinstance(found, list) and isinstance(key, int) and key < len(found)
            if not (listed or (isinstance(found, dict) and key in found)):
                return None
            found = found[key]
        return found

    def members(self, *place: str | int) -> Mapping[str, Any]:
        """The object at a place, sound or not; an empty one where there is none."""
        found = self.value(*place)
        return found if isinstance(found, dict) else {}

    @property
    def strict(self) -> bool:
        """Whether only what the paper has is allowed."""
        return self.value("mode") == "strict"

    @cached_property
    def polygons(self) -> tuple[tuple[int, Mapping[str, Any]], ...]:
        """Number and object of each sound polygon."""
        listed = self.value("polygons")
        numbers = range(len(listed) if isinstance(listed, list) else 0)
        return tuple((number, found) for number in numbers if (found := self.sound("polygons", number)) is not None)

    @cached_property
    def ids(self) -> tuple[tuple[int, str], ...]:
        """Number and id of each polygon that has one."""
        listed = self.value("polygons")
        numbers = range(len(listed) if isinstance(listed, list) else 0)
        return tuple(
            (number, name) for number in numbers if isinstance(name := self.value("polygons", number, "id"), str)
        )

    @cached_property
    def features(self) -> frozenset[str]:
        """Features that it has or, as the schema says already, should have."""
        return frozenset([*PAPER_FEATURES, *self.members("features")])

    @cached_property
    def motors(self) -> frozenset[str]:
        """Motors that it has limits for or, as the schema says already, should have."""
        hand = self.shared_hand
        return frozenset([*paper_codes(), *self.members("motors"), *(hand.limits if hand else ())])

    @property
    def shared_hand(self) -> SharedHand | None:
        """The shipped hand that it asks for, if there is such a one."""
        name = self.sound("hand", "use")
        return SharedHand(name, (0.0, 0.0), 1.0, {}) if name in hand_names() else None

    def values(self) -> Iterator[tuple[Place, Mapping[str, float]]]:
        """Every sound object of values by motor: expressions, poses of the hand and keys of its moves."""
        places: list[Place] = [("expressions", name) for name in self.members("expressions")]
        places += [("hand", "poses", name) for name in self.members("hand", "poses")]
        for name in self.members("hand", "moves"):
            keys = self.sound("hand", "moves", name) or ()
            places += [("hand", "moves", name, row, "values") for row in range(len(keys))]
        yield from ((place, found) for place in places if (found := self.sound(*place)) is not None)

    def drivers(self) -> Iterator[tuple[Place, Mapping[str, Any]]]:
        """Every driver of sound polygons and parts."""
        for number, polygon in self.polygons:
            yield from _numbered(("polygons", number, "drivers"), polygon.get("drivers", ()))
        for name in self.members("parts"):
            yield from _numbered(("parts", name), self.sound("parts", name) or ())

    def lines(self) -> Iterator[tuple[Place, Mapping[str, Any]]]:
        """Every line of a feature that sound polygons and parts name."""
        for number, polygon in self.polygons:
            yield from _numbered(("polygons", number, "span"), polygon.get("span", ()))
            if "stroke" in polygon:
                yield ("polygons", number, "stroke"), polygon["stroke"]
        for place, driver in self.drivers():
            for key in ("min", "max"):
                state = driver.get(key)
                if isinstance(state, dict) and "touch" in state:
                    yield (*place, key, "touch"), state["touch"]

    def outlines(self) -> Iterator[tuple[Place, str | list[Any]]]:
        """Every outline of sound polygons, of their states too."""
        for number, polygon in self.polygons:
            yield from ((("polygons", number, key), polygon[key]) for key in OUTLINES if key in polygon)
        for place, driver in self.drivers():
            yield from (
                ((*place, key), driver[key]) for key in ("min", "max") if isinstance(driver.get(key), str | list)
            )


def _numbered(place: Place, values: Iterable[Any]) -> Iterator[tuple[Place, Any]]:
    return (((*place, number), value) for number, value in enumerate(values))
