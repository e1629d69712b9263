"""Where a document is not what the schema wants: all places, in words for whoever wrote it.

Only the words of JSON Schema that ``toon.schema.json`` uses are known here; a test holds the verdicts against those of
a complete implementation.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from mien.core import UnknownNameError

from .checks_faults import SHOWN, Fault, Place
from .schema import Schema, referred, title

TYPES: Mapping[str, tuple[str, tuple[type, ...]]] = {
    "object": ("an object {…}", (dict,)),
    "array": ("a list […]", (list,)),
    "string": ("a text", (str,)),
    "boolean": ("true or false", (bool,)),
    "number": ("a number", (int, float)),
    "integer": ("a whole number", (int, float)),
}


def find_mismatches(value: Any, schema: Schema, place: Place = ()) -> Iterator[Fault]:
    """Faults of a value and of everything in it."""
    if "$ref" in schema:
        yield from find_mismatches(value, referred(schema), place)
    if "type" in schema and not is_type(value, schema["type"]):
        yield Fault("type", place, "is of another kind", _wanted(schema), show(value))
        return
    for word in schema:
        if word in _CHECKS:
            yield from _CHECKS[word](value, schema, place)


def is_type(value: Any, name: str) -> bool:
    """Whether a value is of a type of JSON Schema; true and false are no numbers."""
    if isinstance(value, bool) != (name == "boolean"):
        return False
    whole = name != "integer" or not isinstance(value, float) or value.is_integer()
    return isinstance(value, TYPES[name][1]) and whole


def show(value: Any) -> str:
    """A value as it stands in a file, its beginning when it is long."""
    if isinstance(value, dict | list) and len(value) > SHOWN:
        return f"{'an object' if isinstance(value, dict) else 'a list'} of {len(value)}"
    text = json.dumps(value[: 2 * SHOWN] if isinstance(value, str) else value, ensure_ascii=False)
    return text if len(text) <= SHOWN else text[: SHOWN - 1] + "…"


def suggest(kind: str, name: str, known: Any) -> tuple[str, str]:
    """What is wrong with a name that is none of the known ones, and what was perhaps meant."""
    what, _, hint = str(UnknownNameError(kind, name[:SHOWN], known)).partition(" — ")
    return what, hint


def _wanted(schema: Schema) -> str:
    return title(schema) or TYPES[schema["type"]][0]


def _check_const(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    wanted = schema["const"]
    if value != wanted or isinstance(value, bool) != isinstance(wanted, bool):
        yield Fault("name", place, "is something else", show(wanted), show(value))


def _check_enum(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    if not isinstance(value, str):
        yield Fault("type", place, "is of another kind", title(schema) or "a text", show(value))
    elif value not in schema["enum"]:
        what, hint = suggest(title(schema).removeprefix("a ") or str(place[-1]), value, schema["enum"])
        yield Fault("name", place, what, hint=hint)


def _check_pattern(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    if not re.search(schema["pattern"], value):
        color = "#" in schema["pattern"]
        yield Fault("color" if color else "name", place, "cannot be understood", _wanted(schema), show(value))


def _check_length(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    if len(value) < schema["minLength"]:
        yield Fault("empty", place, "is empty", _wanted(schema))


def _check_bounds(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    if not isinstance(value, int | float):
        return
    low, above, high = (schema.get(word) for word in ("minimum", "exclusiveMinimum", "maximum"))
    if not (
        math.isfinite(value)
        and (low is None or value >= low)
        and (above is None or value > above)
        and (high is None or value <= high)
    ):
        least = f"from {low}" if low is not None else f"above {above}" if above is not None else ""
        most = f"to {high}" if high is not None else ""
        got = "NaN" if math.isnan(value) else f"{value:g}" if math.isfinite(value) else "a number without end"
        yield Fault("range", place, "is out of range", f"{least} {most}".strip(), got)


def _check_required(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    if isinstance(value, dict):
        for key in schema["required"]:
            if key not in value:
                yield Fault("missing", place, f"{key!r} is missing", f"{title(schema) or 'an object'} with {key!r}")


def _check_properties(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    if isinstance(value, dict):
        for key, member in schema["properties"].items():
            if key in value:
                yield from find_mismatches(value[key], member, (*place, key))


def _check_additional(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    known = schema.get("properties", {})
    for key in value:
        if key in known:
            continue
        if schema["additionalProperties"] is False:
            what, hint = suggest("key", key, known)
            yield Fault("unknown", (*place, key), what, hint=hint)
        else:
            yield from find_mismatches(value[key], schema["additionalProperties"], (*place, key))


def _check_names(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    for key in value:
        yield from find_mismatches(key, schema["propertyNames"], (*place, key))


def _check_prefix(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    count = len(schema["prefixItems"])
    if len(value) != count:
        yield Fault("type", place, "is of another length", f"{title(schema) or 'a list'} of {count}", show(value))
        return
    for number, member in enumerate(schema["prefixItems"]):
        yield from find_mismatches(value[number], member, (*place, number))


def _check_items(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    if "prefixItems" in schema:
        return
    if len(value) < schema.get("minItems", 0):
        wanted = f"{_wanted(schema)}, {schema['minItems']} or more"
        yield Fault("empty", place, "is too short" if value else "is empty", wanted, str(len(value)))
    for number, item in enumerate(value):
        yield from find_mismatches(item, schema["items"], (*place, number))


def _check_all(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    for each in schema["allOf"]:
        yield from find_mismatches(value, each, place)


def _check_if(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    if not any(find_mismatches(value, schema["if"], place)):
        yield from find_mismatches(value, schema["then"], place)


def _check_choice(value: Any, schema: Schema, place: Place) -> Iterator[Fault]:
    """Alternatives differ in the type of the value or in the keys that an object has."""
    choices = schema.get("oneOf") or schema["anyOf"]
    faults = [list(find_mismatches(value, choice, place)) for choice in choices]
    fitting = [choice for choice, wrong in zip(choices, faults, strict=True) if not wrong]
    if len(fitting) == 1 or (fitting and "anyOf" in schema):
        return
    of_type = [wrong for choice, wrong in zip(choices, faults, strict=True) if is_type(value, _type(choice))]
    if len(of_type) == 1:
        yield from of_type[0]
        return
    objects = isinstance(value, dict)
    wanted = " or ".join(title(choice) for choice in choices)
    got = " and ".join(title(choice) for choice in fitting) if objects else show(value)
    what = ("has more than one of these" if fitting else "has none of these") if objects else "is of another kind"
    yield Fault("shape" if objects else "type", place, what, wanted, got)


def _type(schema: Schema) -> str:
    return str(schema.get("type") or (_type(referred(schema)) if "$ref" in schema else "object"))


_CHECKS: Mapping[str, Callable[[Any, Schema, Place], Iterator[Fault]]] = {
    "const": _check_const,
    "enum": _check_enum,
    "pattern": _check_pattern,
    "minLength": _check_length,
    "maximum": _check_bounds,
    "required": _check_required,
    "properties": _check_properties,
    "additionalProperties": _check_additional,
    "propertyNames": _check_names,
    "prefixItems": _check_prefix,
    "items": _check_items,
    "oneOf": _check_choice,
    "anyOf": _check_choice,
    "allOf": _check_all,
    "if": _check_if,
}
"""By the word of a schema that asks for it; every range has a maximum."""
