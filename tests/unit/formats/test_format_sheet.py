"""Contact sheets and labelled pages of any face."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from small_face import SmallFace, SmallRenderer

from mien.core import Drawing, MienError, Parameter, ParameterTable, Pose, Preset, Scene, UnknownNameError, color
from mien.faces import load_face
from mien.formats import face_sheets
from mien.formats.face_sheets import make_sheet, moving_rows, sheet_scene
from mien.formats.picture import Picture
from mien.formats.sheet import PAPER, Block, Page, Section, check_page, contact_sheet, set_sheet

SIZE = (64, 64)


class Renderer(SmallRenderer):
    """Paints values, and counts how often."""

    drawn = 0

    def draw(self, face: SmallFace, pose: Pose) -> np.ndarray:
        Renderer.drawn += 1
        return super().draw(face, pose)

    def close(self) -> None:
        pass


@pytest.fixture(autouse=True)
def _no_rasteriser(monkeypatch: pytest.MonkeyPatch) -> None:
    Renderer.drawn = 0
    monkeypatch.setattr(face_sheets, "Renderer", Renderer)


def scene(**more: object) -> Scene:
    return replace(Scene(size_px=SIZE), **more)  # type: ignore[arg-type]


def flat(number: int) -> np.ndarray:
    return np.full((*SIZE[::-1], 4), (10 * number, 0, 200, 255), dtype=np.uint8)


def page_of(*counts: int, captions: str = "caption") -> Page:
    """A page whose sections have so many blocks of one picture."""
    numbers = iter(range(100))
    sections = (
        Section(f"section {count}", tuple(Block(f"block {n}", "", (n,), (captions,)) for n in islice(numbers, count)))
        for count in counts
    )
    return Page("face", "remark", tuple(sections))


def squares(picture: Picture, value: tuple[int, ...]) -> list[tuple[int, int, int, int]]:
    """Where pixels of one colour are: left, top, right, bottom."""
    rows, columns = np.nonzero((picture.pixels == value).all(axis=2))
    return [(int(columns.min()), int(rows.min()), int(columns.max()) + 1, int(rows.max()) + 1)] if len(rows) else []


def test_every_picture_is_on_the_page_whole_and_once() -> None:
    page = page_of(5, 2)
    picture = set_sheet(page, SIZE, flat, {})
    places = [squares(picture, (10 * number, 0, 200, 255))[0] for number in range(7)]
    assert all((right - left, bottom - top) == SIZE for left, top, right, bottom in places)
    assert len(set(places)) == 7
    assert places[0][0] == places[5][0], "sections begin at the same margin"
    assert picture.size_px == check_page(page, SIZE)


def test_nothing_is_printed_over_a_picture_or_over_the_edge() -> None:
    picture = set_sheet(page_of(3, captions="a long caption that has to be set in several lines"), SIZE, flat, {})
    for number in range(3):
        assert ((picture.pixels == (10 * number, 0, 200, 255)).all(axis=2)).sum() == SIZE[0] * SIZE[1]
    border = np.concatenate([picture.pixels[:5].reshape(-1, 4), picture.pixels[-5:].reshape(-1, 4)])
    assert (border == PAPER).all()


def test_transparent_pictures_show_the_paper() -> None:
    picture = set_sheet(page_of(1), SIZE, lambda _: np.zeros((64, 64, 4), dtype=np.uint8), {})
    assert (picture.pixels[:, :, 3] == 255).all()


def test_a_page_without_anything_and_one_too_large_are_refused() -> None:
    with pytest.raises(MienError, match="nothing to show"):
        check_page(Page("face", "", (Section("", ()),)), SIZE)
    with pytest.raises(MienError, match=r"at most 16384 a side .* try --size (\d+)") as caught:
        check_page(page_of(60), (2048, 2048))
    size = int(str(caught.value).rsplit(" ", 1)[1])
    assert max(check_page(page_of(60), (size, size))) <= 16384


def test_presets_are_there_by_kind_from_the_pose_that_is_given() -> None:
    face = SmallFace()
    sheet = make_sheet(face, "presets", Pose.neutral(face.parameters).replace({"eyelid.opening": 1.0}), scene())
    agape = (191, 255, 255, 255)
    rosy = (0, 255, 255, 255)
    assert Renderer.drawn == 2
    assert squares(sheet, agape)
    assert squares(sheet, rosy)
    assert squares(sheet, rosy)[0][1] >= squares(sheet, agape)[0][1], "palettes follow expressions"
    assert sheet.notes["Title"] == "small: presets"


def test_parameters_stand_at_both_ends_beside_rest_and_rest_is_drawn_once() -> None:
    reports: list[tuple[int, int]] = []
    face = SmallFace()
    make_sheet(face, "parameters", None, scene(), report=lambda done, total: reports.append((done, total)))
    # At rest; the jaw at 20; lids at 0 and 1; the colour at 0 and 1.
    assert Renderer.drawn == 6
    assert reports == [(done, 6) for done in range(7)]


def test_sides_and_channels_move_together_and_what_the_scene_fills_is_left_out() -> None:
    table = ParameterTable(
        (
            Parameter("lid.left", 0, 1),
            Parameter("lid.right", 0, 1),
            *color("skin.color", (0.1, 0.2, 0.3)),
            Parameter("stop.red", 0, 1),
            *(Parameter(f"{what}.{axis}", -1, 1) for what in ("light", "viewer", "target") for axis in "xyz"),
        )
    )
    assert moving_rows(table) == {
        "lid": ("lid.left", "lid.right"),
        "skin.color": ("skin.color.red", "skin.color.green", "skin.color.blue"),
        "stop.red": ("stop.red",),
    }


def test_views_are_all_different() -> None:
    make_sheet(SmallFace(), "views", None, scene())
    assert Renderer.drawn == len(face_sheets.VIEWS) >= 8
    usual = sheet_scene("views", SmallFace())
    assert len({usual.turned(yaw, pitch).position for _, yaw, pitch in face_sheets.VIEWS}) == len(face_sheets.VIEWS)


def test_views_of_a_flat_face_are_refused() -> None:
    class FlatFace(SmallFace):
        def shape(self, pose: Pose) -> Drawing:
            return Drawing((1.0, 1.0), ())

    with pytest.raises(MienError, match="looks the same from everywhere"):
        make_sheet(FlatFace(), "views", None, scene())


def test_a_face_without_presets_is_told_so() -> None:
    with pytest.raises(MienError, match="nothing to show"):
        make_sheet(SmallFace(presets={}), "presets", None, scene())


def test_a_vocabulary_is_drawn_name_by_name_with_what_it_needs() -> None:
    face = load_face("head")
    sections = face_sheets._names("arkit", face, face.neutral, scene(), shots := face_sheets._Shots())
    poses = [shot.pose for shot in shots.all]
    assert sum(len(section.blocks) for section in sections) == len(poses) == 52
    assert face.neutral.replace({"jaw.rotation": 20.0, "mouth.closure": 1.0}) in poses
    sections = face_sheets._names("facs", face, face.neutral, scene(), shots := face_sheets._Shots())
    blocks = {block.name: block for section in sections for block in section.blocks}
    assert blocks["AU12"].captions == ("The corner of the mouth goes up and back.",)
    assert shots.all[blocks["AU12"].pictures[0]].pose.changed() == dict.fromkeys(
        ("mouth.expression.left", "mouth.expression.right"), 0.0
    )


def test_a_face_of_another_family_has_no_sheet_of_names() -> None:
    with pytest.raises(MienError, match="cannot play"):
        make_sheet(SmallFace(), "facs", None, scene())


def test_an_unknown_kind_is_refused_with_the_near_one() -> None:
    with pytest.raises(UnknownNameError, match=r"unknown sheet 'preset' — did you mean 'presets'"):
        make_sheet(SmallFace(), "preset")


def test_names_of_any_length_and_letters_can_be_set(tmp_path: Path) -> None:
    names = ["", "Ł", "x" * 300, "two words", "日本"]
    presets = {name: Preset(name, "", {"jaw.rotation": k}, name * 3) for k, name in enumerate(names)}
    make_sheet(SmallFace(presets=presets), "presets", None, scene()).write(tmp_path / "a.jpg")
    with Image.open(tmp_path / "a.jpg") as image:
        assert image.format == "JPEG"


def test_the_same_sheet_has_the_same_bytes() -> None:
    first, second = (make_sheet(SmallFace(), "parameters", None, scene()).to_png() for _ in range(2))
    assert first == second


def test_a_contact_sheet_has_its_pictures_in_rows() -> None:
    picture = contact_sheet([Picture(flat(number)) for number in range(3)], 2, ["a", "b", "c"])
    assert squares(picture, (20, 0, 200, 255)) == [(0, 86, 64, 150)]
    with pytest.raises(MienError, match="2 labels for 3 pictures"):
        contact_sheet([Picture(flat(0))] * 3, 2, ["a", "b"])
