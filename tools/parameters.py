"""Build docs/parameters.md and its pictures from the tables of the head.

python tools/parameters.py [--pictures [NAME ...]]
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path

import numpy as np
from PIL import Image

import mien
from mien.core import Parameter, Pose, exact, fill_rows, subdivide
from mien.faces.head.head import Head
from mien.faces.head.people import shipped_head
from mien.faces.head.regions import weigh_region
from mien.faces.head.table import conformation_rows
from mien.formats.face_sheets import SCENE_ROWS, moving_rows
from mien.render import draw_mesh

ROOT = Path(__file__).parents[1]
PLACE, PICTURES, VIEWS = ROOT / "docs/parameters.md", ROOT / "docs/parameters", Path(__file__).with_name("views.csv")
HEADER = """# Parameters of the head

Made by `python tools/parameters.py --pictures` from the table itself; `mien params head` prints the same. Left and
right are the face's own. A name without its side sets both. One Parke unit is 0.16 mm (decision 0006). Each row tells
its range with the value at rest in bold, how far the point that moves most goes at either end, and where it comes from.
Pictures show the ends and the rest, or what lies half-way where the rest is an end. Of a shape they first show where it
acts, in orange. The order in which the parameters act is in [structure.md](structure.md).
"""
STRONG = 0.6
"""Share of the farthest move that is tinted fully."""

SIZE_PX, SCALE, QUALITY = 168, 2, 80
TINT = np.array([0.95, 0.20, 0.02])
CHANNELS = (".red", ".green", ".blue")


@dataclass(frozen=True)
class Entry:
    """Rows that are shown as one: both sides of a pair, the channels of a colour."""

    name: str
    rows: tuple[str, ...]

    @property
    def first(self) -> Parameter:
        return person().parameters[self.rows[0]]


@cache
def person(hair: str = "bald") -> Head:
    """The default person with other hair."""
    return replace(shipped_head("head"), hair=hair)


def entries() -> Iterator[Entry]:
    table = person().parameters
    together = {**moving_rows(table), **{row.name: (row.name,) for row in table if row.name.startswith(SCENE_ROWS)}}
    for rows in table.groups().values():
        names = {row.name for row in rows}
        yield from (Entry(name, rows) for name, rows in together.items() if names.issuperset(rows))


# ------------------------------------------------------------------ the page


def page() -> str:
    groups = person().parameters.groups()
    lines, group = [HEADER, " · ".join(f"[{name}](#{name.replace(' ', '-')})" for name in groups), ""], ""
    for entry in entries():
        row = entry.first
        if row.group != group:
            group = row.group
            lines += [f"## {group.capitalize()}", ""]
        sides = " `.left` `.right`" if row.name.endswith(".left") else ""
        sides = " `.red` `.green` `.blue`" if row.name.endswith(".red") else sides
        doc = row.doc.replace(" left ", " ", 1) if row.name.endswith(".left") else row.doc
        doc = doc.removesuffix(" (red, linear light)")
        lines += [
            f"**`{entry.name}`**{sides} — {doc}",
            "",
            f"{_range(entry)}{_displacement(entry)} · {row.source}",
            "",
            f"![{entry.name}](parameters/{entry.name}.jpg)",
            "",
        ]
    return "\n".join(lines)


def _range(entry: Entry) -> str:
    row, table = entry.first, person().parameters
    if row.name.endswith(CHANNELS):
        rest = "".join(f"{_srgb_byte(table[name].default):02x}" for name in entry.rows)
        return f"{row.low:g} … {row.high:g} {row.unit} · at rest `#{rest}`"
    values = dict.fromkeys((row.low, row.default, row.high))
    return " … ".join(f"**{value:g}**" if value == row.default else f"{value:g}" for value in values) + f" {row.unit}"


def _srgb_byte(linear: float) -> int:
    return min(range(256), key=lambda byte: abs(exact.srgb_to_linear(byte / 255.0) - linear))


def _displacement(entry: Entry) -> str:
    """How far the point that moves most goes at each end, mm; nothing where none moves."""
    row = entry.first
    ends = zip((row.low, row.high), row.reach_mm or (0.0, 0.0), strict=True)
    told = [f"{mm:.1f}" for end, mm in ends if end != row.default and mm >= 0.05]
    return f" · {' and '.join(told)} mm" if told else ""


# ------------------------------------------------------------------ the pictures


@cache
def views() -> tuple[dict[str, str], ...]:
    return tuple(csv.DictReader(VIEWS.read_text(encoding="utf-8").splitlines()))


def view_of(name: str) -> dict[str, str]:
    """The first row of ``views.csv`` that fits a parameter; a pattern for sides fits their common name."""
    return next(
        row
        for row in views()
        if any(fnmatchcase(f"{name}.", f"{p.removesuffix('.*')}.*") for p in row["parameters"].split())
    )


def strip(entry: Entry) -> bytes:
    """JPEG with the region of a shape, then the ends of a range and the rest."""
    view, row = view_of(entry.name), entry.first
    face = person(view["hair"])
    held = dict(text.split("=") for text in view["with"].split())
    base = face.neutral.replace({name: float(value) for name, value in held.items()})
    scene = _scene(view)
    values = [row.low, row.default, row.high]
    if row.default in (row.low, row.high):
        values[1] = 0.5 * (row.low + row.high)
    poses = [base if value == row.default else base.replace(dict.fromkeys(entry.rows, value)) for value in values]
    pictures = [mien.draw(face, pose, scene) for pose in poses]
    labels = [_label(row, value) for value in values]
    if (weights := _weights(entry, base)) is not None:
        pictures.insert(0, _tinted(face, base, scene, weights))
        labels.insert(0, "where")
    small = [replace(each, pixels=np.asarray(Image.fromarray(each.pixels).reduce(SCALE))) for each in pictures]
    return mien.contact_sheet(small, len(small), labels).to_jpeg(QUALITY)


def _label(row: Parameter, value: float) -> str:
    if row.name.endswith(CHANNELS):
        return "at rest" if value == row.default else "white" if value else "black"
    return f"{value:g}" + (", at rest" if value == row.default else "")


def _scene(view: dict[str, str]) -> mien.Scene:
    side, up, forward = (float(view[key]) / 1000.0 for key in ("side_mm", "up_mm", "forward_mm"))
    scene = mien.Scene(size_px=(SCALE * SIZE_PX,) * 2, at=(side, up, forward), target=(0.0, 0.0, 2.0))
    return scene.turned(*(float(view[key]) for key in ("yaw_deg", "pitch_deg", "distance_m")))


def _weights(entry: Entry, base: Pose) -> np.ndarray | None:
    """(V,) 0..1 how much a point takes part in a row of the shape; None for other rows."""
    shape = next((row for row in conformation_rows() if row["name"] == entry.name), None)
    if shape is None:
        return None
    face = person()
    if shape["region"] and shape["kind"] != "field":
        points = face.shape(face.neutral).points
        sides = (points, points * (-1.0, 1.0, 1.0)) if shape["sides"] else (points,)
        each = [weigh_region(shape["region"], side) * (side[:, 0] > 0.0 if shape["sides"] else 1.0) for side in sides]
        return np.max(each, axis=0)
    ends = [
        face.shape(base.replace(dict.fromkeys(entry.rows, value))).points
        for value in (entry.first.low, entry.first.high)
    ]
    far = np.sqrt(((ends[1] - ends[0]) ** 2).sum(axis=1))
    return np.clip(far / (STRONG * far.max()), 0.0, 1.0)


def _tinted(face: mien.Face, pose: Pose, scene: mien.Scene, weights: np.ndarray) -> mien.Picture:
    mesh = face.shape(fill_rows(face, pose, scene))
    grey = np.repeat(mesh.colors @ [[0.3], [0.6], [0.1]], 3, axis=1)
    colors = grey + weights[:, None] * (TINT - grey)
    return mien.Picture(draw_mesh(subdivide(replace(mesh, colors=colors), scene.subdivide), scene))


def main(arguments: list[str]) -> None:
    if arguments[:1] == ["--pictures"]:
        PICTURES.mkdir(exist_ok=True)
        wanted = {entry.name: entry for entry in entries() if entry.name in arguments or not arguments[1:]}
        for entry in wanted.values():
            (PICTURES / f"{entry.name}.jpg").write_bytes(strip(entry))
        if not arguments[1:]:
            for path in PICTURES.glob("*.jpg"):
                if path.stem not in wanted:
                    path.unlink()
    PLACE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
