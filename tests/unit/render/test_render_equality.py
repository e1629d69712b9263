"""The fast rasteriser against the plain one: the same bytes, whatever is drawn."""

from __future__ import annotations

import numpy as np
import pytest

from mien.core import Light, Material, Mesh, Scene, build_topology
from mien.render import Renderer, draw_mesh


def random_mesh(rng: np.random.Generator) -> Mesh:
    """Triangles, quads and pentagons of all sizes, some right through the viewer's near plane."""
    count = int(rng.integers(4, 40))
    vertices = int(rng.integers(6, 60))
    spread = float(rng.choice([0.05, 0.3, 3.0]))
    parts = []
    for number in range(int(rng.integers(1, 4))):
        corners = rng.integers(3, min(6, vertices))
        polygons = np.array([rng.choice(vertices, corners, replace=False) for _ in range(count)])
        material = Material(
            gloss=float(rng.choice([0.0, 0.4])),
            gloss_power=int(rng.integers(1, 40)),
            two_sided=bool(rng.random() < 0.6),
            lit=bool(rng.random() < 0.8),
            flat=bool(rng.random() < 0.3),
        )
        parts.append((f"part{number}", polygons, material))
    topology = build_topology(vertices, parts)
    points = rng.normal(0.0, spread, (vertices, 3))
    colors = rng.random((topology.polygon_count if rng.random() < 0.4 else vertices, 3))
    return Mesh(topology, points, colors)


def random_scene(rng: np.random.Generator) -> Scene:
    ends = [tuple(float(x) for x in rng.random(4)) for _ in range(2)]
    lights = tuple(
        Light(tuple(rng.normal(0.0, 2.0, 3).tolist()), tuple(rng.random(3).tolist()), float(rng.random()))
        for _ in range(int(rng.integers(0, 3)))
    )
    return Scene(
        position=tuple(rng.normal(0.0, 0.7, 3).tolist()),
        at=tuple(rng.normal(0.0, 0.1, 3).tolist()),
        fov_deg=float(rng.uniform(5.0, 120.0)),
        size_px=(int(rng.integers(1, 70)), int(rng.integers(1, 70))),
        background=((*ends[0][:3], float(rng.choice([0.0, 0.5, 1.0]))), (*ends[1][:3], float(rng.choice([0.0, 1.0])))),
        lights=lights,
        cosine_power=int(rng.integers(1, 5)),
        shading=str(rng.choice(["smooth", "smooth+", "polygon", "wire"], p=[0.5, 0.2, 0.15, 0.15])),  # type: ignore[arg-type]
        subdivide=0,
    )


@pytest.mark.parametrize("block", range(10))
def test_compiled_picture_equals_the_reference_on_random_scenes(block: int) -> None:
    drawn = 0
    for seed in range(24 * block, 24 * block + 24):
        rng = np.random.default_rng(seed)
        mesh, scene = random_mesh(rng), random_scene(rng)
        samples = int(rng.choice([1, 4]))
        plain = draw_mesh(mesh, scene, samples=samples, rasteriser="reference")
        fast = draw_mesh(mesh, scene, samples=samples, threads=int(rng.integers(1, 4)))
        np.testing.assert_array_equal(fast, plain, err_msg=f"seed {seed}")
        drawn += len(np.unique(plain.reshape(-1, 4), axis=0)) > scene.size_px[1]
    assert drawn > 8, "most of these scenes must show something"


def test_picture_does_not_depend_on_the_number_of_threads() -> None:
    rng = np.random.default_rng(5)
    mesh, scene = random_mesh(rng), Scene(size_px=(150, 130), fov_deg=60.0)
    pictures = []
    for threads in (1, 2, 5):
        with Renderer(scene, threads) as renderer:
            renderer.draw_mesh(mesh)
            pictures.append(renderer.draw_mesh(mesh).tobytes())
    assert len(set(pictures)) == 1
