"""Logs of live sessions, as films and tables."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien import load_face
from mien.cli import main
from mien.live import Session


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def record(name: str, loop_s: float, loops: int) -> list[dict[str, float]]:
    """A short session into ``talk.log``; the values of its frames."""
    lines: list[str] = []
    session = Session(load_face(name), loop_s, seed=3, log=lines.append)
    session.handle({"kind": "play", "motion": "smile"})
    frames = [session.step().pose for _ in range(loops)]
    session.close()
    Path("talk.log").write_text("\n".join(lines) + "\n")
    return [dict(zip(pose.table.names, pose.values.tolist(), strict=True)) for pose in frames]


def test_a_table_has_the_identical_frames() -> None:
    frames = record("toon:olav", 1 / 60, 90)
    assert main(["replay", "talk.log", "-o", "a.csv", "-q"]) == 0
    head, *rows = Path("a.csv").read_text().splitlines()
    names = head.split(",")[1:]
    assert "mouth.corner.vertical.left" in names
    assert len(rows) == 90
    for frame, row in zip(frames, rows, strict=True):
        assert [frame[name] for name in names] == [float(cell) for cell in row.split(",")[1:]]


def test_pictures_come_at_the_rate_of_the_loops() -> None:
    record("toon:gus", 0.1, 4)
    assert main(["replay", "talk.log", "--size", "48", "-q", "-o", "f_%02d.png"]) == 0
    assert len(list(Path().glob("f_*.png"))) == 4
    first, last = (np.asarray(Image.open(f"f_{number:02d}.png")) for number in (0, 3))
    assert (first != last).any()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "talk.log: is empty"),
        ("{}\n", "talk.log:1"),
        ('{"format": "mien-live", "version": 1, "face": "head"}', "talk.log:1"),
    ],
)
def test_what_is_no_log_is_told(text: str, words: str, capfd: pytest.CaptureFixture[str]) -> None:
    Path("talk.log").write_text(text)
    assert main(["replay", "talk.log", "-o", "a.csv", "-q"]) == 2
    assert words in capfd.readouterr().err
    assert not Path("a.csv").exists()


def test_another_face_is_told(capfd: pytest.CaptureFixture[str]) -> None:
    record("toon:olav", 0.1, 2)
    assert main(["replay", "talk.log", "--face", "toon:gus", "-o", "a.csv", "-q"]) == 2
    assert "another version of mien, or of the face" in capfd.readouterr().err
    assert main(["replay", "nowhere.log", "-o", "a.csv", "-q"]) == 2
    assert "nowhere.log" in capfd.readouterr().err
