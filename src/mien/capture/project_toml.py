"""``project.toml``: which photographs there are and what is known of them."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import TypeVar

from mien.core import LoadError, UnknownNameError

from .photographs import photograph_size
from .project_keys import MOST, Keys, read_keys
from .project_points import shorten
from .project_records import DISTANCE_SIGMA_M, KINDS, METRES, PICTURES, PROJECT, Board, Pair, Project
from .records import REST, Photograph

FORMAT, VERSION = "mien-capture", 1

T = TypeVar("T")

DICTIONARIES = (
    *(f"DICT_{n}X{n}_{count}" for n in (4, 5, 6, 7) for count in (50, 100, 250, 1000)),
    "DICT_ARUCO_ORIGINAL",
    *(f"DICT_APRILTAG_{name}" for name in ("16h5", "25h9", "36h10", "36h11")),
)
"""Markers that OpenCV knows by name."""


def read_project_toml(folder: Path) -> Project:
    """What ``project.toml`` in a folder says.

    Raises:
        LoadError: there is no such folder or file, or what is wrong in it, and in which line.
    """
    path = folder / PROJECT
    if not folder.is_dir():
        raise LoadError(folder, "there is no such folder", hint=f"begin a project: mien capture new {folder} PHOTO…")
    if not path.is_file():
        raise LoadError(path, "there is no such file", hint=f"begin a project: mien capture new {folder} PHOTO…")
    keys = read_keys(path)
    _check_format(keys)
    unit = keys.choice("unit", METRES, "mm")
    tables = keys.tables("photograph")
    if not tables:
        raise LoadError(path, "there is no photograph", hint='want [[photograph]] and under it file = "front.jpg"')
    photographs = _read_photographs(tables, folder)
    names = [photograph.name for photograph in photographs]
    still = keys.table("still")
    pair = keys.table("pair")
    project = Project(
        folder=folder,
        name=keys.string("name", folder.resolve().name),
        doc=keys.string("doc", ""),
        unit=unit,
        photographs=photographs,
        boards=_read_boards(keys.tables("board"), names, METRES[unit]),
        pair=None if pair is None else _read_pair(pair, names, METRES[unit]),
        still=() if still is None else _finished(still, still.strings("points")),
    )
    keys.finish()
    return project


def _check_format(keys: Keys) -> None:
    kind = keys.string("format")
    if kind != FORMAT:
        raise keys.mistake("format", f"want {FORMAT!r}, got {kind!r}")
    version = keys.count("version", 1, 1_000_000)
    if version > VERSION:
        raise keys.mistake("version", f"is {version}, and this mien knows up to {VERSION}", "a newer mien reads it")


def _read_photographs(tables: list[Keys], folder: Path) -> tuple[Photograph, ...]:
    found: dict[str, Photograph] = {}
    for keys in tables:
        photograph = _read_photograph(keys, folder)
        if photograph.name in found:
            raise keys.mistake("file", f"there are two photographs {photograph.name!r}", "points are told by that name")
        for other in found.values():
            if other.camera == photograph.camera and other.size_px != photograph.size_px:
                raise keys.mistake("camera", _other_size(photograph, other), "give it a camera of its own")
        found[photograph.name] = photograph
    return tuple(found.values())


def _other_size(photograph: Photograph, other: Photograph) -> str:
    def size(of: Photograph) -> str:
        return f"{of.size_px[0]}x{of.size_px[1]}"

    turned = " (it was turned on its side)" if photograph.size_px == other.size_px[::-1] else ""
    return (
        f"{photograph.name} is {size(photograph)} pixels and {other.name}, of the same camera {other.camera!r}, "
        f"{size(other)}{turned}, so that they have no lens in common"
    )


def _read_photograph(keys: Keys, folder: Path) -> Photograph:
    file = keys.string("file")
    size = keys.take("size", list, "[width, height]", [])
    camera, moment, fixed = keys.string("camera", "a"), keys.string("moment", REST), keys.flag("fixed", False)
    if not camera or not moment:
        raise keys.mistake("camera" if not camera else "moment", "is empty", "leave it out, or give it a name")
    if size and not (len(size) == 2 and all(type(side) is int and 0 < side < MOST for side in size)):
        raise keys.mistake("size", f"want [width, height] in pixels, got {str(size)[:60]}")
    keys.finish()
    path = find_picture(folder, file)
    if path is None and not size:
        raise keys.mistake("file", _not_there(file, folder), "put it there, or tell size = [width, height]")
    seen = None if path is None else photograph_size(path)
    if seen and size and seen != tuple(size):
        got = f"{seen[0]}x{seen[1]}"
        raise keys.mistake("size", f"says {size[0]}x{size[1]}, but {file} is {got} pixels upright", "leave it out")
    width, height = seen or size
    return Photograph(Path(file).name, (width, height), camera, moment, fixed, path)


def find_picture(folder: Path, file: str) -> Path | None:
    """Where a photograph of a project lies, if it is there: in the folder itself or in ``photographs``."""
    return next((path for path in (folder / file, folder / PICTURES / file) if path.is_file()), None)


def _not_there(file: str, folder: Path) -> str:
    pictures = [path.name for place in (folder, folder / PICTURES) if place.is_dir() for path in place.iterdir()]
    return str(UnknownNameError("file", file, sorted(name for name in pictures if not name.startswith("."))))


def _read_boards(tables: list[Keys], names: Collection[str], metres: float) -> tuple[Board, ...]:
    boards: list[Board] = []
    for keys in tables:
        kind = keys.choice("kind", KINDS)
        target = keys.string("target", "board")
        charuco = kind == "charuco"
        board = Board(
            target=target,
            kind=kind,
            columns=keys.count("columns", 3, 200),
            rows=keys.count("rows", 3, 200),
            square_m=keys.length("square") * metres,
            marker_m=keys.length("marker") * metres if charuco else 0.0,
            dictionary=keys.choice("dictionary", DICTIONARIES) if charuco else "",
            photographs=_known(keys, "photographs", keys.strings("photographs"), names),
        )
        if ":" in target or not target:
            raise keys.mistake("target", f"want a name without ':', got {target!r}", "corners are target:row:column")
        if any(other.target == target for other in boards):
            raise keys.mistake("target", f"there are two boards {target!r}", 'give each a name, target = "left"')
        if charuco and board.marker_m >= board.square_m:
            raise keys.mistake("marker", "want it smaller than the square that it lies in")
        boards.append(_finished(keys, board))
    return tuple(boards)


def _read_pair(keys: Keys, names: Collection[str], metres: float) -> Pair:
    front, side = keys.string("front"), keys.string("side")
    _known(keys, "front", (front,), names)
    _known(keys, "side", (side,), names)
    if front == side:
        raise keys.mistake("side", f"is {side!r}, as the front is", "want two photographs")
    distances = keys.lengths("camera_distance")
    _known(keys, "camera_distance", distances, names)
    pair = Pair(
        front=front,
        side=side,
        scale=_read_scale(keys, metres),
        camera_distance_m={
            name: (distance * metres, sigma[0] * metres if sigma else DISTANCE_SIGMA_M)
            for name, (distance, *sigma) in distances.items()
        },
        orthographic=keys.flag("orthographic", False),
        midline=keys.strings("midline"),
        mirror=keys.flag("mirror", True),
        twins=keys.names("twins"),
        side_from=keys.choice("side_from", ("left", "right", ""), "") or None,
        side_turn_deg=keys.length("side_turn_deg", 3.0),
    )
    return _finished(keys, pair)


def _read_scale(keys: Keys, metres: float) -> tuple[str, str, float] | None:
    value = keys.take("scale", list, '["point", "point", distance]', [])
    if not value:
        return None
    kinds = [type(part) for part in value]
    if len(value) != 3 or kinds[:2] != [str, str] or kinds[2] not in (int, float) or not 0 < value[2] < MOST:
        raise keys.mistake(
            "scale", f'want two points and how far they are apart, ["a", "b", 92.0], got {str(value)[:60]}'
        )
    if value[0] == value[1]:
        raise keys.mistake("scale", f"want two points, got {value[0]!r} twice")
    return value[0], value[1], value[2] * metres


def _known(keys: Keys, key: str, wanted: Collection[str], names: Collection[str]) -> tuple[str, ...]:
    for name in wanted:
        if name not in names:
            raise keys.mistake(key, str(UnknownNameError("photograph", name, names)))
    return tuple(wanted)


def _finished(keys: Keys, value: T) -> T:
    keys.finish()
    return value


def format_project(project: Project) -> str:
    """The project as TOML, which is read as the same project."""
    unit = project.metres
    blocks = [
        _block(
            "", {"format": FORMAT, "version": VERSION, "name": project.name, "doc": project.doc, "unit": project.unit}
        )
    ]
    for photograph in project.photographs:
        keys = {"size": list(photograph.size_px), "moment": photograph.moment, "camera": photograph.camera}
        blocks.append(_block("[[photograph]]", {"file": photograph.name, **keys, "fixed": photograph.fixed}))
    blocks += [_block("[[board]]", _board_keys(board, unit)) for board in project.boards]
    if project.pair is not None:
        blocks.append(_block("[pair]", _pair_keys(project.pair, unit)))
    if project.still:
        blocks.append(_block("[still]", {"points": list(project.still)}))
    return "\n".join(blocks)


def _board_keys(board: Board, unit: float) -> dict[str, object]:
    keys: dict[str, object] = {
        "kind": board.kind,
        "target": board.target,
        "columns": board.columns,
        "rows": board.rows,
        "square": shorten(board.square_m, unit),
    }
    if board.kind == "charuco":
        keys |= {"marker": shorten(board.marker_m, unit), "dictionary": board.dictionary}
    return {**keys, "photographs": list(board.photographs)}


def _pair_keys(pair: Pair, unit: float) -> dict[str, object]:
    return {
        "front": pair.front,
        "side": pair.side,
        "scale": [] if pair.scale is None else [*pair.scale[:2], shorten(pair.scale[2], unit)],
        "camera_distance": {
            name: [shorten(part, unit) for part in parts] for name, parts in pair.camera_distance_m.items()
        },
        "orthographic": pair.orthographic,
        "midline": list(pair.midline),
        "mirror": pair.mirror,
        "twins": dict(pair.twins),
        "side_from": pair.side_from or "",
        "side_turn_deg": pair.side_turn_deg,
    }


def _block(header: str, values: Mapping[str, object]) -> str:
    lines = [f"{key} = {_toml(value)}" for key, value in values.items() if value not in ([], {}, "")]
    return "\n".join([*([header] if header else []), *lines, ""])


def _toml(value: object) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{_toml(name)} = {_toml(part)}' for name, part in value.items())} }}"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return str(value).lower() if isinstance(value, bool) else repr(value)
