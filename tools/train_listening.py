"""Learn src/mien/speech/data/listening.npz, which moves the mouth with a live voice, from mien's own voices.

python tools/train_listening.py [--repeats N] [-o FILE]      (needs mien[espeak] and scipy; some ten minutes)

The voices say the words of ``listening_sentences.txt`` and of the sentences of the benchmarks, in random order, so
that sounds meet in many ways. Each clip is changed by chance: pitch and size of the mouth by resampling, microphone,
room, noise and loudness. What is learned is what ``articulate`` makes of the phones that the voice says it spoke. No
recording of a person is used. The same run gives the same file on the same machine.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.signal import fftconvolve, lfilter, resample_poly

from mien.core import Cue
from mien.speech import Voice, find_voice, speak
from mien.speech.listening_model import BEFORE, MIDDLE, OFFSETS
from mien.speech.listening_sound import BANDS, Levels, Spectra
from mien.speech.mouth import MOUTH_CHANNELS, articulate
from mien.speech.voice_espeak import EspeakVoice

ROOT = Path(__file__).parents[1]
TEXTS = (ROOT / "tools" / "listening_sentences.txt", ROOT / "benchmarks" / "labelled" / "sentences.txt")
DATA = ROOT / "src" / "mien" / "speech" / "data" / "listening.npz"

ESPEAK = "f2 f3 f4 f5 m1 m2 m3 m4 m5 m6 m7 m8 klatt klatt4"
WORDS_A_MINUTE = (135, 190)
WORDS_A_SENTENCE = (4, 10)
SENTENCES_A_CLIP = 8

HIDDEN = (60, 40)
EPOCHS = 10
BATCH = 512
RATE = 2e-3
DECAY = 1e-3
HELD_WEIGHT = 2.0
"""Of the errors of closure and tuck: they are rare, and a film must see them."""

Array = NDArray[np.float32]
Spoken = tuple[NDArray[np.int16], int, tuple[Cue, ...]]


def main() -> None:
    """Write the file and tell how well it fits."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=5, help="how often each clip of the built-in voice is changed")
    parser.add_argument("-o", type=Path, default=DATA, help="file to write")
    arguments = parser.parse_args()
    random = np.random.default_rng(1974)
    bands, channels, frames = [], [], []
    count = 0
    for voice, rounds, repeats in voices(random):
        for _ in range(rounds):
            for clip in clips(voice, random):
                for _ in range(arguments.repeats if repeats else 1):
                    seen, wanted = look(*change(clip, random))
                    frames.append(count + BEFORE + np.arange(len(wanted)))
                    bands.append(np.pad(seen, ((BEFORE, OFFSETS[-1]), (0, 0))))
                    channels.append(np.pad(wanted, ((BEFORE, OFFSETS[-1]), (0, 0))))
                    count += len(bands[-1])
        print(f"{voice.name}: {count / 6000:.0f} minutes in all", flush=True)
    layers = learn(np.concatenate(bands), np.concatenate(channels), np.concatenate(frames), random)
    arrays = {}
    for number, (weights, added) in enumerate(layers):
        arrays |= {f"weights{number}": weights.astype(np.float16), f"added{number}": added.astype(np.float16)}
    np.savez(arguments.o, **arrays)
    print(f"{arguments.o}: {arguments.o.stat().st_size} bytes")


def voices(random: np.random.Generator) -> Iterator[tuple[Voice, int, bool]]:
    """Who speaks, how often all the words, and whether each clip is changed in several ways."""
    yield find_voice("hibari"), 4, True
    for variant in ["", *(f"+{name}" for name in ESPEAK.split())]:
        speed = int(random.integers(*WORDS_A_MINUTE))
        yield EspeakVoice(f"espeak{variant}", f"en-us{variant}", "en-US", "", speed), 1, False


def clips(voice: Voice, random: np.random.Generator) -> Iterator[Spoken]:
    """All words, said in random order: samples, their rate and the phones."""
    words = [word for path in TEXTS for word in re.findall(r"[A-Za-z']+", path.read_text(encoding="utf-8"))]
    order = [words[k] for k in random.permutation(len(words))]
    sentences = []
    while order:
        length = int(random.integers(*WORDS_A_SENTENCE))
        sentences.append(" ".join(order[:length]).capitalize() + ".")
        order = order[length:]
    for first in range(0, len(sentences), SENTENCES_A_CLIP):
        speech = speak(" ".join(sentences[first : first + SENTENCES_A_CLIP]), voice)
        yield np.array(speech.sound.samples), speech.sound.rate_hz, speech.phones


def change(clip: Spoken, random: np.random.Generator) -> Spoken:
    """The clip as another person, another microphone and another room would have made it."""
    samples, rate_hz, phones = clip
    slower = Fraction(float(np.exp(random.uniform(np.log(0.8), np.log(1.22))))).limit_denominator(40)
    wave = resample_poly(samples / 32768.0, slower.numerator, slower.denominator)
    wave = lfilter([1.0, random.uniform(-0.55, 0.55)], [1.0], wave)
    if random.random() < 0.4:
        wave = fftconvolve(wave, room(rate_hz, random))[: len(wave)]
    if random.random() < 0.15:
        wave = resample_poly(resample_poly(wave, 8000, rate_hz), rate_hz, 8000)[: len(wave)]
    spoken = np.mean(wave[np.abs(wave) > 0.02 * np.abs(wave).max()] ** 2)
    noise = lfilter([1.0], [1.0, -random.uniform(0.0, 0.95)], random.normal(size=len(wave)))
    wave = wave + noise / noise.std() * np.sqrt(spoken) * 10.0 ** (-random.uniform(8.0, 55.0) / 20.0)
    wave *= 10.0 ** (-random.uniform(3.0, 30.0) / 20.0) / np.abs(wave).max()
    longer = float(slower)
    cues = tuple(Cue(cue.start_s * longer, cue.end_s * longer, cue.symbol) for cue in phones)
    return np.rint(wave * 32767.0).astype(np.int16), rate_hz, cues


def room(rate_hz: int, random: np.random.Generator) -> NDArray[np.float64]:
    """What a room answers to a click: the click, and noise that dies away by 60 dB."""
    count = int(random.uniform(0.08, 0.35) * rate_hz)
    answer = random.normal(size=count) * np.exp(-6.9 * np.arange(count) / count)
    answer *= 10.0 ** (-random.uniform(4.0, 18.0) / 20.0) / np.sqrt((answer**2).sum())
    answer[0] += 1.0
    return answer


def look(samples: NDArray[np.int16], rate_hz: int, phones: tuple[Cue, ...]) -> tuple[Array, Array]:
    """What a Listener sees of a clip (F, B), and what the mouth should do then (F, C)."""
    spectra, levels = Spectra(rate_hz), Levels()
    seen = np.array([levels.step(power)[0] for power in spectra.feed(samples)])
    times = np.array([spectra.middle_s(frame) for frame in range(spectra.frames)])
    tracks = articulate(phones)
    ended = times >= tracks[MOUTH_CHANNELS[0]].length_s
    wanted = np.stack([np.where(ended, 0.0, tracks[name].evaluate(times)[0]) for name in MOUTH_CHANNELS], axis=1)
    return seen.astype(np.float32), wanted.astype(np.float32)


def learn(bands: Array, channels: Array, frames: NDArray[np.int64], random: np.random.Generator) -> list:
    """Weights and what is added of each layer, by stochastic descent.

    Source: Kingma and Ba 2015, "Adam", with decoupled decay (Loshchilov and Hutter 2019) and a cosine schedule.
    """
    sizes = (len(OFFSETS) * BANDS, *HIDDEN, len(MOUTH_CHANNELS))
    offsets = np.array(OFFSETS)
    weight = np.array([HELD_WEIGHT if name in ("closure", "tuck") else 1.0 for name in MOUTH_CHANNELS], np.float32)
    depth = len(sizes) - 1
    pairs = list(pairwise(sizes))
    values = [(random.normal(size=pair) * np.sqrt(2.0 / pair[0])).astype(np.float32) for pair in pairs]
    values += [np.zeros(size, np.float32) for size in sizes[1:]]
    mean, square = [np.zeros_like(each) for each in values], [np.zeros_like(each) for each in values]
    steps, error = EPOCHS * len(frames) // BATCH, 0.0
    for step in range(1, steps + 1):
        chosen = frames[random.integers(len(frames), size=BATCH)]
        layers = [bands[chosen[:, None] + offsets].reshape(BATCH, -1) - np.float32(MIDDLE)]
        for k in range(depth - 1):
            layers.append(np.maximum(layers[-1] @ values[k] + values[depth + k], 0.0))
        wrong = (layers[-1] @ values[depth - 1] + values[-1] - channels[chosen]) * weight
        error += float((wrong**2).mean())
        slope, slopes = 2.0 * wrong / BATCH, [np.zeros(0, np.float32)] * (2 * depth)
        for k in reversed(range(depth)):
            slopes[k], slopes[depth + k] = layers[k].T @ slope, slope.sum(axis=0)
            slope = (slope @ values[k].T) * (layers[k] > 0.0)
        pace = RATE * min(1.0, step / 300) * (0.51 + 0.5 * np.cos(np.pi * step / steps))
        for k, each in enumerate(values):
            mean[k] += 0.1 * (slopes[k] - mean[k])
            square[k] += 0.001 * (slopes[k] ** 2 - square[k])
            change_by = mean[k] / (1.0 - 0.9**step) / (np.sqrt(square[k] / (1.0 - 0.999**step)) + 1e-8)
            each -= pace * (change_by + (DECAY * each if k < depth else 0.0))
        if step % max(1, steps // EPOCHS) == 0:
            print(f"step {step} of {steps}: mean square error {error / max(1, steps // EPOCHS):.4f}", flush=True)
            error = 0.0
    return [(values[k], values[depth + k]) for k in range(depth)]


if __name__ == "__main__":
    main()
