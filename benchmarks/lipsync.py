"""Lip sync against labelled speech: ``python benchmarks/lipsync.py [FOLDER...] [--synthesised MINUTES]``.

A FOLDER holds sounds, and beside each its labels of phones (.phn as TIMIT's, .lab as ESPS's or HTK's, .TextGrid) and
its transcript (.txt); labels are ARPABET, IPA, SAMPA or those of the EMU databases. ``--synthesised`` says sentences
with espeak-ng, which tells at which sample each phone begins; closures of stops are where its samples are silent.

Boundaries: heard minus labelled beginnings of phones. Shapes: the nine of Rhubarb, a hundred frames a second; strict
is the phone's own shape, lenient one of those that ``labelled/allowed_shapes.csv`` allows for it. Lips: labelled p b m
with a frame that is shut, f v with one that is tucked. False closures: shut frames where a sound is labelled that is
no p b m. Intervals are of 95 %, by drawing seconds of speech a thousand times. Real-time factors are CPU seconds a
second of sound, of a minute and more, the start excluded. Rhubarb 1.13 runs beside, from an npm package.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from environment import default_folder, make_environment
from labelled.clips import Clip, join_clips, read_folder, with_noise
from labelled.measures import Block, Figure, figures, score
from labelled.rhubarb import Rhubarb, find_rhubarb
from labelled.rhubarb import default_folder as rhubarb_folder
from labelled.synthesis import synthesise

from mien.core import Cue, Sound
from mien.speech.hearing import hear
from mien.speech.shapes import shapes_of

NOISE_DB = 10.0
NOISE_SEED = 0
TIMED_S = 60.0

Answer = tuple[tuple[Cue, ...] | None, tuple[Cue, ...]]
"""Phones, where the tool tells them, and shapes."""


@dataclass(frozen=True)
class Tool:
    """Something that gives shapes for a sound and, if it has one, its transcript; and how long that took, CPU s."""

    name: str
    run: Callable[[Sound, str], Answer]
    cpu_s: Callable[[Sound, str], float]


def ours(sound: Sound, text: str) -> Answer:
    """What mien hears."""
    heard = hear(sound, text or None)
    return heard.speech.phones, shapes_of(heard.speech.phones, "rhubarb")


def our_cpu_s(sound: Sound, text: str) -> float:
    """CPU seconds of this process."""
    before = time.process_time()
    ours(sound, text)
    return time.process_time() - before


def tools(rhubarb: Path | None) -> Iterator[Tool]:
    """The tools that are there."""
    yield Tool("mien", ours, our_cpu_s)
    if rhubarb is not None:
        peer = Rhubarb(rhubarb)
        yield Tool("Rhubarb 1.13", lambda sound, text: (None, peer.shapes(sound, text)), peer.cpu_s)


def measure(tool: Tool, clips: Sequence[Clip], with_text: bool) -> list[Block]:
    """Seconds of all clips; a clip that the tool refuses counts as said to be silent."""
    blocks: list[Block] = []
    for clip in clips:
        try:
            phones, shapes = tool.run(clip.sound, clip.text if with_text else "")
        except Exception as reason:  # noqa: BLE001
            print(f"  {tool.name} failed on {clip.name}: {reason}", flush=True)
            phones, shapes = (), (Cue(0.0, clip.sound.length_s, "X"),)
        blocks += score(clip.segments, phones, shapes)
    return blocks


def real_time_factor(tool: Tool, clips: Sequence[Clip], with_text: bool) -> float:
    """CPU seconds a second of sound, from a long one less a short one, so that the start does not count."""
    long, short = join_clips(clips, TIMED_S), join_clips(clips[:1], 1.0)
    tool.run(short[0], short[1] if with_text else "")
    taken = [tool.cpu_s(sound, text if with_text else "") for sound, text in (short, long)]
    return (taken[1] - taken[0]) / (long[0].length_s - short[0].length_s)


def print_table(rows: dict[str, dict[str, Figure]], factors: dict[str, float]) -> None:
    """The measures as a table of Markdown, intervals in brackets."""
    names = list(next(iter(rows.values())))
    print("| |" + "|".join(names) + "|CPU s a second|\n|---|" + "---|" * (len(names) + 1))
    for label, row in rows.items():
        cells = [_cell(row[name]) for name in names]
        print(f"|{label}|" + "|".join(cells) + f"|{factors.get(label, np.nan):.3f}|".replace("nan", ""))


def _cell(figure: Figure) -> str:
    return f"{figure.value:.1f} [{figure.low:.1f}, {figure.high:.1f}]" if np.isfinite(figure.value) else "–"


@contextmanager
def folders(given: Sequence[Path], minutes: float) -> Iterator[list[Path]]:
    """The labelled folders; the synthesised one lasts as long as it is needed."""
    with tempfile.TemporaryDirectory() as temporary:
        if minutes:
            python, missing = make_environment(default_folder(), ["espeakng-loader"])
            if missing:
                raise SystemExit(f"no speech can be synthesised: {missing}")
            synthesise(Path(temporary), minutes, python)
        yield [*given, *([Path(temporary)] if minutes else [])]


def main() -> None:
    """Print a table for each folder."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="*")
    parser.add_argument("--synthesised", type=float, default=0.0, metavar="MINUTES", help="of speech by espeak-ng")
    parser.add_argument("--rhubarb", type=Path, default=rhubarb_folder(), help="folder of its npm package, or for it")
    parser.add_argument("--no-peers", action="store_true", help="leave Rhubarb out")
    parser.add_argument("--quick", action="store_true", help="no noise and no times")
    parser.add_argument("--json", type=Path, help="keep the figures in a file")
    arguments = parser.parse_args()
    kept = {}
    there = list(tools(None if arguments.no_peers else find_rhubarb(arguments.rhubarb)))
    with folders(arguments.folder, arguments.synthesised) as places:
        for place in places:
            clips = list(read_folder(place))
            if not clips:
                raise SystemExit(f"{place}: no sound here has labels")
            title = "synthesised" if place not in arguments.folder else str(place)
            length_s = sum(clip.sound.length_s for clip in clips)
            print(f"\n## {title}: {len(clips)} clips, {length_s:.0f} s\n", flush=True)
            kept[title] = measure_all(there, clips, arguments.quick)
    if arguments.json:
        arguments.json.write_text(json.dumps(kept, indent=1))


def measure_all(there: Sequence[Tool], clips: Sequence[Clip], quick: bool) -> dict[str, object]:
    """Prints the table of a folder and gives its figures."""
    random = np.random.default_rng(NOISE_SEED)
    sets = {"": clips} if quick else {"": clips, f", {NOISE_DB:g} dB": [with_noise(c, NOISE_DB, random) for c in clips]}
    rows, factors = {}, {}
    for heading, each in sets.items():
        for with_text in (True, False):
            for tool in there:
                label = f"{tool.name}, {'with' if with_text else 'no'} transcript{heading}"
                rows[label] = figures(measure(tool, each, with_text))
                if not heading and not quick:
                    factors[label] = real_time_factor(tool, each, with_text)
    print_table(rows, factors)
    return {label: {name: asdict(figure) for name, figure in row.items()} for label, row in rows.items()}


if __name__ == "__main__":
    main()
