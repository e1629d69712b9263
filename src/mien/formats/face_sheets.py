"""Labelled sheets of any face, made from tables: presets, parameters, views, the names of a vocabulary."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Face, MienError, ParameterTable, Pose, Scene, UnknownNameError
from mien.core.scene import FRONT
from mien.render import Renderer
from mien.vocab import pose_from, vocabularies, vocabulary
from mien.vocab.loss import fits_on
from mien.vocab.rules import companions

from .notes import notes, software
from .picture import Picture
from .sheet import Block, Page, Section, check_page, set_sheet

SIZE_PX = (256, 256)
"""Size of a picture on a sheet where none is asked for."""

VIEWS: tuple[tuple[str, float, float], ...] = (
    ("three-quarter left", 35.0, 3.0),
    ("front", 0.0, 2.0),
    ("three-quarter right", -35.0, 3.0),
    ("left", 90.0, 2.0),
    ("back", 180.0, 2.0),
    ("right", -90.0, 2.0),
    ("above", 20.0, 40.0),
    ("three-quarter back", 145.0, 3.0),
    ("below", -20.0, -35.0),
)
"""Name, degrees around the face's own left, degrees upwards."""

SCENE_ROWS = ("light.", "viewer.", "target.")
"""What the rows begin with that the scene fills: they do not shape the face."""

CHANNELS = (".red", ".green", ".blue")


@dataclass(frozen=True)
class Shot:
    """One picture of a sheet."""

    pose: Pose
    scene: Scene


class _Shots:
    """Collects the pictures of a sheet, each of them once."""

    def __init__(self) -> None:
        self.all: list[Shot] = []
        self._numbers: dict[Shot, int] = {}

    def number(self, pose: Pose, scene: Scene) -> int:
        shot = Shot(pose, scene)
        if shot not in self._numbers:
            self._numbers[shot] = len(self.all)
            self.all.append(shot)
        return self._numbers[shot]


Fill = Callable[[Face, Pose, Scene, _Shots], tuple[Section, ...]]


def sheet_scene(kind: str, face: Face) -> Scene:
    """The scene of a sheet where none is asked for: the whole head for views, else nearer; a drawing from before.

    Raises:
        UnknownNameError: there is no such kind.
    """
    _fill(kind)
    if face.family == "toon":
        return Scene(position=FRONT, size_px=SIZE_PX)
    scene = Scene(size_px=SIZE_PX)
    return scene if kind == "views" else replace(scene, at=(0.0, -0.008, 0.0)).turned(14.0, 2.0, 0.93)


def make_sheet(
    face: Face,
    kind: str,
    pose: Pose | None = None,
    scene: Scene | None = None,
    *,
    threads: int = 1,
    report: Callable[[int, int], None] | None = None,
) -> Picture:
    """A page with labelled pictures of a face.

    Args:
        face: any face.
        kind: ``presets``, by their kind; ``parameters``, at the ends of their ranges, by group; ``views``; or a
            vocabulary, each of its names at its fullest, by group.
        pose: what every picture starts from; None is neutral.
        scene: light, shading, the size of one picture, where it is seen from; None as ``sheet_scene``.
        threads: how many draw; the picture does not depend on it.
        report: told (done, total) pictures.

    Raises:
        UnknownNameError: there is no such kind.
        MienError: the sheet would be too large or has nothing on it, or the face cannot play the vocabulary.
    """
    usual, shots = sheet_scene(kind, face), _Shots()
    scene = scene or usual
    sections = _fill(kind)(face, Pose.neutral(face.parameters) if pose is None else pose, scene, shots)
    page = Page(face.name, f"{kind} · {software()}", sections)
    check_page(page, scene.size_px)
    if report is not None:
        report(0, len(shots.all))

    # The pictures of one scene come one after the other, and so share a renderer.
    renderer = Renderer(shots.all[0].scene, threads)

    def picture(number: int) -> NDArray[np.uint8]:
        nonlocal renderer
        shot = shots.all[number]
        if shot.scene != renderer.scene:
            renderer.close()
            renderer = Renderer(shot.scene, threads)
        pixels = renderer.draw(face, shot.pose)
        if report is not None:
            report(number + 1, len(shots.all))
        return pixels

    try:
        return set_sheet(page, scene.size_px, picture, {**notes(face.name), "Title": f"{face.name}: {kind}"})
    finally:
        renderer.close()


def _presets(face: Face, pose: Pose, scene: Scene, shots: _Shots) -> tuple[Section, ...]:
    kinds: dict[str, list[Block]] = {}
    for preset in face.presets.values():
        number = shots.number(pose.replace(preset.values), scene)
        kinds.setdefault(preset.kind, []).append(Block(preset.name, "", (number,), (preset.doc,)))
    return tuple(Section(f"{kind}s" if kind else "", tuple(blocks)) for kind, blocks in kinds.items())


def _parameters(face: Face, pose: Pose, scene: Scene, shots: _Shots) -> tuple[Section, ...]:
    table = face.parameters
    groups: dict[str, list[Block]] = {}
    for name, rows in moving_rows(table).items():
        first = table[rows[0]]
        ends = [pose.replace(dict.fromkeys(rows, value)) for value in (first.low, first.high)]
        steps = [(f"{first.low:g}", ends[0]), ("at rest", pose), (f"{first.high:g}", ends[1])]
        if pose in ends:
            steps = [(text + (", at rest" if end == pose else ""), end) for text, end in steps if text != "at rest"]
        elif len({pose[row] for row in rows}) == 1:
            steps[1] = (f"{pose[rows[0]]:g}, at rest", pose)
        numbers = tuple(shots.number(step, scene) for _, step in steps)
        block = Block(name, first.unit, numbers, tuple(text for text, _ in steps))
        groups.setdefault(first.group, []).append(block)
    return tuple(Section(group, tuple(blocks)) for group, blocks in groups.items())


def moving_rows(table: ParameterTable) -> Mapping[str, tuple[str, ...]]:
    """What is moved together, by name: both sides, the channels of a colour; without what the scene fills."""
    together: dict[str, list[str]] = {}
    for row in table:
        if not row.name.startswith(SCENE_ROWS):
            together.setdefault(_common_name(table, row.name), []).append(row.name)
    return {name: tuple(rows) for name, rows in together.items()}


def _common_name(table: ParameterTable, name: str) -> str:
    stem, channel = name.rpartition(".")[::2]
    if f".{channel}" in CHANNELS and all(stem + each in table for each in CHANNELS):
        return stem
    return stem if stem in table.symmetric else name


def _views(face: Face, pose: Pose, scene: Scene, shots: _Shots) -> tuple[Section, ...]:
    if isinstance(face.shape(pose), Drawing):
        raise MienError(f"{face.name}: is a flat drawing and looks the same from everywhere — try --sheet presets")
    blocks = (Block(name, "", (shots.number(pose, scene.turned(yaw, pitch)),), ("",)) for name, yaw, pitch in VIEWS)
    return (Section("", tuple(blocks)),)


def _names(vocabulary_name: str, face: Face, pose: Pose, scene: Scene, shots: _Shots) -> tuple[Section, ...]:
    table = vocabulary(vocabulary_name)
    played = fits_on(vocabulary_name, face)
    groups: dict[str, list[Block]] = {}
    for name, rows in moving_rows(table).items():
        first = table[rows[0]]
        if first.name in played:
            both = first.doc.replace(" left ", " ") if len(rows) > 1 else first.doc
            # What rests between its ends is shown at both.
            ends = {"low end": first.low, both: first.high} if first.default > first.low else {both: first.high}
            beside = companions(vocabulary_name, first.name)
            posed = (
                pose_from(vocabulary_name, {**beside, **dict.fromkeys(rows, end)}, face, pose) for end in ends.values()
            )
            block = Block(name, "", tuple(shots.number(each, scene) for each in posed), tuple(ends))
            groups.setdefault(first.group, []).append(block)
    return tuple(Section(group, tuple(blocks)) for group, blocks in groups.items())


SHEETS: Mapping[str, Fill] = {"presets": _presets, "parameters": _parameters, "views": _views}
"""Kinds of sheets by name; a vocabulary is one more."""


def _fill(kind: str) -> Fill:
    """What fills a sheet of a kind.

    Raises:
        UnknownNameError: there is no such kind.
    """
    if kind in vocabularies():
        return partial(_names, kind)
    if kind not in SHEETS:
        raise UnknownNameError("sheet", kind, [*SHEETS, *vocabularies()])
    return SHEETS[kind]
