"""Names in a document that lead to nothing, to several things, or that nothing leads to; what strict mode has not."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Any

from .checks_faults import Fault, Place
from .checks_schema import suggest
from .checks_sheet import Sheet
from .hands import PART, SLOTS, hand_names
from .motors import motors
from .polygon_reader import COLOR
from .reader import FEATURE_POINTS
from .schema import find_extensions

OF_POINT = {point: feature for feature, points in FEATURE_POINTS.items() for point in points}


def find_wrong_names(sheet: Sheet) -> Iterator[Fault]:
    """All faults of names."""
    yield from _ids(sheet)
    yield from _colors(sheet)
    yield from _attachments(sheet)
    yield from _hand(sheet)
    yield from _values(sheet)
    yield from _unused(sheet)
    if sheet.strict:
        for place in find_extensions(sheet.document):
            yield Fault("strict", place, f"{place[-1]!r} is an extension, and the mode is strict")


def _ids(sheet: Sheet) -> Iterator[Fault]:
    first: dict[str, int] = {}
    for number, name in sheet.ids:
        if name in first:
            yield Fault(
                "repeated id", ("polygons", number, "id"), f"{name!r} is also the id of polygons[{first[name]}]"
            )
        first.setdefault(name, number)


def _colors(sheet: Sheet) -> Iterator[Fault]:
    places: list[Place] = [("background",), *(("polygons", number, "fill") for number, _ in sheet.polygons)]
    places += [("hand", slot) for slot in SLOTS]
    known = sheet.members("palette")
    for place in places:
        name = sheet.sound(*place)
        if name is not None and not COLOR.fullmatch(name) and name not in known:
            yield _unknown("palette", place, "colour", name, known)
    for variant in sheet.members("palettes"):
        for name in sheet.members("palettes", variant):
            if name not in known:
                yield _unknown("palette", ("palettes", variant, name), "colour", name, known)


def _attachments(sheet: Sheet) -> Iterator[Fault]:
    ids, parts = [name for _, name in sheet.ids], sheet.members("parts")
    for number, polygon in sheet.polygons:
        place: Place = ("polygons", number)
        yield from _named(polygon, place, "feature", "feature", sheet.features)
        yield from _named(polygon, place, "motor", "motor", sheet.motors)
        yield from _named(polygon, place, "part", "part", parts)
        if "with" in polygon and OF_POINT[polygon["with"]] not in sheet.features:
            points = [point for point, feature in OF_POINT.items() if feature in sheet.features]
            yield _unknown("attached", (*place, "with"), "control point", polygon["with"], points)
        for name in _cutters(polygon):
            if name not in ids:
                yield _unknown("attached", (*place, "clip"), "polygon", name, ids)
    for place, driver in sheet.drivers():
        yield from _named(driver, place, "motor", "motor", sheet.motors)
    for place, line in sheet.lines():
        yield from _named(line, place, "feature", "feature", sheet.features)
        yield from _named(line.get("offset_by", {}), (*place, "offset_by"), "motor", "motor", sheet.motors)
        for code in line.get("at", ()):
            yield from _named({code: code}, (*place, "at"), code, "motor", sheet.motors)


def _cutters(polygon: Mapping[str, Any]) -> list[str]:
    """Ids of the polygons that a polygon is clipped by."""
    clip = polygon.get("clip", ())
    return [clip] if isinstance(clip, str) else list(clip)


def _values(sheet: Sheet) -> Iterator[Fault]:
    for place, values in sheet.values():
        for code, value in values.items():
            yield from _named({code: code}, place, code, "motor", sheet.motors)
            low, high = _range(sheet, code)
            if not low <= value <= high:
                wanted = f"from {low:g} to {high:g}"
                yield Fault("range", (*place, code), f"is more than {code} can do", wanted, f"{value:g}")


def _hand(sheet: Sheet) -> Iterator[Fault]:
    yield from _named(sheet.members("hand"), ("hand",), "use", "hand", hand_names())
    hand = sheet.shared_hand
    if hand is not None and PART in sheet.members("parts"):
        yield Fault("repeated id", ("parts", PART), f"{PART!r} is the part of the shipped hand {hand.name!r}")
    taken = hand.ids if hand is not None else ()
    for number, name in sheet.ids:
        if name in taken:
            yield Fault("repeated id", ("polygons", number, "id"), f"{name!r} is a polygon of the shipped hand")


def _range(sheet: Sheet, code: str) -> tuple[float, float]:
    """Lowest and highest value of a motor in an expression."""
    unit = motors()[code].unit
    if unit != "deg":
        return (-1.0 if unit == "signed" else 0.0), 1.0
    limits = sheet.sound("motors", code) or {}
    return limits.get("min_deg", -180.0), limits.get("max_deg", 180.0)


def _unused(sheet: Sheet) -> Iterator[Fault]:
    everyone = [polygon for polygon in sheet.value("polygons") or () if isinstance(polygon, dict)]
    if not everyone:
        return
    fills = {str(polygon.get("fill")) for polygon in everyone} | {str(sheet.value("background"))}
    fills |= {str(sheet.value("hand", slot)) for slot in SLOTS}
    for key, used in (("palette", fills), ("parts", {str(polygon.get("part")) for polygon in everyone})):
        for name in sheet.members(key):
            if name not in used:
                yield Fault("unseen", (key, name), "is used by no polygon")
    cutters = {name for _, polygon in sheet.polygons for name in _cutters(polygon)}
    for number, polygon in sheet.polygons:
        if polygon.get("opacity") == 0 and polygon.get("id") not in cutters:
            yield Fault("unseen", ("polygons", number, "opacity"), "nothing of it is seen")


def _named(members: Any, place: Place, key: str, kind: str, known: Collection[str]) -> Iterator[Fault]:
    if key in members and members[key] not in known:
        yield _unknown("attached", (*place, key), kind, members[key], known)


def _unknown(rule: str, place: Place, kind: str, name: str, known: Collection[str]) -> Fault:
    what, hint = suggest(kind, name, sorted(known))
    return Fault(rule, place, what, hint=hint)
