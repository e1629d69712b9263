"""Heads drawn by the fast rasteriser and by the plain one: the same bytes, in any shading, however near."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mien.core import Mesh, Scene, fill_rows
from mien.faces.registry import load_face
from mien.render import Renderer

PORTRAIT = Scene(size_px=(96, 80), subdivide=0).seen("three-quarter")
NEAR = replace(PORTRAIT, position=(0.02, -0.02, 0.105), at=(0.0, -0.04, 0.0), fov_deg=80.0)
"""Two centimetres before the lips: the near plane cuts the nose, and the lashes fill the picture."""

CASES = {
    "smooth": ("head", PORTRAIT),
    "refined": ("head:ada", replace(PORTRAIT, size_px=(60, 60), subdivide=1)),
    "every pixel": ("head:ben", replace(PORTRAIT, shading="smooth+")),
    "polygons": ("head:ada", replace(PORTRAIT, shading="polygon")),
    "lines": ("head", replace(PORTRAIT, shading="wire", size_px=(40, 40)).seen("side")),
    "clear": ("head:ben", replace(PORTRAIT, background=((0.2, 0.1, 0.0, 0.3), (0.0, 0.0, 0.0, 0.0)))),
    "near": ("head", NEAR),
    "near, every pixel": ("head:ada", replace(NEAR, shading="smooth+")),
}


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_head_is_the_same_to_the_byte(case: str) -> None:
    address, scene = CASES[case]
    face = load_face(address)
    rng = np.random.default_rng(len(case))
    moved = rng.choice([row for row in face.parameters if "." in row.name and row.unit != "m"], 25, replace=False)
    values = {row.name: float(row.low + (row.high - row.low) * rng.random()) for row in moved}
    pose = fill_rows(face, face.neutral.replace({**values, "jaw.rotation": 9.0}), scene)
    shape = (face if scene.subdivide else face.unsubdivided).shape(pose)
    assert isinstance(shape, Mesh)
    pictures = []
    for rasteriser, threads in (("compiled", 3), ("reference", 1)):
        with Renderer(scene, threads, rasteriser=rasteriser) as renderer:  # type: ignore[arg-type]
            pictures.append(renderer.draw_mesh(renderer.refine(shape)))
    np.testing.assert_array_equal(*pictures)
    assert len(np.unique(pictures[0].reshape(-1, 4), axis=0)) > 150
