"""Points of a head from tables and capture projects."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mien.capture.fitting_files import _from_solution, read_face, read_names
from mien.capture.records import Solution, SolvedPoint, Survey
from mien.core import LoadError, MienError, UnknownNameError


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def solution(*points: tuple[str, str, str]) -> Solution:
    """A solution of points (moment, name, kind), one millimetre exact."""
    found = {
        (moment, name): SolvedPoint(name, moment, np.array([0.0, 0.1, float(k)]), 1e-6 * np.eye(3), (), kind)
        for k, (moment, name, kind) in enumerate(points)
    }
    return Solution(Survey((), (), ()), {}, found, ())


def test_a_table_has_places_in_its_unit_and_sigmas(tmp_path: Path):
    path = write(tmp_path / "a.csv", "point,x,y,z,sigma\npronasale,1,2,3,0.5\nm0_5.right,-4,5,6,\n")
    face = read_face(path, unit="mm", sigma_m=0.002)
    np.testing.assert_allclose(face.points["pronasale"], [0.001, 0.002, 0.003])
    np.testing.assert_allclose(face.covariances["pronasale"], 0.25e-6 * np.eye(3))
    np.testing.assert_allclose(face.covariances["m0_5.right"], 4e-6 * np.eye(3))


def test_own_names_are_told_by_a_table_and_others_left_out(tmp_path: Path):
    names = read_names(write(tmp_path / "names.csv", "point,landmark\n12,pronasale\n13,cheilion_L\n"))
    path = write(tmp_path / "a.csv", "point,x,y,z\n12,0,0,0.1\nbead,9,9,9\n13,0.02,0,0.1\n")
    assert list(read_face(path, sigma_m=0.001, names=names).points) == ["pronasale", "cheilion_L"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("point,x,y,z\npronasal,0,0,0\n", r"a\.csv:2: unknown point of the head 'pronasal' — did you mean 'pronasale'"),
        ("point,x,y,z\nnasion,0,0,0\nnasion,0,0,0\n", r"a\.csv:3: point 'nasion' is there twice"),
        ("point,x,y,z,sigma\nnasion,0,0,0,-1\n", r"a\.csv:2: column 'sigma': want more than 0"),
        ("point,x,y\nnasion,0,0\n", "there is no column 'z'"),
        ("point,x,y,z\nnasion,0,0,far\n", r"a\.csv:2: column 'z': want a number, got 'far'"),
    ],
)
def test_what_is_wrong_with_a_table_is_told_with_its_line(text, message, tmp_path: Path):
    with pytest.raises(LoadError, match=message):
        read_face(write(tmp_path / "a.csv", text), sigma_m=0.001)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("point,landmark\n1,nasion\n2,nasion\n", "landmark 'nasion' is there twice"),
        ("point,landmark\n1,nasion\n1,sellion\n", "point '1' is there twice"),
        ("point,landmark\n1,nasior\n", "did you mean 'nasion'"),
        ("point,landmark\n", "names no point"),
    ],
)
def test_what_is_wrong_with_names_is_told(text, message, tmp_path: Path):
    with pytest.raises(LoadError, match=message):
        read_names(write(tmp_path / "names.csv", text))


def test_an_unknown_unit_and_a_moment_of_a_table_are_told(tmp_path: Path):
    path = write(tmp_path / "a.csv", "point,x,y,z\nnasion,0,0,0\n")
    with pytest.raises(UnknownNameError, match=r"unit 'mn' — did you mean .*'mm'"):
        read_face(path, unit="mn", sigma_m=0.001)
    with pytest.raises(MienError, match="a table has no moments"):
        read_face(path, sigma_m=0.001, moment="smile")


def test_a_solution_gives_its_neutral_moment_without_references_and_beads():
    found = solution(
        ("neutral", "nasion", "measured"),
        ("neutral", "bead 1", "measured"),
        ("neutral", "pronasale", "reference"),
        ("smile", "sellion", "measured"),
    )
    face = _from_solution(Path("anna"), found, None, "")
    assert list(face.points) == ["nasion"]
    np.testing.assert_array_equal(face.covariances["nasion"], 1e-6 * np.eye(3))
    assert face.remarks == ("1 points that are no places of a head took no part: bead 1",)
    assert list(_from_solution(Path("anna"), found, None, "smile").points) == ["sellion"]
    with pytest.raises(UnknownNameError, match="moment 'smil'"):
        _from_solution(Path("anna"), found, None, "smil")


def test_a_solution_whose_points_or_moments_say_nothing_is_told():
    with pytest.raises(MienError, match="say which is which in a table point,landmark"):
        _from_solution(Path("anna"), solution(("rest", "17", "measured")), None, "")
    with pytest.raises(MienError, match="which of the moments a, b is the neutral face"):
        _from_solution(Path("anna"), solution(("a", "nasion", "measured"), ("b", "nasion", "measured")), None, "")
