"""The program of 1972 at the command line: what is asked, in what order phases come, how many frames."""

from __future__ import annotations

import os
import pty
import select
import shutil
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien import load_face
from mien.api import film_phases, load_phases, order_phases
from mien.cli import main
from mien.core import MienError

AIRCRAFT = Path(__file__).parents[3] / "examples/keypose/aircraft.keypose"
SMALL = ["--size", "48", "--quiet"]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copytree(AIRCRAFT, "aircraft.keypose")


def pixels(path: Path | str) -> np.ndarray:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def test_so_many_frames_between_phases_and_one_for_each() -> None:
    assert main(["keypose", "aircraft.keypose", "--phases", "2,1,2", "--between", "3", *SMALL, "-o", "f_%02d.png"]) == 0
    frames = sorted(Path().glob("f_*.png"))
    assert len(frames) == 2 * (3 + 1) + 1
    np.testing.assert_array_equal(pixels(frames[0]), pixels(frames[-1]))
    np.testing.assert_array_equal(pixels(frames[1]), pixels(frames[-2]))
    assert np.abs(pixels(frames[0]) - pixels(frames[4])).max() > 50


def test_a_frame_of_the_film_is_the_picture_of_its_phase_number() -> None:
    assert main(["keypose", "aircraft.keypose", "--between", "3", *SMALL, "-o", "f_%02d.png"]) == 0
    for frame, number in ((0, 1.0), (1, 1.25), (4, 2.0)):
        command = ["render", "aircraft.keypose", "--phase", str(number), "--subdivide", "0", *SMALL, "-o", "one.png"]
        assert main(command) == 0
        np.testing.assert_array_equal(pixels(f"f_{frame:02d}.png"), pixels("one.png"))


def test_topology_and_phase_files_make_the_face_that_their_folder_makes() -> None:
    names = ["topology.txt", "letter.phase", "aircraft.phase"]
    loose = load_phases([f"aircraft.keypose/{name}" for name in names])
    whole = load_face("aircraft.keypose")
    assert loose.keypose.phases == ("letter", "aircraft")
    for number in (1.0, 1.3, 2.0):
        meshes = [face.shape(face.neutral.replace({"phase.number": number})) for face in (loose, whole)]
        np.testing.assert_array_equal(meshes[0].points, meshes[1].points)


def test_phases_by_name_and_by_number_in_any_order() -> None:
    face = load_face("aircraft.keypose")
    turned = order_phases(face, ["aircraft", "1", "2"])
    assert turned.keypose.phases == ("aircraft", "letter", "aircraft_3")
    np.testing.assert_array_equal(turned.keypose.places, face.keypose.places[[1, 0, 1]])


def test_the_cosine_is_the_one_of_1972() -> None:
    """Half of C is not half of the way in time: at a third C = (1 - cos 60 deg) / 2 = 1/4."""
    film = film_phases(load_face("aircraft.keypose"), 2, fps=30)
    numbers, _ = film.timeline.layers[0].tracks["phase.number"].evaluate(np.array([0.0, 1.0 / 30, 3.0 / 30]))
    rest = film.face.neutral
    first, third, last = (film.face.shape(rest.replace({"phase.number": number})).points for number in numbers)
    np.testing.assert_allclose(third, first + 0.25 * (last - first), atol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["head", "-o", "x.mp4"], "not made of measured phases"),
        (["aircraft.keypose", "--phases", "lettr", "-o", "x.mp4"], "did you mean 'letter'"),
        (["aircraft.keypose", "--phases", "1", "-o", "x.mp4"], "name two or more"),
        (["aircraft.keypose", "--between", "-1", "-o", "x.mp4"], "whole number"),
        (["aircraft.keypose", "--shading", "round", "-o", "x.mp4"], "shading"),
        (["-o", "x.mp4"], "is not given"),
        (["aircraft.keypose"], "File to write: is not given"),
    ],
)
def test_mistakes_are_told_and_nothing_is_written(
    arguments: list[str], message: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert main(["keypose", *arguments]) == 2
    assert message in capfd.readouterr().err
    assert not Path("x.mp4").exists()


def test_no_face_but_a_measured_one_has_a_phase_number(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["render", "head", "--phase", "1.5", "-o", "x.png"]) == 2
    assert "measured phases" in capfd.readouterr().err
    with pytest.raises(MienError, match="measured phases"):
        film_phases(load_face("head"), 3)


def test_at_a_terminal_it_asks_for_what_is_missing_until_it_understands() -> None:
    answers = ["aircraft.keypos", "aircraft.keypose", "", "many", "2", "40x40", "", "", "polygonal", "asked.gif"]
    child, terminal = pty.fork()
    if child == 0:
        os.execv(sys.executable, [sys.executable, "-m", "mien", "keypose"])
    said = converse(terminal, answers)
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == 0, said
    assert "unknown face 'aircraft.keypos'" in said
    assert "want a whole number" in said
    with Image.open("asked.gif") as film:
        assert (film.size, film.n_frames) == ((40, 40), 4)


def converse(terminal: int, answers: list[str]) -> str:
    """What the program said; each answer is given when it has asked and waits."""
    said, end = "", time.monotonic() + 120.0
    left = list(answers)
    while time.monotonic() < end:
        ready, _, _ = select.select([terminal], [], [], 0.2)
        if ready:
            try:
                said += os.read(terminal, 65536).decode()
            except OSError:  # what Linux says when the other end has closed
                break
        elif left and said.endswith(": "):
            os.write(terminal, f"{left.pop(0)}\n".encode())
            said += "\n"
    os.close(terminal)
    return said
