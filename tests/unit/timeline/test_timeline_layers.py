import math
import tracemalloc

import numpy as np
import pytest

from mien.core import Cue, MienError, Parameter, ParameterTable, RangeError, UnknownNameError, both_sides
from mien.timeline import BLENDS, Layer, Timeline, Track

TABLE = ParameterTable(
    (
        Parameter("jaw.rotation", 0, 20, 0, "deg"),
        *both_sides(Parameter("eyelid.opening", 0, 1, 0.75)),
        Parameter("mouth.width", 0.5, 1.5, 1),
        Parameter("head.turn", -60, 60, 0, "deg", odd=True),
    ),
    aliases={"ELU": "eyelid.opening.left"},
)


def hold(value, start=0.0):
    return Track.from_keys([start], [value])


def column(timeline, name, *times):
    return timeline.values(times, TABLE)[:, TABLE.index[name]].tolist()


def two(below, rule, value, weight=1.0, start=0.0):
    return Timeline(
        (
            Layer("idle", "replace", {"head.turn": hold(below)}),
            Layer("direct", rule, {"head.turn": hold(value, start)}, weight),
        ),
        2.0,
    )


@pytest.mark.parametrize(
    ("rule", "weight", "wanted"),
    [
        ("replace", 1.0, 3.0),
        ("add", 1.0, 11.0),
        ("add", 0.5, 9.5),
        ("multiply", 1.0, 24.0),
        ("multiply", 0.5, 16.0),  # half way between 8 and 24
        ("weighted", 1.0, 3.0),
        ("weighted", 0.25, 6.75),
    ],
)
def test_blend_rules_at_hand_computed_values(rule, weight, wanted):
    assert column(two(8.0, rule, 3.0, weight), "head.turn", 0, 1) == [wanted, wanted]


@pytest.mark.parametrize("rule", BLENDS)
def test_a_layer_says_nothing_before_its_first_key_and_goes_on_after_its_last(rule):
    timeline = two(8.0, rule, 3.0, start=1.0)
    before, at, after = column(timeline, "head.turn", 0.5, 1.0, 50.0)
    assert before == 8.0
    assert at == after != 8.0


def test_untouched_parameters_keep_their_defaults():
    values = two(8.0, "replace", 3.0).values([0.0, 1.0], TABLE)
    assert values.shape == (2, 5)
    assert values[1].tolist() == [0, 0.75, 0.75, 1, 3]


def test_symmetric_names_drive_both_sides_and_aliases_one():
    layers = (Layer("a", "replace", {"eyelid.opening": hold(0.5)}), Layer("b", "add", {"ELU": hold(0.25)}))
    timeline = Timeline(layers, 1.0)
    assert column(timeline, "eyelid.opening.left", 0) == [0.75]
    assert column(timeline, "eyelid.opening.right", 0) == [0.5]
    assert timeline.driven(TABLE) == ("eyelid.opening.left", "eyelid.opening.right")


def test_only_the_outcome_is_brought_into_range():
    layers = (Layer("a", "add", {"jaw.rotation": hold(50.0)}), Layer("b", "add", {"jaw.rotation": hold(-40.0)}))
    assert column(Timeline(layers, 1), "jaw.rotation", 0) == [10.0]
    assert column(Timeline(layers[:1], 1), "jaw.rotation", 0) == [20.0]


def test_minus_zero_never_comes_out():
    values = Timeline((Layer("a", "replace", {"head.turn": hold(-0.0)}),), 1).values([0.0], TABLE)
    assert not np.signbit(values).any()


def test_no_nan_from_many_huge_factors():
    layers = [Layer(f"m{k}", "multiply", {"mouth.width": hold(1e9)}) for k in range(60)]
    layers.append(Layer("zero", "multiply", {"mouth.width": hold(0.0)}))
    assert column(Timeline(tuple(layers), 1), "mouth.width", 0) == [0.5]


def test_unknown_parameter_is_refused_with_near_matches():
    timeline = Timeline((Layer("a", "replace", {"jaw.rotatoin": hold(1)}),), 1)
    with pytest.raises(UnknownNameError, match=r"did you mean 'jaw.rotation'"):
        timeline.values([0.0], TABLE)


def test_bad_layers_and_timelines_are_refused():
    with pytest.raises(UnknownNameError, match="blend rule of layer 'a' 'multply' — did you mean 'multiply'"):
        Layer("a", "multply", {})
    with pytest.raises(RangeError, match="layer 'a': weight 2"):
        Layer("a", "add", {}, 2)
    with pytest.raises(RangeError, match="weight nan"):
        Layer("a", "add", {}, math.nan)
    with pytest.raises(MienError, match="'weighted' mixes"):
        Layer("a", "replace", {}, 0.5)
    with pytest.raises(MienError, match="two layers 'a'"):
        Timeline((Layer("a", "add", {}), Layer("a", "add", {})), 1)
    with pytest.raises(RangeError, match="length of nan"):
        Timeline((), math.nan)
    with pytest.raises(RangeError, match="rate of 0"):
        Timeline((), 1).frame_count(0)
    with pytest.raises(MienError, match="finite times"):
        Timeline((), 1).values([math.nan], TABLE)


def test_layers_are_found_put_on_top_and_exchanged():
    timeline = Timeline((Layer("speech", "replace", {}),), 1.0)
    taller = timeline.with_layer(Layer("direct", "add", {"head.turn": hold(1, 3.0)}))
    assert [layer.name for layer in taller.layers] == ["speech", "direct"]
    assert taller.length_s == 3.0
    again = taller.with_layer(Layer("speech", "weighted", {}, 0.5))
    assert [(layer.name, layer.weight) for layer in again.layers] == [("speech", 0.5), ("direct", 1.0)]
    with pytest.raises(UnknownNameError, match="did you mean 'speech'"):
        timeline.layer("speach")


def test_frames_are_at_k_over_fps_exactly():
    timeline = Timeline((), 2.0)
    times = timeline.frame_times(30)
    assert timeline.frame_count(30) == 60
    assert times.tolist() == [k / 30 for k in range(60)]


@pytest.mark.parametrize(
    ("length_s", "fps", "count"),
    [(13 / 24, 24, 13), (0.0, 24, 1), (1.01, 24, 25), (0.1 * 3, 10, 3), (7200.0, 240, 1_728_000), (0.5, 1, 1)],
)
def test_frame_counts(length_s, fps, count):
    assert Timeline((), length_s).frame_count(fps) == count


def test_poses_are_the_values_frame_by_frame_over_chunk_borders():
    track = Track.from_keys([0, 30], [0, 20], "cosine")
    timeline = Timeline((Layer("direct", "replace", {"jaw.rotation": track}),), 30.0)
    poses = list(timeline.poses(TABLE, 24))
    assert len(poses) == 720
    assert poses[0].table is TABLE
    np.testing.assert_array_equal([p["jaw.rotation"] for p in poses], track.evaluate(np.arange(720) / 24)[0])


def test_a_long_timeline_plays_in_bounded_memory():
    track = Track.from_keys([0, 7200], [0, 20])
    timeline = Timeline((Layer("direct", "replace", {"jaw.rotation": track}),), 7200.0, words=(Cue(0, 1, "a"),))
    tracemalloc.start()
    for count, _ in enumerate(timeline.poses(TABLE, 24)):
        if count == 5000:
            break
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1_000_000


def test_layers_cannot_be_changed_behind_their_back():
    tracks = {"head.turn": hold(1)}
    layer = Layer("a", "replace", tracks)
    tracks.clear()
    assert list(layer.tracks) == ["head.turn"]
    with pytest.raises(TypeError):
        layer.tracks["x"] = hold(2)
