"""A new capture project: what can be guessed from photographs, and what is to be filled in."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable, Sequence
from itertools import product
from pathlib import Path

from mien.core import MienError
from mien.formats.atomic import writing, writing_folder

from .photographs import lens_key, photograph_size
from .project_points import format_points, format_references
from .project_records import PICTURES, POINTS, PROJECT, REFERENCES, Pair, Project
from .project_toml import format_project
from .records import REST, Photograph, Reference

_PARTS = re.compile(
    r"(?P<moment>.*?[^\W\d_].*?)(?:[ _.-]*\(?(?P<number>\d+)\)?"
    r"|[ _.-]+(?P<word>(?i:front|side|left|right|center|centre|top|bottom|[a-h]))|(?<=[a-z])(?P<letter>[A-H]))"
)
"""Names as in smile-2, smile (2), smile_left, smileB."""

_VIEW = re.compile(
    r"(?P<view>(?:left|right|front|side|cent(?:er|re)|top|bottom)(?=[ _.-]*\d)"
    r"|cam(?:era)?[ _-]?(?:[a-z]|\d+)(?=[ _.-]))"
    r"[ _.-]*(?P<number>\d+)",
    re.IGNORECASE,
)
"""Names as in left01, cam-b_12: a camera of a rig, and which of its moments."""

_COUNTED = re.compile(r"(img|image|dsc|dscn|dscf|p|pict|photo|pxl|mvi|screenshot)[ _-]*\d.*", re.IGNORECASE)
"""What cameras call all of their pictures."""

NOTES = """\
# What is measured on these photographs goes into points.csv (photo,point,u,v,sigma: u right and v down in pixels of the
# upright picture, from its upper left corner; sigma, how exact the click is, may be left empty).
# What is known of places goes into references.csv (point,x,y,z,sigma: lengths in the unit below).
# moment: photographs of one moment show the face as it was at one time; camera: photographs of one camera have the same
# lens, at the same zoom; fixed = true: it stood still, too. Then: mien capture solve FOLDER
"""

CUBE_NOTES = """
# Corners of the cube in references.csv: cube-101 is at the far end of its edges along x and z, at the near end along y.
# x, y and z are as thumb, forefinger and middle finger of a right hand.
"""

BOARD_NOTES = """
# A chessboard in the photographs (its squares counted, not its corners; its side in the unit above):
# [[board]]
# kind = "chessboard"
# columns = 10
# rows = 7
# square = 25.0
"""

PAIR_NOTES = """\
# scale = ["exocanthion.left", "tragion.left", 92.0]
# midline = ["nasion", "pogonion"]
# camera_distance = { "front.jpg" = 1500.0 }
"""


def cube_references(edge_m: float) -> list[Reference]:
    """Corners of a cube, ``cube-000`` to ``cube-111``: which of x, y and z are at the far end of its edges."""
    return [Reference(f"cube-{a}{b}{c}", a * edge_m, b * edge_m, c * edge_m) for a, b, c in product((0, 1), repeat=3)]


def guess_photographs(paths: Sequence[Path]) -> tuple[Photograph, ...]:
    """Photographs with cameras and moments by what their names and their cameras say.

    ``smile-2.jpg`` is the second view of the moment ``smile``, ``left02.jpg`` the second moment of the camera ``left``;
    ``IMG_0123.jpg`` tells nothing. Pictures of other sizes,
    or of another camera or focal length by their Exif, have another lens. Where there are several moments, views are
    cameras.

    Raises:
        MienError: one is no picture, or two have the same name.
    """
    names = [path.name for path in paths]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise MienError(f"two photographs are called {twice} — points are told by that name: give one another name")
    guessed = [_guess(path.stem) for path in paths]
    several = len({moment for moment, _ in guessed}) > 1
    keys = [(lens_key(path), view if several else "") for path, (_, view) in zip(paths, guessed, strict=True)]
    order = list(dict.fromkeys(keys))
    return tuple(
        Photograph(path.name, photograph_size(path), _letter(order.index(key)), moment, False, path)
        for path, (moment, _), key in zip(paths, guessed, keys, strict=True)
    )


def _guess(stem: str) -> tuple[str, str]:
    """Moment and view in the name of a file."""
    if _COUNTED.fullmatch(stem):
        return REST, ""
    if stem.lower() in ("front", "side", "left", "right"):
        return REST, stem.lower()
    rig = _VIEW.fullmatch(stem)
    if rig is not None:
        return f"moment-{rig['number']}", rig["view"].lower()
    parts = _PARTS.fullmatch(stem)
    if parts is None:
        return (stem if re.search(r"[^\W\d_]", stem) else REST), ""
    return parts["moment"], (parts["number"] or parts["word"] or parts["letter"]).lower()


def _letter(number: int) -> str:
    return chr(ord("a") + number) if number < 26 else f"camera-{number + 1}"


def begin_project(
    folder: Path, paths: Sequence[Path], *, unit: str = "mm", cube_m: float | None = None, pair: bool = False
) -> Project:
    """Makes the folder of a project with copies of the photographs, or fills one that holds them already.

    Args:
        folder: to make; one that is there must hold all of the photographs, and no project.
        paths: of the photographs.
        unit: of lengths in its files.
        cube_m: edge of a cube, to write the corners of into ``references.csv``.
        pair: a front and a side photograph without references, told in that order.

    Raises:
        MienError: a photograph cannot be used, or the folder not be written.
    """
    if pair and len(paths) != 2:
        raise MienError(f"a pair is a front and a side photograph, in that order, got {len(paths)} photographs")
    photographs = guess_photographs(paths)
    if pair:
        photographs = tuple(
            Photograph(each.name, each.size_px, each.camera, REST, False, each.path) for each in photographs
        )
    project = Project(
        folder,
        folder.resolve().name,
        photographs,
        unit=unit,
        pair=Pair(photographs[0].name, photographs[1].name) if pair else None,
    )
    texts = {POINTS: format_points(())}
    hints = PAIR_NOTES if pair else BOARD_NOTES
    if cube_m is not None and not pair:
        texts[REFERENCES] = format_references(cube_references(cube_m), unit)
        hints = f"{CUBE_NOTES}{BOARD_NOTES}"
    texts[PROJECT] = f"{NOTES}{format_project(project)}{hints}"
    if folder.exists():
        _fill(folder, paths, texts)
    else:
        with writing_folder(folder, ()) as place:
            (place / PICTURES).mkdir()
            for path in paths:
                shutil.copyfile(path, place / PICTURES / path.name)
            for name, text in texts.items():
                (place / name).write_text(text, encoding="utf-8", newline="\n")
    return project


def _fill(folder: Path, paths: Iterable[Path], texts: dict[str, str]) -> None:
    """Writes the files of a project beside the photographs; what is there stays as it is."""
    if not folder.is_dir():
        raise MienError(f"{folder}: is a file — give the name of a folder to make")
    if (folder / PROJECT).exists():
        raise MienError(f"{folder / PROJECT}: there is a project already — edit it, or give another folder")
    outside = [path for path in paths if path.resolve().parent not in (folder.resolve(), (folder / PICTURES).resolve())]
    if outside:
        raise MienError(
            f"{folder}: the folder is there already, and {outside[0]} does not lie in it — give a new folder, which "
            "gets copies of the photographs, or put them there first"
        )
    for name, text in sorted(texts.items(), key=lambda item: item[0] == PROJECT):
        if not (folder / name).exists():
            with writing(folder / name) as place:
                place.write_text(text, encoding="utf-8", newline="\n")
