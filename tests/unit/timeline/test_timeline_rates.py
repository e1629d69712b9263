"""Rates as fractions: the times of frames are those of the film, for as long as it lasts."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import LoadError, RangeError
from mien.timeline import Timeline, exact_rate, format_csv, parse_csv, parse_specifications


@pytest.mark.parametrize(
    ("fps", "rate"),
    [
        (24, Fraction(24)),
        (23.976, Fraction(24000, 1001)),
        (23.98, Fraction(24000, 1001)),
        (29.97, Fraction(30000, 1001)),
        (59.94, Fraction(60000, 1001)),
        (119.88, Fraction(120000, 1001)),
        (24000 / 1001, Fraction(24000, 1001)),
        (Fraction(30000, 1001), Fraction(30000, 1001)),
        (Fraction(2997, 100), Fraction(2997, 100)),
        (12.5, Fraction(25, 2)),
        (100 / 3, Fraction(100, 3)),
        (0.1, Fraction(1, 10)),
    ],
)
def test_what_people_write_means_the_exact_rate(fps: float | Fraction, rate: Fraction) -> None:
    assert exact_rate(fps) == rate


@pytest.mark.parametrize("fps", [0, -24, math.nan, math.inf, 1e-9, Fraction(0), Fraction(-1, 2)])
def test_what_is_no_rate_is_refused(fps: float | Fraction) -> None:
    with pytest.raises(RangeError, match="finite number above"):
        exact_rate(fps)


@settings(deadline=None, max_examples=50)
@given(fps=st.floats(1.0, 240.0))
def test_a_rate_is_near_what_was_asked_for_and_stays_itself(fps: float) -> None:
    rate = exact_rate(fps)
    assert abs(float(rate) - fps) <= 0.005
    assert exact_rate(float(rate)) == rate


def test_frame_times_are_exact_over_half_an_hour() -> None:
    timeline = Timeline((), 1800.0)
    times = timeline.frame_times(23.976)
    assert len(times) == math.ceil(1800 * 24000 / 1001)
    for frame in (1, 7, 1000, 30001, len(times) - 1):
        assert times[frame] == float(Fraction(frame * 1001, 24000))


def test_tables_and_lists_count_in_the_same_frames() -> None:
    text = "fps 29.97\nlength 30\njaw.rotation 0 29 0 29 linear\n"
    timeline = parse_specifications(text).to_timeline()
    times = timeline.frame_times(29.97)
    assert len(times) == 30
    track = timeline.layers[0].tracks["jaw.rotation"]
    assert track.evaluate(times)[0].tolist() == pytest.approx(list(range(30)), abs=1e-12)
    table = parse_csv("frame,a\n0,0\n29,29\n", fps=29.97)
    assert (table.length_s, table.fps) == (pytest.approx(58 * 1001 / 30000), 30000 / 1001)
    assert table.layers[0].tracks["a"].keys()[0].tolist() == [0.0, times[29]]


def test_a_table_is_written_at_the_exact_times() -> None:
    from mien.core import Parameter, ParameterTable

    lines = list(format_csv(Timeline((), 1.0), ParameterTable((Parameter("a", 0, 1),)), 23.976))
    assert [float(line) for line in lines[1:]] == Timeline((), 1.0).frame_times(23.976).tolist()


def test_a_list_at_a_rate_that_is_none_is_refused_at_its_line() -> None:
    with pytest.raises(LoadError, match=r"x\.spec:1: .*rate of 1e-09"):
        parse_specifications("fps 1e-9\njaw 0 1 0 1 linear\n", "x.spec")
