import numpy as np
import pytest

from mien.faces.toon.lines import Moment, Stretch, Track, activation, profile_weights, rest_of, resting_share
from mien.faces.toon.motors import motors, paper_codes
from mien.faces.toon.records import Limits, Line, Profile
from toons import extended, face_of, small


def moment_of(face, **shares):
    return Moment(face.character, {**rest_of(face.character).shares, **shares})


def test_there_are_his_21_motors_with_his_numbers():
    assert len(paper_codes()) == 21
    assert paper_codes()[:3] == ("BRL", "BRC", "BRM")
    numbers = {motors()[code].number for code in paper_codes()}
    assert numbers == set(range(1, 18)) - {11}
    assert motors()["PLH"].aliases == ("PLH", "15-0", "15-H")
    assert motors()["HV"].aliases == ("HV", "17-1", "17-V")


@pytest.mark.parametrize(("share", "value"), [(0.25, 0.0), (0.0, -1.0), (1.0, 1.0), (0.125, -0.5), (0.625, 0.5)])
def test_the_share_of_the_way_from_rest_to_a_limit(share, value):
    limits = Limits(-5.0, 15.0)
    assert resting_share("BRL", limits) == 0.25
    assert activation("BRL", limits, share) == value


def test_a_motor_moves_its_point_between_its_limits():
    face = face_of(small())
    assert moment_of(face, BRC=1.0).points["BRC"] == (60.0, 45.0)
    assert moment_of(face, BRC=0.0).points["BRC"] == (60.0, 65.0)
    assert moment_of(face, BRC=0.5).points["BRC"] == (60.0, 55.0)  # -5 + 0.5 * 20 up
    assert moment_of(face, MRH=1.0).points["MR"] == (60.0, 140.0)
    assert moment_of(face, MLH=1.0).points["ML"] == (140.0, 140.0)
    assert moment_of(face, MB=1.0).points["MB"] == (100.0, 178.0)


def test_pupils_go_by_the_sine_of_their_degrees():
    face = face_of(small())
    assert moment_of(face, PRH=30.0).points["PR"] == (54.0, 90.0)  # to the left as seen
    x, y = moment_of(face, PRV=15.0).points["PR"]
    assert x == 60.0
    assert y == pytest.approx(90.0 - 6.0 * np.sin(np.radians(15)) / np.sin(np.radians(30)))
    assert moment_of(face, PLH=-30.0).points["PL"] == (146.0, 90.0)


def test_straight_lines_run_from_point_to_point():
    face = face_of(small())
    track = Track(face.character.features["BR"], np.array([-1.0, -0.5, 0.0, 0.5, 1.0]))
    now = track.points(moment_of(face, BRL=0.0), lower=False)
    np.testing.assert_allclose(now, [[40, 65], [50, 62.5], [60, 60], [70, 60], [80, 60]])


def test_a_line_of_upright_pieces_is_where_its_points_are():
    document = small()
    document["features"]["BR"]["points"] = {"BRL": [60, 40], "BRC": [60, 60], "BRM": [60, 80]}
    face = face_of(document)
    track = Track(face.character.features["BR"], np.array([-1.0, -0.5, 0.0, 0.5, 1.0]))
    np.testing.assert_allclose(
        track.points(rest_of(face.character), lower=False), [[60, 40], [60, 50], [60, 60], [60, 70], [60, 80]]
    )


def test_profiles():
    s = np.array([0.0, 0.5, 1.0])
    assert profile_weights(Profile(1, 1), s).tolist() == [1.0, 0.5, 0.0]
    assert profile_weights(Profile(2, 1), s).tolist() == [1.0, 0.75, 0.0]
    np.testing.assert_allclose(profile_weights(Profile(2, 2), s), [1.0, 0.75**0.5, 0.0])
    np.testing.assert_allclose(profile_weights(Profile(2.2, 1.6), s), (1 - s**2.2) ** (1 / 1.6))


@pytest.mark.parametrize("lower_lid", [0.0, 0.1, 0.5, 1.0])
def test_a_lid_at_its_minimum_lies_on_the_lower_one_wherever_that_is(lower_lid):
    face = face_of(extended())
    moment = moment_of(face, ERU=0.0, ERL=lower_lid)
    assert moment.points["ERU"][1] == pytest.approx(moment.points["ERL"][1])
    assert moment.eye_opening("ER") == pytest.approx(0.0)


def test_lids_never_cross_and_their_points_go_one_way():
    face = face_of(extended())
    heights = [moment_of(face, ERU=share, ERL=0.0).points["ERU"][1] for share in np.linspace(0.0, 1.0, 50)]
    assert (np.diff(heights) < 0.0).all()
    for lower in np.linspace(0.0, 1.0, 11):
        points = moment_of(face, ERU=0.3, ERL=lower).points
        assert points["ERU"][1] <= points["ERL"][1]


def test_a_strict_lid_goes_where_the_paper_puts_it():
    face = face_of(small())
    assert moment_of(face, ERU=0.0, ERL=1.0).points["ERU"] == (60.0, 100.0)


@pytest.mark.parametrize("corner", [0.0, 0.3, 1.0])
def test_a_mouth_at_its_minimum_is_shut_whatever_its_corners_do(corner):
    document = extended()
    document["features"]["M"].update(profile=[2, 1], profile_open=[2.2, 1.6], shape=[[-1, 0], [0, 3], [1, 0]])
    face = face_of(document)
    moment = moment_of(face, MB=0.0, MLH=corner, MRV=corner, MLV=1.0 - corner)
    upper, lower = (Stretch(Line("M", low), face.character.features["M"]).points(moment) for low in (False, True))
    np.testing.assert_allclose(upper, lower, atol=1e-9)


def test_held_motors_hold():
    face = face_of(extended())
    line = Line("ER", at={"ERU": 1.0})
    stretch = Stretch(line, face.character.features["ER"])
    np.testing.assert_allclose(stretch.points(moment_of(face, ERU=0.0)), stretch.points(moment_of(face, ERU=0.9)))


def test_an_offset_shrinks_with_its_motor():
    face = face_of(extended())
    line = Line("M", offset=((0.0, 10.0),), offset_by=("MLH", 0.0))
    stretch = Stretch(line, face.character.features["M"])
    plain = Stretch(Line("M"), face.character.features["M"])
    for share, left in ((0.5, 10.0), (0.0, 0.0)):
        moment = moment_of(face, MLH=share)
        np.testing.assert_allclose(stretch.points(moment)[:, 1] - plain.points(moment)[:, 1], left, atol=1e-12)
