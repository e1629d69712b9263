"""A recording heard, with and without a transcript."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from hearing_cases import GARDEN, MARKET, in_noise, joined, noise, said, words

from mien.core import SILENCE, Sound
from mien.speech import PHONES, Heard, hear, strip_stress
from mien.speech.phones import check_symbol


def late_ms(heard: Heard, text: str, by_s: float = 0.0) -> np.ndarray:
    """How much later each word begins than the voice says."""
    pairs = zip(heard.speech.words, said(text).words, strict=True)
    return np.array([1000 * (cue.start_s - by_s - truth.start_s) for cue, truth in pairs])


def test_importing_loads_no_recogniser():
    code = "import sys, mien.speech; print('pocketsphinx' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "False\n"


def test_words_of_a_transcript_are_found_where_they_are_said():
    heard = hear(said(MARKET).sound, MARKET)
    assert words(heard) == [cue.symbol for cue in said(MARKET).words]
    assert np.abs(late_ms(heard, MARKET)).max() < 60  # the voice's own times come in steps of 25 ms
    assert min(heard.sure) > 0.5
    assert heard.notices == ()
    assert heard.speech.skipped == ()


def test_phones_have_no_holes_and_are_ours():
    speech = hear(said(MARKET).sound, MARKET).speech
    edges = [0.0, *(cue.end_s for cue in speech.phones)]
    assert [cue.start_s for cue in speech.phones] == edges[:-1]
    assert edges[-1] == speech.sound.length_s
    for cue in speech.phones:
        check_symbol(cue.symbol, "ours")
        assert strip_stress(cue.symbol) in PHONES
    spoken = [cue.symbol for cue in speech.phones if cue.symbol != SILENCE]
    assert [strip_stress(symbol) for symbol in spoken[:6]] == ["SH", "IY", "B", spoken[3][:2], "T", "F"]
    assert spoken[3] in {"AO1", "AA1"}


def test_the_same_sound_is_heard_the_same():
    first, second = (hear(said(MARKET).sound, MARKET) for _ in range(2))
    assert first.speech.phones == second.speech.phones
    assert first.sure == second.sure


def test_without_a_transcript_words_are_recognised():
    heard = hear(said(GARDEN).sound)
    wanted = [cue.symbol.lower() for cue in said(GARDEN).words]
    assert sum(word in wanted for word in words(heard)) >= 0.8 * len(wanted)
    assert heard.speech.text == " ".join(words(heard))


def test_numbers_and_unknown_words_are_heard_as_the_voice_says_them():
    text = "In 1974 Dr. Zorblatt paid $3.50 for 2 well-known pears."
    heard = hear(said(text).sound, text)
    assert words(heard) == ["In", "1974", "Dr", "Zorblatt", "paid", "$3.50", "for", "2", "well-known", "pears"]
    assert np.median(np.abs(late_ms(heard, text))) < 40


@pytest.mark.parametrize("lead", [Sound.silence(40.0), noise(40.0, 20.0)])
def test_leading_silence_delays_the_words(lead: Sound):
    heard = hear(joined(lead, said(MARKET).sound), MARKET)
    assert np.abs(late_ms(heard, MARKET, by_s=40.0)).max() < 60


def test_one_word_is_heard():
    heard = hear(said("Breakfast.").sound, "Breakfast")
    assert words(heard) == ["Breakfast"]
    assert next(cue.symbol for cue in heard.speech.phones if cue.symbol != SILENCE) == "B"


def test_sound_of_a_telephone_is_heard():
    rate_hz = 8000
    samples = said(MARKET).sound.samples.astype(np.float64)
    smooth = np.convolve(samples, np.sinc(np.arange(-30, 31) / 3) * np.hanning(61) / 3, mode="same")
    heard = hear(Sound(smooth[::3].astype(np.int16), rate_hz), MARKET)
    assert np.median(np.abs(late_ms(heard, MARKET))) < 40


def test_speech_in_noise_is_heard():
    heard = hear(in_noise(said(MARKET).sound, 10.0), MARKET)
    assert np.median(np.abs(late_ms(heard, MARKET))) < 40


def test_clipping_is_told():
    loud = said(MARKET).sound.samples.astype(np.int32) * 4
    heard = hear(Sound(np.clip(loud, -32768, 32767).astype(np.int16), 24000), MARKET)
    assert len(heard.notices) == 1
    assert heard.notices[0].startswith("the sound is clipped (")
    assert np.abs(late_ms(heard, MARKET)).max() < 60


def test_long_sound_is_heard_a_piece_at_a_time_and_reported():
    seen: list[tuple[int, int, str]] = []
    parts = [MARKET, GARDEN] * 4
    heard = hear(joined(*(said(part).sound for part in parts)), " ".join(parts), report=lambda *step: seen.append(step))
    truth = [cue.symbol for part in parts for cue in said(part).words]
    assert words(heard) == truth
    begin_s = np.cumsum([0.0, *(said(part).sound.length_s for part in parts)])
    starts_s = [begin + cue.start_s for begin, part in zip(begin_s, parts, strict=False) for cue in said(part).words]
    assert np.abs([cue.start_s - true for cue, true in zip(heard.speech.words, starts_s, strict=True)]).max() < 0.08
    total = round(heard.speech.sound.length_s)
    assert len(seen) >= 3
    assert seen[-1] == (total, total, "listening")
