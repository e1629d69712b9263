"""Several speakers from a file, with the real heads and the real voice."""

from __future__ import annotations

from pathlib import Path

import av
import numpy as np
import pytest

import mien
from mien.cli import main

SMALL = ["--size", "32", "--subdivide", "0", "--fps", "6", "--threads", "1", "--quiet"]


@pytest.fixture
def talk(tmp_path: Path) -> Path:
    path = tmp_path / "talk.csv"
    path.write_text("speaker,line,face,emotion\nann,Go!,head:ada,angry\nbob,[look up] No.,head:ben,\n")
    return path


def frames(path: Path) -> np.ndarray:
    """(N, H, W, 3) pictures of a film."""
    with av.open(str(path)) as film:
        return np.stack([frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)])


def test_a_film_each_and_one_that_cuts_between_them(talk: Path, tmp_path: Path) -> None:
    for out in ("talk_%s.mp4", "talk.mp4"):
        assert main(["say", "--script", str(talk), *SMALL, "-o", str(tmp_path / out)]) == 0
    assert sorted(path.name for path in tmp_path.glob("*.mp4")) == ["talk.mp4", "talk_ann.mp4", "talk_bob.mp4"]
    whole, ann, bob = (frames(tmp_path / f"{name}.mp4").astype(int) for name in ("talk", "talk_ann", "talk_bob"))
    assert len(whole) == len(ann) == len(bob)
    mine, other = (np.abs(whole - part).mean(axis=(1, 2, 3)) for part in (ann, bob))
    cut = int(np.argmax(mine > other))
    assert 0.3 * len(whole) < cut < 0.7 * len(whole)
    assert (mine[:cut] < other[:cut]).all()
    assert (mine[cut:] > other[cut:]).all()


def test_timelines_have_their_own_words_and_one_sound(talk: Path, tmp_path: Path) -> None:
    out = str(tmp_path / "talk_%s.json")
    assert main(["say", "--script", str(talk), "-o", out, "--emotion", "smile", "--set", "head.turn=5", "-q"]) == 0
    ann, bob = (mien.play(tmp_path / f"talk_{name}.json") for name in ("ann", "bob"))
    assert [[word.symbol for word in part.timeline.words] for part in (ann, bob)] == [["Go"], ["No"]]
    assert (ann.face.name, bob.face.name) == ("head:ada", "head:ben")
    assert "eyebrow.lower.left" in ann.timeline.layer("expression").tracks
    assert "mouth.expression.left" in bob.timeline.layer("expression").tracks
    assert (tmp_path / "talk_ann.wav").read_bytes() == (tmp_path / "talk_bob.wav").read_bytes()
    assert ann.timeline.layer("settings").tracks.keys() == bob.timeline.layer("settings").tracks.keys() == {"head.turn"}


def test_subtitles_tell_what_all_say(talk: Path, tmp_path: Path) -> None:
    assert main(["say", "--script", str(talk), "-o", str(tmp_path / "a.srt"), "-q"]) == 0
    text = (tmp_path / "a.srt").read_text()
    assert "Go!" in text
    assert "No." in text


@pytest.mark.parametrize(
    ("rows", "arguments", "message"),
    [
        ("ann,Hi.,head:adda,", ["-o", "a.mp4"], "talk.csv:2: column 'face': unknown face 'head:adda'"),
        ("ann,[smiel] Hi.,,", ["-o", "a.mp4"], "talk.csv:2: column 'line': unknown mark in line 1, column 1: 'smiel'"),
        ("ann,Hi.,,smiel", ["-o", "a.mp4"], "talk.csv:2: column 'emotion': unknown mark in line 1, column 1: 'smiel'"),
        ("ann,Hi.,,", ["-o", "a.mp4", "--emotion", "smiel"], "unknown mark in line 1, column 1: 'smiel'"),
        ("ann,Hi.,,", ["-o", "a.mp4", "--language", "xx"], "xx"),
        ("ann,...,,", ["-o", "a.mp4"], "talk.csv:2: column 'line': text '...'"),
        ("a/b,Hi.,,", ["-o", "a_%s.mp4"], "speaker 'a/b': makes no name of a file"),
        ("ann,Hi.,,", ["-o", "a.json"], "a.json: is of one face only — write %s for the speaker's name"),
        ("ann,Hi.,,", ["-o", "a_%s.mp4", "--subtitles", "a.srt"], "--subtitles a.srt: every film needs its own"),
        ("ann,Hi.,,", ["-o", "a.mp4", "Hello"], "TEXT Hello: the script"),
        ("ann,Hi.,,", ["-o", "a.mp4", "--audio", "b.wav"], "--audio b.wav: the script"),
        ("ann,Hi.,,", ["-o", "a.mp4", "--voice", "nobody"], "unknown voice 'nobody'"),
    ],
)
def test_mistakes_are_told_and_nothing_is_written(
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    rows: str,
    arguments: list[str],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("talk.csv").write_text(f"speaker,line,face,emotion\n{rows}\n")
    assert main(["say", "--script", "talk.csv", *SMALL, *arguments]) == 2
    assert message in capfd.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["talk.csv"]


def test_an_interrupted_script_leaves_nothing(talk: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*arguments: object, **more: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("mien.render.Renderer.draw", interrupt)
    assert main(["say", "--script", str(talk), *SMALL, "-o", str(tmp_path / "talk.mp4")]) == 130
    assert [path.name for path in tmp_path.iterdir()] == ["talk.csv"]
