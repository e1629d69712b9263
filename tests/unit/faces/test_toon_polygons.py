import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Drawing
from toons import extended, face_of, small

FACE = face_of(small())


def contours(face, name, **values):
    drawing = face.shape(face.neutral.replace(values))
    (path,) = [path for path in drawing.paths if path.name == name]
    return [np.stack([c[:, 0], drawing.size[1] - c[:, 1]], axis=1) for c in path.contours]  # y down, as in the file


def test_a_strict_face_is_drawn_in_his_six_steps():
    assert [path.name for path in FACE.shape(FACE.neutral).paths] == [
        "eye_R", "eye_L", "pupil_R", "pupil_L", "face", "hat", "lips", "brow_R", "brow_L",
    ]  # fmt: skip


def test_the_face_is_cut_by_the_holes():
    drawing = FACE.shape(FACE.neutral)
    by_name = {path.name: path for path in drawing.paths}
    assert [region.contours for region in by_name["face"].outside] == [
        by_name["eye_R"].contours,
        by_name["eye_L"].contours,
    ]
    assert all(path.outside == () for name, path in by_name.items() if name != "face")


def test_a_polygon_on_a_feature_keeps_place_and_distance():
    """The middle point of a level brow goes up by 10: half way along each line its vertices go up by 5."""
    document = small()
    document["polygons"][5]["path"] = "M40 57 L50 57 L60 57 L70 57 L80 57 L80 61 Z"
    face = face_of(document)
    (now,) = contours(face, "brow_R", BRC=0.75)
    # Across lines that rise by 10 on a run of 20 the distance of 3 has a slant.
    along = np.array([20.0, -10.0]) / np.sqrt(500.0)
    np.testing.assert_allclose(now[1], [50 + 3 * along[1], 55 - 3 * along[0]])
    np.testing.assert_allclose(now[3], [70 - 3 * along[1], 55 - 3 * along[0]])


def test_a_polygon_on_a_point_is_between_its_states():
    rest = 2.0 / 40.0
    (now,) = contours(FACE, "lips")
    np.testing.assert_allclose(now[2], [130 - 10 * rest, 142 + 38 * rest])
    assert contours(FACE, "lips", MB=0.0)[0].tolist() == [[70, 138], [130, 138], [130, 142], [70, 142]]
    assert contours(FACE, "lips", MB=1.0)[0].tolist() == [[70, 138], [130, 138], [120, 180], [80, 180]]


def test_a_pupil_moves_as_one():
    (rest,), (now,) = contours(FACE, "pupil_R"), contours(FACE, "pupil_R", PRH=30.0, PRV=-30.0)
    np.testing.assert_allclose(now - rest, [[-6.0, 6.0]] * len(rest))


def test_free_polygons_stay():
    (rest,) = contours(FACE, "hat")
    (now,) = contours(FACE, "hat", BRC=1.0, MB=1.0, ELU=0.0)
    assert rest.tolist() == now.tolist()


def test_drivers_add_up():
    driven = {
        "id": "chin", "kind": "free", "fill": "skin", "path": "M90 180 H110 V190 H90 Z",
        "drivers": [
            {"motor": "MB", "max": {"move": [0, 10]}},
            {"motor": "MLV", "max": "M92 180 H112 V190 H92 Z", "min": {"scale": [2, 1], "about": [100, 185]}},
        ],
    }  # fmt: skip
    face = face_of(extended(driven))
    (rest,) = contours(face, "chin")
    (now,) = contours(face, "chin", MB=1.0, MLV=1.0)
    np.testing.assert_allclose(now - rest, [[2.0, 10.0]] * len(rest))
    (now,) = contours(face, "chin", MLV=0.0)
    assert np.ptp(now[:, 0]) == pytest.approx(40.0)
    (now,) = contours(face, "chin", MLV=0.25)
    assert np.ptp(now[:, 0]) == pytest.approx(30.0)


def test_a_state_sets_in_along_its_ramp():
    driven = {
        "id": "beard", "kind": "free", "fill": "skin", "path": "M80 100 L120 100 L120 140 L120 180 L80 180 Z",
        "drivers": [{"motor": "MB", "max": {"move": [0, 10], "ramp": [120, 160]}}],
    }  # fmt: skip
    face = face_of(extended(driven))
    moved = contours(face, "beard", MB=1.0)[0][:, 1] - contours(face, "beard")[0][:, 1]
    heights = contours(face, "beard")[0][:, 1]
    assert moved[heights <= 120.0].max() == 0.0
    np.testing.assert_allclose(moved[heights >= 160.0], 10.0)
    np.testing.assert_allclose(moved[np.isclose(heights, 140.0)], 5.0)


def test_a_span_lies_between_two_lines_and_a_stroke_on_one():
    face = face_of(
        extended(
            {
                "id": "inside",
                "kind": "hole",
                "fill": "ink",
                "span": [{"feature": "M"}, {"feature": "M", "line": "lower"}],
            },
            {"id": "line", "kind": "feature", "fill": "ink", "stroke": {"feature": "M"}, "width": 4},
        )
    )
    (shut,) = contours(face, "inside", MB=0.0)
    assert np.ptp(shut[:, 1]) == pytest.approx(0.0)
    (open_,) = contours(face, "inside", MB=1.0)
    assert open_[:, 1].max() == pytest.approx(178.0)
    (stroke,) = contours(face, "line")
    np.testing.assert_allclose([stroke.min(axis=0), stroke.max(axis=0)], [[68, 138], [132, 142]])


def test_a_tongue_reaches_its_line():
    face = face_of(
        extended(
            {
                "id": "tongue", "kind": "point", "layer": "inner", "fill": "ink", "path": "M90 160 H110 V170 H90 Z",
                "drivers": [{"motor": "TG", "max": {"touch": {"feature": "M"}, "offset": 3}}],
            },
            motors={**small()["motors"], "TG": {}},
        )
    )  # fmt: skip
    assert contours(face, "tongue", TG=1.0)[0][:, 1].min() == pytest.approx(143.0)
    assert contours(face, "tongue", TG=0.5)[0][:, 1].min() == pytest.approx(151.5)


def test_what_is_fading_has_no_width_while_the_eye_is_open():
    face = face_of(
        extended(
            {"id": "lash", "kind": "feature", "fill": "ink", "stroke": {"feature": "ER"}, "width": 4, "fade": "ER"}
        )
    )
    heights = [np.ptp(contours(face, "lash", ERU=share)[0][:, 1]) for share in (0.8, 0.0)]
    (open_,) = contours(face, "lash")
    assert np.ptp(open_[:, 1]) == pytest.approx(10.0)  # the lid's line, 80 to 90, and no more
    assert heights[1] > 4.0


def test_clips_are_the_polygons_that_they_name():
    iris = {
        "id": "iris",
        "kind": "pupil",
        "feature": "PR",
        "fill": "ink",
        "path": "M50 80 H70 V99 H50 Z",
        "clip": "eye_R",
    }
    drawing = face_of(extended(iris)).shape(face_of(extended(iris)).neutral)
    by_name = {path.name: path for path in drawing.paths}
    assert by_name["iris"].inside[0].contours == by_name["eye_R"].contours


def test_proportions_move_features_with_what_is_on_them():
    face = face_of(extended(proportions={"eyes.size": [0.5, 2], "mouth.up": [-10, 10], "eyes.spacing": [-5, 5]}))
    (rest,), (now,) = contours(face, "pupil_R", PRH=30.0), contours(face, "pupil_R", **{"PRH": 30.0, "eyes.size": 2.0})
    np.testing.assert_allclose(now.mean(axis=0), [60 - 12, 90])
    assert np.ptp(now[:, 0]) == pytest.approx(2 * np.ptp(rest[:, 0]))
    (now,) = contours(face, "eye_L", **{"eyes.spacing": 5.0})
    assert now[:, 0].max() == pytest.approx(165.0)
    assert contours(face, "hat", **{"mouth.up": 10.0})[0].tolist() == contours(face, "hat")[0].tolist()


@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_any_motion_of_any_motor_leaves_outlines_whole(data):
    values = {row.name: data.draw(st.floats(row.low, row.high), label=row.name) for row in FACE.parameters}
    drawing = FACE.shape(FACE.neutral.replace(values))
    rest = FACE.shape(FACE.neutral)
    assert isinstance(drawing, Drawing)
    for path, before in zip(drawing.paths, rest.paths, strict=True):
        assert [len(c) for c in path.contours] == [len(c) for c in before.contours]
        assert all(np.isfinite(c).all() and np.abs(c).max() < 1000.0 for c in path.contours)
