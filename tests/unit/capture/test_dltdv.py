"""Files of DLTdv and Argus, and what they mean in ours."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from project_folders import make_folder, make_solution, photograph, turned

from mien.capture.dltdv import (
    ORIGINS,
    coefficients,
    format_clicks,
    format_coefficients,
    format_names,
    format_places,
    names_file,
    read_clicks,
    to_pixels,
    views,
)
from mien.capture.exchanging import add_points, export
from mien.capture.project import read_project, write_solution
from mien.capture.records import Camera, Lens, Observation, SolvedPoint, Survey
from mien.core import LoadError, MienError, UnknownNameError

PHOTOS = (
    photograph("s1.jpg", "a"),
    photograph("s2.jpg", "b"),
    photograph("o1.jpg", "a", "open"),
    photograph("o2.jpg", "b", "open"),
)
TEXT = """\
pt1_cam1_X,pt1_cam1_Y,pt1_cam2_X,pt1_cam2_Y,pt2_cam1_X,pt2_cam1_Y,pt2_cam2_X,pt2_cam2_Y
1,1,400,300,NaN,NaN,10,20
NaN,NaN,NaN,NaN,30.5,40.5,NaN,NaN
NaN,NaN,NaN,NaN,NaN,NaN,NaN,NaN
"""


def written(folder: Path, text: str, name: str = "trial_xypts.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_the_middle_of_the_first_pixel_is_one(tmp_path: Path) -> None:
    path = written(tmp_path, TEXT)
    assert read_clicks(path, PHOTOS) == (
        Observation("s1.jpg", "pt1", 0.5, 0.5),
        Observation("s2.jpg", "pt1", 399.5, 299.5),
        Observation("s2.jpg", "pt2", 9.5, 19.5),
        Observation("o1.jpg", "pt2", 30.0, 40.0),
    )
    lower = read_clicks(path, PHOTOS, origin="lower-left")
    assert [(each.u, each.v) for each in lower] == [(0.5, 299.5), (399.5, 0.5), (9.5, 280.5), (30.0, 260.0)]


def test_argus_spells_columns_otherwise(tmp_path: Path) -> None:
    path = written(tmp_path, "Track 1_cam_1_x,Track 1_cam_1_y\n\nnan,\n5,6\n")
    assert read_clicks(path, PHOTOS) == (Observation("o1.jpg", "Track 1", 4.5, 5.5),)


def test_rows_of_a_film_that_are_moments(tmp_path: Path) -> None:
    rows = ["pt1_cam2_X,pt1_cam2_Y", *(f"{row},{row}" for row in range(1, 101))]
    path = written(tmp_path, "\n".join(rows))
    found = read_clicks(path, PHOTOS, frames=[12, 90], names=["nose"])
    assert found == (Observation("s2.jpg", "nose", 11.5, 11.5), Observation("o2.jpg", "nose", 89.5, 89.5))
    with pytest.raises(LoadError, match=r"trial_xypts\.csv:4: row 3 has clicks, and the project has 2 moments"):
        read_clicks(path, PHOTOS)
    with pytest.raises(LoadError, match="has 100 rows, and row 101 is wanted"):
        read_clicks(path, PHOTOS, frames=[1, 101])


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("x,y\n", ":1: column 1: want a name as pt1_cam1_X, got 'x'"),
        ("pt1_cam3_X,pt1_cam3_Y\n", ":1: column 1: 'pt1_cam3_X' is of camera 3, and the project has 2"),
        ("pt1_cam1_X,pt1_cam2_Y\n", ":1: want one X and one Y of pt1 in camera 1"),
        ("pt1_cam1_X,pt1_cam1_Y,pt1_cam1_X\n", ":1: want one X and one Y of pt1 in camera 1"),
        ("pt1_cam1_X,pt1_cam1_Y\n1\n", ":2: want 2 cells, got 1"),
        ("pt1_cam1_X,pt1_cam1_Y\n1,NaN\n", ":2: pt1 in camera 1 has one of X and Y only"),
        ("pt1_cam1_X,pt1_cam1_Y\n1,one\n", ":2: pt1 in camera 1: want a number or NaN, got 'one'"),
        ("pt1_cam1_X,pt1_cam1_Y\n1,301.6\n", ":2: point 'pt1' at 0.5, 301.1 lies outside of s1.jpg"),
    ],
)
def test_mistakes_are_told_with_their_line(tmp_path: Path, text: str, wanted: str) -> None:
    with pytest.raises(LoadError) as caught:
        read_clicks(written(tmp_path, text), PHOTOS)
    assert wanted in str(caught.value)


def test_one_camera_that_was_carried_about_counts_by_photographs() -> None:
    carried = [photograph(f"{number}.jpg", "a", moment) for number, moment in enumerate(["s", "s", "o", "s", "o"])]
    found = views(carried)
    assert (found.moments, found.cameras) == (("s", "o"), 3)
    assert {key: photo.name for key, photo in found.photographs.items()} == {
        (0, 0): "0.jpg", (0, 1): "1.jpg", (1, 0): "2.jpg", (0, 2): "3.jpg", (1, 1): "4.jpg",
    }  # fmt: skip
    missing = views([photograph("1.jpg", "a", "s"), photograph("2.jpg", "b", "s"), photograph("3.jpg", "b", "o")])
    assert missing.photographs[1, 1].name == "3.jpg"


POINTS = st.dictionaries(
    st.tuples(st.sampled_from([photo.name for photo in PHOTOS]), st.sampled_from(["nose", "chin, left", 'a"b'])),
    st.tuples(st.floats(0.0, 400.0), st.floats(0.0, 300.0)),
    min_size=1,
)


@given(POINTS, st.sampled_from(ORIGINS))
def test_clicks_come_back_with_their_names(tmp_path_factory: pytest.TempPathFactory, points: dict, origin: str) -> None:
    folder = tmp_path_factory.mktemp("dltdv")
    clicks = [Observation(*key, *place) for key, place in points.items()]
    path = written(folder, format_clicks(clicks, PHOTOS, origin=origin))
    names_file(path).write_text(format_names(list(dict.fromkeys(each.point for each in clicks))), encoding="utf-8")
    found = {(each.photo, each.point): (each.u, each.v) for each in read_clicks(path, PHOTOS, origin=origin)}
    assert found.keys() == points.keys()
    for key, place in points.items():
        assert found[key] == pytest.approx(place, abs=1e-6)


@pytest.mark.parametrize("origin", ORIGINS)
@pytest.mark.parametrize("metres", [1.0, 0.001])
def test_coefficients_see_places_where_the_camera_does(origin: str, metres: float) -> None:
    camera = Camera(Lens(800.0, (210.0, 140.0), aspect=1.1), turned(0.4), np.array([0.5, 0.1, 1.2]))
    found = coefficients(camera, 300, metres, origin)
    place = np.array([0.03, -0.05, 0.02])
    x, y, z = camera.rotation @ (place - camera.place)
    u, v = 800.0 * x / z + 210.0, 880.0 * y / z + 140.0
    top = found[:8].reshape(2, 4) @ [*place / metres, 1.0]
    bottom = found[8:] @ (place / metres) + 1.0
    np.testing.assert_allclose(top / bottom, to_pixels(u, v, 300, origin), atol=1e-9)


def test_coefficients_do_not_exist_where_the_origin_lies_beside_the_camera() -> None:
    camera = Camera(Lens(800.0, (200.0, 150.0)), turned(0.0), np.array([0.5, 0.0, 0.0]))
    with pytest.raises(MienError, match="move the origin into the middle of the references"):
        coefficients(camera, 300, 1.0)


def test_cameras_and_points_of_a_solution(tmp_path: Path) -> None:
    point = SolvedPoint("nose", "open", np.array([0.01, 0.02, 0.03]), np.eye(3) * 1e-8, ("o1.jpg", "o2.jpg"))
    solution = make_solution(Survey(PHOTOS, (), ()), [point])
    assert format_places(solution, ["nose", "chin"], 0.001).splitlines() == [
        "pt1_X,pt1_Y,pt1_Z,pt2_X,pt2_Y,pt2_Z",
        "NaN,NaN,NaN,NaN,NaN,NaN",
        "10,20,30,NaN,NaN,NaN",
    ]
    table = np.loadtxt(format_coefficients(solution, 0.001).splitlines(), delimiter=",")
    assert table.shape == (11, 2)
    np.testing.assert_allclose(table[:, 1], coefficients(solution.cameras["s2.jpg"], 300, 0.001), rtol=1e-12)


def test_clicks_are_added_to_a_project_and_not_written_over(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    file = written(tmp_path, "pt1_cam1_X,pt1_cam1_Y,pt1_cam2_X,pt1_cam2_Y\n11,21,31,41\n")
    before = (folder / "points.csv").read_text()
    with pytest.raises(
        LoadError, match=r"points\.csv:2: point 'nose' of front\.jpg is there already, at 200\.5, 150\.25"
    ):
        add_points(read_project(folder), file, names=["nose"])
    assert (folder / "points.csv").read_text() == before
    assert add_points(read_project(folder), file, names=["chin"]) == (2, ["chin"])
    assert (folder / "points.csv").read_text().splitlines() == [
        "photo,point,u,v,sigma",
        "front.jpg,chin,10.5,20.5,",
        "front.jpg,nose,200.5,150.25,",
        "left.jpg,chin,30.5,40.5,",
        "left.jpg,nose,180,150,0.5",
    ]
    add_points(read_project(folder), file, names=["nose"], replace_points=True)
    assert "front.jpg,nose,10.5,20.5," in (folder / "points.csv").read_text()
    with pytest.raises(UnknownNameError, match="did you mean 'lower-left'"):
        add_points(read_project(folder), file, origin="lower left")
    with pytest.raises(MienError, match="want as many rows as the project has moments, got 2"):
        add_points(read_project(folder), file, frames=[1, 2])


def test_the_name_of_a_file_tells_what_to_export(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    assert len(export(folder, tmp_path / "anna_xypts.csv")) == 2
    assert (tmp_path / "anna_pointnames.csv").read_text() == "point,name\npt1,nose\n"
    assert (tmp_path / "anna_xypts.csv").read_text().splitlines()[1] == "201,150.75,180.5,150.5"
    with pytest.raises(LoadError, match="there is no solution — find it first: mien capture solve"):
        export(folder, tmp_path / "anna_dltCoefs.csv")
    project = read_project(folder)
    point = SolvedPoint("nose", "smile", np.array([0.01, 0.02, 0.03]), np.eye(3) * 1e-8, ("front.jpg", "left.jpg"))
    write_solution(folder, make_solution(Survey(project.photographs, (), ()), [point]))
    (told,) = export(folder, tmp_path / "anna_dltCoefs.csv")
    assert told.endswith(
        "for lengths in mm; their lenses are taken for straight: the coefficients have no terms of distortion"
    )
    export(folder, tmp_path / "anna-xyzpts.csv")
    assert (tmp_path / "anna-xyzpts.csv").read_text() == "pt1_X,pt1_Y,pt1_Z\n10,20,30\n"
    with pytest.raises(MienError, match=r"want a name that ends in xypts\.csv"):
        export(folder, tmp_path / "anna.csv")


def test_points_have_the_numbers_of_their_clicks(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    (folder / "points.csv").write_text(
        "photo,point,u,v,sigma\nfront.jpg,chin,10,20,\nfront.jpg,nose,200.5,150.25,\nleft.jpg,nose,180,150,\n"
    )
    project = read_project(folder)
    points = [
        SolvedPoint(name, "smile", np.array([0.01, 0.02, 0.03]), np.eye(3) * 1e-8, ("front.jpg", "left.jpg"))
        for name in ("ear", "nose")
    ]
    write_solution(folder, make_solution(Survey(project.photographs, (), ()), points))
    export(folder, tmp_path / "anna_xypts.csv")
    export(folder, tmp_path / "anna_xyzpts.csv")
    assert (tmp_path / "anna_pointnames.csv").read_text() == "point,name\npt1,chin\npt2,nose\npt3,ear\n"
    assert (tmp_path / "anna_xyzpts.csv").read_text().splitlines()[1] == "NaN,NaN,NaN,10,20,30,10,20,30"
    clicks = read_clicks(tmp_path / "anna_xypts.csv", project.photographs)
    assert {(each.photo, each.point) for each in clicks} == {
        ("front.jpg", "chin"), ("front.jpg", "nose"), ("left.jpg", "nose"),
    }  # fmt: skip


def test_points_may_be_named_by_number_and_none_is_left_out(tmp_path: Path) -> None:
    file = written(tmp_path, "pt1_cam1_X,pt1_cam1_Y,pt2_cam1_X,pt2_cam1_Y\n11,21,31,41\n")
    names = written(tmp_path, "point,name\n1,nose\n2,chin\n", "trial_pointnames.csv")
    assert [each.point for each in read_clicks(file, PHOTOS)] == ["nose", "chin"]
    names.write_text("point,name\n1,nose\n")
    with pytest.raises(LoadError, match=r"trial_pointnames\.csv: does not name 'pt2' of trial_xypts\.csv — want"):
        read_clicks(file, PHOTOS)


def test_no_clicks_are_not_exported(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    (folder / "points.csv").write_text("photo,point,u,v,sigma\n")
    with pytest.raises(MienError, match="there are no clicks to export"):
        export(folder, tmp_path / "anna_xypts.csv")
    assert not (tmp_path / "anna_xypts.csv").exists()
