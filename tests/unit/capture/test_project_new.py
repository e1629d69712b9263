"""A new project: what names of photographs tell, and what is written where."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image

from mien.capture.project import read_project, read_survey
from mien.capture.project_new import begin_project, guess_photographs
from mien.capture.records import REST
from mien.core import LoadError, MienError


def photos(folder: Path, *names: str, size: tuple[int, int] = (40, 30)) -> list[Path]:
    folder.mkdir(exist_ok=True)
    paths = [folder / name for name in names]
    for number, path in enumerate(paths):
        Image.new("RGB", size, (60 * number, 0, 0)).save(path)
    return paths


@pytest.mark.parametrize(
    ("names", "wanted"),
    [
        (["neutral-1.jpg", "neutral-2.jpg"], [("neutral", "a"), ("neutral", "a")]),
        (["neutral-1.jpg", "smile-1.jpg", "smile-2.jpg"], [("neutral", "a"), ("smile", "a"), ("smile", "b")]),
        (["smile_left.png", "open_left.png", "open right.png"], [("smile", "a"), ("open", "a"), ("open", "b")]),
        (["brows up (2).jpg", "brows up (3).jpg"], [("brows up", "a"), ("brows up", "a")]),
        (["smileA.jpg", "smileB.jpg"], [("smile", "a"), ("smile", "a")]),
        (["IMG_0012.jpg", "IMG_0013.jpg"], [(REST, "a"), (REST, "a")]),
        (["DSC00123.jpg", "P1010001.jpg", "20211103.jpg"], [(REST, "a")] * 3),
        (["smile.jpg", "smile-b.jpg"], [("smile", "a"), ("smile", "a")]),
        (["left01.jpg", "right01.jpg", "left02.jpg"], [("moment-01", "a"), ("moment-01", "b"), ("moment-02", "a")]),
        (["cam1_07.jpg", "cam2_07.jpg", "cam12.jpg"], [("moment-07", "a"), ("moment-07", "b"), ("cam", "c")]),
        (["Grace.jpg"], [("Grace", "a")]),
        (["front.jpg", "side.jpg"], [(REST, "a"), (REST, "a")]),
        (["smile.jpg", "open.jpg"], [("smile", "a"), ("open", "a")]),
    ],
)
def test_names_tell_moments_and_views(tmp_path: Path, names: list[str], wanted: list[tuple[str, str]]) -> None:
    found = guess_photographs(photos(tmp_path, *names))
    assert [(each.moment, each.camera) for each in found] == wanted
    assert {each.size_px for each in found} == {(40, 30)}


def test_pictures_of_other_sizes_have_another_lens(tmp_path: Path) -> None:
    paths = photos(tmp_path, "a-1.jpg") + photos(tmp_path, "a-2.jpg", size=(30, 40)) + photos(tmp_path, "a-3.jpg")
    assert [each.camera for each in guess_photographs(paths)] == ["a", "b", "a"]


def test_a_new_folder_gets_copies(tmp_path: Path) -> None:
    paths = photos(tmp_path / "card", "smile-1.jpg", "smile-2.jpg")
    folder = tmp_path / "anna"
    begin_project(folder, paths, unit="inch", cube_m=0.254)
    assert (folder / "photographs" / "smile-1.jpg").read_bytes() == paths[0].read_bytes()
    assert (folder / "references.csv").read_text().splitlines()[:3] == [
        "point,x,y,z,sigma,target",
        "cube-000,0,0,0,,",
        "cube-001,0,0,10,,",
    ]
    project = read_project(folder)
    assert (project.name, project.unit) == ("anna", "inch")
    assert [photo.path for photo in project.photographs] == [
        folder / "photographs" / "smile-1.jpg", folder / "photographs" / "smile-2.jpg",
    ]  # fmt: skip
    survey = read_survey(folder)
    assert len(survey.references) == 8
    toml = (folder / "project.toml").read_text()
    board = toml[toml.index("# [[board]]") :].replace("# ", "")
    (folder / "project.toml").write_text(toml + board)
    assert read_project(folder).boards[0].corners == (9, 6)
    assert survey.references[-1].x == pytest.approx(0.254)
    assert survey.observations == ()
    assert (folder / "project.toml").read_text().startswith("# What is measured on these photographs goes into points")


def test_a_folder_with_the_photographs_is_filled(tmp_path: Path) -> None:
    paths = photos(tmp_path / "anna", "front.jpg", "side.jpg")
    (tmp_path / "anna" / "points.csv").write_text("photo,point,u,v\nfront.jpg,nose,3,4\n")
    begin_project(tmp_path / "anna", paths, pair=True)
    project = read_project(tmp_path / "anna")
    assert project.pair is not None
    hints = (tmp_path / "anna" / "project.toml").read_text().replace("# scale", "scale").replace("# mid", "mid")
    (tmp_path / "anna" / "project.toml").write_text(hints.replace("# camera_dist", "camera_dist"))
    project = read_project(tmp_path / "anna")
    assert project.pair is not None
    assert project.pair.scale == ("exocanthion.left", "tragion.left", pytest.approx(0.092))
    assert (project.pair.front, project.pair.side) == ("front.jpg", "side.jpg")
    assert not (tmp_path / "anna" / "references.csv").exists()
    assert len(read_survey(tmp_path / "anna").observations) == 1
    with pytest.raises(MienError, match="there is a project already"):
        begin_project(tmp_path / "anna", paths)


def test_what_cannot_be_begun(tmp_path: Path) -> None:
    paths = photos(tmp_path / "card", "front.jpg", "side.jpg", "more.jpg")
    (tmp_path / "anna").mkdir()
    with pytest.raises(MienError, match=r"front\.jpg does not lie in it — give a new folder"):
        begin_project(tmp_path / "anna", paths)
    with pytest.raises(MienError, match="a pair is a front and a side photograph, in that order, got 3"):
        begin_project(tmp_path / "bea", paths, pair=True)
    with pytest.raises(MienError, match="two photographs are called front"):
        begin_project(tmp_path / "bea", [paths[0], paths[0]])
    paths[1].write_bytes(b"")
    with pytest.raises(LoadError, match=r"side\.jpg: is empty"):
        begin_project(tmp_path / "bea", paths)
    with pytest.raises(MienError, match="is a file — give the name of a folder"):
        begin_project(paths[0], [paths[0]])
    assert sorted(path.name for path in tmp_path.iterdir()) == ["anna", "card"]
    assert list((tmp_path / "anna").iterdir()) == []
