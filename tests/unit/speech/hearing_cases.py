"""Sentences of the built-in voice to listen to, each said once a run."""

from functools import cache

import numpy as np

from mien.core import Sound
from mien.speech import Heard, Speech, speak

MARKET = "She bought fresh bread, butter, and a jar of plum jam at the market."
GARDEN = "We have never seen such a beautiful garden in the middle of winter."


@cache
def said(text: str) -> Speech:
    """A text, said; the same for the same text."""
    return speak(text)


def words(heard: Heard) -> list[str]:
    """The words that were heard."""
    return [cue.symbol for cue in heard.speech.words]


def joined(*parts: Sound) -> Sound:
    """Sounds one after another, at the rate of the first."""
    return Sound(np.concatenate([part.samples for part in parts]), parts[0].rate_hz)


def noise(length_s: float, level: float, rate_hz: int = 24000) -> Sound:
    """White noise with a root mean square, of 32767; the same each time."""
    return Sound(np.random.default_rng(0).normal(0, level, round(length_s * rate_hz)).astype(np.int16), rate_hz)


def in_noise(sound: Sound, below_db: float) -> Sound:
    """The sound with white noise so far below it."""
    samples = sound.samples.astype(np.float64)
    level = np.sqrt((samples**2).mean()) * 10 ** (-below_db / 20)
    return Sound((samples + noise(sound.length_s, level, sound.rate_hz).samples).astype(np.int16), sound.rate_hz)


def chords(length_s: float, rate_hz: int = 24000) -> Sound:
    """Three square waves that move on twice a second and die away: music without a voice."""
    time = np.arange(round(length_s * rate_hz)) / rate_hz
    step = 2.0 ** (np.floor(time * 2) % 5 / 12)
    phases = [2 * np.pi * np.cumsum(pitch * step) / rate_hz for pitch in (220.0, 277.0, 330.0)]
    wave = sum(np.sign(np.sin(phase)) for phase in phases) * np.exp(-2 * (time * 2 % 1))
    return Sound((3000 * wave).astype(np.int16), rate_hz)
