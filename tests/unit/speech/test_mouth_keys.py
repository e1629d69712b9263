import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.speech.mouth_keys import reduce_keys

CURVES = st.lists(st.floats(0.0, 1.0), min_size=2, max_size=200)


@settings(deadline=None, max_examples=60)
@given(CURVES)
def test_kept_samples_pass_all_others_within_the_tolerance(values: list[float]) -> None:
    curve, times = np.array(values), np.linspace(0.0, 1.0, len(values))
    kept = reduce_keys(times, curve, tolerance=0.01)
    assert (kept[0], kept[-1]) == (0, len(values) - 1)
    assert np.max(np.abs(np.interp(times, times[kept], curve[kept]) - curve)) <= 0.01 + 1e-12


def test_straight_line_needs_two_keys() -> None:
    times = np.arange(100.0)
    assert list(reduce_keys(times, 0.25 * times)) == [0, 99]


def test_plateau_keeps_its_corners() -> None:
    curve = np.clip(np.minimum(np.arange(50.0), 49.0 - np.arange(50.0)) / 10.0, 0.0, 1.0)
    assert list(reduce_keys(np.arange(50.0), curve)) == [0, 10, 39, 49]


def test_wanted_samples_are_kept() -> None:
    keep = np.zeros(10, dtype=bool)
    keep[3] = True
    assert 3 in reduce_keys(np.arange(10.0), np.zeros(10), keep=keep)
