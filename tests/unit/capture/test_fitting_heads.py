"""Heads of people from points, their files, and points that are wrong."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from breaking import eyes_shown, mouth_shown, resting_mouth_shown
from mien.capture.fitting import FittedHead, fit_head, write_head
from mien.capture.fitting_field import Placing, turn_by
from mien.capture.fitting_people import population
from mien.capture.fitting_places import find_place, known_places, weights_of
from mien.core import MienError, UnknownNameError
from mien.faces import load_face
from mien.faces.head.head import Head
from mien.faces.head.measured import archive
from soundness import Posed

NAMES = [name for name in known_places() if name.startswith("ibug_")] + ["tragion_L", "tragion_R", "vertex"]
ROWS = population().rows
STANDING = Placing(turn_by(np.array([0.0, 0.7, 0.1])), np.array([0.1, 1.6, -0.3]))
SPECIAL = ROWS.mean + 1.5 * ROWS.modes[0] + ROWS.modes[3] + ROWS.modes[42]


def measured(moves: np.ndarray = SPECIAL, names: list[str] = NAMES) -> dict[str, np.ndarray]:
    """Points of a person, as they stand in the room."""
    places = weights_of([find_place(name) for name in names], len(ROWS.points)) @ (ROWS.points + moves)
    return dict(zip(names, STANDING.to_world(places), strict=True))


@pytest.fixture(scope="module")
def fitted() -> FittedHead:
    return fit_head(measured(), 2e-4)


def test_the_head_becomes_the_person(fitted):
    head = fitted.head()
    skin = head.shape(head.neutral).points[: len(ROWS.points) - 2]
    face = np.unique([row for name in NAMES for row in find_place(name).rows])
    missed = np.linalg.norm((skin - (ROWS.points + SPECIAL)[:-2])[face], axis=1)
    assert np.sqrt((missed**2).mean()) < 0.0008
    assert fitted.rms_m < 0.0005
    assert not fitted.suspects
    assert not fitted.remarks


def test_its_eyes_are_where_the_person_has_them(fitted):
    head = fitted.head()
    points = head.shape(head.neutral).points
    wanted = (ROWS.points + SPECIAL)[-2:]
    for side, centre in zip(("left", "right"), wanted, strict=True):
        ball = points[head._layout.span[f"eye.{side}"]]
        # The ball of the parts is bounded by a plane behind; its front is as far as its radius.
        assert abs(ball[:, 0].mean() - centre[0]) < 0.002
    assert 0.85 < fitted.residual.eye_scale < 1.15


def test_its_lids_shut_and_its_lips_meet_though_its_sides_differ(fitted):
    assert np.abs(fitted.residual.cage - fitted.residual.cage[archive().mirror] * [-1, 1, 1]).max() > 0.0005
    posed = Posed(fitted.head(), fitted.head().neutral)
    assert eyes_shown(posed) == 0
    assert mouth_shown(posed) == 0
    assert resting_mouth_shown(posed) <= 5


def test_values_stay_within_their_ranges_and_some_are_away_from_rest(fitted):
    table = Head().parameters
    assert fitted.values
    for name, value in fitted.values.items():
        assert table[name].low <= value <= table[name].high


def test_files_are_the_same_bytes_each_time_and_load_as_the_same_head(fitted, tmp_path: Path):
    face, beside = write_head(fitted, tmp_path / "ann.face.json", choices={"name": "Ann", "hair": "crop"})
    assert beside is not None
    first = face.read_bytes(), beside.read_bytes()
    write_head(fitted, tmp_path / "ann.face.json", choices={"name": "Ann", "hair": "crop"})
    assert (face.read_bytes(), beside.read_bytes()) == first
    assert json.loads(first[0])["residual"] == "ann.residual.npz"
    loaded, own = load_face(str(face)), fitted.head("crop")
    np.testing.assert_array_equal(loaded.shape(loaded.neutral).points, own.shape(own.neutral).points)


def test_without_a_residual_there_is_one_file(tmp_path: Path):
    plain = fit_head(measured(), residual=False)
    assert plain.residual is None
    assert write_head(plain, tmp_path / "a.face.json")[1] is None
    assert [path.name for path in tmp_path.iterdir()] == ["a.face.json"]
    head = plain.head()
    assert np.isfinite(head.shape(head.neutral).points).all()


def test_another_ending_or_choice_writes_nothing(fitted, tmp_path: Path):
    with pytest.raises(MienError, match=r"try ann\.face\.json"):
        write_head(fitted, tmp_path / "ann.json")
    with pytest.raises(UnknownNameError, match="hair style 'crob'"):
        write_head(fitted, tmp_path / "ann.face.json", choices={"hair": "crob"})
    assert not list(tmp_path.iterdir())


def test_unknown_names_and_too_few_points_are_told():
    with pytest.raises(UnknownNameError, match="'pronasal' — did you mean 'pronasale'"):
        fit_head({**measured(), "pronasal": np.zeros(3)})
    with pytest.raises(MienError, match="at least 6 points, got 5"):
        fit_head(measured(names=NAMES[:5]))
    with pytest.raises(MienError, match="lie on a line"):
        fit_head({name: np.array([0.01 * k, 0.0, 0.0]) for k, name in enumerate(NAMES[:8])})
    with pytest.raises(MienError, match="'ibug_3': want three finite numbers"):
        fit_head({**measured(), "ibug_3": np.array([0.0, np.nan, 0.0])})
    with pytest.raises(MienError, match="'ibug_0': no covariance"):
        fit_head(measured(), {})


@pytest.mark.parametrize(("factor", "unit"), [(1000.0, "mm"), (100.0, "cm"), (1 / 0.0254, "inch")])
def test_points_in_another_unit_are_told_with_the_unit(factor, unit):
    with pytest.raises(MienError, match=f"seem to be in {unit}: say so with --unit {unit}"):
        fit_head({name: factor * place for name, place in measured().items()})


def test_a_size_that_no_unit_explains_is_told():
    with pytest.raises(MienError, match="look at the scale of the references"):
        fit_head({name: 5.0 * place for name, place in measured().items()})


def test_a_face_in_the_mirror_is_told():
    with pytest.raises(MienError, match="mirror image"):
        fit_head({name: place * [-1.0, 1.0, 1.0] for name, place in measured().items()})


def test_two_exchanged_points_are_named():
    points = measured()
    points["ibug_31"], points["ibug_48"] = points["ibug_48"], points["ibug_31"]
    with pytest.raises(MienError, match="'ibug_31' and 'ibug_48' seem to be exchanged"):
        fit_head(points)


def test_a_point_beside_the_face_takes_no_part():
    points = measured()
    points["ibug_8"] = points["ibug_8"] + [0.02, 0.0, 0.02]
    found = fit_head(points, residual=False)
    assert found.suspects == ("ibug_8",)
    assert "ibug_8" in found.remarks[0]


def test_an_open_mouth_is_remarked():
    head = Head(hair="bald")
    rest, opened = (head.shape(head.neutral.replace({"jaw.rotation": angle})).points for angle in (0.0, 12.0))
    count = len(ROWS.points) - 2
    moves = ROWS.mean.copy()
    moves[:count] += (opened - rest)[:count]
    found = fit_head(measured(moves), residual=False)
    assert any("mouth seems to be open by 1" in remark for remark in found.remarks)
