"""Milliseconds a frame of the head takes, stage by stage: ``python benchmarks/stages.py [FACE] [--size 1024]``.

Every number is the best of several frames, since whatever else a machine does only ever adds. The share is that of
the whole frame. Pictures of both numbers of threads are compared, byte by byte, on the way.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import numpy as np

from mien.compiling import on_compile
from mien.core import Mesh, Pose, Scene, fill_rows
from mien.faces.registry import load_face
from mien.render import Renderer


def best_ms(work: Callable[[], object], repeats: int) -> float:
    """Least milliseconds that some work takes."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times) * 1000.0


def measure(face_name: str, size: int, threads: int, samples: int, repeats: int) -> tuple[dict[str, float], bytes]:
    """Milliseconds by stage, and the picture."""
    face = load_face(face_name)
    scene = Scene(size_px=(size, size)).seen("three-quarter")
    pose = fill_rows(face, Pose.neutral(face.parameters), scene)
    coarse = face.shape(pose)
    if not isinstance(coarse, Mesh):
        raise SystemExit(f"{face_name} is no mesh")
    with Renderer(scene, threads, samples=samples) as renderer:
        picture = renderer.draw(face, pose)
        fine = renderer.refine(coarse)
        stages = {
            "shape": best_ms(lambda: face.shape(pose), repeats),
            "subdivision": best_ms(lambda: renderer.refine(coarse), repeats),
            "light and raster": best_ms(lambda: renderer.draw_mesh(fine), repeats),
            "frame": best_ms(lambda: renderer.draw(face, pose), repeats),
        }
    return stages, picture.tobytes()


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("face", nargs="?", default="head")
    parser.add_argument("--size", type=int, default=1024)
    parser.add_argument("--repeats", type=int, default=20)
    arguments = parser.parse_args()
    on_compile(print)
    for samples in (1, 4):
        columns, pictures = [], []
        for threads in (1, 2):
            stages, picture = measure(arguments.face, arguments.size, threads, samples, arguments.repeats)
            columns.append(stages)
            pictures.append(picture)
        same = "the same" if len(set(pictures)) == 1 else "NOT THE SAME"
        print(f"\n{arguments.face}, {arguments.size} x {arguments.size}, {samples} samples a pixel")
        print(f"{'':17s}{'1 thread':>10s}{'share':>7s}{'2 threads':>12s}{'share':>7s}   pictures are {same}")
        for stage in columns[0]:
            cells = [f"{c[stage]:9.1f} ms{c[stage] / c['frame']:6.0%}" for c in columns]
            print(f"{stage:16s}{cells[0]} {cells[1]}")
    print(f"\nNumPy {np.__version__}")


if __name__ == "__main__":
    main()
