"""A mouth that follows a live voice."""

from __future__ import annotations

import numpy as np
import pytest
from hearing_cases import GARDEN, MARKET, in_noise, noise, said

from mien.core import RangeError
from mien.speech import strip_stress
from mien.speech.listening import DELAY_S, Heard, Listener
from mien.speech.listening_model import AHEAD, BEFORE, OFFSETS, load_layers
from mien.speech.listening_sound import BANDS
from mien.speech.mouth import MOUTH_CHANNELS, articulate

RATE_HZ = 24000


def listen(samples: np.ndarray, rate_hz: int = RATE_HZ) -> tuple[Heard, ...]:
    return Listener(rate_hz).feed(samples)


def curve(heard: tuple[Heard, ...], channel: str) -> np.ndarray:
    return np.array([each.channels[channel] for each in heard])


def as_blocks(samples: np.ndarray, size: int) -> tuple[Heard, ...]:
    listener = Listener(RATE_HZ)
    return tuple(
        heard for first in range(0, len(samples), size) for heard in listener.feed(samples[first : first + size])
    )


def vowel(formants_hz: tuple[float, ...], length_s: float = 0.6, pitch_hz: float = 120.0) -> np.ndarray:
    """A held vowel after half a second of nothing: clicks of a pitch through resonances."""
    wave = np.zeros(round(length_s * RATE_HZ))
    wave[:: round(RATE_HZ / pitch_hz)] = 1.0
    for formant in formants_hz:
        radius, turn = np.exp(-np.pi * 90.0 / RATE_HZ), 2.0 * np.pi * formant / RATE_HZ
        out = np.zeros(len(wave) + 2)
        for place, value in enumerate(wave):
            out[place + 2] = value + 2.0 * radius * np.cos(turn) * out[place + 1] - radius**2 * out[place]
        wave = out[2:]
    wave *= 8000.0 / np.abs(wave).max()
    return np.concatenate([np.zeros(RATE_HZ // 2), wave]).astype(np.int16)


def test_silence_shuts_the_mouth():
    for heard in listen(np.zeros(RATE_HZ, dtype=np.int16)):
        assert set(heard.channels) == set(MOUTH_CHANNELS)
        assert not any(heard.channels.values())


def test_the_mouth_is_shut_soon_after_the_last_sound():
    loud = vowel((750.0, 1200.0, 2500.0))
    heard = listen(np.concatenate([loud, np.zeros(RATE_HZ // 2, dtype=np.int16)]))
    end_s = len(loud) / RATE_HZ
    assert max(each.channels["jaw"] for each in heard if each.time_s < end_s) > 0.4
    assert not any(any(each.channels.values()) for each in heard if each.time_s > end_s + 0.15)


def test_times_are_those_of_the_sound():
    times = np.array([each.time_s for each in listen(np.zeros(RATE_HZ, dtype=np.int16))])
    assert times[0] == 0.0125
    np.testing.assert_allclose(np.diff(times), 0.01)
    assert times[-1] == pytest.approx(1.0 - DELAY_S, abs=0.0101)


def test_an_open_vowel_opens_and_a_round_one_rounds():
    father, food = listen(vowel((750.0, 1200.0, 2500.0))), listen(vowel((310.0, 850.0, 2250.0)))
    held = slice(70, 95)
    assert curve(father, "jaw")[held].mean() > curve(food, "jaw")[held].mean() + 0.2
    assert curve(food, "round")[held].mean() > curve(father, "round")[held].mean() + 0.2


def test_blocks_do_not_matter():
    samples = said(MARKET).sound.samples[: RATE_HZ // 4]
    whole = listen(samples)
    assert len(whole) > 10
    for size in (1, 160, 168, 4096):  # 168 samples are 7 ms
        assert as_blocks(samples, size) == whole


def test_the_same_sound_gives_the_same():
    samples = said(GARDEN).sound.samples
    assert listen(samples) == listen(samples)


def test_loud_and_quiet_voices_open_alike():
    samples = said(GARDEN).sound.samples
    loud, quiet = listen(samples), listen((samples / 16).astype(np.int16))
    for channel in ("jaw", "round", "spread"):
        ours, theirs = curve(loud, channel), curve(quiet, channel)
        assert abs(ours - theirs).mean() < 0.08
        assert theirs.std() == pytest.approx(ours.std(), rel=0.15)


@pytest.mark.parametrize("level", [3.0, 30.0, 300.0, 3000.0])
def test_noise_alone_does_not_babble(level: float):
    heard = listen(noise(4.0, level).samples)[100:]
    moving = np.array([max(each.channels.values()) for each in heard])
    assert np.mean(moving > 0.1) < 0.02


@pytest.mark.parametrize("rate_hz", [8000, 16000, 44100, 48000, 96000])
def test_any_rate_is_heard_alike(rate_hz: int):
    sound = said(MARKET).sound
    times = np.arange(int(sound.length_s * rate_hz)) / rate_hz
    samples = sound.samples.astype(np.float64)
    if rate_hz < RATE_HZ:
        width = RATE_HZ / rate_hz
        samples = np.convolve(samples, np.sinc(np.arange(-60, 61) / width) * np.hanning(121) / width, mode="same")
    other = np.interp(times, np.arange(len(samples)) / RATE_HZ, samples).astype(np.int16)
    ours, theirs = (curve(heard, "jaw") for heard in (listen(sound.samples), listen(other, rate_hz)))
    count = min(len(ours), len(theirs))
    assert np.corrcoef(ours[:count], theirs[:count])[0, 1] > (0.8 if rate_hz == 8000 else 0.95)


@pytest.mark.parametrize("rate_hz", [0, 7999, 96001])
def test_a_rate_that_is_none_is_refused(rate_hz: int):
    with pytest.raises(RangeError, match="want 8000 to 96000"):
        Listener(rate_hz)


def test_the_mouth_moves_as_the_phones_ask_and_in_noise():
    speech = said("A bottle of warm milk stood upon the farmer's table, beside a large bowl of soup.")
    tracks = articulate(speech.phones)
    for samples, least in ((speech.sound.samples, 0.6), (in_noise(speech.sound, 15.0).samples, 0.45)):
        heard = listen(samples)
        times = np.array([each.time_s for each in heard])
        like = [
            np.corrcoef(curve(heard, name), tracks[name].evaluate(times)[0])[0, 1]
            for name in ("jaw", "round", "spread", "closure")
        ]
        assert np.mean(like) > least


def test_lips_shut_at_most_p_b_m():
    speech = said("Mum may buy my baby brother a bumpy bamboo boat. Papa may be happy about a map.")
    heard = listen(speech.sound.samples)
    shut = [
        max(each.channels["closure"] for each in heard if cue.start_s - 0.03 <= each.time_s <= cue.end_s + 0.03)
        for cue in speech.phones
        if strip_stress(cue.symbol) in {"P", "B", "M"}
    ]
    assert len(shut) > 15
    assert np.mean(np.array(shut) > 0.5) > 0.6


def test_what_was_learned_fits_what_is_seen():
    assert list(OFFSETS) == sorted(OFFSETS)
    assert (BEFORE, AHEAD) == (12, 5)
    layers = load_layers()
    assert layers[0][0].shape[0] == len(OFFSETS) * BANDS
    assert layers[-1][0].shape[1] == len(MOUTH_CHANNELS)
    assert 2 * sum(weights.size + added.size for weights, added in layers) <= 50_000
    assert all(np.isfinite(weights).all() for weights, _ in layers)
