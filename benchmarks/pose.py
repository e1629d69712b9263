"""Milliseconds from pose to mesh, of many poses at once, and of the first one: ``python benchmarks/pose.py [FACE]``.

Everything runs on one thread, in the processor time of that thread, so that what else a machine does adds little; all
rows are measured in turns, round after round, and the median round is given. Loading is the wall time of a fresh
process, with compiled code in its cache.
"""

# ruff: noqa: E402
from __future__ import annotations

import os

for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ[f"{library}_NUM_THREADS"] = "1"  # read when NumPy is imported

import argparse
import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mien.core import Cue, Face, Mesh, Pose, Scene, Sound
from mien.faces import load_face, shapes
from mien.perform import perform
from mien.render import Renderer, lighting, refining
from mien.render.plan import plan_shading
from mien.speech import Speech

SENTENCE = "SIL HH AH0 L OW1 SIL HH AW1 HH AE1 P IY0 IH0 Z DH AH0 F AO1 R M SIL"

COLD = """
import json, sys, time
import numpy
marks = [time.perf_counter()]
def mark(): marks.append(time.perf_counter())
from mien.faces import load_face; mark()
face = load_face(sys.argv[1]); mark()
mesh = face.shape(face.neutral); mark()
from mien.core.subdivision import refine
first = refine(mesh.topology); mark()
refine(first.topology); mark()
print(json.dumps([1000.0 * (b - a) for a, b in zip(marks, marks[1:])]))
"""
COLD_ROWS = ("import, after NumPy", "load the face", "first shape", "first matrix, level 1", "first matrix, level 2")

Normals = Callable[[Mesh], np.ndarray]


def random_poses(face: Face, count: int) -> list[Pose]:
    """Poses in which everything but the palette moves."""
    table, generator = face.parameters, np.random.default_rng(1)
    moving = np.array([row.group != "color" for row in table])
    share = generator.random((count, len(table)))
    values = np.where(moving, table.lows * (1.0 - share) + table.highs * share, table.defaults)
    return [Pose(table, row) for row in values]


def spoken_poses(face: Face, count: int) -> list[Pose]:
    """Poses of a sentence at 24 frames a second."""
    symbols = SENTENCE.split() * (1 + count // 45)
    phones = tuple(Cue(0.09 * k, 0.09 * (k + 1), symbol) for k, symbol in enumerate(symbols))
    timeline = perform(Speech("", Sound.silence(phones[-1].end_s), (), phones, (), "none"), face, seed=1).timeline
    values = timeline.values(timeline.frame_times(24), face.parameters)[:count]
    return [Pose(face.parameters, row) for row in values]


def make_normals(mesh: Mesh) -> Normals:
    """A function that gives the vertex normals (V, 3) of meshes like this one, by the renderer's compiled code."""
    topology, plan = mesh.topology, plan_shading(mesh.topology, False)
    count, total = topology.polygon_count, plan.normal_sum
    polygons, facing, viewer = np.empty((count, 3)), np.empty(count, dtype=np.bool_), np.array([0.0, 0.0, 1.0, 1.0])

    def normals(mesh: Mesh) -> np.ndarray:
        lighting.sum_normals(mesh.points, topology.corners, topology.starts, 0, count, polygons, facing, viewer)
        out = np.empty((total.shape[0], 3))
        refining.multiply_rows(*total.mixed, polygons, 0, len(total.mixed[0]), out)
        return out

    return normals


def measure(works: dict[str, tuple[Callable[[], object], int]], rounds: int) -> dict[str, float]:
    """Milliseconds of the processor for one of the things that each work does as many of as its number says."""
    times: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(rounds):
        for name, (work, count) in works.items():
            start = time.thread_time()
            work()
            times[name].append((time.thread_time() - start) * 1000.0 / count)
    return {name: statistics.median(row) for name, row in times.items()}


def each(work: Callable[[Pose], object], poses: list[Pose]) -> tuple[Callable[[], object], int]:
    """Work on one pose after the other, forgetting what comes of it."""

    def run() -> None:
        for pose in poses:
            work(pose)

    return run, len(poses)


def frames(face: Face, rounds: int) -> dict[str, float]:
    """The rows of single poses."""
    works = {}
    with Renderer(replace(Scene(), subdivide=1)) as renderer:
        first = face.shape(face.neutral)
        if not isinstance(first, Mesh):
            raise SystemExit(f"{face.name} is no mesh")
        normals = make_normals(renderer.refine(first))
        for kind, poses in (("random", random_poses(face, 100)), ("spoken", spoken_poses(face, 100))):
            works[f"{kind}: pose to cage"] = each(face.shape, poses)
            works[f"{kind}: level 1"] = each(lambda pose: renderer.refine(face.shape(pose)), poses)
            works[f"{kind}: level 1, normals"] = each(lambda pose: normals(renderer.refine(face.shape(pose))), poses)
        return measure(works, rounds)


def batches(face: Face, count: int, threads: int) -> tuple[float, float]:
    """Seconds of wall time for many random poses, one by one and as a batch."""
    poses = random_poses(face, count)
    values = np.stack([pose.values for pose in poses])
    for _ in range(2):  # the first time is for the memory that is got from the system
        start = time.perf_counter()
        for pose in poses:
            face.shape(pose)
        middle = time.perf_counter()
        shapes(face, values, threads)
        end = time.perf_counter()
    return middle - start, end - middle


def cold(face_name: str, rounds: int) -> list[float]:
    """Milliseconds of ``COLD_ROWS``."""
    command = [sys.executable, "-c", COLD, face_name]
    runs = [json.loads(subprocess.run(command, capture_output=True, check=True).stdout) for _ in range(rounds + 1)]
    return [statistics.median(column) for column in zip(*runs[1:], strict=True)]


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("face", nargs="?", default="head")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--poses", type=int, default=10_000)
    parser.add_argument("--threads", type=int, default=2, help="of the batch")
    arguments = parser.parse_args()
    face = load_face(arguments.face)
    print(f"{face.name}, one thread, ms a frame")
    for name, value in frames(face, arguments.rounds).items():
        print(f"  {name:26s}{value:8.3f}")
    for threads in sorted({1, arguments.threads}):
        single, many = batches(face, arguments.poses, threads)
        print(f"{arguments.poses} random poses: {single:.2f} s one by one, {many:.2f} s at once", end=" ")
        print(f"on {threads} thread{'s' * (threads > 1)}: {single / many:.1f} times as fast")
    print("a fresh process, ms")
    rows = cold(arguments.face, arguments.rounds)
    for name, value in zip(COLD_ROWS, rows, strict=True):
        print(f"  {name:26s}{value:8.1f}")
    print(f"NumPy {np.__version__}")


if __name__ == "__main__":
    main()
