"""Short spectra of a stream, and the levels of noise and voice."""

from __future__ import annotations

import numpy as np
import pytest

from mien.speech.listening_sound import BANDS, Levels, Spectra


def tone(pitch_hz: float, rate_hz: int, level: float = 16384.0) -> np.ndarray:
    return (level * np.sin(2.0 * np.pi * pitch_hz * np.arange(rate_hz // 4) / rate_hz)).astype(np.int16)


@pytest.mark.parametrize("rate_hz", [8000, 11025, 22050, 48000, 96000])
def test_the_power_of_a_tone_is_its_own_at_every_rate(rate_hz: int):
    spectra = Spectra(rate_hz).feed(tone(1000.0, rate_hz))
    # A sine of half the scale has the power (1/2)² / 2; neighbouring bands share it.
    assert sum(spectra[3]) == pytest.approx(0.125, rel=0.02)


def test_a_band_lies_where_mel_says():
    # 26 edges from 80 Hz, 121.9 mel, to 7000 Hz, 2701.4 mel: 103.2 mel apart; the tenth middle is 1153.7 mel, 1248 Hz.
    power = Spectra(16000).feed(tone(1248.0, 16000))[3]
    assert int(power.argmax()) == 9


def test_a_frame_comes_each_hundredth_of_a_second():
    spectra = Spectra(22050)
    assert len(spectra.feed(np.zeros(22050, dtype=np.int16))) == 98  # the last that ends in time begins at 0.97 s
    assert spectra.begin(1) == 220
    assert spectra.begin(98) == 21609


def test_bands_above_half_the_rate_are_empty():
    power = Spectra(8000).feed(np.random.default_rng(0).normal(0, 3000, 2000).astype(np.int16))[0]
    assert power[0] > 0.0
    assert not power[-4:].any()


def test_steady_noise_becomes_the_floor_and_a_voice_stands_out():
    levels, hiss, voice = Levels(), np.full(BANDS, 1e-5), np.full(BANDS, 1e-5)
    voice[4:10] = 1e-2
    for _ in range(150):
        bands, level_db = levels.step(hiss)
    assert level_db < -50.0
    assert not bands.any()
    for _ in range(20):
        bands, level_db = levels.step(voice)
    assert level_db == pytest.approx(0.0, abs=0.5)
    assert bands[4:10].min() > 0.8
    assert not bands[10:].any()


def test_a_voice_twenty_times_as_quiet_looks_the_same():
    loud, quiet = Levels(), Levels()
    power = np.zeros(BANDS)
    power[3:12] = 1e-3
    for _ in range(16):
        ours, theirs = loud.step(power)[0], quiet.step(power / 400.0)[0]
    np.testing.assert_allclose(ours, theirs, atol=0.02)
