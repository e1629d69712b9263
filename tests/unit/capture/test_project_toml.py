"""project.toml: what it says, and what is told of mistakes in it."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.capture.project_records import METRES, Board, Pair, Project
from mien.capture.project_toml import DICTIONARIES, format_project, read_project_toml
from mien.capture.records import REST, Photograph
from mien.core import LoadError

BEGIN = 'format = "mien-capture"\nversion = 1\n'
PHOTO = '[[photograph]]\nfile = "{}"\nsize = [400, 300]\n'
TWO = PHOTO.format("front.jpg") + PHOTO.format("side.jpg")


def read(folder: Path, text: str) -> Project:
    (folder / "project.toml").write_text(text, encoding="utf-8")
    return read_project_toml(folder)


def test_all_of_it(tmp_path: Path) -> None:
    project = read(
        tmp_path,
        BEGIN + 'name = "anna"\ndoc = "Two."\nunit = "cm"\n'
        '[[photograph]]\nfile = "photographs/front.jpg"\nsize = [400, 300]\nmoment = "smile"\ncamera = "b"\n'
        "fixed = true\n"
        + PHOTO.format("side.jpg")
        + '[[board]]\nkind = "charuco"\ncolumns = 8\nrows = 6\nsquare = 3\nmarker = 2\ndictionary = "DICT_4X4_50"\n'
        'photographs = ["side.jpg"]\n[still]\npoints = ["nasion"]\n'
        '[pair]\nfront = "front.jpg"\nside = "side.jpg"\nscale = ["a", "b", 9.2]\n'
        'camera_distance = { "side.jpg" = 150, "front.jpg" = [160, 1] }\n'
        'side_from = "right"\n'
        'midline = ["nasion"]\nmirror = false\ntwins = { left = "right" }\n',
    )
    assert project == Project(
        tmp_path,
        "anna",
        (Photograph("front.jpg", (400, 300), "b", "smile", True), Photograph("side.jpg", (400, 300), "a", REST)),
        "Two.",
        "cm",
        (Board("board", "charuco", 8, 6, 0.03, 0.02, "DICT_4X4_50", ("side.jpg",)),),
        Pair("front.jpg", "side.jpg", ("a", "b", pytest.approx(0.092)),
             {"side.jpg": (1.5, 0.02), "front.jpg": (1.6, 0.01)}, False, ("nasion",), False,
             {"left": "right"}, "right"),
        ("nasion",),
    )  # fmt: skip


def test_what_may_be_left_out(tmp_path: Path) -> None:
    project = read(tmp_path, BEGIN + TWO)
    assert (project.name, project.unit, project.doc, project.boards) == (tmp_path.name, "mm", "", ())
    assert (project.pair, project.still, project.photographs[0].fixed) == (None, (), False)


@pytest.mark.parametrize(
    ("text", "line", "wanted"),
    [
        ("", None, "is empty"),
        ("format = 'mien\n", 1, "is not TOML"),
        ('version = 1\n[[photograph]]\nfile = "a.jpg"\n', None, "there is no 'format'"),
        ('format = "mien"\n', 1, "format: want 'mien-capture', got 'mien'"),
        ('format = "mien-capture"\nversion = 2\n', 2, "version: is 2, and this mien knows up to 1"),
        (BEGIN + 'unit = "ft"\n' + TWO, 3, "unit: unknown unit 'ft'"),
        (BEGIN, None, "there is no photograph"),
        (BEGIN + "photograph = 3\n", 3, "photograph: want tables that begin with [[photograph]], got 3"),
        (BEGIN + "[photograph]\n", 3, "photograph: want tables that begin with [[photograph]], got a table"),
        (BEGIN + "[[photograph]]\n", 3, "[photograph] there is no 'file'"),
        (BEGIN + PHOTO.format("front.jpg") * 2, 7, "[photograph] file: there are two photographs 'front.jpg'"),
        (BEGIN + TWO + 'momnet = "a"\n', 9, "[photograph] momnet: unknown key 'momnet' — did you mean 'moment'?"),
        (BEGIN + 'nmae = "a"\n' + TWO, 3, "nmae: unknown key 'nmae' — did you mean 'name'?"),
        (BEGIN + TWO + "fixed = 1\n", 9, "[photograph] fixed: want true or false, got 1"),
        (BEGIN + TWO + 'moment = ""\n', 9, "[photograph] moment: is empty"),
        (BEGIN + TWO + "camera = 2\n", 9, "[photograph] camera: want a text in double quotes, got 2"),
        (BEGIN + '[[photograph]]\nfile = "a.jpg"\nsize = [1, 2.0]\n', 5, "size: want [width, height] in pixels"),
        (BEGIN + '[[photograph]]\nfile = "a.jpg"\n', 4, "file: unknown file 'a.jpg'"),
        (BEGIN + TWO.replace("300", "200", 1), 6, "[photograph] camera: side.jpg is 400x300 pixels and front.jpg, of"),
        (BEGIN + TWO + '[pair]\nfront = "front.jpg"\nside = "sid.jpg"\n', 11, "did you mean 'side.jpg'"),
        (BEGIN + TWO + '[pair]\nfront = "side.jpg"\nside = "side.jpg"\n', 11, "is 'side.jpg', as the front is"),
        (BEGIN + TWO + '[pair]\nfront = "front.jpg"\n', 9, "[pair] there is no 'side'"),
        (BEGIN + TWO + '[[board]]\nkind = "chess"\n', 10, "did you mean 'chessboard'"),
        (BEGIN + TWO + '[[board]]\nkind = "chessboard"\ncolumns = 2\nrows = 9\n', 11, "want a number from 3 to 200"),
        (BEGIN + TWO + '[[board]]\nkind = "chessboard"\ncolumns = 8\nrows = 9\nsquare = nan\n', 13, "want a number"),
        (BEGIN + TWO + '[still]\npoints = ["a", 3]\n', 10, "points: want texts in brackets"),
        (BEGIN + TWO + '[still]\npoints = ["a", "a"]\n', 10, "points: has 'a' more than once"),
    ],
)  # fmt: skip
def test_mistakes_are_told_with_their_line_and_key(tmp_path: Path, text: str, line: int | None, wanted: str) -> None:
    with pytest.raises(LoadError) as caught:
        read(tmp_path, text)
    message = str(caught.value)
    place = f"{tmp_path / 'project.toml'}{f':{line}' if line else ''}: "
    assert message.startswith(place), message
    assert wanted in message
    assert "\n" not in message


SCALES = ['["a", "b"]', '["a", "b", 0]', '["a", 3, 92]', '["a", "a", 92]', '["a", "b", true]', '["a", "b", "92"]']


@pytest.mark.parametrize("scale", SCALES)
def test_a_scale_that_is_none(tmp_path: Path, scale: str) -> None:
    with pytest.raises(LoadError, match=r"project\.toml:12: \[pair\] scale: want two points"):
        read(tmp_path, f'{BEGIN}{TWO}[pair]\nfront = "front.jpg"\nside = "side.jpg"\nscale = {scale}\n')


def test_a_folder_that_is_none(tmp_path: Path) -> None:
    with pytest.raises(LoadError, match="there is no such folder — begin a project: mien capture new"):
        read_project_toml(tmp_path / "anna")
    with pytest.raises(LoadError, match=r"project\.toml: there is no such file — begin a project"):
        read_project_toml(tmp_path)


TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=["Cs"]), min_size=1, max_size=12)
NAMES = TEXTS.filter(lambda text: text.strip() and not set(text) & set('/\\:\0"') and text not in (".", ".."))
LENGTHS = st.floats(1e-3, 10.0)


@st.composite
def projects(draw: st.DrawFn) -> Project:
    names = draw(st.lists(NAMES, min_size=2, max_size=4, unique=True))
    photographs = tuple(Photograph(name, (400, 300), draw(NAMES), draw(NAMES), draw(st.booleans())) for name in names)
    board = Board("b", "charuco", 7, 5, 2.0 * draw(LENGTHS), 1e-3, draw(st.sampled_from(DICTIONARIES)), (names[0],))
    plain = Board("c", "chessboard", draw(st.integers(3, 40)), 9, draw(LENGTHS))
    midline = draw(st.lists(NAMES, max_size=3, unique=True))
    scale = draw(st.none() | st.tuples(st.just("p"), st.just("q"), LENGTHS))
    distances = {names[1]: (draw(LENGTHS), draw(LENGTHS))}
    pair = Pair(names[0], names[1], scale, distances, draw(st.booleans()), tuple(midline), draw(st.booleans()),
                draw(st.dictionaries(NAMES, NAMES, max_size=2)))  # fmt: skip
    return Project(Path(), draw(NAMES), photographs, draw(TEXTS), draw(st.sampled_from(sorted(METRES))),
                   draw(st.sampled_from([(), (board,), (board, plain)])), draw(st.none() | st.just(pair)),
                   tuple(midline))  # fmt: skip


@given(projects())
def test_a_project_comes_back_as_it_was_written(tmp_path_factory: pytest.TempPathFactory, project: Project) -> None:
    folder = tmp_path_factory.mktemp("project")
    found = read(folder, format_project(project))
    assert (found.name, found.doc, found.unit, found.still) == (project.name, project.doc, project.unit, project.still)
    assert found.photographs == project.photographs
    assert [(each.target, each.dictionary, each.photographs) for each in found.boards] == [
        (each.target, each.dictionary, each.photographs) for each in project.boards
    ]
    for board, wanted in zip(found.boards, project.boards, strict=True):
        assert (board.square_m, board.marker_m) == pytest.approx((wanted.square_m, wanted.marker_m), rel=1e-14)
    if project.pair is None:
        assert found.pair is None
        return
    assert found.pair is not None
    assert (found.pair.midline, found.pair.twins) == (project.pair.midline, project.pair.twins)
    assert found.pair.camera_distance_m.keys() == project.pair.camera_distance_m.keys()
    for name, told in project.pair.camera_distance_m.items():
        assert found.pair.camera_distance_m[name] == pytest.approx(told, rel=1e-14)
    if project.pair.scale is not None:
        assert found.pair.scale is not None
        assert found.pair.scale[2] == pytest.approx(project.pair.scale[2], rel=1e-14)
