"""Renderers side by side: ``python benchmarks/render.py [--sizes 800,5000,50000] [--no-peers] [--quick]``.

All draw the same moving form at 1024 x 1024 and hand over RGBA in NumPy. A frame's time goes from new points to those
pixels; peers are given normals as well, ours makes its own. Each renderer is a process; they draw in turn, a few frames
a round, and the median of the rounds counts, so that what else the machine does meets all alike. CPU is the work of all
threads of a process. Peers are installed in an environment of their own; who does not start is left out, with the
reason. A bare Debian needs libegl1 for moderngl and VTK, mesa-vulkan-drivers for wgpu.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import tempfile
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from environment import default_folder, installed, make_environment
from headlike import GRIDS, make_form
from numpy.typing import NDArray
from peers.setting import BACKGROUND, SIDE_PX
from PIL import Image
from workers import Worker, WorkerEndedError

ALIKE = 0.97
"""Least share of covered pixels that a picture has in common with ours; else something else was drawn."""


@dataclass(frozen=True)
class Entry:
    """A line of the table: a renderer and its settings; no package: it runs in our own environment."""

    label: str
    module: str
    package: str | None
    samples: int
    threads: int = 0

    @property
    def title(self) -> str:
        """Label and samples, as people read them."""
        return f"{self.label}, {self.samples} sample{'s' * (self.samples > 1)}"


OURS = tuple(
    Entry(f"mien, {threads} thread{'s' * (threads > 1)}", "with_mien", None, samples, threads)
    for samples in (1, 4)
    for threads in (1, 2)
)
FLOOR = Entry("memory floor", "floor", None, 1, 1)
PEERS = tuple(
    Entry(label, module, package, samples)
    for label, module, package, choices in (
        ("moderngl", "with_moderngl", "moderngl", (1, 4)),
        ("VTK", "with_vtk", "vtk", (1, 4)),
        ("Panda3D tinydisplay", "with_panda3d", "panda3d", (1,)),
        ("raylib_software", "with_raylib", "raylib_software", (1,)),
        ("wgpu", "with_wgpu", "wgpu", (1, 4)),
    )
    for samples in choices
)


@dataclass(frozen=True)
class Target:
    """How much longer a peer is meant to take than ours on so many threads."""

    label: str
    samples: int
    measure: str
    factor: float
    threads: int


TARGETS = (
    Target("moderngl", 1, "wall", 1.8, 2),
    Target("moderngl", 4, "wall", 4.0, 2),
    Target("VTK", 1, "CPU", 4.0, 1),
    Target("VTK", 4, "CPU", 4.0, 1),
)
FLOOR_FACTOR = 2.5


@dataclass
class Times:
    """Milliseconds a frame, round by round, and how alike the picture is."""

    wall: list[float] = field(default_factory=list)
    cpu: list[float] = field(default_factory=list)
    overlap: float = 0.0

    def median(self, measure: str) -> float:
        """Of ``wall`` or ``CPU``."""
        return statistics.median(self.wall if measure == "wall" else self.cpu)


Race = dict[Entry, Times]


def start(stack: ExitStack, entries: list[Entry], pythons: dict[str | None, Path]) -> dict[Entry, Worker]:
    """Those of the entries that are there, ready to draw; says what the others lack."""
    workers = {}
    for entry in entries:
        worker = stack.enter_context(Worker(pythons[entry.package], entry.module, entry.samples, entry.threads))
        try:
            print(f"- {entry.title}: {worker.start()}", flush=True)
        except WorkerEndedError as reason:
            print(f"- {entry.title}: left out, it {reason}", flush=True)
            continue
        workers[entry] = worker
    return workers


def race(workers: dict[Entry, Worker], form: Path, pictures: Path | None, rounds: int, frames: int) -> Race:
    """Times of every renderer with a form; who falls over is dropped from ``workers``."""
    result: Race = {}

    def drop(entry: Entry, reason: WorkerEndedError) -> None:
        print(f"{entry.title} is left out from here on, it {reason}")
        result.pop(entry, None)
        del workers[entry]

    covered: NDArray[np.bool_] | None = None
    for entry in list(workers):
        kept = form.with_suffix(".npy")
        try:
            workers[entry].ask("load", path=str(form))
            workers[entry].ask("picture", path=str(kept), frame=7)
            workers[entry].ask("draw", first=12, count=1)
        except WorkerEndedError as reason:
            drop(entry, reason)
            continue
        picture = np.load(kept)
        if pictures is not None:
            name = f"{form.stem} {entry.label.replace(',', '')} {entry.samples}".replace(" ", "-")
            Image.fromarray(np.ascontiguousarray(picture)).save(pictures / f"{name}.png")
        own = coverage(picture)
        covered = own if covered is None else covered
        result[entry] = Times(overlap=float((own & covered).sum() / (own | covered).sum()))
    for k in range(rounds):
        for entry, times in list(result.items()):
            try:
                answer = workers[entry].ask("draw", first=12 + k * frames, count=frames)
            except WorkerEndedError as reason:
                drop(entry, reason)
                continue
            times.wall.append(1000.0 * answer["wall_s"] / frames)
            times.cpu.append(1000.0 * answer["cpu_s"] / frames)
    return result


def coverage(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """(H, W) where a picture (H, W, 3) is not background."""
    apart = np.abs(picture.astype(int) - np.rint(255.0 * np.array(BACKGROUND)).astype(int))
    covered: NDArray[np.bool_] = (apart > 24).any(axis=2)
    return covered


def print_table(title: str, result: Race) -> None:
    """Markdown: ours with as many samples on two threads is 1."""
    print(f"\n{title}\n")
    print("| renderer | samples | wall ms | CPU ms | wall / ours | CPU / ours | same pixels |")
    print("|---|---|---|---|---|---|---|")
    for entry, times in sorted(result.items(), key=lambda row: row[0].samples):
        own = result.get(ours(entry.samples))
        ratios = [times.median(m) / own.median(m) if own else float("nan") for m in ("wall", "CPU")]
        alike = f"{times.overlap:.1%}" + (" NOT ALIKE" if times.overlap < ALIKE else "")
        cells = f"{times.median('wall'):.2f} | {times.median('CPU'):.2f} | {ratios[0]:.2f} | {ratios[1]:.2f}"
        print(f"| {entry.label} | {entry.samples} | {cells} | {alike} |")


def ours(samples: int, threads: int = 2) -> Entry:
    """Our own line with these settings."""
    return next(entry for entry in OURS if (entry.samples, entry.threads) == (samples, threads))


def print_targets(size: int, result: Race) -> None:
    """What was wanted, what was reached."""
    for target in TARGETS:
        peer = next((t for e, t in result.items() if (e.label, e.samples) == (target.label, target.samples)), None)
        own = result.get(ours(target.samples, target.threads))
        if peer is not None and own is not None:
            factor = peer.median(target.measure) / own.median(target.measure)
            word = "reached" if factor >= target.factor else "MISSED"
            what = f"{target.label}, {target.samples} samples, {target.measure}"
            threads = f"{target.threads} thread{'s' if target.threads > 1 else ''}"
            print(f"- {size}: {what}: {factor:.2f} times ours on {threads}, wanted {target.factor}: {word}")
    if FLOOR in result and ours(1, 1) in result:
        factor = result[ours(1, 1)].median("CPU") / result[FLOOR].median("CPU")
        word = "reached" if factor <= FLOOR_FACTOR else "MISSED"
        print(f"- {size}: ours, one thread, 1 sample, is {factor:.2f} times the floor, wanted {FLOOR_FACTOR}: {word}")


def parse() -> argparse.Namespace:
    """What the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", default=",".join(map(str, GRIDS)), help="numbers of triangles")
    parser.add_argument("--rounds", type=int, default=11)
    parser.add_argument("--frames", type=int, default=12, help="frames a round")
    parser.add_argument("--peers", type=Path, default=default_folder(), help="their environment, made if need be")
    parser.add_argument("--no-peers", action="store_true", help="only ours and the floor")
    parser.add_argument("--quick", action="store_true", help="800 triangles, two short rounds: does it run?")
    parser.add_argument("--pictures", type=Path, help="a folder for what everybody drew")
    arguments = parser.parse_args()
    if arguments.quick:
        arguments.sizes, arguments.rounds, arguments.frames = "800", 2, 2
    arguments.sizes = [int(size) for size in arguments.sizes.split(",")]
    if unknown := set(arguments.sizes) - set(GRIDS):
        parser.error(f"no form of {unknown} triangles; there are {list(GRIDS)}")
    return arguments


def main() -> None:
    """Print a table a size, then the targets."""
    arguments = parse()
    entries: list[Entry] = [*OURS, FLOOR]
    pythons: dict[str | None, Path] = {None: Path(sys.executable)}
    if not arguments.no_peers:
        packages = list(dict.fromkeys(str(entry.package) for entry in PEERS))
        python, missing = make_environment(arguments.peers, packages)
        for package, reason in missing.items():
            print(f"{package} is left out, it could not be installed: {reason}")
        pythons.update(dict.fromkeys(packages, python))
        entries += [entry for entry in PEERS if entry.package not in missing]
        print("peers:", ", ".join(f"{name} {at}" for name, at in sorted(installed(python).items())))
    print(f"{SIDE_PX} x {SIDE_PX}, {os.cpu_count()} cores, Python {sys.version.split()[0]}, NumPy {np.__version__}\n")
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="mien-render-")))
        if arguments.pictures is not None:
            arguments.pictures.mkdir(parents=True, exist_ok=True)
        workers = start(stack, entries, pythons)
        results = {}
        for size in arguments.sizes:
            form = folder / f"{size}.npz"
            make_form(size).write(form)
            results[size] = race(workers, form, arguments.pictures, arguments.rounds, arguments.frames)
            print_table(f"{size:,} triangles, median of {arguments.rounds} rounds", results[size])
        print()
        for size, result in results.items():
            print_targets(size, result)


if __name__ == "__main__":
    main()
