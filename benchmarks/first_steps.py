"""Milliseconds of one start of ours, step by step: ``python benchmarks/first_steps.py``. Nothing is imported before."""

from __future__ import annotations

import time

STEPS = (  # what a step is called, and its program; later steps see the names of earlier ones
    ("import numpy", "import numpy"),
    (
        "import mien, its render and faces",
        "import mien.api, mien.render, mien.formats.picture; from mien.core import *",
    ),
    ("load the head", "face = mien.load_face('head')"),
    (
        "first pose to cage",
        "scene = mien.api.default_scene(); pose = fill_rows(face, Pose.neutral(face.parameters), scene)",
    ),
    ("- its shape", "cage = face.shape(pose)"),
    ("- its shape again", "cage = face.shape(pose)"),
    ("make a renderer", "renderer = mien.render.Renderer(scene, 1)"),
    ("first subdivision: matrices, code", "fine = renderer.refine(cage)"),
    ("- again", "fine = renderer.refine(cage)"),
    ("first picture: plan, code", "picture = renderer.draw_mesh(fine)"),
    ("- again", "picture = renderer.draw_mesh(fine)"),
    ("import Pillow", "import PIL.Image, PIL.PngImagePlugin"),
    ("PNG, level 6", "mien.Picture(picture).to_png()"),
    ("- level 1", "mien.Picture(picture).to_png(1)"),
)


def main() -> None:
    """Print the table."""
    names: dict[str, object] = {}
    print("\n| one start of ours, step by step | wall ms | CPU ms |\n|---|---|---|")
    for label, program in STEPS:
        start, work = time.perf_counter(), time.process_time()
        exec(program, names)
        wall, work = time.perf_counter() - start, time.process_time() - work
        print(f"| {label} | {1000.0 * wall:.1f} | {1000.0 * work:.1f} |")


if __name__ == "__main__":
    main()
