"""An exaggerated timeline: what is added and what replaces is stretched, what multiplies and aims is not."""

import numpy as np
import pytest

from mien.core import Parameter, ParameterTable, Pose, both_sides, exaggerate
from mien.timeline import Layer, Timeline, Track, exaggerate_timeline, with_settings

TABLE = ParameterTable(
    (
        Parameter("jaw", 0, 20),
        *both_sides(Parameter("lid", 0, 1, 0.75, closed=0.0)),
        Parameter("brow.left", 0, 1, 0.25),
        Parameter("brow.right", 0, 1, 0.5),
        Parameter("seal", 0, 1, role="contact"),
        Parameter("nod", -30, 30),
    )
)


def track(*values):
    return Track.from_keys(np.arange(len(values), dtype=float), values)


def values(timeline, name, times=(0.0, 1.0)):
    return [float(v) for v in timeline.values(times, TABLE)[:, TABLE.index[name]]]


def test_what_is_added_grows_and_what_shuts_does_not():
    timeline = Timeline(
        (
            Layer("speech", "add", {"jaw": track(0, 4), "seal": track(0.5, 1)}),
            Layer("shut", "multiply", {"jaw": track(1, 0.5)}),
        ),
        1.0,
    )
    louder = exaggerate_timeline(timeline, TABLE, 2.0)
    expected = exaggerate(Pose.neutral(TABLE).replace({"jaw": 4}), 2.0)["jaw"]
    assert values(louder, "jaw") == [0.0, pytest.approx(expected / 2)]
    assert values(louder, "seal") == [0.5, 1.0]
    assert louder.layer("shut") is timeline.layer("shut")


@pytest.mark.parametrize("amount", [0.0, 0.5, 3.0])
def test_a_blink_shuts_at_every_amount(amount):
    layers = (Layer("expression", "add", {"lid": track(0.25, -0.5)}), Layer("shut", "multiply", {"lid": track(0, 0)}))
    assert values(exaggerate_timeline(Timeline(layers, 1.0), TABLE, amount), "lid.left") == [0.0, 0.0]


def test_an_eye_that_an_expression_shuts_stays_shut_in_a_softer_one():
    timeline = Timeline((Layer("expression", "add", {"lid.left": track(0, -0.75)}),), 1.0)
    assert values(exaggerate_timeline(timeline, TABLE, 0.5), "lid.left") == [0.75, 0.0]


def test_looks_keep_their_angles_and_nods_do_not():
    layers = (Layer("gaze", "add", {"nod": track(0, 5)}), Layer("idle", "add", {"nod": track(0, 1)}))
    louder = exaggerate_timeline(Timeline(layers, 1.0), TABLE, 2.0)
    assert values(louder, "nod") == [0.0, pytest.approx(7.0, abs=1e-4)]


def test_settings_and_what_is_set_by_hand_are_stretched_from_rest_on_either_side():
    timeline = with_settings(
        Timeline((Layer("direct", "replace", {"brow": track(0.3, 0.5)}),), 1.0), Pose.neutral(TABLE).replace({"jaw": 4})
    )
    louder = exaggerate_timeline(timeline, TABLE, 2.0)
    for name, first, last in (("brow.left", 0.3, 0.5), ("brow.right", 0.3, 0.5), ("jaw", 4, 4)):
        wanted = [exaggerate(Pose.neutral(TABLE).replace({name: value}), 2.0)[name] for value in (first, last)]
        assert values(louder, name) == pytest.approx(wanted, abs=1e-12)


def test_several_names_of_one_row_act_in_their_order_still():
    timeline = Timeline(
        (Layer("direct", "replace", {"lid": track(0.2, 0.2), "lid.left": track(0.5, 0.5), "jaw": track(1, 1)}),), 1.0
    )
    softer = exaggerate_timeline(timeline, TABLE, 0.999999)
    assert values(softer, "lid.left") == pytest.approx([0.5, 0.5], abs=1e-4)
    assert values(softer, "lid.right") == pytest.approx([0.2, 0.2], abs=1e-4)
    assert [layer.name for layer in softer.layers] == ["direct", "direct 2"]


def test_one_is_the_same_timeline():
    timeline = Timeline((Layer("speech", "add", {"jaw": track(0, 4)}),), 1.0)
    assert exaggerate_timeline(timeline, TABLE, 1.0) is timeline
