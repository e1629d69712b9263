"""All that is wrong with a file of a drawn face, each with its place."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

from mien.core import MienError

from .checks_drawn import find_misplaced
from .checks_faults import Fault, Place
from .checks_limits import find_wrong_limits
from .checks_names import find_wrong_names
from .checks_outlines import find_wrong_outlines
from .checks_places import Places, find_depth, find_places
from .checks_poses import POSES, find_wild_poses
from .checks_schema import find_mismatches
from .checks_sheet import Sheet
from .motors import motors
from .polygon_reader import COLOR
from .reader import MOST_BYTES, parse_toon
from .records import Character
from .schema import toon_schema
from .toon import ToonFace

DEEPEST = 16
"""Lists and objects within one another; a face has half as many."""

MOST_FAULTS = 1000
"""Of one file; whoever has more has them all from one slip."""

GREY = "#808080"


@dataclass(frozen=True)
class Report:
    """What was found in a file.

    Attributes:
        faults: in the order of their lines.
        face: the face, if nothing keeps it from being one.
    """

    faults: tuple[Fault, ...]
    face: ToonFace | None = None

    @property
    def errors(self) -> int:
        """How many faults keep the face from being used."""
        return sum(fault.grave for fault in self.faults)


def check_file(path: Path) -> Report:
    """What is wrong with a file; one that cannot be read has that as its only fault."""
    try:
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
    except OSError as error:
        return _broken("file", f"cannot be read ({error.strerror})", hint="give the name of a face file")
    if len(data) > MOST_BYTES:
        what = f"is larger than {MOST_BYTES // 1_000_000} MB"
        return _broken("file", what, hint="a face is some thousand bytes; simplify its outlines")
    return check_bytes(data)


def check_bytes(data: bytes, poses: int = POSES) -> Report:
    """What is wrong with the bytes of a file; one without errors is played in ``poses``."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        return _broken("file", f"is not UTF-8 text (byte {error.start})", line=line)
    if (deep := find_depth(text, DEEPEST)) is not None:
        return _broken("depth", f"more than {DEEPEST} lists and objects within one another", line=deep)
    try:
        document = json.loads(text, parse_int=_integer)
    except json.JSONDecodeError as error:
        return _broken("json", f"column {error.colno}: {error.msg}", line=error.lineno, hint=_advice(error))
    places = find_places(text)
    faults, face = _check(document, places, poses)
    told = dict.fromkeys(_locate(fault, places, document) for fault in faults)
    return Report(tuple(sorted(told, key=lambda fault: (fault.line or 0, not fault.grave))), face)


def _check(document: Any, places: Places, poses: int) -> tuple[list[Fault], ToonFace | None]:
    repeated = [
        Fault("repeated", place, f"{place[-1]!r} stands here a second time", line=line)
        for place, line in places.repeated
    ]
    sheet = Sheet(document, tuple(islice(find_mismatches(document, toon_schema()), MOST_FAULTS)))
    if not isinstance(document, dict):
        return list(sheet.faults), None
    found = [*find_wrong_names(sheet), *find_wrong_limits(sheet), *find_wrong_outlines(sheet)]
    explained = {fault.place[:2] for fault in found if fault.rule == "limits"}
    plain = (fault for fault in sheet.faults if fault.rule != "range" or fault.place[:2] not in explained)
    faults = [*repeated, *plain, *found]
    found_at: dict[str, Place] = {name: ("polygons", number) for number, name in sheet.ids}
    if sheet.shared_hand is not None:
        found_at |= dict.fromkeys(sheet.shared_hand.ids, ("hand",))
    character = _mended(document, sheet, faults)
    if character is not None:
        faults += find_misplaced(character, found_at)
    if any(fault.grave for fault in faults):
        return faults, None
    try:
        face = ToonFace(parse_toon(json.dumps(document), "document"), "document")
    except MienError as error:
        return [*faults, Fault("type", (), str(error))], None
    return [*faults, *find_wild_poses(face, found_at, poses)], face


SOME_LIMITS = {"min": -1, "max": 1, "min_deg": -1, "max_deg": 1}
"""Of a motor whose own are wrong, while the rest of the face is looked at."""


def _mended(document: Mapping[str, Any], sheet: Sheet, faults: Iterable[Fault]) -> Character | None:
    """The face without the polygons and colours that have faults, so that the others can be looked at."""
    wrong = {fault.place[:2] for fault in faults if fault.grave and fault.place}
    parts = {name: part for name, part in sheet.members("parts").items() if ("parts", name) not in wrong}
    kept = [
        polygon
        for number, polygon in sheet.polygons
        if ("polygons", number) not in wrong and polygon.get("part") in (None, *parts)
    ]
    ids = {polygon["id"] for polygon in kept}
    hand = {key: value for key, value in sheet.members("hand").items() if key not in ("poses", "moves")}
    given = {"hand": hand} if sheet.shared_hand and not any(place[0] == "hand" for place in wrong) else {}
    palette = sheet.members("palette")
    background = document.get("background")
    try:
        return parse_toon(
            json.dumps(
                {
                    **{key: document[key] for key in ("mode", "size", "head", "features") if key in document},
                    **{"format": "mien-toon", "version": 1, "name": "mended"},
                    "background": background if background in palette else GREY,
                    "palette": {name: code if _is_color(code) else GREY for name, code in palette.items()},
                    "motors": {
                        code: SOME_LIMITS if ("motors", code) in wrong else limits
                        for code, limits in sheet.members("motors").items()
                        if code in motors()
                    },
                    **given,
                    **({"parts": parts} if parts else {}),
                    "polygons": [dict(_clipped(polygon, ids)) for polygon in kept],
                }
            ),
            "document",
        )
    except MienError:
        return None


def _is_color(code: Any) -> bool:
    return isinstance(code, str) and COLOR.fullmatch(code) is not None


def _clipped(polygon: Mapping[str, Any], ids: set[str]) -> Iterator[tuple[str, Any]]:
    """Members of a polygon, clipped only by polygons that there are."""
    for key, value in polygon.items():
        if key != "clip":
            yield key, value
        elif names := [name for name in ([value] if isinstance(value, str) else value) if name in ids]:
            yield key, names


def _locate(fault: Fault, places: Places, document: Any) -> Fault:
    """A fault with its line and the id of its polygon."""
    who = ""
    if fault.place[:1] == ("polygons",) and len(fault.place) > 1:
        polygon = document["polygons"][fault.place[1]]
        name = polygon.get("id") if isinstance(polygon, dict) else None
        who = name if isinstance(name, str) else ""
    return replace(fault, who=who, line=fault.line or places.line(fault.place))


def _broken(rule: str, what: str, *, line: int | None = None, hint: str = "") -> Report:
    return Report((Fault(rule, (), what, hint=hint, line=line),))


def _integer(digits: str) -> float:
    """Python refuses to read whole found_at of thousands of digits."""
    return int(digits) if len(digits) < 18 else float(digits)


def _advice(error: json.JSONDecodeError) -> str:
    """What to try where JSON ends to be JSON; empty where nothing is known of it."""
    here, before = error.doc[error.pos : error.pos + 1], error.doc[: error.pos].rstrip()[-1:]
    if not error.doc.strip():
        return "the file is empty; mien toon new writes a face to start from"
    if here in ("/", "#"):
        return "JSON has no comments; leave it out"
    if here == "'":
        return 'write texts between double quotes, "so"'
    if here in ("]", "}") and before == ",":
        return "remove the comma before it"
    if "trailing comma" in error.msg:
        return "remove this comma"
    if error.msg.startswith("Expecting ',' delimiter"):
        return "put a comma, or a closing bracket, before it"
    return "" if here else "the file ends too early; close what is open"
