import math

import numpy as np
import pytest

from mien.core import MienError, UnknownNameError
from mien.timeline import Segment, Track


def values(track, *times):
    return track.evaluate(times)[0].tolist()


def covered(track, *times):
    return track.evaluate(times)[1].tolist()


def test_parkes_formula_at_hand_computed_frames():
    # jaw.rotation from 2 at frame 10 to 10 at frame 14: DIFF = 8, FF = 0, 1/4, 1/2, 3/4, 1
    track = Track.from_segments([Segment(10, 14, 2, 10, "cosine")])
    root = math.sqrt(0.5)
    assert values(track, 10, 11, 12, 13, 14) == pytest.approx([2, 2 + 4 * (1 - root), 6, 2 + 4 * (1 + root), 10])


def test_nothing_before_the_first_key_and_the_last_value_after():
    track = Track.from_keys([1, 2], [3, 5])
    assert math.isnan(values(track, 0.999)[0])
    assert values(track, 1, 1.5, 2, 100) == [3, 4, 5, 5]
    assert covered(track, 0.999, 1, 1.5, 2, 2.001) == [False, True, True, True, False]
    assert (track.first_s, track.length_s) == (1.0, 2.0)


def test_gaps_hold_the_last_value():
    track = Track.from_segments([Segment(0, 4, 0, 1), Segment(10, 12, 5, 6)])
    assert values(track, 4, 7, 9.999, 10) == [1, 1, 1, 5]
    assert covered(track, 4, 7, 10) == [True, False, True]


def test_later_segment_wins_where_both_cover_whatever_their_order_in_time():
    early, late = Segment(0, 8, 0, 8), Segment(8, 12, 20, 24)
    assert values(Track.from_segments([early, late]), 7, 8, 9) == [7, 20, 21]
    assert values(Track.from_segments([late, early]), 7, 8, 9) == [7, 8, 21]


def test_rest_of_an_overlapped_segment_keeps_the_curve_of_the_whole():
    track = Track.from_segments([Segment(0, 10, 0, 10), Segment(4, 6, 50, 50)])
    assert values(track, 3, 4, 5, 6, np.nextafter(6, 7), 7, 10, 11) == pytest.approx([3, 50, 50, 50, 6, 7, 10, 10])


def test_hold_follows_the_segment_seen_last_not_the_one_that_ends_last_in_the_list():
    track = Track.from_segments([Segment(0, 10, 0, 10), Segment(8, 12, 1, 2), Segment(2, 3, 7, 7)])
    assert values(track, 2.5, 5, 11, 40) == pytest.approx([7, 5, 1.75, 2])


def test_segment_without_length_sets_one_moment():
    track = Track.from_segments([Segment(0, 10, 0, 10), Segment(5, 5, 1, 9)])
    assert values(track, 4, 5, 6) == [4, 9, 6]
    assert values(Track.from_keys([2], [9]), 2, 3) == [9, 9]


def test_two_keys_at_one_time_are_a_jump():
    track = Track.from_keys([0, 1, 1, 2], [0, 1, 5, 6])
    assert values(track, 0.5, 1, 1.5, 2) == [0.5, 5, 5.5, 6]
    assert values(Track.from_keys([0, 1, 1], [0, 1, 5]), 1, 3) == [5, 5]


def test_ends_of_a_change_are_exact_whatever_the_rounding():
    track = Track.from_keys([0.1, 0.3, 0.7], [0.1, 0.7, 1e-17], "ease-out")
    assert values(track, 0.1, 0.3, 0.7, 9) == [0.1, 0.7, 1e-17, 1e-17]


def test_every_way_between_keys_can_have_its_own_change_function():
    track = Track.from_keys([0, 3, 6], [0, 4, 0], ["cosine", "linear"])
    assert values(track, 1, 4.5) == pytest.approx([1, 2])


def test_keys_come_back_and_segments_that_are_no_keys_do_not():
    times, numbers = Track.from_keys([0, 1, 1, 2], [0, 1, 5, 6]).keys()
    assert (times.tolist(), numbers.tolist()) == ([0, 1, 1, 2], [0, 1, 5, 6])
    times, numbers = Track.from_keys([3], [4]).keys()
    assert (times.tolist(), numbers.tolist()) == ([3], [4])
    assert Track.from_segments([Segment(0, 1, 0, 1), Segment(2, 3, 1, 1)]).keys() is None


def test_given_values_are_the_ends_sorted_by_time():
    track = Track.from_segments([Segment(5, 6, 1, 2), Segment(0, 5, 0, 1)])
    times, numbers = track.given()
    assert (times.tolist(), numbers.tolist()) == ([0, 5, 6], [0, 1, 2])


def test_read_only_times_are_shared_and_others_copied():
    times = np.arange(4.0)
    track = Track.from_keys(times, times)
    times[:] = 99
    assert values(track, 2) == [2]
    times = np.arange(4.0)
    times.flags.writeable = False
    one, two = Track.from_keys(times, [0, 1, 2, 3]), Track.from_keys(times, [3, 2, 1, 0])
    assert np.shares_memory(one.start_s, two.end_s)


def test_millions_of_keys_cost_two_arrays_and_a_search():
    times = np.arange(2_000_000) * 0.01
    track = Track.from_keys(times, times * 0.5)
    assert np.shares_memory(track.start_s, track.end_s)
    assert track.change.strides == (0,)
    assert values(track, 12345.678) == pytest.approx([12345.678 / 2])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Track.from_keys([], [], name="jaw.rotation"), "track 'jaw.rotation' has no key"),
        (lambda: Track.from_segments([]), "has no key"),
        (lambda: Track.from_keys([0, 1], [0]), r"shapes \(2,\) and \(1,\)"),
        (lambda: Track.from_keys([0, 2, 1], [0, 0, 0]), r"key 2 at 1.0 s comes before key 1 at 2.0 s"),
        (lambda: Track.from_keys([0, 1.5], [0, math.nan], name="jaw"), r"track 'jaw': value nan at 1.5 s is not a fin"),
        (lambda: Track.from_keys([0, math.inf], [0, 1]), "time inf of key 1 is not a finite number"),
        (lambda: Track.from_segments([Segment(0, 1, 0, 1e300)]), r"value 1e\+300 at 1.0 s"),
        (lambda: Track.from_segments([Segment(3, 2, 0, 1)], name="jaw"), "track 'jaw': .*ends at 2.0 s, before it st"),
        (lambda: Track.from_keys([0, 1], [0, 1], ["linear", "linear"]), "want 1 change functions, got 2"),
    ],
)
def test_impossible_tracks_are_refused_with_their_place(make, message):
    with pytest.raises(MienError, match=message):
        make()


def test_unknown_change_function_is_refused():
    with pytest.raises(UnknownNameError, match="did you mean 'linear'"):
        Track.from_keys([0, 1], [0, 1], "linaer")
