"""``keypose.toml``: the order of the phases, the unit, what the phases stand for."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mien.core import LoadError, MienError, UnknownNameError

from .records import UNITS_M, Eyes, Vector
from .standard import standard_phases

FORMAT, VERSION = "mien-keypose", 1
KEYS = (
    "format", "version", "name", "doc", "unit", "phases", "mirror", "stands_for", "sided", "pivot", "neck", "eyes",
)  # fmt: skip
PHASE_NAME = re.compile(r"[a-z][a-z0-9_]*")
TAKEN = "number"
"""The parameter ``phase.number`` is Parke's."""

MOST_PHASES = 99


@dataclass(frozen=True)
class Settings:
    """What the file says; the fields are those of ``Keypose``."""

    phases: tuple[str, ...]
    name: str = ""
    doc: str = ""
    unit: str = "mm"
    mirror: bool = True
    stands_for: Mapping[str, str] = field(default_factory=dict)
    sided: tuple[str, ...] = ()
    pivot: Vector | None = None
    eyes: Eyes | None = None
    neck: tuple[float, float] | None = None


def read_settings(path: Path, text: str) -> Settings:
    """The settings in the text of a file.

    Raises:
        LoadError: it cannot be understood; names the key.
    """
    try:
        record = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise LoadError(path, f"is not TOML: {error}") from None
    if record.get("format") != FORMAT:
        raise LoadError(path, f"want format = {FORMAT!r}, got {record.get('format')!r}")
    if record.get("version") != VERSION:
        raise LoadError(path, f"version {record.get('version')!r}, wanted {VERSION}", hint="another mien made it")
    try:
        for key in record:
            if key not in KEYS:
                raise UnknownNameError("key", key, KEYS)
        return _settings(record)
    except MienError as error:
        raise LoadError(path, str(error)) from None


def _settings(record: Mapping[str, Any]) -> Settings:
    phases = _phases(record.get("phases"))
    unit = _typed(record, "unit", str, "mm")
    if unit not in UNITS_M:
        raise UnknownNameError("unit", unit, UNITS_M)
    sided = _names(record.get("sided", []), "sided")
    for name in sided:
        if name not in phases[1:]:
            raise UnknownNameError("phase in sided:", name, phases[1:])
    pivot = _vector(record["pivot"], "pivot", unit) if "pivot" in record else None
    return Settings(
        phases,
        _typed(record, "name", str, ""),
        _typed(record, "doc", str, ""),
        unit,
        _typed(record, "mirror", bool, True),
        _stands_for(_typed(record, "stands_for", dict, {}), phases),
        sided,
        pivot,
        _eyes(_typed(record, "eyes", dict, {}), unit) if "eyes" in record else None,
        _neck(record["neck"], unit) if "neck" in record else None,
    )


def _phases(value: object) -> tuple[str, ...]:
    phases = _names(value, "phases")
    if not 1 <= len(phases) <= MOST_PHASES:
        raise MienError(f"phases: {len(phases)} of them — a face has 1 to {MOST_PHASES}")
    for name in phases:
        if not PHASE_NAME.fullmatch(name) or name == TAKEN:
            raise MienError(
                f"phases: {name!r} cannot be the name of a phase — small letters, digits and _, as brows_up"
            )
        if phases.count(name) > 1:
            raise MienError(f"phases: {name!r} is there twice")
    return phases


def _stands_for(rows: Mapping[str, Any], phases: tuple[str, ...]) -> dict[str, str]:
    found: dict[str, str] = {}
    for own, name in rows.items():
        if own not in phases:
            raise UnknownNameError("phase in stands_for:", own, phases)
        if name not in standard_phases():
            raise UnknownNameError("standard phase", str(name), standard_phases())
        if name in phases or name in found.values():
            raise MienError(f"stands_for: two phases are {name!r} — one of them has to go by another name")
        found[own] = name
    return found


def _eyes(rows: Mapping[str, Any], unit: str) -> Eyes:
    for key in rows:
        if key not in ("part", "center"):
            raise UnknownNameError("key of eyes:", key, ("part", "center"))
    if "center" not in rows:
        raise MienError("eyes.center: is missing — [x, y, z] of the middle of the left eyeball")
    return Eyes(_typed(rows, "part", str, "eyes"), _vector(rows["center"], "eyes.center", unit))


def _names(value: object, key: str) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(name, str) for name in value):
        raise MienError(f"{key}: want a list of names, got {value!r}")
    return tuple(value)


def _neck(value: object, unit: str) -> tuple[float, float]:
    heights = _numbers(value, unit)
    if len(heights) != 2 or not heights[0] < heights[1]:
        raise MienError(f"neck: want [height where nothing turns, height where all does] in {unit}, got {value!r}")
    return heights[0], heights[1]


def _vector(value: object, key: str, unit: str) -> Vector:
    place = _numbers(value, unit)
    if len(place) != 3:
        raise MienError(f"{key}: want [x, y, z] in {unit}, got {value!r}")
    return place[0], place[1], place[2]


def _numbers(value: object, unit: str) -> list[float]:
    """The numbers of a list in metres; none if something else is among them."""
    numbers = value if isinstance(value, list) else []
    if not all(isinstance(x, int | float) and not isinstance(x, bool) and math.isfinite(x) for x in numbers):
        return []
    return [float(number) * UNITS_M[unit] for number in numbers]


def _typed(record: Mapping[str, Any], key: str, kind: type, default: Any) -> Any:
    value = record.get(key, default)
    if not isinstance(value, kind):
        words = {str: "a text", bool: "true or false", dict: "a table"}
        raise MienError(f"{key}: want {words[kind]}, got {value!r}")
    return value
