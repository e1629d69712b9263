"""Loudness, pauses and resampling of what is listened to."""

from __future__ import annotations

import numpy as np
import pytest

from mien.core import Sound
from mien.speech.hearing_sound import DITHER, HEARING_HZ, LEVEL, measure_loudness, take_piece


def tone(length_s: float, rate_hz: int, level: float = 8000.0, pitch_hz: float = 700.0) -> Sound:
    time = np.arange(round(length_s * rate_hz)) / rate_hz
    return Sound(np.rint(level * np.sin(2 * np.pi * pitch_hz * time)).astype(np.int16), rate_hz)


@pytest.mark.parametrize("rate_hz", [8000, 16000, 22050, 24000, 44100, 48000, 96000])
def test_a_tone_stays_a_tone_at_its_time(rate_hz: int):
    sound = tone(2.0, rate_hz)
    piece = take_piece(sound, 0.5, 1.5, measure_loudness(sound))
    time = 0.5 + np.arange(HEARING_HZ) / HEARING_HZ
    wanted = LEVEL * np.sqrt(2) * np.sin(2 * np.pi * 700 * time)
    assert len(piece) == HEARING_HZ
    assert np.abs(piece - wanted).max() < 0.004 * LEVEL + 5 * DITHER


def test_what_lies_above_the_range_is_left_out():
    sound = tone(1.0, 48000, pitch_hz=11000.0)
    piece = take_piece(sound, 0.2, 0.8, measure_loudness(sound))
    assert np.abs(piece).max() < 6 * DITHER  # at 16 kHz it would come back as a tone of 5 kHz


def test_beyond_the_ends_is_silence():
    sound = tone(0.5, 16000)
    piece = take_piece(sound, 0.4, 0.8, measure_loudness(sound))
    assert np.abs(piece[: HEARING_HZ // 20]).max() > LEVEL
    assert np.abs(piece[-HEARING_HZ // 5 :]).max() < 6 * DITHER


def test_loudness_of_a_known_tone():
    loudness = measure_loudness(tone(1.0, 16000, level=32768 / 100))
    assert loudness.loud_db == pytest.approx(-43.0, abs=0.05)  # 1/100 of full scale, and 3 dB because it is a sine
    assert len(loudness.level_db) == 100


def test_a_pause_is_quiet_and_the_place_to_cut():
    parts = [tone(1.0, 16000), Sound.silence(0.4, 16000), tone(1.0, 16000)]
    loudness = measure_loudness(Sound(np.concatenate([part.samples for part in parts]), 16000))
    assert loudness.count_loud_s(1.0, 1.4) == 0.0
    assert loudness.trim(1.05, 2.4) == pytest.approx((1.1, 2.4))
    assert loudness.trim(0.5, 1.4) == pytest.approx((0.5, 1.3))
    assert loudness.trim(1.0, 1.4) == (1.0, 1.0)
    assert loudness.count_loud_s(0.5, 2.0) == pytest.approx(1.1)
    assert 1.07 <= loudness.find_cut_s(0.0, 2.4) <= 1.33


def test_noise_between_words_is_quiet():
    generator = np.random.default_rng(1)
    level = np.repeat([10.0, 1.0, 10.0], 16000) * 300
    loudness = measure_loudness(Sound((generator.normal(0, 1, 48000) * level).astype(np.int16), 16000))
    assert loudness.count_loud_s(1.0, 2.0) == 0.0


def test_clipping_is_counted():
    samples = np.zeros(1000, np.int16)
    samples[100:104], samples[500] = 32767, 32767
    assert measure_loudness(Sound(samples, 16000)).clipped_share == pytest.approx(0.003)
    # one sample at the top is a peak


@pytest.mark.parametrize("rate_hz", [11025, 16000, 22050, 44100])
def test_frames_keep_time_at_any_rate(rate_hz: int) -> None:
    samples = np.zeros(60 * rate_hz + 7, np.int16)
    samples[59 * rate_hz : round(59.5 * rate_hz)] = 3000 * (-1) ** np.arange(round(59.5 * rate_hz) - 59 * rate_hz)
    level_db = measure_loudness(Sound(samples, rate_hz)).level_db
    assert len(level_db) == 6000
    loud = np.flatnonzero(level_db > -30.0)
    assert (loud[0], loud[-1]) == (5900, 5949)
