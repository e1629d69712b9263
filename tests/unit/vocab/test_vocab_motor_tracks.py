import numpy as np
import pytest

import mien
from mien.core import MienError, UnknownNameError
from mien.timeline import Layer, Timeline, Track
from mien.vocab.motor_tracks import play_motors, table_with_motors

HEAD = mien.load_face("head")


def timeline_of(tracks, blend="replace"):
    return Timeline((Layer("direct", blend, tracks),), 1.0)


def test_the_head_plays_tracks_of_motors():
    track = Track.from_keys([0.0, 0.5, 1.0], [0.9, 0.0, 0.9], name="ELU")
    played = play_motors(timeline_of({"ELU": track}), HEAD)
    assert played.driven(HEAD.parameters) == ("eyelid.opening.left",)
    for time_s, share in ((0.0, 0.9), (0.5, 0.0), (0.25, 0.45)):
        pose = mien.pose_from("toonface", {"ELU": share}, HEAD)
        value = played.values(time_s, HEAD.parameters)[0][HEAD.parameters.index["eyelid.opening.left"]]
        assert value == pytest.approx(pose["eyelid.opening.left"], abs=1e-3)


def test_own_parameters_win_and_numbers_are_names():
    tracks = {"14-1": Track.from_keys([0.0, 1.0], [1.0, 1.0]), "jaw.rotation": Track.from_keys([0.0, 1.0], [4.0, 4.0])}
    played = play_motors(timeline_of({**tracks, "MB": Track.from_keys([0.0, 1.0], [1.0, 1.0])}), HEAD)
    values = dict(zip(HEAD.parameters.names, played.values(0.5, HEAD.parameters)[0], strict=True))
    assert values["jaw.rotation"] == 4.0
    smiling = mien.pose_from("toonface", {"MLV": 1.0}, HEAD)
    assert values["mouth.expression.left"] == pytest.approx(smiling["mouth.expression.left"])


def test_drawn_faces_play_codes_as_they_are():
    toon = mien.load_face("toon:olav")
    timeline = timeline_of({"ELU": Track.from_keys([0.0, 1.0], [0.9, 0.0])})
    assert play_motors(timeline, toon).layers == timeline.layers
    assert "ELU" in toon.parameters
    assert table_with_motors(toon).names == toon.parameters.names


def test_what_is_no_name_is_told():
    with pytest.raises(UnknownNameError, match="ELX"):
        play_motors(timeline_of({"ELX": Track.from_keys([0.0, 1.0], [0.0, 1.0])}), HEAD)
    with pytest.raises(MienError, match="can only replace"):
        play_motors(timeline_of({"ELU": Track.from_keys([0.0, 1.0], [0.0, 1.0])}, "add"), HEAD)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("wink.spec", "ELU 0 11 0.9 0 linear\nELU 12 23 0 0.9 linear\n"),
        ("wink.csv", "time_s,ELU\n0,0.9\n0.5,0\n1,0.9\n"),
    ],
)
def test_files_may_name_motors(name, text, tmp_path):
    path = tmp_path / name
    path.write_text(text)
    performance = mien.play(path)
    values = performance.timeline.values(np.linspace(0.0, 1.0, 49), HEAD.parameters)
    opening = values[:, HEAD.parameters.index["eyelid.opening.left"]]
    assert opening.min() < 0.05
    assert opening[0] > 0.6
    assert (values[:, HEAD.parameters.index["eyelid.opening.right"]] == HEAD.neutral["eyelid.opening.right"]).all()


def test_a_value_out_of_a_motors_range_is_refused_with_its_line(tmp_path):
    path = tmp_path / "wide.csv"
    path.write_text("time_s,ELU\n0,0.9\n0.5,2\n")
    with pytest.raises(MienError, match=r"wide.csv.*3.*ELU"):
        mien.play(path)
