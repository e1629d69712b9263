"""Small capture projects for tests: two photographs of a cube that a camera of known place sees."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from mien.capture.records import Camera, Lens, Observation, Photograph, Residual, Solution, SolvedPoint, Survey

TOML = """\
format = "mien-capture"
version = 1
name = "anna"
unit = "mm"

[[photograph]]
file = "front.jpg"
size = [400, 300]
camera = "a"
moment = "smile"

[[photograph]]
file = "left.jpg"
size = [400, 300]
camera = "b"
moment = "smile"
"""

POINTS = """\
photo,point,u,v,sigma
front.jpg,nose,200.5,150.25,
left.jpg,nose,180,150,0.5
"""

REFERENCES = """\
point,x,y,z,sigma,target
near,0,0,0,,
far,254,0,0,0.5,
"""


def make_folder(folder: Path, *, toml: str = TOML, points: str = POINTS, references: str | None = REFERENCES) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "project.toml").write_text(toml, encoding="utf-8")
    (folder / "points.csv").write_text(points, encoding="utf-8")
    if references is not None:
        (folder / "references.csv").write_text(references, encoding="utf-8")
    return folder


def turned(angle: float) -> np.ndarray:
    """Rotation (3, 3) of a camera that looks along -z, turned about the vertical axis."""
    across, deep = np.cos(angle), np.sin(angle)
    return np.array([[across, 0.0, -deep], [0.0, -1.0, 0.0], [-deep, 0.0, -across]])


def make_solution(survey: Survey, points: Iterable[SolvedPoint] = (), suspects: Iterable[Observation] = ()) -> Solution:
    """A solution with made-up numbers for all that the survey has."""
    cameras = {
        photo.name: Camera(
            Lens(500.5 + number, (200.25, 150.0), -0.1, 0.01, ("focal", "k1"), 1e-3, -2e-3, 1.01),
            turned(0.3 * number),
            np.array([0.1 * number, 0.2, 1.0 / 3.0]),
        )
        for number, photo in enumerate(survey.photographs)
    }
    residuals = tuple(Residual(each, 0.25, -0.5, 1.5) for each in survey.observations)
    wrong = {(each.photo, each.point) for each in suspects}
    bad = tuple(each for each in residuals if (each.observation.photo, each.observation.point) in wrong)
    table = {(point.moment, point.name): point for point in points}
    return Solution(survey, cameras, table, residuals, bad, 1.25, ("Lens: as told.",), "metric")


def photograph(name: str, camera: str = "a", moment: str = "smile") -> Photograph:
    return Photograph(name, (400, 300), camera, moment)
