"""Pitch and loudness of known tones, and words and phrases made of them."""

from __future__ import annotations

import numpy as np
import pytest

from mien.core import Cue, Sound
from mien.speech import prosody
from mien.speech.prosody import measure_contour, measure_prosody

RATES = (8000, 11025, 16000, 24000, 44100, 48000)


def voice(pitch_hz: float | np.ndarray, level: float, length_s: float, rate: int = 16000) -> np.ndarray:
    """(N,) int16 with five harmonics that fall off as a voice's, of a root mean square ``level``."""
    count = round(length_s * rate)
    phase = 2.0 * np.pi * np.cumsum(np.broadcast_to(pitch_hz, count)) / rate
    wave = sum(np.sin(k * phase) / k for k in range(1, 6))
    return np.rint(32767.0 * level * wave / np.sqrt(np.mean(wave * wave))).astype(np.int16)


def silence(length_s: float, rate: int = 16000) -> np.ndarray:
    return np.zeros(round(length_s * rate), np.int16)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("pitch_hz", [70.0, 123.4, 220.0, 401.0])
def test_the_pitch_of_a_tone_is_found_at_every_rate(rate: int, pitch_hz: float) -> None:
    contour = measure_contour(Sound(voice(pitch_hz, 0.1, 0.5, rate), rate))
    inside = contour.within(0.05, 0.45)
    assert contour.pitch_hz[inside] == pytest.approx(pitch_hz, rel=0.012)
    assert contour.loudness[inside] == pytest.approx(0.1, rel=0.15)
    assert len(contour.loudness) * contour.step_s == pytest.approx(0.5, abs=0.011)


def test_a_glide_is_followed() -> None:
    pitch_hz = np.linspace(100.0, 200.0, 16000)
    contour = measure_contour(Sound(voice(pitch_hz, 0.1, 1.0), 16000))
    middles = (np.arange(len(contour.pitch_hz)) + 0.5) * contour.step_s
    inside = contour.within(0.05, 0.95)
    assert contour.pitch_hz[inside] == pytest.approx((100.0 + 100.0 * middles)[inside], rel=0.02)


def test_silence_and_noise_have_no_pitch() -> None:
    quiet = measure_contour(Sound(silence(0.5), 16000))
    assert not quiet.pitch_hz.any()
    assert not quiet.loudness.any()
    noise = np.random.default_rng(3).integers(-3000, 3000, 16000).astype(np.int16)
    contour = measure_contour(Sound(noise, 16000))
    assert np.mean(contour.pitch_hz > 0.0) < 0.05
    assert contour.loudness[5:-5] == pytest.approx(3000 / 3**0.5 / 32768 / 2**0.5, rel=0.15)
    assert len(measure_contour(Sound(silence(0.0), 16000)).pitch_hz) == 0


def test_a_sound_too_coarse_for_pitch_has_loudness() -> None:
    contour = measure_contour(Sound(np.full(100, 3277, np.int16), 100))
    assert not contour.pitch_hz.any()
    assert contour.loudness[2:-2] == pytest.approx(0.1, rel=0.01)


def test_a_hum_under_speech_is_not_listened_to() -> None:
    samples = np.concatenate([voice(120.0, 0.2, 0.3), voice(300.0, 0.002, 0.3)])
    contour = measure_contour(Sound(samples, 16000))
    assert not contour.pitch_hz[contour.within(0.35, 0.6)].any()


def test_loudness_steps_when_the_sound_does() -> None:
    contour = measure_contour(Sound(np.concatenate([silence(0.5), voice(150.0, 0.2, 0.5)]), 16000))
    assert not contour.loudness[contour.within(0.0, 0.48)].any()
    assert contour.loudness[contour.within(0.52, 0.98)].min() > 0.17


def test_the_size_of_the_pieces_changes_no_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = Sound(np.concatenate([voice(150.0, 0.2, 0.4), silence(0.2), voice(90.0, 0.1, 0.4)]), 16000)
    whole = measure_contour(sound)
    monkeypatch.setattr(prosody, "CHUNK_STEPS", 7)
    pieces = measure_contour(sound)
    np.testing.assert_array_equal(whole.pitch_hz, pieces.pitch_hz)
    np.testing.assert_array_equal(whole.loudness, pieces.loudness)


def say(*parts: tuple[float, float, float]) -> tuple[Sound, list[Cue]]:
    """Words of (pitch, level, length), each of two phones, one after the other; level 0 is a pause."""
    samples, words, time = [], [], 0.0
    for pitch_hz, level, length_s in parts:
        if level:
            words.append(Cue(time, time + length_s, f"word{len(words)}"))
            samples.append(voice(pitch_hz, level, length_s))
        else:
            samples.append(silence(length_s))
        time += length_s
    return Sound(np.concatenate(samples), 16000), words


def listen(*parts: tuple[float, float, float]) -> tuple[list[float], list[float]]:
    sound, words = say(*parts)
    phones = [Cue(word.start_s, word.end_s, "AA1") for word in words]
    heard = measure_prosody(sound, words, phones)
    return [heard.prominence[word] for word in words], list(heard.ends_s)


PLAIN = (120.0, 0.05, 0.3)


@pytest.mark.parametrize(
    ("word", "share"), [((160.0, 0.05, 0.3), 0.4), ((120.0, 0.1, 0.3), 0.35), ((120.0, 0.05, 0.6), 0.25)]
)
def test_each_of_pitch_loudness_and_length_makes_a_word_stand_out(word: tuple[float, float, float], share: float):
    prominence, _ = listen(PLAIN, PLAIN, word, PLAIN, PLAIN)
    assert prominence[2] == pytest.approx(0.5 + 0.5 * share, abs=0.02)
    assert prominence[:2] + prominence[3:] == pytest.approx([0.5] * 4, abs=0.06)


def test_a_word_with_all_three_stands_out_most() -> None:
    prominence, _ = listen(PLAIN, PLAIN, (170.0, 0.12, 0.6), PLAIN, (90.0, 0.02, 0.1))
    assert prominence[2] == pytest.approx(1.0, abs=0.01)
    assert prominence[4] < 0.2


def test_phrases_end_at_pauses_and_where_the_voice_begins_anew() -> None:
    low = (100.0, 0.05, 0.3)
    _, ends = listen(PLAIN, low, (0.0, 0.0, 0.2), PLAIN, low, PLAIN, low)
    assert ends == pytest.approx([0.6, 2.0])
    dim = (100.0, 0.01, 0.15)
    _, ends = listen(PLAIN, low, dim, (140.0, 0.05, 0.3), low, PLAIN)
    assert ends == pytest.approx([0.75, 1.65])
    _, ends = listen(PLAIN, low, dim, (100.0, 0.05, 0.3), low, PLAIN)
    assert ends == pytest.approx([1.65])


def test_nothing_heard_or_said_is_no_prosody() -> None:
    sound, words = say(PLAIN)
    assert not measure_prosody(Sound.silence(1.0), words, []).prominence
    assert measure_prosody(sound, [], []).ends_s == ()
