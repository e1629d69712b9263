"""The published JSON Schema of ``name.toon.json``."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from functools import cache
from importlib.resources import files
from typing import Any

Schema = Mapping[str, Any]


def schema_text() -> str:
    """The schema as it is published, draft 2020-12."""
    return files(__package__).joinpath("data", "toon.schema.json").read_text(encoding="utf-8")


@cache
def toon_schema() -> Schema:
    """The schema as a document."""
    document: Schema = json.loads(schema_text())
    return document


def referred(schema: Schema) -> Schema:
    """The definition that the ``$ref`` of a schema leads to; empty without one."""
    if "$ref" not in schema:
        return {}
    found: Schema = toon_schema()["$defs"][schema["$ref"].removeprefix("#/$defs/")]
    return found


def title(schema: Schema) -> str:
    """What a schema wants, in words."""
    return str(schema.get("title") or title(referred(schema)) if schema else "")


def find_extensions(document: Any) -> Iterator[tuple[str | int, ...]]:
    """Where a document has keys that the paper has not; of keys within one another the outermost."""
    return _extensions(document, toon_schema(), ())


def _extensions(value: Any, schema: Schema, place: tuple[str | int, ...]) -> Iterator[tuple[str | int, ...]]:
    if "$ref" in schema:
        yield from _extensions(value, referred(schema), place)
    if isinstance(value, dict):
        for key, member in schema.get("properties", {}).items():
            if key in value and member.get("x-extension"):
                yield (*place, key)
            elif key in value:
                yield from _extensions(value[key], member, (*place, key))
    elif isinstance(value, list) and "items" in schema and "prefixItems" not in schema:
        for number, item in enumerate(value):
            yield from _extensions(item, schema["items"], (*place, number))
