"""Files of drawn faces, ``name.toon.json``, as records.

The first thing that is wrong ends the reading; ``mien toon check`` tells all that is wrong.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from mien.core import LoadError, MienError, UnknownNameError

from .fields import Fields
from .hands import PART, gestures_of, own_gestures, shared_hand
from .motor_values import motor_values
from .motors import motors, paper_codes
from .polygon_reader import COLOR, PolygonReader, check_clips, depth_of
from .records import (
    Character,
    Depth,
    Feature,
    Head,
    Limits,
    Mode,
    Point,
    Profile,
)
from .schema import find_extensions
from .table import PROPORTIONS

FORMAT, VERSION = "mien-toon", 1
MODES: tuple[Mode, ...] = ("strict", "extended")

MOST_BYTES = 20_000_000
"""More than any drawing needs; less than what stops a machine."""

FEATURE_POINTS: Mapping[str, tuple[str, ...]] = {
    "BR": ("BRL", "BRC", "BRM"),
    "BL": ("BLL", "BLC", "BLM"),
    "ER": ("ERO", "ERU", "ERI", "ERL"),
    "EL": ("ELO", "ELU", "ELI", "ELL"),
    "PR": ("PR",),
    "PL": ("PL",),
    "M": ("MR", "MT", "ML", "MB"),
    "N": ("N",),
    "AR": ("AR",),
    "AL": ("AL",),
}
PAPER_FEATURES = ("BR", "BL", "ER", "EL", "PR", "PL", "M")


def read_toon(path: Path) -> Character:
    """The character in a file.

    Raises:
        LoadError: it cannot be read or understood; names the place in the file.
    """
    try:
        if path.stat().st_size > MOST_BYTES:
            raise LoadError(path, f"is larger than {MOST_BYTES // 1_000_000} MB")
        return parse_toon(path.read_text(encoding="utf-8-sig"), str(path))
    except OSError as error:
        raise LoadError(path, error.strerror or str(error)) from None
    except UnicodeDecodeError:
        raise LoadError(path, "is not a text in UTF-8") from None


def parse_toon(text: str, place: str) -> Character:
    """The character in the text of a file.

    Raises:
        LoadError: it cannot be understood.
    """
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise LoadError(place, f"is not JSON: {error.msg}", line=error.lineno) from None
    except RecursionError:
        raise LoadError(place, "is nested too deeply") from None
    except ValueError:  # of Python itself
        raise LoadError(place, "has a number of thousands of digits") from None
    try:
        character = _character(Fields(document, ""))
        if character.mode == "strict":
            _check_strict(document)
        return character
    except LoadError:
        raise
    except MienError as error:
        raise LoadError(place, str(error), hint=f"mien toon check {place} tells all that is wrong") from None


def _check_strict(document: Any) -> None:
    """Makes sure that a document has nothing but what the paper has.

    Raises:
        MienError: it has; names the first such key.
    """
    extension = next(find_extensions(document), None)
    if extension is not None:
        place = ".".join(map(str, extension))
        raise MienError(f"{place}: is an extension, and the mode is strict — leave it out, or set mode to extended")


def _character(fields: Fields) -> Character:
    if fields.text("format") != FORMAT:
        raise fields.error("format", f"is not {FORMAT!r}")
    fields.text("$schema", "")  # for editors of JSON
    if fields.number("version") != VERSION:
        raise fields.error("version", f"is not {VERSION}, the only one that is known")
    mode = fields.choice("mode", MODES, "extended")
    palette = {name: _color(fields.inner("palette"), name) for name in fields.inner("palette").keys}
    fields.inner("palette").done()
    features = {name: _feature(each, name) for name, each in fields.group("features")}
    limits = {code: _limits(each, code) for code, each in fields.group("motors")}
    for name in PAPER_FEATURES:
        if name not in features:
            raise fields.error("features", f"want {name!r}, one of the seven features, but it is missing")
    for code in paper_codes():
        if code not in limits:
            raise fields.error("motors", f"want limits of {code!r}, one of the 21 motors, but there are none")
    head = _head(fields.inner("head"))
    reader = PolygonReader(mode, palette, features, limits)
    asked = fields.inner("hand") if "hand" in fields.keys else None
    if asked is not None and mode == "strict":
        raise fields.error("hand", "a strict face has none — the paper draws faces")
    hand = shared_hand(asked, reader) if asked is not None else None
    if hand is not None:
        limits.update(hand.limits)
    parts = {name: tuple(reader.drivers(each)) for name, each in fields.lists("parts")}
    polygons = tuple(reader.polygon(each, parts) for each in fields.items("polygons"))
    if hand is not None:
        if PART in parts:
            raise fields.error("parts", f"{PART!r} is the part of the shared hand — give this one another name")
        parts[PART] = hand.drivers(reader)
        polygons += tuple(hand.polygons(reader, parts))
    own = tuple(own_gestures(asked, limits)) if asked is not None else ()
    check_clips(polygons, fields)
    character = Character(
        fields.text("name"),
        _positive(fields, "size"),
        reader.fill(fields, "background"),
        palette,
        head,
        features,
        limits,
        polygons,
        mode,
        fields.text("doc", ""),
        fields.text("license", ""),
        {name: dict(_variant(each, palette)) for name, each in fields.group("palettes")},
        parts,
        {name: motor_values(each, limits) for name, each in fields.group("expressions")},
        dict(_proportions(fields.inner("proportions"))) if "proportions" in fields.keys else {},
        gestures_of(limits, own),
    )
    if asked is not None:
        asked.done()
    fields.done()
    return character


def _positive(fields: Fields, key: str) -> Point:
    width, height = fields.point(key)
    if not (0.0 < width <= 1e5 and 0.0 < height <= 1e5):
        raise fields.error(key, f"want two sides above 0, got {width:g} and {height:g}")
    return width, height


def _color(fields: Fields, key: str) -> str:
    code = fields.text(key)
    if not COLOR.fullmatch(code):
        raise fields.error(key, f"{code!r} is not a colour such as #2A4F63")
    return code


def _variant(fields: Fields, palette: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    for name in fields.keys:
        if name not in palette:
            raise UnknownNameError(f"{fields.place}: colour", name, palette)
        yield name, _color(fields, name)


def _proportions(fields: Fields) -> Iterator[tuple[str, tuple[float, float]]]:
    for name in fields.keys:
        if name not in PROPORTIONS:
            raise UnknownNameError(f"{fields.place}: proportion", name, PROPORTIONS)
        low, high = fields.point(name)
        if not low <= PROPORTIONS[name][0] <= high:
            raise fields.error(name, f"want limits around {PROPORTIONS[name][0]:g}, got {low:g} and {high:g}")
        if PROPORTIONS[name][1] == "factor" and low < 0.1:
            raise fields.error(name, f"want factors of at least 0.1, got {low:g}")
        yield name, (low, high)


def _head(fields: Fields) -> Head:
    center = fields.point("center")
    head = Head(
        center,
        _positive(fields, "radius"),
        fields.point("pivot", center),
        Depth(fields.number("depth", 0.0), fields.number("bulge", 0.0), fields.number("shorten", 0.0)),
    )
    fields.done()
    return head


def _feature(fields: Fields, name: str) -> Feature:
    if name not in FEATURE_POINTS:
        raise UnknownNameError("feature", name, FEATURE_POINTS)
    inner = fields.inner("points")
    points = {point: inner.point(point) for point in FEATURE_POINTS[name]}
    inner.done()
    feature = Feature(
        name,
        points,
        fields.flag("smooth"),
        _profile(fields, "profile") or Profile(),
        _profile(fields, "profile_open"),
        _profile(fields, "profile_shut"),
        fields.knots("shape") if "shape" in fields.keys else (),
        depth_of(fields),
    )
    fields.done()
    return feature


def _profile(fields: Fields, key: str) -> Profile | None:
    if key not in fields.keys:
        return None
    p, q = fields.point(key)
    if not (0.2 <= p <= 20.0 and 0.2 <= q <= 20.0):
        raise fields.error(key, f"want two exponents from 0.2 to 20, got {p:g} and {q:g}")
    return Profile(p, q)


def _limits(fields: Fields, code: str) -> Limits:
    if code not in motors():
        raise UnknownNameError("motor", code, motors())
    limits = Limits(*(fields.number(key, 0.0) for key in ("min", "max", "min_deg", "max_deg")))
    for low, least, most in (("min", limits.low, limits.high), ("min_deg", limits.low_deg, limits.high_deg)):
        if least > most:
            raise fields.error(low, f"the minimum {least:g} is above the maximum {most:g}")
        if not least <= 0.0 <= most:
            raise fields.error(low, f"rest, 0, is not between {least:g} and {most:g}")
    if motors()[code].unit == "deg" and not limits.high_deg > limits.low_deg:
        raise fields.error("max_deg", "a motor that is measured in degrees wants min_deg and max_deg")
    if max(-limits.low_deg, limits.high_deg) > 89.0:
        raise fields.error("max_deg", "want less than 90 degrees to either side")
    fields.done()
    return limits
