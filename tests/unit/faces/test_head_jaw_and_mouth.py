"""The jaw and the lips: known answers, contact, regions."""

from dataclasses import replace

import numpy as np
import pytest

from mien.core import Pose, Scene, subdivide
from mien.faces import load_face
from mien.faces.head.jaw import remake_shares, rotate_jaw
from mien.faces.head.measured import archive
from mien.faces.head.mouth import mouth_regions
from mien.render import draw
from support import in_python, lip_gap_mm

HEAD = load_face("head")
REST = Pose.neutral(HEAD.parameters)
MIRRORED_ROWS = sorted({name.removesuffix(".left") for name in HEAD.parameters.names if name.endswith(".left")})


def points(values, face=HEAD):
    return face.shape(Pose.neutral(face.parameters).replace(values)).points


def vertex(name):
    return archive().vertex[name]


def gap_mm(values):
    return lip_gap_mm(subdivide(HEAD.shape(REST.replace(values)), 2).points)


def test_a_jaw_at_ninety_degrees_points_straight_down():
    axis = np.array([-0.04, 0.01])
    chin = np.array([[0.02, -0.04, 0.11]])
    in_python(rotate_jaw)(chin, 90.0, axis, np.ones(1), np.empty((2, 1)))
    # 0.1 in front of the axis and level with it: a quarter turn that opens brings it 0.1 below the axis.
    np.testing.assert_allclose(chin, [[0.02, -0.04 - 0.1, 0.01]], atol=1e-15)


def test_opening_the_mouth_lowers_the_chin_and_leaves_the_crown():
    moved = points({"jaw.rotation": 12}) - points({})
    assert moved[vertex("k11_2"), 1] < -0.014
    assert np.abs(moved[vertex("s5_0")]).max() == 0.0
    assert np.abs(moved[vertex("m1_0")]).max() < 0.002


def shares_at(jaw, *names):
    share = archive().measured("cage").jaw_share[[vertex(name) for name in names]]
    return remake_shares(share, jaw).tolist()


def test_parkes_shares_turn_the_chin_fully_and_the_corner_by_a_third():
    np.testing.assert_allclose(remake_shares(np.array([0.0, 0.44, 0.8, 0.93]), "parke"), [0.0, 1 / 3, 1.0, 1.0])
    assert shares_at("parke", "m0_5") == pytest.approx([1 / 3], abs=0.02)


def test_parkes_first_shares_turn_all_of_the_lower_lip_fully_and_the_corner_by_a_half():
    lower_lip = [f"{ring}_{station}" for ring in ("m0", "m1") for station in (6, 7, 8, 9)]
    assert shares_at("untapered", *lower_lip) == [1.0] * 8
    assert shares_at("untapered", "m0_5") == pytest.approx([0.5], abs=0.02)
    tapered = shares_at("parke", *lower_lip[:4])
    assert tapered == sorted(tapered)
    assert tapered[0] < 0.9


def test_fitted_shares_stay_as_they_are():
    share = archive().measured("cage").jaw_share
    np.testing.assert_array_equal(remake_shares(share, "fitted"), share)


def test_the_lower_lip_is_tapered_towards_the_corner():
    share = archive().measured("cage").jaw_share[[vertex(f"m0_{station}") for station in (9, 8, 7, 6, 5)]]
    assert (np.diff(share) < 0).all()


def test_lower_teeth_turn_with_the_jaw_and_upper_ones_stay():
    span = HEAD._layout.span["teeth"]
    moved = np.abs(points({"jaw.rotation": 10}) - points({}))[span].max(axis=1)
    lower = HEAD._layout.lower["teeth"]
    assert moved[lower].min() > 0.004
    assert moved[~lower].max() == 0.0


@pytest.mark.parametrize("jaw", [0, 3, 8, 12])
@pytest.mark.parametrize(
    "more",
    [{}, {"mouth.expression": 0.3}, {"mouth.upper_raise": 0.4, "mouth.lower_depress": 0.4}, {"mouth.upper_lip": 12}],
    ids=["rest", "smile", "parted", "raised"],
)
def test_closure_shuts_the_lips_whatever_the_jaw_does(jaw, more):
    rest = gap_mm({})
    assert gap_mm({"jaw.rotation": jaw, "mouth.closure": 1, **more}) < rest + 0.35
    if jaw >= 3:
        assert gap_mm({"jaw.rotation": jaw, **more}) > 3.0


INSIDE = {
    f"{part}.color.{channel}": value
    for part in ("tooth", "gum", "tongue", "cavity")
    for channel, value in (("red", 0.0), ("green", 1.0), ("blue", 0.0))
}


@pytest.mark.parametrize(("yaw", "pitch"), [(0, 0), (22, 3), (45, 0), (0, -15)])
@pytest.mark.parametrize(
    "values", [{"jaw.rotation": 4}, {"jaw.rotation": 10}, {"jaw.rotation": 5, "mouth.pucker": 0.5}]
)
def test_nothing_of_the_mouth_shows_between_shut_lips(yaw, pitch, values):
    scene = replace(Scene(size_px=(300, 220)), at=(0.0, -0.067, 0.08)).turned(yaw, pitch, 0.3)

    def seen(more):
        pixels = draw(HEAD, REST.replace({**INSIDE, **values, **more}), scene).astype(int)
        return int(((pixels[..., 1] > pixels[..., 0] + 25) & (pixels[..., 1] > pixels[..., 2] + 25)).sum())

    assert seen({"mouth.closure": 1}) == 0
    assert seen({}) > 50


def test_a_full_tuck_brings_the_lower_lip_under_the_upper_front_teeth():
    moved = points({"mouth.tuck": -20, "jaw.rotation": 4})
    teeth = moved[HEAD._layout.span["teeth"]][~HEAD._layout.lower["teeth"]]
    front = teeth[np.abs(teeth[:, 0]) < 0.008]
    lip = moved[vertex("m0_9")]
    assert abs(lip[1] - front[:, 1].min()) < 0.003
    assert lip[2] < points({"jaw.rotation": 4})[vertex("m0_9"), 2] - 0.004


def test_the_upper_lip_rises_most_in_the_middle_and_not_at_the_corner():
    rise = (points({"mouth.upper_lip": 20}) - points({}))[:, 1]
    stations = [rise[vertex(f"m0_{station}")] for station in range(6)]
    assert stations[0] == pytest.approx(20 * 0.00016)
    assert (np.diff(stations[:5]) < 0).all()
    assert np.abs(stations[4:]).max() < 1e-9, "beside the corner the lips stick together"


def test_mouth_width_scales_the_lips_and_leaves_nose_and_ears():
    rest, wide = points({}), points({"mouth.width": 1.2})
    assert wide[vertex("m0_5"), 0] == pytest.approx(1.2 * rest[vertex("m0_5"), 0], rel=1e-6)
    for name in ("n60", "p2", "d5", "e0_6"):
        assert np.abs(wide[vertex(name)] - rest[vertex(name)]).max() < 0.0004


def test_corner_moves_are_his_units_in_his_directions():
    moved = points(
        {"mouth.corner.up.left": 25, "mouth.corner.side.left": 10, "mouth.corner.forward.left": -5}
    ) - points({})
    np.testing.assert_allclose(moved[vertex("m0_5")], np.array([10, 25, -5]) * 0.00016, rtol=0.06)
    right = archive().mirror[vertex("m0_5")]
    assert np.abs(moved[right]).max() == 0.0


def test_weights_of_the_mouth_leave_the_rest_of_the_head_alone():
    measured = archive().measured("cage")
    regions = mouth_regions(archive(), measured)
    for weight in (regions.around, regions.lips, *regions.corner, regions.upper, regions.tuck):
        assert weight.min() >= 0.0
        assert weight.max() <= 1.0
        assert weight[vertex("s5_0")] == 0.0
        assert weight[vertex("e0_3")] == 0.0


@pytest.mark.parametrize("name", MIRRORED_ROWS)
def test_one_side_alone_leaves_the_midline_unless_its_row_says_otherwise(name):
    row = HEAD.parameters[f"{name}.left"]
    moved = 0.0
    for value in (row.low, row.high):
        delta = points({f"{name}.left": value}) - points({})
        middle = np.flatnonzero(np.abs(archive().floats("cage")[:, 0]) < 1e-9)
        moved = max(moved, 1000.0 * float(np.abs(delta[middle]).max()))
    if "midline" in row.doc:
        said = float(row.doc.split("up to ")[1].split(" mm")[0])
        assert 0.1 < moved <= said
    else:
        assert moved < 0.1


def test_a_smile_raises_the_corners_and_bares_no_teeth_by_itself():
    smiling = points({"mouth.expression": 0.3}) - points({})
    assert smiling[vertex("m0_5"), 1] > 0.003
    assert smiling[vertex("m0_5"), 0] > 0.002


def test_the_tongue_rises_at_its_tip_only():
    span = HEAD._layout.span["tongue"]
    moved = (points({"tongue.raise": 1}) - points({}))[span]
    assert moved[:, 1].max() > 0.009
    assert moved[-1, 1] == 0.0
