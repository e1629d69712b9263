"""Build the tables of docs/toon-format.md from the schema of drawn faces and from the table of faults.

python tools/toon_format.py
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from mien.faces.toon.checks_faults import rules
from mien.faces.toon.motors import motors
from mien.faces.toon.schema import referred, title, toon_schema

PLACE = Path(__file__).parents[1] / "docs/toon-format.md"
TABLE = re.compile(r"(<!-- table: ([\w ]+) -->\n).*?(<!-- end -->)", re.DOTALL)

Schema = Mapping[str, Any]


def page() -> str:
    """The page as it stands, with its tables made anew."""
    text = PLACE.read_text(encoding="utf-8")
    return TABLE.sub(lambda match: "\n".join([match[1], *_table(match[2]), "", match[3]]), text)


def _table(name: str) -> Iterator[str]:
    if name == "faults":
        yield from ("| fault | | what it means | what to try |", "|---|---|---|---|")
        for rule in rules().values():
            yield f"| `{rule.name}` | {rule.severity} | {rule.meaning} | {rule.hint[0].upper()}{rule.hint[1:]}. |"
    elif name == "motors":
        yield from ("| code | number | moves | parameter | what it does |", "|---|---|---|---|---|")
        for code, motor in motors().items():
            number = f"{motor.number}-{motor.dimension}" if motor.number else ""
            moves = f"{motor.point} {_direction(motor.direction)}" if motor.point else ""
            marked = _marked(code, extension=not motor.paper)
            yield f"| {marked} | {number} | {moves} | `{motor.parameter}` | {motor.doc} |"
    else:
        yield from _keys(toon_schema() if name == "file" else toon_schema()["$defs"][name])


def _keys(schema: Schema) -> Iterator[str]:
    yield from ("| key | value | what it is |", "|---|---|---|")
    required = schema.get("required", ())
    for key, member in schema["properties"].items():
        doc = member["description"]
        if "default" in member:
            doc = f"{doc.rstrip('.')}; `{member['default']}` unless said.".replace("False", "false")
        must = "" if key not in required else " (needed)"
        extension = bool(member.get("x-extension"))
        yield f"| {_marked(key, extension=extension)}{must} | {_value(member).replace('|', '/')} | {doc} |"


def _marked(key: str, *, extension: bool) -> str:
    return f"`{key}` +" if extension else f"`{key}`"


def _value(schema: Schema) -> str:
    if "const" in schema:
        return f"`{schema['const']}`"
    if "enum" in schema and "title" not in schema:
        return " ".join(f"`{name}`" for name in schema["enum"])
    plain = {"string": "a text", "boolean": "true or false", "array": "a list", "object": "an object"}
    return title(schema) or title(referred(schema)) or plain[schema["type"]]


def _direction(direction: tuple[float, float]) -> str:
    """Which way a positive offset moves a point, as one sees the picture."""
    return {(0.0, -1.0): "up", (0.0, 1.0): "down", (-1.0, 0.0): "to the left", (1.0, 0.0): "to the right"}[direction]


def main() -> None:
    PLACE.write_text(page(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
