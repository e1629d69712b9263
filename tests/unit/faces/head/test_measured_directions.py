"""Measured fields on the skin: symmetric, still where they must be, and nothing turned inside out."""

from functools import cache
from importlib.resources import files
from itertools import combinations

import numpy as np
import pytest

from mien.core import Material, build_topology
from mien.core.subdivision import refine
from mien.faces.head.arrays import parse_arrays
from mien.faces.head.measured import archive

PLACE = files("mien.faces.head").joinpath("data/conformation.arrays")
ARRAYS = parse_arrays(PLACE.read_bytes())
DIRECTIONS = [str(name) for name in ARRAYS["names"]]
MORPHS = [str(name) for name in ARRAYS["morph_names"]]
ENDS = [
    (number, end) for number, name in enumerate(DIRECTIONS) for end in (-1.0, 1.0) if (name, end) != ("face.age", -1.0)
]
KINDS = ("cage", "surface")
HIDDEN = ("nostril", "mouth")
"""Groups of polygons inside of nose and mouth."""


def mirrored(field):
    return field[archive().mirror] * [-1.0, 1.0, 1.0]


def field(prefix, kind, number):
    return ARRAYS[prefix + kind][number].astype(np.float64)


def twin(name):
    for left, right in (("_L", "_R"), (".left", ".right")):
        if name.endswith((left, right)):
            return name.removesuffix(left) + right if name.endswith(left) else name.removesuffix(right) + left
    return name


@cache
def refined():
    """One step of subdivision: its matrix, its polygons that are seen, and their normals at rest."""
    fine = refine(build_topology(len(archive().mirror), [("skin", archive().quads, Material(subdivide=True))]))
    hidden = np.isin(archive().groups, [archive().group_names.index(name) for name in HIDDEN])
    quads = fine.topology.corners.reshape(-1, 4)[~hidden[fine.polygon_parent]]
    return fine.matrix, quads, normals(fine.matrix.apply(archive().floats("cage")), quads)


def normals(points, quads):
    a, b, c, d = points[quads].swapaxes(0, 1)
    normal = np.cross(c - a, d - b)
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def least_turn(move):
    """The smallest cosine by which a polygon of the subdivided head turns when its cage is moved."""
    matrix, quads, rest = refined()
    return (normals(matrix.apply(archive().floats("cage") + move), quads) * rest).sum(axis=1).min()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("prefix", "names", "name"),
    [("", DIRECTIONS, name) for name in DIRECTIONS] + [("morph_", MORPHS, name) for name in MORPHS],
)
def test_field_mirrors_its_twin(prefix, names, name, kind):
    own, other = (field(prefix, kind, names.index(each)) for each in (name, twin(name)))
    np.testing.assert_array_equal(own, mirrored(other))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("prefix", ["", "morph_"])
def test_no_lid_moves(prefix, kind):
    assert not ARRAYS[prefix + kind][:, archive().ints("lid_index")].any()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", DIRECTIONS)
def test_nothing_moves_outside_the_region(name, kind):
    region = ARRAYS["region"][DIRECTIONS.index(name)]
    assert region.min() == 0.0
    assert 0.3 < region.max() <= 1.0
    assert not field("", kind, DIRECTIONS.index(name))[region == 0.0].any()


@pytest.mark.parametrize("name", DIRECTIONS)
def test_end_is_the_largest_displacement(name):
    number = DIRECTIONS.index(name)
    moves_mm = 1000.0 * np.linalg.norm(field("", "surface", number), axis=1)
    assert moves_mm.max() == pytest.approx(ARRAYS["end_mm"][number], rel=2e-3)
    assert ARRAYS["sd_mm"][number] > 0.3


@pytest.mark.parametrize("name", [name for name in DIRECTIONS if not name.endswith(".right")])
def test_subdivided_cage_moves_as_the_surface(name):
    number = DIRECTIONS.index(name)
    matrix, _, _ = refined()
    limit = matrix.apply(matrix.apply(field("", "cage", number))[: len(archive().mirror)])[: len(archive().mirror)]
    miss_mm = 1000.0 * np.linalg.norm(limit - field("", "surface", number), axis=1)
    assert np.sqrt((miss_mm**2).mean()) < 0.05 * ARRAYS["end_mm"][number]


@pytest.mark.parametrize("name", [name for name in MORPHS if name.endswith("_L")])
def test_left_morph_ends_behind_the_midline(name):
    right = archive().floats("surface")[:, 0] < -0.0081
    assert not field("morph_", "surface", MORPHS.index(name))[right].any()


@pytest.mark.parametrize("name", [name for name in DIRECTIONS if name.endswith(".left")])
def test_left_direction_ends_behind_the_midline(name):
    right = archive().floats("surface")[:, 0] < -0.0081
    assert not field("", "surface", DIRECTIONS.index(name))[right].any()


@pytest.mark.parametrize("name", ["lip.upper.thickness", "lip.lower.thickness", "lip.shape"])
def test_the_line_where_the_lips_meet_stays(name):
    contact = archive().ring("m0", 10)
    assert not field("", "surface", DIRECTIONS.index(name))[contact].any()


@pytest.mark.parametrize(("number", "end"), ENDS, ids=[f"{DIRECTIONS[number]} {end:+.0f}" for number, end in ENDS])
def test_no_polygon_turns_far_at_an_end(number, end):
    assert least_turn(end * field("", "cage", number)) > 0.25


def test_no_polygon_is_turned_inside_out_by_two_ends_together():
    moves = {(number, end): end * field("", "cage", number) for number, end in ENDS}
    for one, other in combinations(moves, 2):
        if one[0] != other[0]:
            assert least_turn(moves[one] + moves[other]) > 0.0, (
                DIRECTIONS[one[0]],
                one[1],
                DIRECTIONS[other[0]],
                other[1],
            )


@pytest.mark.parametrize("name", MORPHS)
def test_morph_is_seen_and_turns_nothing_inside_out(name):
    number = MORPHS.index(name)
    assert 0.001 < np.linalg.norm(field("morph_", "surface", number), axis=1).max() < 0.012
    assert least_turn(field("morph_", "cage", number)) > 0.0


def test_file_is_small():
    assert len(PLACE.read_bytes()) <= 600_000
