"""Photograph a person of the reference folder: dressed, marked with dots, in the cube of strings, by four cameras.

    python tools/photograph.py ../shared/reference ivy ../ivy

writes a capture project: photographs of every phase, where the dots are clicked with an error of the hand, the beads of
the cube, and the topology that the dots are corners of. ``truth.npz`` beside it tells where they truly are; nothing but
``tools/measure_person.py``, which compares, reads it.
"""

from __future__ import annotations

import csv
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).parent))
from measuring.reference import Reference
from model_hair import CAPS
from photographing.drafting import Draft, drafted
from photographing.halves import draft
from photographing.set_up import SIZE_PX, beads
from photographing.subject import Scan, Subject
from photographing.taking import Moment, Studio

from mien.capture.marks import MARKS, format_marks
from mien.capture.project_points import format_points, format_references
from mien.capture.project_records import PICTURES, POINTS, PROJECT, REFERENCES, TOPOLOGY, Project
from mien.capture.project_toml import format_project
from mien.capture.records import Observation, Photograph
from mien.capture.records import Reference as Bead
from mien.faces.keypose.topology_file import format_topology

PEOPLE = Path(__file__).parent / "photographing/people.csv"
CLICK_PX = 0.5
"""Standard deviation of a click."""
QUALITY = 92
THICKER_M = 0.003
"""How much thicker hair of few polygons is: they cut corners off, and the skull must not show."""


def person(name: str) -> dict[str, str]:
    """The row of a person: who, hair, palette, seed, doc."""
    with PEOPLE.open(encoding="utf-8", newline="") as lines:
        rows = {row["name"]: row for row in csv.DictReader(lines)}
    if name not in rows:
        raise SystemExit(f"there is nobody called {name!r}: there are {', '.join(rows)}")
    return rows[name]


def clicked(moments: list[Moment], draft: Draft, seed: int) -> list[Observation]:
    """What is seen in all photographs, as exact as a hand is."""
    rng = np.random.default_rng(seed)
    kept = {*draft.marks.names, *beads()}
    out = []
    for moment in moments:
        for click in moment.clicks:
            u, v = click.place + rng.normal(0.0, CLICK_PX, 2)
            if click.point in kept and 0 <= u < SIZE_PX and 0 <= v < SIZE_PX:
                photo = f"{moment.phase}-{click.camera}.jpg"
                out.append(Observation(photo, click.point, round(float(u), 2), round(float(v), 2), CLICK_PX))
    return out


def photograph(reference: Path, name: str, out: Path) -> None:
    """Write the project."""
    row = person(name)
    seed = int(row["seed"])
    style = CAPS[row["hair"]]
    thick = tuple((around, thickness + THICKER_M) for around, thickness in style.thick)
    cap = replace(style, columns=34, rows=11, thick=thick, groove=0.0, locks=0, ragged=0.0)
    scan = Scan(Reference(reference))
    studio = Studio(Subject(scan, scan.identity(row["who"])), draft(cap), row["palette"], seed)
    (out / PICTURES).mkdir(parents=True, exist_ok=True)
    moments = []
    for moment in studio.moments():
        for camera, picture in moment.photographs.items():
            Image.fromarray(picture).save(out / PICTURES / f"{moment.phase}-{camera}.jpg", quality=QUALITY)
        moment.photographs.clear()
        moments.append(moment)
        print(moment.phase, len(moment.clicks), flush=True)
    seen = {click.point for moment in moments for click in moment.clicks}
    plan = drafted(studio.half, row["palette"], seen)
    photographs = tuple(
        Photograph(f"{moment.phase}-{station.name}.jpg", (SIZE_PX, SIZE_PX), station.name, moment.phase, True)
        for moment in moments
        for station in studio.stations
    )
    places = [Bead(bead, *map(float, place)) for bead, place in beads().items()]
    texts = {
        PROJECT: format_project(Project(out, name, photographs, row["doc"])),
        POINTS: format_points(clicked(moments, plan, seed + 2)),
        REFERENCES: format_references(places, "mm"),
        TOPOLOGY: format_topology(plan.topology),
        MARKS: format_marks(plan.marks, "mm"),
    }
    for file, text in texts.items():
        (out / file).write_text(text, encoding="utf-8", newline="\n")
    truth = np.stack([moment.truth for moment in moments])[:, plan.kept]
    np.savez(out / "truth.npz", places=truth, phases=[moment.phase for moment in moments])


if __name__ == "__main__":
    photograph(Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3]))
