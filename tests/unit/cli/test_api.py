"""The Python interface, on the real head."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mien
from mien import api
from mien.timeline import with_settings

SCENE = mien.Scene(size_px=(48, 48), subdivide=0)


def test_draw_takes_a_face_or_its_address_and_a_pose_or_its_values(tmp_path: Path) -> None:
    face = mien.load_face("head")
    one = mien.draw(face, face.neutral.replace({"jaw.rotation": 8, "mouth.expression": 0.2}), SCENE)
    other = mien.draw("head", {"jaw.rotation": 8, "mouth.expression": 0.2}, SCENE, threads=2)
    np.testing.assert_array_equal(one.pixels, other.pixels)
    assert one.size_px == (48, 48)
    assert one.notes["Face"] == "head"
    one.write(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == one._repr_png_()


def test_parts_can_be_left_out_of_a_picture() -> None:
    whole, bald = mien.draw("head:imani", scene=SCENE), mien.draw("head:imani", scene=SCENE, without=["hair"])
    assert (whole.pixels != bald.pixels).any()
    np.testing.assert_array_equal(bald.pixels, mien.draw("head:imani", scene=SCENE, without=["hair", "hair"]).pixels)
    with pytest.raises(mien.UnknownNameError, match="did you mean 'hair'"):
        mien.draw("head:imani", scene=SCENE, without=["har"])


def test_a_pose_from_presets_and_values() -> None:
    face = mien.load_face("head")
    pose = api.make_pose(face, {"jaw.rotation": 3}, presets=["laugh"])
    laugh = face.presets["laugh"].values
    assert pose["jaw.rotation"] == 3
    assert pose.changed() == {**api.make_pose(face, laugh).changed(), "jaw.rotation": 3.0}
    with pytest.raises(mien.UnknownNameError, match="did you mean 'laugh'"):
        api.make_pose(face, presets=["lough"])


def test_say_in_one_line_and_in_three_give_the_same_film(tmp_path: Path) -> None:
    mien.say("Go.", face="head", seed=4, scene=SCENE).write(tmp_path / "a.mp4", fps=12)
    performance = mien.perform(mien.speak("Go."), mien.load_face("head"), seed=4, scene=SCENE)
    performance.write(tmp_path / "b.mp4", fps=12)
    assert (tmp_path / "a.mp4").read_bytes() == (tmp_path / "b.mp4").read_bytes()


def test_a_style_is_a_record_or_a_text(monkeypatch: pytest.MonkeyPatch) -> None:
    speech = mien.speak("Go.")
    record, text = (
        mien.perform(speech, "head", style=style).timeline.layers
        for style in (mien.Style(jaw=0.5, blinks=0), "jaw=0.5,blinks=off")
    )
    assert [layer.tracks for layer in record] == [layer.tracks for layer in text]
    monkeypatch.setattr(api, "speak", None)
    with pytest.raises(mien.UnknownNameError, match="did you mean 'mumbling'"):
        mien.say("Go.", style="mumble")


def test_marks_are_followed_and_not_said(tmp_path: Path) -> None:
    text = "Hi. [angry] <break time='1s'/> *Go.*"
    performance = mien.say(text, scene=SCENE)
    timeline = performance.timeline
    assert (timeline.text, timeline.title, [word.symbol for word in timeline.words]) == (
        "Hi. Go.",
        "Hi. Go.",
        ["Hi", "Go"],
    )
    first, second = timeline.words
    assert second.start_s - first.end_s == pytest.approx(1.0, abs=0.001)
    lowered = performance.face.parameters.index["eyebrow.lower.left"]
    values = timeline.values([first.start_s, first.end_s + 0.3], performance.face.parameters)[:, lowered]
    assert values == pytest.approx([0.0, 1.0], abs=0.01)
    speech = mien.speak(text)
    assert (speech.text, speech.script) == ("Hi. Go.", text)
    again = mien.perform(speech, scene=SCENE).timeline
    times = timeline.frame_times(12)
    np.testing.assert_array_equal(
        timeline.values(times, performance.face.parameters), again.values(times, performance.face.parameters)
    )


def test_marks_of_a_recording_act_where_its_words_are_heard(tmp_path: Path) -> None:
    mien.say("The stone is happy.").write(tmp_path / "a.wav")
    speech = mien.hear(tmp_path / "a.wav", "The stone [angry] is *happy*.")
    assert (speech.text, speech.script) == ("The stone is happy.", "The stone [angry] is *happy*.")
    start_s = next(word.start_s for word in speech.words if word.symbol == "is")
    track = mien.perform(speech).timeline.layer("expression").tracks["eyebrow.lower.left"]
    assert track.evaluate([start_s - 0.2, start_s + 0.2])[0] == pytest.approx([0.0, 1.0], abs=0.001)


def test_the_function_perform_and_the_package_perform_share_a_name() -> None:
    import mien.perform

    for _ in range(2):
        assert callable(mien.perform)
        assert mien.perform.Style is mien.Style


def test_play_gives_back_what_was_written(tmp_path: Path) -> None:
    performance = mien.say("Go.", scene=SCENE)
    performance.write(tmp_path / "a.json", fps=25)
    back = mien.play(tmp_path / "a.json")
    assert (back.scene, back.timeline.fps, back.face.name) == (SCENE, 25.0, "head")
    times, table = back.timeline.frame_times(25), back.face.parameters
    np.testing.assert_array_equal(back.timeline.values(times, table), performance.timeline.values(times, table))
    assert mien.play(tmp_path / "a.json", face="head:ada").face.name == "head:ada"


def test_settings_are_the_lowest_layer_and_add_up() -> None:
    face = mien.load_face("head")
    timeline = mien.Timeline((mien.Layer("speech", "add", {}),), 1.0)
    first = with_settings(timeline, api.make_pose(face, {"head.turn": 5, "head.nod": 1}))
    second = with_settings(first, api.make_pose(face, {"head.nod": 2}))
    assert [layer.name for layer in second.layers] == ["settings", "speech"]
    values = second.values([0.0, 0.5], face.parameters)
    assert values[:, face.parameters.index["head.turn"]].tolist() == [5.0, 5.0]
    assert values[:, face.parameters.index["head.nod"]].tolist() == [2.0, 2.0]
    assert with_settings(timeline, mien.Pose.neutral(face.parameters)) is timeline


def test_a_head_is_seen_a_little_from_its_left_and_a_drawing_from_before() -> None:
    face = mien.load_face("toon:gus")
    told = {"gaze.compensation": 1.0, "head.horizontal": 10.0}
    aside = mien.draw(face, told, mien.Scene().seen("three-quarter"))
    before = mien.draw(face, told, mien.Scene(position=(0.0, 0.0, 2.0)))
    np.testing.assert_array_equal(mien.draw(face, told).pixels, before.pixels)
    assert (aside.pixels != before.pixels).any()
    assert api.default_scene(mien.load_face("head")) == api.default_scene() == mien.Scene().seen("three-quarter")
    assert mien.say("Go.", face).scene.position == api.default_scene(face).position == (0.0, 0.0, 1.1)
