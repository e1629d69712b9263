"""Labelled speech: a folder of sounds with labels of the same name, and of transcripts."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mien.core import Cue, LoadError, Sound
from mien.formats.cue_text import read_text
from mien.formats.cue_textgrid import parse_textgrid
from mien.formats.sound_files import read_sound

from .labels import Segment, segments_of

SOUNDS = (".wav", ".flac", ".ogg", ".mp3", ".m4a", ".sph")
PHONE_TIERS = ("phone", "phones", "phonetic", "segment", "segments", "mau", "phoneme", "phonemes")
LABELS = ("{}.phn", "{}.lab", "{}_phones.TextGrid", "{}.TextGrid")
"""Files of labels that belong to a sound; the first that is there counts."""

TICKS_A_SECOND = 1e7
"""Times of HTK's labels are in units of 100 ns."""


@dataclass(frozen=True, eq=False)
class Clip:
    """A sound with its labels and, if it has one, its transcript."""

    name: str
    sound: Sound
    segments: tuple[Segment, ...]
    text: str


def read_folder(folder: Path) -> Iterator[Clip]:
    """Every sound that has labels, in order of name; says what the alphabet is and what it cannot read."""
    for path in sorted(path for path in folder.rglob("*") if path.suffix.lower() in SOUNDS):
        found = [path.with_name(form.format(path.stem)) for form in LABELS]
        found = [each for each in found if each.exists()]
        if not found:
            continue
        sound = read_sound(path)
        segments, alphabet, strange = segments_of(read_labels(found[0], sound))
        name = str(path.relative_to(folder).with_suffix(""))
        note = f", without {' '.join(sorted(strange))}" if strange else ""
        print(
            f"- {name}: {sound.length_s:.1f} s, {len(segments)} {alphabet} labels of {found[0].name}{note}", flush=True
        )
        yield Clip(name, sound, tuple(segments), read_transcript(path.with_suffix(".txt")))


def read_transcript(path: Path) -> str:
    """The words of a transcript; TIMIT's first and last sample are left out."""
    return re.sub(r"^\d+ \d+ ", "", read_text(path).strip()) if path.exists() else ""


def read_labels(path: Path, sound: Sound) -> list[Cue]:
    """Labels with their times, seconds.

    Raises:
        LoadError: the file has no labels of phones.
    """
    text = read_text(path)
    if path.suffix == ".TextGrid":
        return _fill(_phone_tier(parse_textgrid(text, str(path)).tiers, path), sound.length_s)
    rows = [line.split() for line in text.partition("\n#\n")[2].splitlines() or text.splitlines() if line.strip()]
    unit = 1.0 / sound.rate_hz if path.suffix == ".phn" else 1.0 / TICKS_A_SECOND
    cues, time_s = [], 0.0
    for row in rows:
        if "\n#\n" in text:
            cues.append(Cue(time_s, float(row[0]), row[2] if len(row) > 2 else ""))
            time_s = float(row[0])
        elif len(row) >= 3:
            cues.append(Cue(float(row[0]) * unit, float(row[1]) * unit, row[2]))
    if not cues:
        raise LoadError(path, "has no labels — want 'start end label', or a '#' and then 'end number label'")
    return cues


def join_clips(clips: Sequence[Clip], least_s: float, pause_s: float = 0.4) -> tuple[Sound, str]:
    """The clips one after the other at 16 kHz, again and again, for at least that long, and what is said."""
    rate_hz = 16000
    pause = np.zeros(round(pause_s * rate_hz), dtype=np.int16)
    sounds, words, length = [], [], 0
    while length < least_s * rate_hz:
        for clip in clips:
            samples = resampled(clip.sound, rate_hz).samples
            sounds += [samples, pause]
            words.append(clip.text)
            length += len(samples) + len(pause)
    return Sound(np.concatenate(sounds), rate_hz), " ".join(words)


def resampled(sound: Sound, rate_hz: int) -> Sound:
    """The sound at another rate."""
    from math import gcd

    from scipy.signal import resample_poly

    if sound.rate_hz == rate_hz:
        return sound
    common = gcd(sound.rate_hz, rate_hz)
    samples = resample_poly(sound.samples.astype(np.float64), rate_hz // common, sound.rate_hz // common)
    return Sound(np.clip(np.rint(samples), -32768, 32767).astype(np.int16), rate_hz)


def with_noise(clip: Clip, ratio_db: float, random: np.random.Generator) -> Clip:
    """The clip under white noise; the ratio is that of the powers, of speech where it is labelled, and of noise."""
    samples = clip.sound.samples.astype(np.float64)
    times = np.arange(len(samples)) / clip.sound.rate_hz
    said = np.zeros(len(samples), dtype=bool)
    for segment in clip.segments:
        if not segment.is_pause:
            said |= (times >= segment.start_s) & (times < segment.end_s)
    power = np.mean(samples[said] ** 2) * 10.0 ** (-ratio_db / 10.0)
    noisy = samples + random.normal(scale=np.sqrt(power), size=len(samples))
    scale = min(1.0, 32767.0 / np.abs(noisy).max())
    sound = Sound(np.rint(noisy * scale).astype(np.int16), clip.sound.rate_hz)
    return Clip(clip.name, sound, clip.segments, clip.text)


def _phone_tier(tiers: dict[str, tuple[Cue, ...]], path: Path) -> tuple[Cue, ...]:
    """The tier whose name, or its last word, says that it has phones; where none says so, the one with most labels."""
    last = {re.split(r"[^a-z]+", name.lower().strip("() 0123456789"))[-1]: name for name in reversed(tiers)}
    named = [last[each] for each in PHONE_TIERS if each in last]
    best = named[0] if named else max(tiers, key=lambda name: len(tiers[name]))
    if not tiers[best]:
        raise LoadError(path, f"tier {best!r} has no labels")
    return tiers[best]


def _fill(cues: Sequence[Cue], end_s: float) -> list[Cue]:
    out, time_s = [], 0.0
    for cue in [*cues, Cue(end_s, end_s, "")]:
        if cue.start_s > time_s + 1e-6:
            out.append(Cue(time_s, cue.start_s, ""))
        if cue.length_s > 0.0:
            out.append(cue)
        time_s = max(time_s, cue.end_s)
    return out
