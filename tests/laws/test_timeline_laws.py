"""What holds for every track, layer and timeline."""

import json
import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Cue, LoadError, Parameter, ParameterTable, both_sides
from mien.timeline import (
    BLENDS,
    CHANGES,
    Layer,
    Mark,
    Segment,
    Specification,
    Specifications,
    Timeline,
    Track,
    command_list,
    format_csv,
    format_specifications,
    from_json,
    json_text,
    parse_csv,
    parse_specifications,
    to_json,
)

TABLE = ParameterTable(
    (
        Parameter("jaw.rotation", 0, 20, 0, "deg"),
        *both_sides(Parameter("eyelid.opening", 0, 1, 0.7)),
        Parameter("head.turn", -60, 60, 0, "deg", odd=True),
    ),
    aliases={"ELU": "eyelid.opening.left"},
)
few = settings(deadline=None, max_examples=40)

changes = st.sampled_from(list(CHANGES))
values = st.floats(-1e9, 1e9) | st.sampled_from([0.0, 1.0, -1.0])
whole = st.integers(0, 24).map(float)  # times that coincide
moments = st.floats(0, 1e6) | whole
names = st.sampled_from([*TABLE.names, "eyelid.opening", "ELU"])


@st.composite
def segment_lists(draw, times=moments):
    def one():
        start, end = sorted((draw(times), draw(times)))
        return Segment(start, end, draw(values), draw(values), draw(changes))

    return [one() for _ in range(draw(st.integers(1, 8)))]


@st.composite
def key_tracks(draw, times=moments):
    at = sorted(draw(st.lists(times, min_size=1, max_size=8)))
    return Track.from_keys(at, [draw(values) for _ in at], draw(changes))


tracks = segment_lists().map(Track.from_segments) | key_tracks()


@st.composite
def layers(draw, name):
    blend = draw(st.sampled_from(list(BLENDS)))
    weight = 1.0 if blend == "replace" else draw(st.floats(0, 1))
    return Layer(name, blend, draw(st.dictionaries(names, tracks, max_size=4)), weight)


cue_lists = st.lists(
    st.tuples(moments, st.floats(0, 10), st.text(max_size=5)).map(lambda c: Cue(c[0], c[0] + c[1], c[2])), max_size=4
).map(tuple)


@st.composite
def timelines(draw):
    return Timeline(
        tuple(draw(layers(f"layer {k}")) for k in range(draw(st.integers(0, 4)))),
        draw(st.floats(0, 100)),
        fps=draw(st.none() | st.floats(1, 240)),
        words=draw(cue_lists),
        phones=draw(cue_lists),
        title=draw(st.text(max_size=9)),
        seed=draw(st.none() | st.integers(0, 2**63)),
    )


def plain(segments, time):
    """Value and cover by the rule as it stands in words, one line at a time; None before the first."""
    covering = [s for s in segments if s.start_s <= time <= s.end_s]
    if covering:
        return at(covering[-1], time), True
    gone = [s for s in segments if s.end_s < time]
    if not gone:
        return None, False
    moment = max(s.end_s for s in gone)
    return at([s for s in segments if s.start_s <= moment <= s.end_s][-1], moment), False


def at(segment, time):
    length = segment.end_s - segment.start_s
    share = float(CHANGES[segment.change]((time - segment.start_s) / length)) if length else 1.0
    return segment.last if share == 1.0 else segment.first + share * (segment.last - segment.first)


@few
@given(segment_lists() | segment_lists(whole), st.lists(moments, max_size=20))
def test_tracks_follow_the_rule_in_words(segments, times):
    times = times + [
        t for s in segments for e in (s.start_s, s.end_s) for t in (e, np.nextafter(e, -1), np.nextafter(e, 2e9))
    ]
    numbers, covered = Track.from_segments(segments).evaluate(times)
    for time, number, cover in zip(times, numbers, covered, strict=True):
        wanted, covers = plain(segments, time)
        assert cover == covers
        assert math.isnan(number) if wanted is None else number == wanted


@few
@given(tracks, st.lists(st.floats(-1e12, 1e12), min_size=1, max_size=20))
def test_evaluating_many_times_is_evaluating_each(track, times):
    numbers, covered = track.evaluate(times)
    each = [track.evaluate([time]) for time in times]
    np.testing.assert_array_equal(numbers, [one[0][0] for one in each])
    np.testing.assert_array_equal(covered, [one[1][0] for one in each])


@few
@given(tracks, st.floats(0, 1e9))
def test_after_the_end_the_last_value_is_held_and_before_the_first_there_is_none(track, more):
    held, last = track.evaluate([track.length_s + more, track.length_s])[0]
    assert held == last
    number, covered = track.evaluate([np.nextafter(track.first_s, -np.inf)])
    assert np.isnan(number[0])
    assert not covered[0]


@few
@given(segment_lists(), segment_lists(), st.lists(moments, min_size=1, max_size=20))
def test_later_wins_wherever_it_covers(earlier, later, times):
    alone, covered = Track.from_segments(later).evaluate(times)
    both = Track.from_segments(earlier + later).evaluate(times)[0]
    np.testing.assert_array_equal(both[covered], alone[covered])


@few
@given(tracks)
def test_segments_and_keys_make_the_same_track_again(track):
    assert Track.from_segments(list(track.segments())) == track
    keys = track.keys()
    if keys is not None:
        names = [segment.change for segment in track.segments()]
        assert Track.from_keys(*keys, names if len(keys[0]) > 1 else "linear").evaluate([0.0, 1.0])[1].tolist() == (
            track.evaluate([0.0, 1.0])[1].tolist()
        )


@few
@given(timelines(), st.lists(st.floats(-1e9, 1e9), min_size=1, max_size=20))
def test_values_are_in_range_never_nan_and_each_moment_stands_alone(timeline, times):
    numbers = timeline.values(times, TABLE)
    assert numbers.shape == (len(times), len(TABLE))
    assert np.all((numbers >= TABLE.lows) & (numbers <= TABLE.highs))
    for row, time in zip(numbers, times, strict=True):
        np.testing.assert_array_equal(row, timeline.values([time], TABLE)[0])


@few
@given(timelines(), st.sampled_from(["add", "multiply", "weighted"]), st.dictionaries(names, tracks, max_size=4))
def test_a_layer_of_weight_0_changes_nothing(timeline, blend, more):
    times = np.linspace(0, 100, 41)
    above = timeline.with_layer(Layer("top", blend, more, 0.0))
    np.testing.assert_array_equal(above.values(times, TABLE), timeline.values(times, TABLE))


@few
@given(timelines(), st.dictionaries(names, tracks, max_size=4))
def test_weighted_at_1_replaces(timeline, more):
    times = np.linspace(0, 100, 41)
    weighted = timeline.with_layer(Layer("top", "weighted", more, 1.0)).values(times, TABLE)
    np.testing.assert_array_equal(weighted, timeline.with_layer(Layer("top", "replace", more)).values(times, TABLE))


@few
@given(timelines(), st.floats(1, 60))
def test_frames_poses_and_commands_agree(timeline, fps):
    timeline = Timeline(timeline.layers, min(timeline.length_s, 600 / fps))
    times = timeline.frame_times(fps)
    numbers = timeline.values(times, TABLE)
    assert times[0] == 0.0
    assert times[-1] < max(timeline.length_s, 1e-9)
    np.testing.assert_array_equal(numbers, [pose.values for pose in timeline.poses(TABLE, fps)])
    commands = list(command_list(timeline, TABLE, fps))
    assert [frame for frame, _ in commands] == list(range(len(times)))
    for frame, settings_ in commands:
        for name, value in settings_:
            assert value == numbers[frame, TABLE.index[name]]


@few
@given(timelines())
def test_json_comes_back_bit_for_bit(timeline):
    text = "".join(json_text(timeline, TABLE, face="toy"))
    assert json.loads(text) == to_json(timeline, TABLE, face="toy")
    stored = from_json(json.loads(text))
    assert stored.timeline == timeline
    assert stored.fits(TABLE)
    times = np.linspace(-1, 100, 50)
    assert stored.timeline.values(times, TABLE).tobytes() == timeline.values(times, TABLE).tobytes()


@few
@given(timelines(), st.sampled_from([1.0, 24.0, 29.97, 60.0]))
def test_csv_comes_back_bit_for_bit_at_its_frames(timeline, fps):
    timeline = Timeline(timeline.layers, min(timeline.length_s, 300 / fps))
    back = parse_csv("\n".join(format_csv(timeline, TABLE, fps)), fps=fps)
    times = timeline.frame_times(fps)
    assert back.frame_count(fps) == len(times)
    assert back.values(times, TABLE).tobytes() == timeline.values(times, TABLE).tobytes()


symbols = st.from_regex(r"[A-Za-zəɡŋ'][\w' -]{0,8}\w", fullmatch=True)
marks = st.lists(
    st.tuples(moments, st.floats(0, 10), symbols).map(lambda m: Mark(m[0], m[0] + m[1], m[2])), max_size=4
).map(tuple)


@st.composite
def specification_lists(draw):
    rows = tuple(
        Specification(draw(names), s.start_s, s.end_s, s.first, s.last, s.change) for s in draw(segment_lists())
    )
    return Specifications(
        rows,
        fps=draw(st.floats(1, 240)),
        unit=draw(st.sampled_from(["frames", "seconds"])),
        length=draw(st.none() | st.floats(1, 1e6)),
        title=draw(st.just("") | symbols),
        words=draw(marks),
        phones=draw(marks),
    )


@few
@given(specification_lists())
def test_specification_lists_come_back(specifications):
    assert parse_specifications(format_specifications(specifications)) == specifications


@few
@given(st.text(max_size=200))
def test_any_text_is_a_list_or_an_error_with_its_source(text):
    for parse in (parse_specifications, parse_csv):
        assert complaint(parse, text).startswith("here.txt")


def complaint(parse, text):
    try:
        parse(text, "here.txt")
    except LoadError as error:
        return str(error)
    return "here.txt is a list"
