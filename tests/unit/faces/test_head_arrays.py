"""The file of arrays: back as they went in, each where numbers of eight bytes may begin."""

from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as more

from mien.faces.head.arrays import format_arrays, parse_arrays
from mien.faces.head.measured import archive

KINDS = st.sampled_from(["float64", "float32", "float16", "int16", "uint8", "bool", "<U5"])


@given(st.dictionaries(st.text(max_size=9), more.arrays(KINDS, more.array_shapes(min_dims=0, max_side=4, min_side=0))))
def test_arrays_come_back_as_they_went_in(arrays):
    data = format_arrays(arrays)
    back = parse_arrays(data)
    assert list(back) == list(arrays)
    for name, array in arrays.items():
        assert (back[name].dtype, back[name].shape) == (array.dtype, array.shape)
        assert back[name].tobytes() == array.tobytes()
        assert back[name].ctypes.data % 8 == back[next(iter(back))].ctypes.data % 8
        assert not back[name].flags.writeable


def test_the_file_that_ships_is_written_as_it_is_read():
    assert parse_arrays(format_arrays(archive().arrays)).keys() == archive().arrays.keys()
    assert archive().arrays["morph_cage"].shape == (44, 1026, 3)
