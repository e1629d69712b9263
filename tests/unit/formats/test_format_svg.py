"""Filled paths as SVG: places, holes, colours, backgrounds."""

from __future__ import annotations

import re
from pathlib import Path as FilePath
from xml.etree import ElementTree

import numpy as np
import pytest

from mien.core import Drawing, MienError, Path, Region, Scene
from mien.formats.notes import notes
from mien.formats.numbers import format_number
from mien.formats.svg import OVERLAP_PX, STOPS, VectorPicture

SPACE = "{http://www.w3.org/2000/svg}"
WHITE, CLEAR = (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 0.0)
OUTER = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
RING = Drawing((4.0, 4.0), (Path("ring", (OUTER, OUTER / 2 + 1), (1.0, 0.0, 0.0, 1.0)),))


def scene(**more: object) -> Scene:
    return Scene(**{"size_px": (100, 100), "background": (WHITE, WHITE), **more})  # type: ignore[arg-type]


def read(picture: VectorPicture) -> ElementTree.Element:
    return ElementTree.fromstring(picture.to_svg())


def outlines(element: ElementTree.Element) -> list[list[list[float]]]:
    """Contours of a path as points."""
    out = []
    for text in re.findall(r"M([^z]*)z", element.attrib["d"]):
        numbers = [float(number) for number in text.split()]
        out.append([list(pair) for pair in zip(numbers[::2], numbers[1::2], strict=True)])
    return out


def test_the_canvas_fills_the_picture_and_y_runs_down() -> None:
    (path,) = read(VectorPicture(RING, scene())).iter(f"{SPACE}path")
    assert outlines(path) == [
        [[0, 100], [100, 100], [100, 0], [0, 0]],
        [[25, 75], [75, 75], [75, 25], [25, 25]],
    ]


def test_a_canvas_of_another_shape_is_centred() -> None:
    (path,) = read(VectorPicture(RING, scene(size_px=(200, 100)))).iter(f"{SPACE}path")
    assert outlines(path)[0] == [[50, 100], [150, 100], [150, 0], [50, 0]]


def test_holes_are_holes_and_drawn_faces_have_no_lines() -> None:
    root = read(VectorPicture(RING, scene()))
    assert [group.attrib.get("fill-rule") for group in root.iter(f"{SPACE}g")] == ["evenodd", None]
    (path,) = root.iter(f"{SPACE}path")
    assert path.attrib["fill"] == "#ff0000"
    assert "stroke" not in path.attrib


def test_seams_of_polygons_are_covered_in_their_own_colour_and_thin_ones_thinly() -> None:
    thin = Path("lash", (np.array([[0.0, 0], [100, 0], [100, 0.1], [0, 0.1]]),), (0.0, 0.0, 0.0, 1.0))
    wide = Path("skin", (OUTER * 10,), (0.0, 0.0, 1.0, 1.0))
    first, second = read(VectorPicture(Drawing((100.0, 100.0), (thin, wide)), scene(), True)).iter(f"{SPACE}path")
    assert second.attrib["stroke"] == second.attrib["fill"] == "#0000ff"
    assert "stroke-width" not in second.attrib
    assert float(first.attrib["stroke-width"]) < 0.1


def test_wire_inks_every_edge() -> None:
    root = read(VectorPicture(RING, scene(shading="wire"), True))
    inked = [group.attrib["stroke"] for group in root.iter(f"{SPACE}g") if "stroke" in group.attrib]
    assert len(inked) == 1
    assert all("stroke" not in path.attrib for path in root.iter(f"{SPACE}path"))


def test_half_transparent_paths_say_so() -> None:
    faint = Drawing((4.0, 4.0), (Path("tear", (OUTER,), (0.0, 0.0, 0.0, 0.25)),))
    (path,) = read(VectorPicture(faint, scene())).iter(f"{SPACE}path")
    assert path.attrib["fill-opacity"] == "0.25"


def test_one_colour_behind_is_a_rectangle_and_nothing_is_nothing() -> None:
    (plain,) = read(VectorPicture(RING, scene())).iter(f"{SPACE}rect")
    assert plain.attrib["fill"] == "#ffffff"
    assert not list(read(VectorPicture(RING, scene(background=(CLEAR, CLEAR)))).iter(f"{SPACE}rect"))


def test_a_background_runs_evenly_in_linear_light_from_below() -> None:
    root = read(VectorPicture(RING, scene(background=((0.0, 0.0, 0.0, 1.0), WHITE))))
    stops = [stop.attrib["stop-color"] for stop in root.iter(f"{SPACE}stop")]
    assert len(stops) == STOPS
    # Half of the light is sRGB code 188.
    assert (stops[0], stops[STOPS // 2], stops[-1]) == ("#000000", "#bcbcbc", "#ffffff")
    (gradient,) = root.iter(f"{SPACE}linearGradient")
    assert (gradient.attrib["y1"], gradient.attrib["y2"]) == ("1", "0")


RED = (1.0, 0.0, 0.0, 1.0)


def test_a_path_says_its_rule_where_it_is_not_the_usual_one() -> None:
    both = Drawing((4.0, 4.0), (Path("a", (OUTER,), RED), Path("b", (OUTER,), RED, "nonzero")))
    assert [path.attrib.get("fill-rule") for path in read(VectorPicture(both, scene())).iter(f"{SPACE}path")] == [
        None,
        "nonzero",
    ]


def test_a_region_that_paths_share_is_defined_once_and_groups_are_cut_by_it() -> None:
    eye, lid = Region((OUTER / 2,), "nonzero"), Region((OUTER / 2 + 1,))
    paths = [Path("eye", (OUTER / k,), RED, inside=(eye,), outside=(lid,)) for k in (1, 2)]
    root = read(VectorPicture(Drawing((4.0, 4.0), (*paths, Path("brow", (OUTER,), RED, outside=(lid,)))), scene()))
    (clip,), (mask,) = root.iter(f"{SPACE}clipPath"), root.iter(f"{SPACE}mask")
    assert clip[0].attrib["clip-rule"] == "nonzero"
    assert outlines(clip[0]) == [[[0, 100], [50, 100], [50, 50], [0, 50]]]
    assert [part.attrib["fill"] for part in mask] == ["#fff", "#000"]
    assert mask[1].attrib["fill-rule"] == "evenodd"
    (cut,) = (group for group in root.iter(f"{SPACE}g") if "clip-path" in group.attrib)
    assert cut.attrib["clip-path"] == f"url(#{clip.attrib['id']})"
    assert cut[0].attrib == {"mask": f"url(#{mask.attrib['id']})"}
    assert len(list(cut[0].iter(f"{SPACE}path"))) == 2
    assert sum("mask" in group.attrib for group in root.iter(f"{SPACE}g")) == 2


def test_what_fills_a_hole_reaches_under_what_has_it() -> None:
    hole = (OUTER / 2 + 1,)
    halves = (Path(f"face{k}", (OUTER * (0.5, 1) + (k, 0),), WHITE, outside=(Region(hole),)) for k in (0, 2))
    root = read(VectorPicture(Drawing((4.0, 4.0), (Path("hole", hole, RED), *halves)), scene()))
    lines = [path for path in root.iter(f"{SPACE}path") if path.attrib.get("fill") == "none"]
    clips = list(root.iter(f"{SPACE}clipPath"))
    assert [line.attrib["clip-path"] for line in lines] == [f"url(#{clip.attrib['id']})" for clip in clips]
    assert {(line.attrib["stroke"], float(line.attrib["stroke-width"])) for line in lines} == {("#ff0000", OVERLAP_PX)}
    assert [outlines(clip[0])[0][0] for clip in clips] == [[0, 100], [50, 100]]


def test_empty_outlines_and_regions_are_valid() -> None:
    nothing = Drawing((4.0, 4.0), (Path("a", (), RED, inside=(Region(()),)), Path("b", (np.zeros((0, 2)),), RED)))
    assert [path.attrib["d"] for path in read(VectorPicture(nothing, scene())).iter(f"{SPACE}path")] == ["", "", ""]


def test_a_drawing_brings_its_own_background() -> None:
    blue = Drawing((4.0, 4.0), (), (0.0, 0.0, 1.0, 1.0))
    (rectangle,) = read(VectorPicture(blue, Scene(size_px=(100, 100)))).iter(f"{SPACE}rect")
    assert rectangle.attrib["fill"] == "#0000ff"


def test_two_backgrounds_in_one_page_do_not_share_a_name() -> None:
    names = {
        next(read(VectorPicture(RING, scene(background=(top, WHITE)))).iter(f"{SPACE}linearGradient")).attrib["id"]
        for top in ((0.0, 0.0, 0.0, 1.0), (0.5, 0.0, 0.0, 1.0))
    }
    assert len(names) == 2


def test_the_file_says_what_made_it_in_any_letters(tmp_path: FilePath) -> None:
    VectorPicture(RING, scene(), notes=notes("toon:<Łucja & Zoë>")).write(tmp_path / "a.svg")
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    assert root.findtext(f"{SPACE}title") == "toon:<Łucja & Zoë>"
    assert "Synthetic" in (root.findtext(f"{SPACE}desc") or "")


def test_small_pictures_have_finer_coordinates() -> None:
    third = Drawing((3.0, 3.0), (Path("dot", (np.eye(3, 2),), WHITE),))
    (small,) = read(VectorPicture(third, scene(size_px=(16, 16)))).iter(f"{SPACE}path")
    (large,) = read(VectorPicture(third, scene(size_px=(4096, 4096)))).iter(f"{SPACE}path")
    assert "5.3333 " in small.attrib["d"]
    assert "1365.33 " in large.attrib["d"]


def test_a_notebook_is_shown_the_same_text() -> None:
    assert VectorPicture(RING, scene())._repr_svg_() == VectorPicture(RING, scene()).to_svg()


def test_a_place_that_cannot_be_written_is_said_and_nothing_left(tmp_path: FilePath) -> None:
    with pytest.raises(MienError):
        VectorPicture(RING, scene()).write(tmp_path / "none" / "a.svg")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [(1.5, 2, "1.5"), (-0.001, 2, "0"), (-0.0, 0, "0"), (120.0, 0, "120"), (2.0, 3, "2"), (-1.25, 1, "-1.2")],
)
def test_numbers_are_short(value: float, decimals: int, text: str) -> None:
    assert format_number(value, decimals) == text
