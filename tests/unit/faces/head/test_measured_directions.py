"""Measured fields on the skin: symmetric, still where they must be, and nothing turned inside out."""

from importlib.resources import files

import numpy as np
import pytest

from mien.faces.head.arrays import parse_arrays
from mien.faces.head.measured import archive

PLACE = files("mien.faces.head").joinpath("data/conformation.arrays")
ARRAYS = parse_arrays(PLACE.read_bytes())
MORPHS = [str(name) for name in ARRAYS["morph_names"]]
KINDS = ("cage", "surface")


def mirrored(field):
    return field[archive().mirror] * [-1.0, 1.0, 1.0]


def field(prefix, kind, number):
    return ARRAYS[prefix + kind][number].astype(np.float64)


def twin(name):
    return name[:-2] + {"_L": "_R", "_R": "_L"}[name[-2:]] if name[-2:] in ("_L", "_R") else name


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", MORPHS)
def test_morph_mirrors_its_twin(name, kind):
    own, other = (field("morph_", kind, MORPHS.index(each)) for each in (name, twin(name)))
    np.testing.assert_array_equal(own, mirrored(other))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", MORPHS)
def test_morph_moves_something_but_no_lid(name, kind):
    moves = np.linalg.norm(field("morph_", kind, MORPHS.index(name)), axis=1)
    assert 0.001 < moves.max() < 0.012
    assert not moves[archive().ints("lid_index")].any()


@pytest.mark.parametrize("name", [name for name in MORPHS if name.endswith("_L")])
def test_left_morph_ends_behind_the_midline(name):
    right = archive().floats("surface")[:, 0] < -0.0081
    assert not field("morph_", "surface", MORPHS.index(name))[right].any()


def test_file_is_small():
    assert len(PLACE.read_bytes()) <= 600_000
