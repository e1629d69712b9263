"""Milliseconds a frame of the head takes, stage by stage: ``python benchmarks/stages.py [FACE] [--size 1024]``.

Every number is the best of several frames, since whatever else a machine does only ever adds. The share is that of
the whole frame. Pictures of both numbers of threads are compared, byte by byte, on the way.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import numpy as np

from mien.core import Mesh, Pose, Scene, exact, fill_rows, subdivide
from mien.faces.registry import load_face
from mien.render import Renderer, warmup
from mien.render.camera import Camera
from mien.render.plan import plan_shading
from mien.render.triangles import make_triangles


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
    fine = subdivide(coarse, scene.subdivide)
    points = exact.round_points(fine.points)
    plan = plan_shading(fine.topology, False)
    camera = Camera.of(scene, 2 if samples == 4 else 1)
    with Renderer(scene, threads, samples=samples) as renderer:
        triangles = make_triangles(fine, scene, camera, renderer._light, renderer._place)
        stages = {
            "shape": best_ms(lambda: face.shape(pose), repeats),
            "subdivision": best_ms(lambda: renderer.refine(coarse), repeats),
            "light": best_ms(lambda: renderer._light(fine, points, plan, scene), repeats),
            "view, clip": best_ms(
                lambda: make_triangles(fine, scene, camera, renderer._light, renderer._place), repeats
            ),
            "raster, pixels": best_ms(lambda: renderer._rasterise(triangles), repeats),
            "frame": best_ms(lambda: renderer.draw(face, pose), repeats),
        }
        stages["view, clip"] -= stages["light"]
        return stages, renderer.draw(face, pose).tobytes()


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("face", nargs="?", default="head")
    parser.add_argument("--size", type=int, default=1024)
    parser.add_argument("--repeats", type=int, default=20)
    arguments = parser.parse_args()
    print(f"first use: {warmup(print):.2f} s; again: {warmup() * 1000:.1f} ms")
    for samples in (1, 4):
        columns, pictures = [], []
        for threads in (1, 2):
            stages, picture = measure(arguments.face, arguments.size, threads, samples, arguments.repeats)
            columns.append(stages)
            pictures.append(picture)
        same = "the same" if len(set(pictures)) == 1 else "NOT THE SAME"
        print(f"\n{arguments.face}, {arguments.size} x {arguments.size}, {samples} samples a pixel")
        print(f"{'':16s}{'1 thread':>10s}{'share':>7s}{'2 threads':>12s}{'share':>7s}   pictures are {same}")
        for stage in columns[0]:
            cells = [f"{c[stage]:9.1f} ms{c[stage] / c['frame']:6.0%}" for c in columns]
            print(f"{stage:15s}{cells[0]} {cells[1]}")
    print(f"\nNumPy {np.__version__}")


if __name__ == "__main__":
    main()
