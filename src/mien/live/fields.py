"""What a field of a message may hold: one record for checks, JSON Schema and docs."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from mien.core import MienError, RangeError, UnknownNameError

SHOWN = 60
"""Characters of a value that a message about it repeats."""

MOST_VALUES = 100
LONGEST_NAME = 200
NAME = {"type": "string", "minLength": 1, "maxLength": LONGEST_NAME}


@dataclass(frozen=True)
class Field:
    """A field of a message.

    Attributes:
        name: its key in JSON.
        type: a name of ``TYPES``.
        doc: what it means.
        low: least number, or fewest characters.
        high: greatest number, or most characters.
        unit: of the number.
        default: what holds where it is not given; None where nothing does.
        required: whether it has to be there.
        choices: the only texts allowed, if not empty.
    """

    name: str
    type: str
    doc: str
    low: float = 0.0
    high: float = 1.0
    unit: str = ""
    default: Any = None
    required: bool = False
    choices: tuple[str, ...] = ()

    def check(self, value: object) -> Any:
        """The value as the session takes it.

        Raises:
            MienError: it is of another type, out of range or unknown.
        """
        return TYPES[self.type].check(self, value)

    def schema(self) -> dict[str, Any]:
        """The field as JSON Schema."""
        found: dict[str, Any] = {**TYPES[self.type].schema(self), "description": self.doc}
        if self.default is not None:
            found["default"] = self.default
        return found


@dataclass(frozen=True)
class Type:
    """What kind of value it is: how people call it, its check and its JSON Schema."""

    doc: str
    check: Callable[[Field, object], Any]
    schema: Callable[[Field], dict[str, Any]]


def show(value: object) -> str:
    """A value from anywhere in a few printable characters."""
    if isinstance(value, dict | list):
        return "an object" if isinstance(value, dict) else "a list"
    # The text of a huge whole number takes long, or is refused.
    if isinstance(value, int) and abs(value) >= 10**SHOWN:
        return "a number of many digits"
    text = ascii(value) if isinstance(value, str) else str(value)
    return text if len(text) <= SHOWN else text[: SHOWN - 1] + "…"


def read_number(place: str, value: object, low: float, high: float, unit: str = "") -> float:
    """A finite number in a range as a float; true and false are none.

    Raises:
        MienError: it is no number.
        RangeError: it is not finite or out of range.
    """
    # Words only where something is wrong: thousands of numbers come each second.
    if isinstance(value, int | float) and not isinstance(value, bool):
        if low <= value <= high:
            return float(value)
        state = "is out of range" if not isinstance(value, float) or math.isfinite(value) else "is not a finite number"
        raise RangeError(f"{place}: {show(value)} {state} — {_say_range(low, high, unit)}")
    raise MienError(f"{place}: want a number, got {show(value)} — {_say_range(low, high, unit)}")


def _say_range(low: float, high: float, unit: str) -> str:
    return f"it goes from {low:g} to {high:g}" + (f" {unit}" if unit else "")


def read_text(place: str, value: object, shortest: float, longest: float) -> str:
    """A text of some length that can be written down.

    Raises:
        MienError: it is no text, too short or too long, or holds half a character.
    """
    if not isinstance(value, str):
        raise MienError(f"{place}: want a text, got {show(value)}")
    if not shortest <= len(value.strip()) or not len(value) <= longest:
        raise MienError(f"{place}: want {shortest:g} to {longest:g} characters, got {len(value.strip())}")
    try:
        value.encode("utf-8")
    except UnicodeEncodeError:
        raise MienError(f"{place}: {show(value)} holds half a character — write it as UTF-8") from None
    return value


def read_list(place: str, value: object, most: int, *, fewest: int = 0) -> list[Any]:
    """A list of so many things.

    Raises:
        MienError: it is no list, too short or too long.
    """
    if not isinstance(value, list):
        raise MienError(f"{place}: want a list, got {show(value)}")
    if not fewest <= len(value) <= most:
        raise MienError(f"{place}: want {fewest} to {most} of them, got {len(value)}")
    return value


def _number(field: Field, value: object) -> float:
    return read_number(field.name, value, field.low, field.high, field.unit)


def _text(field: Field, value: object) -> str:
    return read_text(field.name, value, field.low, field.high)


def _choice(field: Field, value: object) -> str:
    text = read_text(field.name, value, 1, LONGEST_NAME)
    if text not in field.choices:
        raise UnknownNameError(field.name, text, field.choices)
    return text


def _flag(field: Field, value: object) -> bool:
    if not isinstance(value, bool):
        raise MienError(f"{field.name}: want true or false, got {show(value)}")
    return value


def _values(field: Field, value: object) -> Mapping[str, float]:
    if not isinstance(value, dict):
        raise MienError(f"{field.name}: want an object of names and numbers, got {show(value)}")
    if not 1 <= len(value) <= MOST_VALUES:
        raise MienError(f"{field.name}: want 1 to {MOST_VALUES} of them, got {len(value)}")
    return MappingProxyType(
        {
            read_text(f"{field.name}: a name", name, 1, LONGEST_NAME): read_number(
                f"{field.name}: {show(name)}", number, field.low, field.high
            )
            for name, number in value.items()
        }
    )


def _names(field: Field, value: object) -> tuple[str, ...]:
    return tuple(
        read_text(f"{field.name}: a name", name, 1, LONGEST_NAME)
        for name in read_list(field.name, value, MOST_VALUES, fewest=1)
    )


def _place(field: Field, value: object) -> str | tuple[float, float, float]:
    return read_text(field.name, value, 1, LONGEST_NAME) if isinstance(value, str) else _point(field, value)


def _point(field: Field, value: object) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:
        raise MienError(f"{field.name}: want {TYPES[field.type].doc}, got {show(value)}")
    x, y, z = (
        read_number(f"{field.name}: {axis}", value[i], field.low, field.high, "m") for i, axis in enumerate("xyz")
    )
    if x == y == z == 0.0:
        raise RangeError(f"{field.name}: [0, 0, 0] is in the middle of the head — name a point in front of it")
    return x, y, z


def _cues(field: Field, value: object) -> tuple[tuple[float, float, str], ...]:
    cues: list[tuple[float, float, str]] = []
    for number, cue in enumerate(read_list(field.name, value, int(field.high), fewest=int(field.low))):
        place = f"{field.name}: cue {number}"
        if not isinstance(cue, list) or len(cue) != 3:
            raise MienError(f"{place}: want [start_s, end_s, symbol], got {show(cue)}")
        start = read_number(f"{place}: start", cue[0], 0.0, LONGEST_SPEECH_S, "s")
        end = read_number(f"{place}: end", cue[1], start, LONGEST_SPEECH_S, "s")
        if cues and start < cues[-1][1]:
            raise MienError(f"{place}: starts at {start:g} s, before the one before has ended")
        cues.append((start, end, read_text(f"{place}: symbol", cue[2], 1, LONGEST_NAME)))
    return tuple(cues)


LONGEST_SPEECH_S = 300.0


def _number_schema(field: Field) -> dict[str, Any]:
    return {"type": "number", "minimum": field.low, "maximum": field.high}


def _text_schema(field: Field) -> dict[str, Any]:
    return {"type": "string", "minLength": int(field.low), "maxLength": int(field.high)}


def _values_schema(field: Field) -> dict[str, Any]:
    return {
        "type": "object",
        "propertyNames": NAME,
        "additionalProperties": _number_schema(field),
        "minProperties": 1,
        "maxProperties": MOST_VALUES,
    }


def _point_schema(field: Field) -> dict[str, Any]:
    return {"type": "array", "items": _number_schema(field), "minItems": 3, "maxItems": 3}


def _cues_schema(field: Field) -> dict[str, Any]:
    second = {"type": "number", "minimum": 0, "maximum": LONGEST_SPEECH_S}
    cue = {"type": "array", "prefixItems": [second, second, NAME], "minItems": 3, "maxItems": 3}
    return {"type": "array", "items": cue, "minItems": int(field.low), "maxItems": int(field.high)}


def _names_schema(field: Field) -> dict[str, Any]:
    return {"type": "array", "items": NAME, "minItems": 1, "maxItems": MOST_VALUES}


TYPES: Mapping[str, Type] = MappingProxyType(
    {
        "number": Type("a number", _number, _number_schema),
        "text": Type("a text", _text, _text_schema),
        "choice": Type("one of some texts", _choice, lambda field: {"enum": list(field.choices)}),
        "flag": Type("true or false", _flag, lambda field: {"type": "boolean"}),
        "values": Type("an object of names and numbers", _values, _values_schema),
        "names": Type("a list of names", _names, _names_schema),
        "point": Type("[x, y, z] in metres", _point, _point_schema),
        "place": Type("[x, y, z] in metres, or a name", _place, lambda field: {"anyOf": [NAME, _point_schema(field)]}),
        "cues": Type("a list of [start_s, end_s, symbol]", _cues, _cues_schema),
    }
)
"""Types of fields by name."""


def describe(fields: Iterable[Field]) -> list[str]:
    """Lines of a Markdown table of some fields."""
    lines = ["| field | type | what | range | default |", "|---|---|---|---|---|"]
    for field in fields:
        given = "**needed**" if field.required else ("" if field.default is None else f"`{json.dumps(field.default)}`")
        lines.append(f"| `{field.name}` | {TYPES[field.type].doc} | {field.doc} | {_limits(field)} | {given} |")
    return lines


def _limits(field: Field) -> str:
    """What a field can be, in words."""
    if field.choices:
        return ", ".join(f"`{choice}`" for choice in field.choices)
    if field.type == "number":
        return f"{field.low:g} to {field.high:g} {field.unit}".strip()
    return f"{field.low:g} to {field.high:g} characters" if field.type == "text" else ""
