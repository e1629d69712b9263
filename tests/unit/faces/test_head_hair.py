"""Hair: what its shells must be, whatever the style."""

from importlib.resources import files
from itertools import combinations

import numpy as np
import pytest

from mien.core import UnknownNameError
from mien.faces.head.hair import hair, hair_styles
from mien.faces.head.head import Head
from mien.faces.head.measured import archive

STYLES = [style for style in hair_styles() if style != "bald"]
SIZE_PX = 48


def triangles(points, quads):
    return points[np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])]


def silhouette(style: str) -> np.ndarray:
    """Pixels that the middles of finely split polygons of skin and hair cover, from the front and from the left."""
    shell = hair(style)
    a, b, c, d = (shell.points[shell.quads[:, k]] for k in range(4))
    t = np.linspace(0.0, 1.0, 7)
    u, v = (grid.ravel()[:, None, None] for grid in np.meshgrid(t, t))
    dense = ((a * (1 - u) + b * u) * (1 - v) + (d * (1 - u) + c * u) * v).reshape(-1, 3)
    out = np.zeros((2, SIZE_PX, SIZE_PX), dtype=bool)
    for view, axis in enumerate((0, 2)):
        place = np.clip(((dense[:, [axis, 1]] + [0.16, 0.18]) / 0.35 * SIZE_PX).astype(int), 0, SIZE_PX - 1)
        out[view, place[:, 0], place[:, 1]] = True
    return out


def boundary(quads: np.ndarray) -> np.ndarray:
    """(E,) vertices on edges that belong to one polygon only."""
    edges = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    _, first, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    assert count.max() == 2
    return np.unique(edges[first[count == 1]])


def depth(points: np.ndarray, solid: np.ndarray) -> np.ndarray:
    """(N,) how often a ray straight down from each point meets the triangles (T, 3, 3)."""
    a, b, c = solid[:, 0], solid[:, 1], solid[:, 2]

    def side(p, q, r):
        return (q[:, 0] - p[:, 0]) * (r[2] - p[:, 2]) - (q[:, 2] - p[:, 2]) * (r[0] - p[:, 0])

    out = []
    for point in points + np.array([1e-6, 0.0, 1e-6]):
        w = np.stack([side(b, c, point), side(c, a, point), side(a, b, point)])
        over = (w > 0).all(axis=0) | (w < 0).all(axis=0)
        height = (w[:, over] * np.stack([a, b, c])[:, over, 1]).sum(axis=0) / w[:, over].sum(axis=0)
        out.append(int((height > point[1]).sum()))
    return np.array(out)


def test_there_are_twelve_styles_besides_bald_and_an_unknown_one_is_an_error():
    assert {"crop", "side_part", "bob", "updo", "afro", "bonnet", "long", "curls", "ring"} <= set(STYLES)
    assert hair_styles()[0] == "bald"
    assert len(hair("bald").points) == 0
    with pytest.raises(UnknownNameError, match="bob"):
        hair("bobb")


def test_hair_stays_small():
    assert files("mien.faces.head").joinpath("data/hair.arrays").stat().st_size <= 500_000
    assert max(len(hair(style).points) for style in STYLES) < 3500


@pytest.mark.parametrize("style", STYLES)
def test_every_rim_ends_inside_the_head(style):
    """An odd number of layers above a vertex: it lies within the closed skin, which hair cannot leave free."""
    shell, skin = hair(style), archive()
    rim = shell.points[boundary(shell.quads)]
    face = triangles(skin.floats("surface"), skin.quads)
    near = np.sqrt(((rim[:, None] - skin.floats("surface")[None]) ** 2).sum(axis=2)).min(axis=1)
    covered = depth(rim, np.concatenate([face, triangles(shell.points, shell.quads)])) > 0
    assert (covered | (near < 0.012)).all()


@pytest.mark.parametrize("style", STYLES)
def test_polygons_face_outwards_and_neighbours_agree(style):
    shell = hair(style)
    directed = np.concatenate([shell.quads[:, [k, (k + 1) % 4]] for k in range(4)])
    assert len(np.unique(directed, axis=0)) == len(directed)
    a, b, c, d = (shell.points[shell.quads[:, k]] for k in range(4))
    normal, middle = np.cross(c - a, d - b), 0.25 * (a + b + c + d)
    top = middle[:, 1] > 0.08
    if style != "ring":
        assert (normal[top, 1] > 0).mean() > 0.8
    assert (np.linalg.norm(normal, axis=1) > 0).all()


def test_silhouettes_differ():
    shapes = {style: silhouette(style) for style in STYLES}
    for one, other in combinations(STYLES, 2):
        both, either = (shapes[one] & shapes[other]).sum(), (shapes[one] | shapes[other]).sum()
        assert both / either < 0.97, (one, other)


@pytest.mark.parametrize("style", STYLES)
def test_no_skull_shows_through(style):
    """From the back and the top, nothing of the crown lies farther out than the hair."""
    if style == "ring":
        return
    shell, skull = hair(style), archive().floats("surface")
    crown = skull[(skull[:, 1] > 0.07) & (skull[:, 2] < 0.02)]
    middle = np.array([0.0, 0.03, 0.0])

    def ways(points):
        size = np.linalg.norm(points - middle, axis=1)
        return (points - middle) / size[:, None], size

    way, size = ways(crown)
    over, far = ways(shell.points)
    near = np.argsort(-(way @ over.T), axis=1)[:, :6]
    assert (far[near].max(axis=1) > size + 0.001).all()


def test_hair_has_no_twin_in_the_mirror():
    head = Head(hair="bob")
    run = head._layout.span["hair"]
    assert (head.mirror_vertices[run] == -1).all()
