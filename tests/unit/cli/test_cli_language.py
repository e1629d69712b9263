"""Other languages on the command line: a voice for them, and recordings in them."""

from __future__ import annotations

from pathlib import Path

import pytest

import mien
from mien.cli import main
from mien.core import SILENCE
from mien.formats import read_cue_file
from mien.formats.wav import write_wav
from mien.speech import speak, strip_stress, voice_espeak
from mien.speech.voice_espeak_engine import find_installation

needs_espeak = pytest.mark.skipif(find_installation() is None, reason="needs the extra: pip install 'mien[espeak]'")

TEXT = "Schöne Grüße aus München."


@needs_espeak
def test_a_language_chooses_its_voice(tmp_path: Path) -> None:
    (tmp_path / "named").mkdir()
    out = tmp_path / "gruss.json"
    assert main(["say", TEXT, "--language", "de", "-o", str(out), "--quiet"]) == 0
    named = tmp_path / "named" / "gruss.json"
    assert main(["say", TEXT, "--voice", "espeak-de", "-o", str(named), "--quiet"]) == 0
    assert out.read_bytes() == named.read_bytes()


@needs_espeak
def test_a_recording_in_another_language_is_aligned(tmp_path: Path) -> None:
    said, sound, out = speak(TEXT, "espeak-de"), tmp_path / "gruss.wav", tmp_path / "gruss.TextGrid"
    write_wav(said.sound, sound)
    assert main(["lipsync", str(sound), "--text", TEXT, "--language", "de", "-o", str(out), "--quiet"]) == 0
    sheet = read_cue_file(out)
    assert [cue.symbol for cue in sheet.tier("words")] == ["Schöne", "Grüße", "aus", "München"]
    spoken = [strip_stress(cue.symbol) for cue in sheet.tier("phones") if cue.symbol != SILENCE]
    assert " ".join(spoken[:5]) == "SH OE N AH G"
    assert mien.hear(sound, TEXT, language="de").words[1].symbol == "Grüße"
    film = tmp_path / "gruss.json"
    assert main(["say", "--audio", str(sound), "--text", TEXT, "--language", "de", "-o", str(film), "--quiet"]) == 0
    # What was written is read back: our names of its sounds are those of a file of cues.
    again = tmp_path / "again.tsv"
    assert main(["lipsync", str(sound), "--cues", str(out), "-o", str(again), "--quiet"]) == 0


def test_mistakes_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    out = str(tmp_path / "x.json")
    assert main(["say", TEXT, "--language", "de", "--voice", "hibari", "-o", out]) == 2
    assert "leave --language de out" in capsys.readouterr().err
    assert main(["say", TEXT, "--language", "xx", "-o", out]) == 2
    assert "unknown language 'xx'" in capsys.readouterr().err
    monkeypatch.setattr(voice_espeak, "find_installation", lambda: None)
    assert main(["say", TEXT, "--language", "de", "-o", out]) == 2
    assert "pip install 'mien[espeak]'" in capsys.readouterr().err
    assert not Path(out).exists()
