import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien.core import Cue, MienError, Parameter, ParameterTable, UnknownNameError, both_sides
from mien.formats.plot import MOST_DOTS, collect_strips, curve_times, draw_page, plot_timeline
from mien.timeline import Layer, Segment, Timeline, Track, parse_specifications

EXAMPLE = Path(__file__).parents[3] / "examples" / "jaw.spec"
TABLE = ParameterTable(
    (
        Parameter("jaw.rotation", 0, 20, 0, "deg"),
        Parameter("mouth.width", 0.5, 1.5, 1),
        *both_sides(Parameter("eyelid.opening", 0, 1, 0.7)),
        *both_sides(Parameter("eyebrow.arch", 0, 1, 0.7)),
    )
)


def example():
    return parse_specifications(EXAMPLE.read_text()).to_timeline(TABLE)


def direct(tracks, blend="replace", **more):
    return Timeline((Layer("direct", blend, tracks),), 2.0, **more)


def strips_of(timeline, parameters=None):
    return collect_strips(timeline, TABLE, curve_times(timeline, 24), parameters)


@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_the_same_timeline_gives_the_same_bytes_and_no_clock(tmp_path, suffix):
    for name in ("a", "b"):
        plot_timeline(example(), TABLE, tmp_path / (name + suffix))
    first = (tmp_path / ("a" + suffix)).read_bytes()
    assert first == (tmp_path / ("b" + suffix)).read_bytes()
    assert re.search(rb"20\d\d-\d\d-\d\d|D:20\d\d", first) is None
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a" + suffix, "b" + suffix]


def test_picture_has_curves_dots_and_words_and_no_empty_margin(tmp_path):
    plot_timeline(example(), TABLE, tmp_path / "a.png")
    with Image.open(tmp_path / "a.png") as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    red, _, blue = pixels.transpose(2, 0, 1)
    assert ((red > 140) & (blue < 60)).sum() > 200  # dots
    assert ((blue > 85) & (red < 50)).sum() > 1000  # curves
    ink = np.argwhere(pixels.sum(axis=2) < 600)
    assert np.all(ink.min(axis=0) > 4)
    assert np.all(pixels.shape[:2] - ink.max(axis=0) > 4)


def test_every_driven_parameter_has_a_strip_and_equal_sides_share_one():
    assert [strip.label for strip in strips_of(example())] == [
        "jaw.rotation",
        "mouth.width",
        "eyelid.opening (left and right)",
        "eyebrow.arch.left",
    ]
    named = strips_of(example(), ["eyebrow.arch", "jaw.rotation"])
    assert [strip.label for strip in named] == ["eyebrow.arch.left", "eyebrow.arch.right", "jaw.rotation"]
    assert named[1].values.tolist() == [0.7] * len(named[1].values)


def test_dots_are_the_given_values_and_those_out_of_sight_are_hollow():
    track = Track.from_segments([Segment(0, 1, 0, 8), Segment(0.5, 1.5, 2, 4)])
    strip = strips_of(direct({"jaw.rotation": track}))[0]
    assert strip.dot_times_s.tolist() == [0, 0.5, 1, 1.5]
    assert strip.dot_values.tolist() == [0, 2, 8, 4]
    assert strip.reached.tolist() == [True, True, False, True]


def test_both_ends_of_a_jump_are_reached():
    strip = strips_of(direct({"jaw.rotation": Track.from_keys([0, 1, 1, 2], [0, 5, 9, 9])}))[0]
    assert strip.dot_values.tolist() == [0, 5, 9, 9]
    assert strip.reached.all()


def test_dense_tracks_have_no_dots():
    times = np.linspace(0, 2, MOST_DOTS + 2)
    assert len(strips_of(direct({"jaw.rotation": Track.from_keys(times, times)}))[0].dot_times_s) == 0


def test_where_layers_are_mixed_dots_lie_on_the_curve():
    layers = (
        Layer("speech", "replace", {"jaw.rotation": Track.from_keys([0], [3])}),
        Layer("direct", "add", {"jaw.rotation": Track.from_keys([1], [4])}),
    )
    strip = strips_of(Timeline(layers, 2.0))[0]
    assert strip.dot_values.tolist() == [3, 7]
    assert strip.reached.all()


def test_a_held_value_is_not_covered():
    strip = strips_of(direct({"jaw.rotation": Track.from_keys([0.5, 1], [3, 4])}))[0]
    times = curve_times(direct({}), 24)
    np.testing.assert_array_equal(strip.covered, (times >= 0.5) & (times <= 1))


def test_words_and_phones_stand_beneath_and_axes_carry_frames_unit_and_range():
    timeline = direct(
        {"jaw.rotation": Track.from_keys([0, 1], [0, 20])},
        words=(Cue(0.5, 1.5, "what $5$"), Cue(1.5, 1.50001, "tiny")),
        phones=(Cue(0.5, 1.0, "ɡ"),),
        title="A title with $ and _",
    )
    figure = draw_page(timeline, strips_of(timeline), curve_times(timeline, 24), 24)
    texts = {text.get_text() for axes in figure.axes for text in axes.texts} | {t.get_text() for t in figure.texts}
    assert {"what $5$", "ɡ", "0 to 20 deg", "A title with $ and _"} <= texts
    assert "tiny" not in texts
    assert "frames, 24 a second" in {axes.get_xlabel() for axes in figure.axes}
    labels = [label.get_text() for axes in figure.axes for label in axes.get_xticklabels()]
    assert {"0", "5", "45"} <= set(labels)


def test_a_script_without_letters_in_the_font_and_hours_of_keys_are_drawn(tmp_path):
    times = np.arange(0, 7200, 0.05)
    track = Track.from_keys(times, times % 20)
    words = tuple(Cue(float(k), k + 0.5, "你好") for k in range(0, 7200, 4))
    plot_timeline(
        Timeline((Layer("speech", "replace", {"jaw.rotation": track}),), 7200.0, words=words), TABLE, tmp_path / "a.png"
    )
    plot_timeline(direct({"jaw.rotation": Track.from_keys([0], [1])}, words=words[:1]), TABLE, tmp_path / "b.png")
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.width <= 9600


def test_a_moment_and_a_constant_are_drawn(tmp_path):
    plot_timeline(Timeline((), 0.0), TABLE, tmp_path / "a.svg", parameters=["mouth.width"], fps=1)
    assert (tmp_path / "a.svg").stat().st_size > 1000


def test_what_cannot_be_drawn_is_refused_and_leaves_the_old_picture(tmp_path):
    old = tmp_path / "a.png"
    old.write_text("old")
    with pytest.raises(UnknownNameError, match=r"unknown suffix of a plot '\.jpg'"):
        plot_timeline(example(), TABLE, tmp_path / "a.jpg")
    with pytest.raises(UnknownNameError, match=r"did you mean 'jaw\.rotation'"):
        plot_timeline(example(), TABLE, old, parameters=["jaw.rotatio"])
    with pytest.raises(MienError, match="no track drives a parameter"):
        plot_timeline(Timeline((), 1.0), TABLE, old)
    with pytest.raises(MienError, match="does not exist"):
        plot_timeline(example(), TABLE, tmp_path / "no" / "a.png")
    assert old.read_text() == "old"
    assert list(tmp_path.iterdir()) == [old]


def test_matplotlib_is_loaded_by_plots_only_and_pyplot_never(tmp_path):
    code = f"""
import sys
from mien.core import Parameter, ParameterTable
from mien.formats.plot import plot_timeline
from mien.timeline import Timeline
assert "matplotlib" not in sys.modules
plot_timeline(Timeline((), 1.0), ParameterTable((Parameter("a", 0, 1),)), {str(tmp_path / "a.svg")!r}, ["a"])
assert "matplotlib" in sys.modules
assert "matplotlib.pyplot" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True)
