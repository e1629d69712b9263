"""Beards and glasses: optional parts of a person."""

import json

import numpy as np
import pytest

from mien.core import LoadError, Pose, UnknownNameError
from mien.faces import load_face
from mien.faces.head.head import Head
from mien.faces.head.measured import archive
from mien.faces.head.people import people
from mien.faces.head.wear import beard, beard_styles, glasses, glasses_styles

BEARDED = Head(hair="bald", beard="full", glasses="round")


def rows(head, name, points):
    return points[head._layout.span[name]]


def test_styles_begin_with_none_and_an_unknown_one_is_an_error():
    assert beard_styles() == ("none", "stubble", "moustache", "goatee", "full")
    assert glasses_styles()[0] == "none"
    assert {"round", "square"} < set(glasses_styles())
    with pytest.raises(UnknownNameError, match="goatee"):
        beard("goaty")
    with pytest.raises(UnknownNameError, match="round"):
        glasses("rond")


def test_what_is_absent_costs_nothing():
    bare, stubble = Head(hair="bald"), Head(hair="bald", beard="stubble")
    assert bare.topology.vertex_count == stubble.topology.vertex_count
    assert {part.name for part in bare.topology.parts}.isdisjoint({"beard", "glasses"})


def test_beard_stands_off_the_skin_it_grows_on_and_follows_the_jaw():
    rest = Pose.neutral(BEARDED.parameters)
    shut, wide = (BEARDED.shape(rest.replace({"jaw.rotation": angle})).points for angle in (0, 15))
    grown = BEARDED._layout.beard
    for points in (shut, wide):
        distance = np.linalg.norm(rows(BEARDED, "beard", points) - points[grown.index[:, 0]], axis=1)
        np.testing.assert_allclose(distance, np.abs(grown.offset), atol=1e-9)
    fall = rows(BEARDED, "beard", shut)[:, 1] - rows(BEARDED, "beard", wide)[:, 1]
    assert fall.max() > 0.008
    np.testing.assert_allclose(rows(BEARDED, "glasses", shut), rows(BEARDED, "glasses", wide), atol=1e-12)


def test_glasses_turn_with_the_head_and_stay_off_the_eyes():
    rest = Pose.neutral(BEARDED.parameters)
    still, turned = (BEARDED.shape(rest.replace({"head.turn": angle})).points for angle in (0, 20))
    frame, moved = rows(BEARDED, "glasses", still), rows(BEARDED, "glasses", turned)
    sides = [np.linalg.norm(points[1:] - points[:-1], axis=1) for points in (frame, moved)]
    np.testing.assert_allclose(*sides, atol=1e-12)
    assert np.abs(moved - frame).max() > 0.02
    skin = archive()
    lids = still[np.unique(skin.quads[skin.groups == skin.group_names.index("lidrim")])]
    assert np.sqrt(((lids[:, None] - frame[None]) ** 2).sum(axis=2)).min() > 0.004


def test_stubble_darkens_the_skin_only():
    bare, stubble = Head(hair="bald"), Head(hair="bald", beard="stubble")
    one, other = (head.shape(Pose.neutral(head.parameters)).colors for head in (bare, stubble))
    changed = np.flatnonzero(np.abs(one - other).max(axis=1) > 0.01)
    assert len(changed) > 30
    skin = bare._layout.span["skin"]
    assert ((changed >= skin.start) & (changed < skin.stop)).all()


def test_beard_and_glasses_are_mirrored():
    points = BEARDED.shape(Pose.neutral(BEARDED.parameters)).points
    for name in ("beard", "glasses"):
        run = BEARDED._layout.span[name]
        twin = points[BEARDED.mirror_vertices[run]] * [-1.0, 1.0, 1.0]
        np.testing.assert_allclose(points[run], twin, atol=1e-4)


@pytest.mark.parametrize(("key", "value", "wanted"), [("beard", "goaty", "goatee"), ("glasses", "rond", "round")])
def test_face_file_with_an_unknown_style_is_refused(tmp_path, key, value, wanted):
    path = tmp_path / "x.face.json"
    path.write_text(json.dumps({"format": "mien-face", "version": 1, key: value}))
    with pytest.raises(LoadError, match=wanted):
        load_face(str(path))
    path.write_text(json.dumps({"format": "mien-face", "version": 1, key: wanted}))
    assert getattr(load_face(str(path)), key) == wanted


def test_people_are_many_and_varied():
    rows_of = people().values()
    assert len(people()) >= 14
    assert len({row["hair"] for row in rows_of}) >= 10
    assert len({row["palette"] for row in rows_of}) >= 10
    assert len({row.get("beard", "none") for row in rows_of}) >= 4


def test_beard_goes_with_the_neck_as_the_skin_beneath_it_does():
    layout, shares = BEARDED._layout, BEARDED.rig(Pose.neutral(BEARDED.parameters)).shares
    skin, own = shares[layout.beard.index[:, 0]], shares[layout.span["beard"]]
    np.testing.assert_array_equal(own, skin)
    assert 0.0 < own.max(axis=1).min() < 1.0
