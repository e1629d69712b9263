"""From a capture project to a measured face."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from mien.core import LoadError, MienError
from mien.core.mesh import Ints, Points
from mien.faces.keypose.files import write_keypose
from mien.faces.keypose.records import Eyes, Keypose, KeyposeTopology, SkinPart
from mien.faces.keypose.topology_file import read_topology

from .bodies import fit_centre
from .coloring import Picture, even_out, hex_color, sample_colors
from .marks import MARKS, plain_marks, read_marks
from .phases import MeasuredPhases, measure_phases
from .project import read_project, read_solution
from .project_records import TOPOLOGY, Project

EYES, COLLAR = "eyes", "collar"
"""Parts of a topology that mean something: the left eyeball, which turns, and a garment, which does not."""
NECK_M = 0.045
"""How far above the garment the neck ends and all turns with the head."""

Report = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class MadeFace:
    """A face made of a project.

    Attributes:
        keypose: what is written.
        phases: how its points were found.
        colored: polygons that were seen in a photograph, of ``polygons``.
        polygons: how many it has.
        remarks: what was guessed, a sentence each.
    """

    keypose: Keypose
    phases: MeasuredPhases
    colored: int
    polygons: int
    remarks: tuple[str, ...]


def make_keypose(folder: Path, out: Path, *, name: str = "", doc: str = "", report: Report | None = None) -> MadeFace:
    """The face that a solved project shows, written to ``out``, a ``*.keypose`` folder.

    Moments of the photographs become phases, the first of them the face at rest.

    Raises:
        LoadError: a file of the project is missing or wrong.
        MienError: too little was measured, or the face cannot be written.
    """
    say = report or (lambda _: None)
    project = read_project(folder)
    path = folder / TOPOLOGY
    if not path.is_file():
        raise LoadError(path, "there is no such file", hint="it tells which points make which polygons, by number")
    topology = read_topology(path)
    count = topology.point_count
    marks = read_marks(folder / MARKS, count, project.unit) if (folder / MARKS).is_file() else plain_marks(count)
    solution = read_solution(folder)
    say("registering phases")
    phases = measure_phases(solution, topology, marks, still=project.still)
    say("looking at colours")
    colors, looks = sample_colors(solution, topology, marks.names, _pictures(project), say)
    painted = _painted(topology, even_out(colors, topology))
    keypose = Keypose(
        name or project.name,
        painted,
        phases.names,
        phases.places,
        bool(topology.midline),
        doc or project.doc,
        project.unit,
        eyes=_eyes(topology, phases.places[0]),
        neck=_neck(topology, phases.places[0]),
    )
    keypose = replace(keypose, places=np.round(keypose.places, 6))
    say(f"writing {out}")
    write_keypose(out, keypose)
    return MadeFace(keypose, phases, int(np.count_nonzero(looks)), len(looks), phases.remarks + _color_remarks(looks))


def _pictures(project: Project) -> Callable[[str], Picture]:
    from .photographs import read_photograph

    paths = {photograph.name: photograph.path for photograph in project.photographs}

    def picture_of(photo: str) -> Picture:
        path = paths[photo]
        if path is None:
            raise MienError(f"{project.folder / photo}: the photograph is not there, and colours are taken from it")
        return read_photograph(path)

    return picture_of


def _painted(topology: KeyposeTopology, colors: Points) -> KeyposeTopology:
    """The topology with other colours, (F, 3) sRGB 0..255."""
    rows = iter(colors)
    parts: list[SkinPart] = []
    for part in topology.parts:
        polygons = tuple(replace(polygon, color=hex_color(next(rows)), line=0) for polygon in part.polygons)
        parts.append(replace(part, polygons=polygons))
    return replace(topology, parts=tuple(parts))


def _eyes(topology: KeyposeTopology, rest: Points) -> Eyes | None:
    """The eyeballs, if there is a part that is called so."""
    points = _points_of(topology, EYES)
    if not len(points):
        return None
    x, y, z = np.round(fit_centre(rest[points]), 6).tolist()
    return Eyes(EYES, (x, y, z))


def _neck(topology: KeyposeTopology, rest: Points) -> tuple[float, float] | None:
    """Heights between which the head turns on the shoulders, if there is a part that is called a collar."""
    points = _points_of(topology, COLLAR)
    if not len(points):
        return None
    top = round(float(rest[points, 1].max()), 4)
    return top, round(top + NECK_M, 4)


def _points_of(topology: KeyposeTopology, name: str) -> Ints:
    """Sorted numbers, from 0, of the points of a part; none where there is no such part."""
    polygons = [polygon for part in topology.parts if part.name == name for polygon in part.polygons]
    return np.unique([number - 1 for polygon in polygons for number in polygon.points]).astype(np.int64)


def _color_remarks(looks: Ints) -> tuple[str, ...]:
    unseen = int(np.count_nonzero(looks == 0))
    if not unseen:
        return ()
    return (
        f"{unseen} of {len(looks)} polygons are seen in no photograph: they have the colour of those drafted alike.",
    )
