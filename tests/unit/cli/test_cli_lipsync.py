"""A recording's words, phones and shapes as files, and a face that speaks with it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import mien
from mien.cli import main
from mien.core import SILENCE, Cue
from mien.formats import CueSheet, read_cue_file, write_cue_file
from mien.formats.wav import write_wav
from mien.speech import Speech, speak

TEXT = "Bob moved the box."


@pytest.fixture(scope="module")
def spoken() -> Speech:
    return speak(TEXT)


@pytest.fixture(scope="module")
def recording(spoken: Speech, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "bob.wav"
    write_wav(spoken.sound, path)
    return path


def test_words_phones_and_shapes_are_written(recording: Path, spoken: Speech, tmp_path: Path):
    out = tmp_path / "bob.TextGrid"
    assert main(["lipsync", str(recording), "--text", TEXT, "-o", str(out), "--quiet"]) == 0
    sheet = read_cue_file(out)
    assert list(sheet.tiers) == ["words", "phones", "shapes"]
    assert [cue.symbol for cue in sheet.tier("words")] == ["Bob", "moved", "the", "box"]
    assert [cue.symbol for cue in sheet.tier("phones") if cue.symbol != SILENCE][:3] == ["B", "AA1", "B"]
    assert {cue.symbol for cue in sheet.tier("shapes")} <= set("ABCDEFGHX")
    assert sheet.length_s == pytest.approx(spoken.sound.length_s, abs=1e-6)


def test_other_sets_of_shapes_and_other_layouts(recording: Path, tmp_path: Path):
    out = tmp_path / "bob.tsv"
    words = ["lipsync", str(recording), "--text", TEXT, "--quiet", "-o", str(out)]
    assert main([*words, "--shapes", "oculus"]) == 0
    assert "\tPP" in out.read_text()
    assert main([*words, "--layout", "rhubarb"]) == 0
    assert out.read_text().startswith("0.00\tX\n")


def test_json_tells_the_words_and_how_sure_they_are(recording: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["lipsync", str(recording), "--text", TEXT, "--json"]) == 0
    shown = capsys.readouterr()
    found = json.loads(shown.out)
    assert [word["word"] for word in found["words"]] == ["Bob", "moved", "the", "box"]
    assert all(0.5 < word["sure"] <= 1.0 for word in found["words"])
    assert (found["notices"], found["skipped"]) == ([], [])
    assert "listening" in shown.err


def test_without_a_transcript_what_was_heard_is_told(recording: Path, tmp_path: Path, capsys):
    assert main(["lipsync", str(recording), "-o", str(tmp_path / "bob.vtt")]) == 0
    assert "\nheard: " in capsys.readouterr().err


def test_cues_corrected_by_hand_win(recording: Path, spoken: Speech, tmp_path: Path):
    cues, out = tmp_path / "mine.TextGrid", tmp_path / "again.json"
    length_s = spoken.sound.length_s
    mine = (Cue(0.0, 0.4, SILENCE), Cue(0.4, 0.7, "M"), Cue(0.7, 0.9, "AA1"), Cue(0.9, length_s, SILENCE))
    write_cue_file(CueSheet(length_s, {"words": (Cue(0.4, 0.9, "Ma"),), "phones": mine}), cues)
    assert main(["lipsync", str(recording), "--cues", str(cues), "-o", str(out), "--quiet"]) == 0
    assert read_cue_file(out).tier("phones") == mine
    assert main(["say", "--audio", str(recording), "--cues", str(cues), "-o", str(out), "--quiet"]) == 0
    assert read_cue_file(out).tier("phones") == mine
    assert main(["say", TEXT, "--cues", str(cues), "-o", str(out), "--quiet"]) == 0
    assert [cue.symbol for cue in read_cue_file(out).tier("words")] == ["Ma"]


def test_a_face_speaks_with_a_recording(recording: Path, tmp_path: Path):
    out = tmp_path / "bob.json"
    assert main(["say", "--audio", str(recording), "--text", TEXT, "-o", str(out), "--quiet"]) == 0
    assert [cue.symbol for cue in read_cue_file(out).tier("words")] == ["Bob", "moved", "the", "box"]
    assert (tmp_path / "bob.wav").read_bytes() == recording.read_bytes()


def test_the_text_of_a_recording_may_have_marks(recording: Path, tmp_path: Path):
    out = tmp_path / "bob.json"
    marked = "Bob moved [angry] the *box*."
    assert main(["say", "--audio", str(recording), "--text", marked, "-o", str(out), "--quiet"]) == 0
    timeline = mien.play(out).timeline
    assert timeline.text == TEXT
    brows = timeline.layer("expression").tracks["eyebrow.lower.left"]
    start_s = timeline.words[2].start_s
    assert brows.evaluate([start_s - 0.2, start_s + 0.2])[0] == pytest.approx([0.0, 1.0])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["lipsync", "AUDIO"], "nothing to do with it — give -o FILE or --json"),
        (["lipsync", "AUDIO", "-o", "OUT.json", "--shapes", "rubarb"], "did you mean 'rhubarb'?"),
        (["lipsync", "AUDIO", "-o", "OUT.mp4"], "'.mp4'"),
        (["lipsync", "AUDIO", "-o", "OUT.srt", "--layout", "rhubarb"], "no layout 'rhubarb' of such a file"),
        (["lipsync", "none.wav", "-o", "OUT.json"], "none.wav: cannot be read"),
        (["lipsync", "AUDIO", "--text", "@none.txt", "-o", "OUT.json"], "none.txt: cannot be read"),
        (["say", "-o", "OUT.json"], "nothing to say"),
        (["say", "Hi", "--audio", "AUDIO", "-o", "OUT.json"], "speaks already"),
        (
            ["say", "--audio", "AUDIO", "--text", "[angri] Bob", "-o", "OUT.json"],
            "unknown mark in line 1, column 1: 'angri'",
        ),
        (["say", "Hi", "--text", "Hi", "-o", "OUT.json"], "add --audio FILE"),
        (["say", "--audio", "AUDIO", "--voice", "hibari", "-o", "OUT.json"], "has its own"),
    ],
)
def test_mistakes_are_told_and_nothing_is_written(
    arguments: list[str], message: str, recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    given = [word.replace("AUDIO", str(recording)).replace("OUT", str(tmp_path / "out")) for word in arguments]
    assert main([*given, "--quiet"]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_cues_that_cannot_be_used_are_named(recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    cues = tmp_path / "mine.TextGrid"
    write_cue_file(CueSheet(1.0, {"phones": (Cue(0.0, 1.0, "wrong!"),)}), cues)
    assert main(["lipsync", str(recording), "--cues", str(cues), "-o", str(tmp_path / "out.json"), "--quiet"]) == 2
    assert str(cues) in capsys.readouterr().err
    assert not (tmp_path / "out.json").exists()
