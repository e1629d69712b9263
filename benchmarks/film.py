"""What a film costs: ``python benchmarks/film.py [--suffix .mp4] [--size 1024] [--seconds 10] [--memory]``.

A sentence becomes a film, whole and stage by stage, wall and processor milliseconds a frame; the share is that of the
film's own length. The conversion to luma and chroma is measured beside PyAV's, in turn. With ``--memory``, processes of
their own write films of 10 s and 60 s and say how much memory they took at most.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from itertools import islice
from pathlib import Path
from typing import NamedTuple

import av
import numpy as np
from av.video.reformatter import ColorRange, Colorspace

import mien
from mien.formats.codecs import find_codec
from mien.formats.film import write_film
from mien.formats.film_frames import make_frame
from mien.formats.performances import draw_frames

SENTENCE = "A face is a function from named parameters to coloured polygons, and this one says so. "

FPS = 24

MEMORY = """
import resource, sys
from film import perform
perform(float(sys.argv[1]), int(sys.argv[2])).write(sys.argv[3])
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
"""


class Cost(NamedTuple):
    """Milliseconds a frame."""

    wall: float
    processor: float


def perform(seconds: float, size: int) -> mien.Performance:
    """A performance of about that length."""
    sentences = max(1, round(seconds / 5.3))
    scene = mien.Scene(size_px=(size, size)).seen("three-quarter")
    return mien.say(SENTENCE * sentences, face="head", seed=1, scene=scene)


def measure(work: Callable[[], object], frames: int) -> Cost:
    """What some work costs, shared by the frames that it is about."""
    wall, processor = time.perf_counter(), time.process_time()
    work()
    return Cost((time.perf_counter() - wall) * 1000 / frames, (time.process_time() - processor) * 1000 / frames)


def best(work: Callable[[], object], frames: int, repeats: int) -> Cost:
    """The cheapest of several runs: whatever else a machine does only ever adds."""
    return min(measure(work, frames) for _ in range(repeats))


def convert_as_pyav(pixels: np.ndarray) -> av.VideoFrame:
    """The frame that PyAV makes of a picture."""
    return av.VideoFrame.from_ndarray(pixels, format="rgba").reformat(
        format="yuv420p",
        dst_colorspace=Colorspace.ITU709,
        src_color_range=ColorRange.JPEG,
        dst_color_range=ColorRange.MPEG,
    )


def measure_stages(performance: mien.Performance, path: Path, size: int, repeats: int) -> dict[str, Cost]:
    """Cost by stage, each alone; a part of the film stands for all of it where frames are kept."""
    timeline, face, scene = performance.timeline, performance.face, performance.scene
    pictures = list(islice(draw_frames(timeline, face, scene, FPS), 48))
    layout = find_codec(path).pixels

    def exhaust(items: Iterable[object]) -> None:
        for _ in items:
            pass

    def write() -> None:
        write_film(pictures, path, fps=FPS, size_px=(size, size))

    stages = {
        "pose and draw": best(lambda: exhaust(draw_frames(timeline, face, scene, FPS)), timeline.frame_count(FPS), 1),
        "convert and encode": best(write, len(pictures), repeats),
    }
    if layout.startswith("yuv"):
        ours = [best(lambda: exhaust(map(to_layout(layout), pictures)), len(pictures), 1) for _ in range(repeats)]
        stages["convert"] = min(ours)
    if layout == "yuv420p":
        stages["convert, PyAV's"] = best(lambda: exhaust(map(convert_as_pyav, pictures)), len(pictures), repeats)
    return stages


def to_layout(layout: str) -> Callable[[np.ndarray], av.VideoFrame]:
    """A function that makes frames of one layout."""
    return lambda pixels: make_frame(pixels, layout)


def measure_memory(seconds: float, size: int, path: Path) -> int:
    """MiB that a process takes at most while it writes a film."""
    command = [sys.executable, "-c", MEMORY, str(seconds), str(size), str(path)]
    return int(subprocess.run(command, cwd=Path(__file__).parent, check=True, capture_output=True, text=True).stdout)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--suffix", default=".mp4")
    parser.add_argument("--size", type=int, default=1024)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--memory", action="store_true")
    arguments = parser.parse_args()
    perform(1, 64)
    start = time.perf_counter()
    performance = perform(arguments.seconds, arguments.size)
    speaking_s = time.perf_counter() - start
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"film{arguments.suffix}"
        frames = performance.timeline.frame_count(FPS)
        length_s = frames / FPS
        stages = measure_stages(performance, path, arguments.size, arguments.repeats)
        stages["whole film"] = best(lambda: performance.write(path, fps=FPS), frames, arguments.repeats)
        print(f"{arguments.suffix}, {arguments.size} x {arguments.size}, {frames} frames, {length_s:.2f} s")
        print(f"{'':20s}{'wall':>10s}{'processor':>12s}{'of the length':>16s}")
        for name, cost in stages.items():
            share = cost.wall * frames / 1000 / length_s
            print(f"{name:20s}{cost.wall:7.2f} ms{cost.processor:9.2f} ms{share:15.1%}")
        print(f"voice and movement before that: {speaking_s:.2f} s, {speaking_s / length_s:.1%} of the length")
        print(f"{path.stat().st_size / 1000 / length_s:.0f} kB a second")
        if arguments.memory:
            for seconds in (10, 60):
                print(f"a film of {seconds} s: {measure_memory(seconds, arguments.size, path)} MiB at most")


if __name__ == "__main__":
    main()
