"""How a live voice moves the mouth, beside its alignment: ``python benchmarks/listening.py FOLDER``.

The FOLDER holds sounds and beside each its transcript (.txt). What a mouth should do is what ``articulate`` makes of
the phones that mien aligns with the transcript; nothing was learned from these sounds. Compared with it, a hundred
times a second, are

- mien live: ``Listener``, moved back by its delay;
- loudness: each channel as a straight line over the loudness, fitted to these very sounds, which flatters it;
- mien offline: ``hear`` without a transcript, which waits for the end and knows words.

Lips: p b m with a moment of closure over one half; false closures: others, a minute. Delay: of the face drawn at 60
loops a second from blocks of 20 ms, by the shift at which it is most like what it should do. CPU: of one core.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mien.core import MienError, Sound
from mien.formats.cue_text import read_text
from mien.formats.sound_files import read_sound
from mien.live.serving.microphone import Microphone
from mien.live.slices import Motors, Way, count_slices
from mien.speech import hear, strip_stress
from mien.speech.listening import Listener
from mien.speech.listening_sound import Levels, Spectra
from mien.speech.mouth import MOUTH_CHANNELS, articulate

STEP_S = 0.01
BLOCK_S = 0.02
LOOPS_HZ = 60
SHUT = 0.5
NEAR_S = 0.03
LABIALS = frozenset("PBM")

Curves = np.ndarray
"""(F, C) channels, a row each ``STEP_S``."""


@dataclass(frozen=True, eq=False)
class Clip:
    """A sound, what the mouth should do (F, C), and when lips should be shut, s."""

    name: str
    sound: Sound
    wanted: Curves
    labials: tuple[tuple[float, float], ...]

    @property
    def times_s(self) -> np.ndarray:
        return STEP_S * np.arange(len(self.wanted))


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--json", type=Path, help="keep the figures in a file")
    arguments = parser.parse_args()
    clips = [read_clip(path) for path in sorted(arguments.folder.glob("*.wav"))]
    if not clips:
        raise SystemExit(f"{arguments.folder}: there is no .wav")
    length_s = sum(clip.sound.length_s for clip in clips)
    print(f"{len(clips)} sounds, {length_s:.1f} s, {sum(len(clip.labials) for clip in clips)} p b m\n")
    before = time.process_time()
    live = [listen(clip) for clip in clips]
    cpu_s = (time.process_time() - before) / length_s
    rows = {
        "mien live": figures(clips, live),
        "loudness, fitted": figures(clips, fit_loudness(clips)),
        "mien offline": figures(clips, [offline(clip) for clip in clips]),
    }
    names = list(next(iter(rows.values())))
    print("| |" + "|".join(names) + "|\n|---|" + "---|" * len(names))
    for name, row in rows.items():
        print(f"|{name}|" + "|".join(f"{row[each]:.2f}" for each in names) + "|")
    delay_ms = 1000.0 * delay_s(clips)
    print(f"\ndelay of the drawn face {delay_ms:.0f} ms; CPU {cpu_s:.3f} s a second of sound")
    if arguments.json:
        arguments.json.write_text(json.dumps({"rows": rows, "delay_ms": delay_ms, "cpu_s": cpu_s}, indent=1))


def read_clip(path: Path) -> Clip:
    """A sound with what its aligned phones make of it."""
    sound = read_sound(path)
    sound = Sound(np.array(sound.samples), sound.rate_hz)
    phones = hear(sound, read_text(path.with_suffix(".txt"))).speech.phones
    count = int(sound.length_s / STEP_S)
    labials = tuple((cue.start_s, cue.end_s) for cue in phones if strip_stress(cue.symbol) in LABIALS)
    return Clip(path.stem, sound, sample(phones, count), labials)


def sample(phones: Sequence, count: int) -> Curves:
    """What the mouth does with phones, at so many steps."""
    tracks, times = articulate(phones), STEP_S * np.arange(count)
    return np.stack([tracks[name].evaluate(times)[0] for name in MOUTH_CHANNELS], axis=1)


def listen(clip: Clip) -> Curves:
    """What the Listener tells, at the time of the sound that it tells it of."""
    listener, size = Listener(clip.sound.rate_hz), round(BLOCK_S * clip.sound.rate_hz)
    heard = []
    for first in range(0, len(clip.sound.samples), size):
        heard += listener.feed(clip.sound.samples[first : first + size])
    times = [each.time_s for each in heard]
    curves = [[each.channels[name] for each in heard] for name in MOUTH_CHANNELS]
    return np.stack([np.interp(clip.times_s, times, curve) for curve in curves], axis=1)


def fit_loudness(clips: Sequence[Clip]) -> list[Curves]:
    """Each channel as a straight line over the loudness in dB, from 0 at 30 dB below loud speech to 1."""
    loudness = []
    for clip in clips:
        spectra, levels = Spectra(clip.sound.rate_hz), Levels()
        level = [levels.step(power)[1] for power in spectra.feed(clip.sound.samples)]
        times = [spectra.middle_s(frame) for frame in range(spectra.frames)]
        loudness.append(np.interp(clip.times_s, times, np.clip(1.0 + np.array(level) / 30.0, 0.0, 1.0)))
    design = np.stack([np.concatenate(loudness), np.ones(sum(map(len, loudness)))], axis=1)
    line = np.linalg.lstsq(design, np.concatenate([clip.wanted for clip in clips]), rcond=None)[0]
    return [np.clip(np.stack([each, np.ones(len(each))], axis=1) @ line, 0.0, 1.0) for each in loudness]


def offline(clip: Clip) -> Curves:
    """What mien hears without a transcript; nothing where it hears nothing."""
    try:
        return sample(hear(clip.sound).speech.phones, len(clip.wanted))
    except MienError as error:
        print(f"offline, {clip.name}: {error}")
        return np.zeros_like(clip.wanted)


def figures(clips: Sequence[Clip], found: Sequence[Curves]) -> Mapping[str, float]:
    """Correlation of each channel, means, and what the lips do."""
    wanted, ours = np.concatenate([clip.wanted for clip in clips]), np.concatenate(found)
    row = {name: correlation(wanted[:, k], ours[:, k]) for k, name in enumerate(MOUTH_CHANNELS)}
    row |= {"mean": float(np.mean(list(row.values())))}
    row |= {"RMS": float(np.mean(np.sqrt(((wanted - ours) ** 2).mean(axis=0))))}
    return row | lips(clips, found)


def correlation(wanted: np.ndarray, ours: np.ndarray) -> float:
    """Pearson's; 0 where nothing moves."""
    return float(np.corrcoef(wanted, ours)[0, 1]) if ours.std() and wanted.std() else 0.0


def lips(clips: Sequence[Clip], found: Sequence[Curves]) -> Mapping[str, float]:
    """Share of p b m with shut lips, and closures elsewhere in a minute."""
    hits = labials = false = 0
    for clip, curves in zip(clips, found, strict=True):
        shut = curves[:, MOUTH_CHANNELS.index("closure")] >= SHUT
        inside = np.zeros(len(shut), dtype=bool)
        for start_s, end_s in clip.labials:
            span = (clip.times_s >= start_s - NEAR_S) & (clip.times_s <= end_s + NEAR_S)
            inside |= span
            hits += bool(shut[span].any())
        labials += len(clip.labials)
        edges = np.flatnonzero(np.diff(np.concatenate([[False], shut, [False]]).astype(int)))
        false += sum(not inside[first:last].any() for first, last in zip(edges[::2], edges[1::2], strict=True))
    minutes = sum(clip.sound.length_s for clip in clips) / 60.0
    return {"p b m shut": hits / max(1, labials), "false a minute": false / minutes}


def delay_s(clips: Sequence[Clip]) -> float:
    """By how much the drawn mouth is late, seconds."""
    shifts = np.arange(0.0, 0.3, 0.002)
    like = np.zeros(len(shifts))
    for clip in clips:
        times, drawn = draw(clip)
        for number, shift in enumerate(shifts):
            wanted = [np.interp(times - shift, clip.times_s, curve, left=0.0, right=0.0) for curve in clip.wanted.T]
            pairs = zip(wanted, drawn.T, strict=True)
            like[number] += len(times) * np.mean([correlation(each, ours) for each, ours in pairs])
    return float(shifts[like.argmax()])


def draw(clip: Clip) -> tuple[np.ndarray, Curves]:
    """Times of loops and the channels drawn then, when each block arrives as soon as its last sample is there."""
    rate, size = clip.sound.rate_hz, round(BLOCK_S * clip.sound.rate_hz)
    microphone, motors = Microphone(1.0 / LOOPS_HZ), Motors(np.zeros(len(MOUTH_CHANNELS)))
    count, done, rows = int((clip.sound.length_s + 0.3) * LOOPS_HZ), 0, []
    for loop in range(count):
        while done + size <= min(len(clip.sound.samples), loop * rate / LOOPS_HZ):
            message = microphone.hear(clip.sound.samples[done : done + size], rate)
            done += size
            slices = 0 if message is None else count_slices(message["over_ms"] / 1000.0, 1.0 / LOOPS_HZ)
            for row, name in enumerate(MOUTH_CHANNELS if message is not None else ()):
                motors.move(row, Way(message["values"][name], slices))
        microphone.tick(loop)
        motors.step()
        rows.append(motors.values.copy())
    return np.arange(count) / LOOPS_HZ, np.array(rows)


if __name__ == "__main__":
    main()
