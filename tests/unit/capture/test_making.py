"""From a folder with photographs to a face that can be played."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from mien.capture.making import make_keypose
from mien.capture.project import solve_project, write_solution
from mien.capture.project_points import format_points, format_references
from mien.capture.project_records import Project
from mien.capture.project_toml import format_project
from mien.capture.projecting import project
from mien.capture.records import Camera, Lens, Observation, Photograph, Reference
from mien.cli.app import app
from mien.core import LoadError, Pose
from mien.faces.keypose.files import read_keypose
from mien.faces.registry import load_face

SIDE = 4
GRID = np.array(
    [[0.02 * k, 0.03 * (row - 1.5), 0.05 - 0.3 * (0.02 * k) ** 2] for row in range(SIDE) for k in range(SIDE)]
)
"""Left half of a bent patch of skin, m."""
SMILE = GRID + np.where(np.arange(16)[:, None] < 4, np.array([0.004, 0.006, 0.0]), 0.0)
HELD = np.array([[0.9998, -0.02, 0.0], [0.02, 0.9998, 0.0], [0.0, 0.0, 1.0]])
CUBE = 0.15 * np.array(list(product((-1.0, 1.0), repeat=3)))
SIZE = 600
COLOR = (201, 150, 120)
TOPOLOGY = "part skin subdivide\n" + "".join(
    f"{a} {a + SIDE} {a + SIDE + 1} {a + 1} #808080\n" for row in (1, 5, 9) for a in range(row, row + 3)
)


def camera(around_deg: float) -> Camera:
    """One that looks at the cube from so far around."""
    angle = np.radians(around_deg)
    forward = -np.array([np.sin(angle), 0.0, np.cos(angle)])
    right = np.array([-forward[2], 0.0, forward[0]])
    return Camera(Lens(900.0, (300.0, 300.0)), np.stack([right, [0.0, -1.0, 0.0], forward]), -forward)


CAMERAS = {"a": camera(-5.0), "b": camera(40.0), "c": camera(20.0)}
MOMENTS = {"neutral": GRID, "smile": SMILE @ HELD.T + [0.005, -0.003, 0.002]}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A solved project of two moments and three cameras."""
    out = tmp_path_factory.mktemp("anna")
    (out / "photographs").mkdir()
    photographs, observations = [], []
    rng = np.random.default_rng(7)
    for (moment, places), (name, each) in product(MOMENTS.items(), CAMERAS.items()):
        photo = f"{moment}-{name}.png"
        pixels = np.full((SIZE, SIZE, 3), COLOR, dtype=np.uint8)
        pixels[0, : len(photographs) + 1] = 0
        Image.fromarray(pixels).save(out / "photographs" / photo)
        photographs.append(Photograph(photo, (SIZE, SIZE), name, moment, True))
        seen = {f"bead{k}": place for k, place in enumerate(CUBE)} | {str(k + 1): p for k, p in enumerate(places)}
        pictures = project(each, np.array(list(seen.values()))) + rng.normal(0.0, 0.1, (len(seen), 2))
        observations += [
            Observation(photo, point, float(u), float(v), 0.1) for point, (u, v) in zip(seen, pictures, strict=True)
        ]
    texts = {
        "project.toml": format_project(Project(out, "anna", tuple(photographs), still=("10", "11", "12", "15", "16"))),
        "points.csv": format_points(observations),
        "references.csv": format_references([Reference(f"bead{k}", *place) for k, place in enumerate(CUBE)], "mm"),
        "topology.txt": TOPOLOGY,
    }
    for file, text in texts.items():
        (out / file).write_text(text, encoding="utf-8")
    write_solution(out, solve_project(out))
    return out


def test_photographs_become_a_face_that_smiles(folder, tmp_path):
    made = make_keypose(folder, tmp_path / "anna.keypose")
    face = read_keypose(tmp_path / "anna.keypose")
    assert face.phases == ("neutral", "smile")
    assert (made.colored, made.polygons) == (9, 9)
    assert {polygon.color for polygon in face.topology.polygons} == {"#c99678"}
    moves = face.places[1] - face.places[0]
    np.testing.assert_allclose(np.linalg.norm(moves[:4], axis=1), np.hypot(0.004, 0.006), atol=4e-4)
    assert np.abs(moves[8:]).max() < 3e-4
    widths = np.linalg.norm(face.places[0][3::4] - face.places[0][::4], axis=1)
    np.testing.assert_allclose(widths, np.linalg.norm(GRID[3] - GRID[0]), atol=6e-4)


def test_the_command_makes_a_face_that_loads(folder, tmp_path):
    out = tmp_path / "anna.keypose"
    result = CliRunner().invoke(app, ["capture", "keypose", str(folder), "-o", str(out), "--name", "Anna"])
    assert result.exit_code == 0, result.output
    assert "2 phases, 16 points, 9 polygons" in result.output
    face = load_face(str(out))
    assert "phase.smile.left" in face.parameters
    assert face.shape(Pose.neutral(face.parameters)).points.shape == (16, 3)


def test_a_project_without_topology_says_what_is_missing(folder, tmp_path):
    bare = tmp_path / "bare"
    bare.mkdir()
    (bare / "project.toml").write_text((folder / "project.toml").read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(LoadError, match=r"topology\.txt: there is no such file — it tells which points"):
        make_keypose(bare, tmp_path / "x.keypose")
