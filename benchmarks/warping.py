"""Recordings in other languages: ``python benchmarks/warping.py [FOLDER...]``, with the extra ``espeak``.

mien aligns them by saying the text and stretching the voice's sound until it fits. FOLDERs of labelled English speech,
as ``lipsync.py`` takes them, are aligned in this way too, by the English voice: what a person's speech costs. Other
languages have no labelled speech here: the sentences of ``languages.csv`` are said by other speakers of the same
engine at another pace, whose times are known, which is easier than a person. Both also in noise. Beginnings of
phones, heard minus known; intervals of 95 % by drawing seconds of speech a thousand times.
"""

from __future__ import annotations

import argparse
import csv
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from labelled.clips import Clip, read_folder, with_noise
from labelled.labels import Segment
from labelled.measures import Block, figures, score

from mien.core import SILENCE, Cue, MienError
from mien.formats.cue_sheet import fill_gaps
from mien.speech import find_speaker, find_voice, speak, strip_stress
from mien.speech.hearing_sound import measure_loudness
from mien.speech.voice import Voice
from mien.speech.voice_espeak import EspeakVoice
from mien.speech.warping import warp

VARIANTS = (("f4", 120), ("m3", 185), ("f1", 150))
"""Other speakers of the engine, and their words a minute; the pattern is a man's at 155. f2 and f3 vary by chance."""

NOISES_DB = (None, 20.0, 10.0)
MEASURES = ("boundary ms", "20 ms %", "50 ms %", "found %")


def align(clip: Clip, voice: Voice) -> tuple[Cue, ...]:
    """The phones of a clip without holes."""
    warped = warp(clip.sound, measure_loudness(clip.sound), clip.text, voice, lambda _: None)
    phones = [cue for word in warped.words for cue in word.phones if cue.length_s > 0.0]
    return tuple(fill_gaps(phones, clip.sound.length_s, SILENCE))


def other_speakers(language: str, sentences: Sequence[str]) -> Iterator[Clip]:
    """Sentences said by speakers other than the one who is compared with them."""
    for number, text in enumerate(sentences):
        variant, pace = VARIANTS[number % len(VARIANTS)]
        said = speak(text, EspeakVoice(variant, f"{language}+{variant}", language, "", pace))
        segments = (Segment(cue.start_s, cue.end_s, (strip_stress(cue.symbol),)) for cue in said.phones)
        yield Clip(f"{language}-{variant}", said.sound, tuple(segments), text)


def measure(clips: Sequence[Clip], voice: Voice) -> tuple[list[Block], float, int]:
    """Seconds of all clips, CPU seconds a second of sound, and how many clips were refused."""
    blocks: list[Block] = []
    refused, begin = 0, time.process_time()
    for clip in clips:
        try:
            phones = align(clip, voice)
        except MienError as error:
            print(f"  {clip.name}: {error}", flush=True)
            refused, phones = refused + 1, (Cue(0.0, clip.sound.length_s, SILENCE),)
        blocks += score(clip.segments, phones, ())
    return blocks, (time.process_time() - begin) / sum(clip.sound.length_s for clip in clips), refused


def print_row(label: str, clips: Sequence[Clip], voice: Voice) -> None:
    """A row of the table."""
    blocks, factor, refused = measure(clips, voice)
    found = figures(blocks)
    cells = [f"{found[name].value:.1f} [{found[name].low:.1f}, {found[name].high:.1f}]" for name in MEASURES]
    print(f"| {label} | {' | '.join(cells)} | {refused} | {factor:.3f} |", flush=True)


def read_sentences() -> dict[str, list[str]]:
    """Sentences by language."""
    found: dict[str, list[str]] = {}
    with Path(__file__).with_name("languages.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["language"], []).append(row["sentence"])
    return found


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="*", help="labelled English speech")
    parser.add_argument("--quick", action="store_true", help="no noise")
    arguments = parser.parse_args()
    sets = [(str(folder), list(read_folder(folder)), find_voice("espeak-en")) for folder in arguments.folder]
    sets += [
        (f"{language}, other speakers", list(other_speakers(language, sentences)), find_speaker(language))
        for language, sentences in read_sentences().items()
    ]
    print(f"\n| | {' | '.join(MEASURES)} | refused | CPU s a second |\n|---|" + "---|" * (len(MEASURES) + 2))
    for label, clips, voice in sets:
        random = np.random.default_rng(0)
        for noise_db in NOISES_DB[: 1 if arguments.quick else None]:
            noisy = clips if noise_db is None else [with_noise(clip, noise_db, random) for clip in clips]
            print_row(label if noise_db is None else f"{label}, {noise_db:g} dB", noisy, voice)


if __name__ == "__main__":
    main()
