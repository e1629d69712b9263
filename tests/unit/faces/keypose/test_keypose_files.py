"""Folders of measured faces: what is read, what is refused and where, what is written."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mien.core import LoadError, Material, MienError
from mien.faces.keypose.files import read_keypose, read_phase, read_topology, write_keypose
from mien.faces.keypose.records import Eyes, Polygon
from support import MASK

TWO = """\
# a roof: two quads along the midline
part skin gloss 0.25 subdivide
1 2 3 4 #E0AC96
part brim two-sided unlit flat   # what is left of it
4 3 5 #102030 # triangle
midline 1 4
crease 3 4
"""


@pytest.fixture
def mask(tmp_path):
    return Path(shutil.copytree(MASK, tmp_path / "mask.keypose"))


def topology(tmp_path, text):
    (tmp_path / "topology.txt").write_text(text)
    return read_topology(tmp_path / "topology.txt")


def change(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def test_a_topology_says_what_its_lines_say(tmp_path):
    read = topology(tmp_path, TWO)
    skin, brim = read.parts
    assert skin.name == "skin"
    assert skin.polygons == (Polygon((1, 2, 3, 4), "#e0ac96"),)
    assert skin.material == Material(gloss=0.25, subdivide=True)
    assert brim.material == Material(two_sided=True, lit=False, flat=True)
    assert brim.polygons == (Polygon((4, 3, 5), "#102030"),)
    assert (read.midline, read.creases, read.point_count) == ((1, 4), ((3, 4),), 5)


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("4 3 5 #", "4 3 #", 5, "polygon of 2 points"),
        ("4 3 5 #", "4 3 4 #", 5, "point 4 is twice"),
        ("4 3 5 #102030", "4 3 5", 5, "#rrggbb"),
        ("4 3 5 #102030", "4 3 5 #10203", 5, "#rrggbb"),
        ("4 3 5 #", "4 3 0 #", 5, "'0' is not the number"),
        ("4 3 5 #", "4 3 -5 #", 5, "'-5' is not the number"),
        ("4 3 5 #", "4 3 99999999999 #", 5, "is not the number"),
        ("4 3 5 #", "4 3 ٥ #", 5, "is not the number"),
        ("4 3 5 #", "4 3 7 #", 5, "point 5 is in no polygon"),
        ("1 2 3 4 #", "1 2 3 4 5 6 7 8 9 12 #", 3, "point 10 is in no polygon"),
        ("crease 3 4", "crease 1 3", 7, "span the crease"),
        ("crease 3 4", "crease 3", 7, "two points"),
        ("crease 3 4", "crease 3 nose", 7, "'nose'"),
        ("midline 1 4", "midline 1 44", 6, "point 44 of the midline"),
        ("gloss 0.25", "gloss 2", 2, "from 0 to 1"),
        ("gloss 0.25", "gloss nan", 2, "from 0 to 1"),
        ("gloss 0.25 subdivide", "subdivide gloss", 2, "'nothing'"),
        ("subdivide", "subdivded", 2, "'subdivded' is nothing"),
        ("part brim", "part skin", 4, "twice"),
        ("part brim two-sided unlit flat", "part", 4, "part NAME"),
    ],
)
def test_a_topology_that_is_wrong_is_refused_with_its_line(tmp_path, old, new, line, words):
    with pytest.raises(LoadError, match=words) as caught:
        topology(tmp_path, TWO.replace(old, new, 1))
    assert str(caught.value).startswith(f"{tmp_path / 'topology.txt'}:{line}: ")


def test_a_polygon_before_any_part_and_a_file_without_polygons_are_refused(tmp_path):
    with pytest.raises(LoadError, match=r":1: a polygon before any part"):
        topology(tmp_path, "1 2 3 #ffffff\n")
    with pytest.raises(LoadError, match="has no polygon"):
        topology(tmp_path, "part skin\n# 1 2 3 #ffffff\n")


def test_neighbours_that_go_around_in_opposite_ways_are_refused(tmp_path):
    # One of the two would be seen from inside.
    with pytest.raises(LoadError, match=r":3: goes from 2 to 3, and so does the polygon in line 2"):
        topology(tmp_path, "part skin\n1 2 3 #ffffff\n2 3 4 #ffffff\n")


def phase(tmp_path, text, count=3, unit="mm"):
    (tmp_path / "a.phase").write_text(text)
    return read_phase(tmp_path / "a.phase", count, unit)


def test_points_come_in_any_order_and_unit(tmp_path):
    places = phase(tmp_path, "3 0 0 1\n# nose\n1 10 20 30\n2 -1.5 0 2e1  # a comment\n", unit="cm")
    np.testing.assert_allclose(places, [[0.1, 0.2, 0.3], [-0.015, 0.0, 0.2], [0.0, 0.0, 0.01]], atol=1e-15)
    assert phase(tmp_path, "1 1 0 0\n", 1, "inch")[0, 0] == 0.0254


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("1 0 0 0\n2 0 0 0\n912 0 0 0\n", 3, r"point 912 is in no polygon of the topology, which has 1..3"),
        ("1 0 0 0\n1 0 0 0\n", 2, "point 1 is in line 1 already"),
        ("1 0 0\n", 1, "want 'number x y z', got '1 0 0'"),
        ("1 0 0 0 0\n", 1, "want 'number x y z'"),
        ("one 0 0 0\n", 1, "want 'number x y z'"),
        ("1 0 O 0\n", 1, "want 'number x y z'"),
        ("1 0 nan 0\n", 1, "not finite"),
        ("1 0 inf 0\n", 1, "not finite"),
        ("1 0 1200 0\n", 1, "is the unit mm"),
        ("0 0 0 0\n", 1, "point 0 is in no polygon"),
    ],
)
def test_a_phase_that_is_wrong_is_refused_with_its_line(tmp_path, text, line, words):
    with pytest.raises(LoadError, match=words) as caught:
        phase(tmp_path, text)
    assert f"a.phase:{line}: " in str(caught.value)


def test_missing_points_are_named(tmp_path):
    with pytest.raises(LoadError, match=r"2 of 3 points are missing: 1, 3 — was this phase measured on another"):
        phase(tmp_path, "2 0 0 0\n")


def test_what_is_no_text_is_refused(tmp_path):
    (tmp_path / "a.phase").write_bytes(b"\xff\xfe1 0 0 0")
    with pytest.raises(LoadError, match="UTF-8"):
        read_phase(tmp_path / "a.phase", 1)


def test_a_folder_is_read_whole(mask):
    read = read_keypose(mask)
    assert read.name == "mask"
    assert read.phases[:3] == ("neutral", "smile", "open")
    assert read.places.shape == (11, 44, 3)
    np.testing.assert_allclose(read.places[0, 3], [0.0, -0.028, 0.104])
    assert read.eyes == Eyes("eyes", (0.031, 0.002, 0.055))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"mien-keypose"', '"mien-face"', "want format"),
        ("version = 1", "version = 2", "version 2, wanted 1"),
        ('unit = "mm"', 'unit = "mn"', "unknown unit 'mn' — did you mean 'm' or 'mm'"),
        ('unit = "mm"', "unit = 3", "unit: want a text, got 3"),
        ('"neutral", "smile"', '"smile", "smile"', "'smile' is there twice"),
        ('"neutral", "smile"', '"neutral", "Big Smile"', "cannot be the name of a phase"),
        ('"neutral", "smile"', '"neutral", "number"', "cannot be the name of a phase"),
        ('"neutral", "smile"', '"neutral", "grin"', "there is no grin.phase"),
        ("phases = [", "phases = []\nsided = [", "phases: 0 of them"),
        ("mirror = true", "mirror = 1", "mirror: want true or false"),
        ("mirror = true", "mirrored = true", "unknown key 'mirrored' — did you mean 'mirror'"),
        ("mirror = true", 'mirror = true\nsided = ["opne"]', "did you mean 'open'"),
        ("mirror = true", "mirror = true\npivot = [0, 1]", r"pivot: want \[x, y, z\] in mm"),
        ('part = "eyes"', 'part = "eye"', "there is no part 'eye'"),
        ("center = [", "centre = [", "unknown key of eyes"),
        ('part = "eyes"', 'part = "eyes', "not TOML"),
    ],
)
def test_settings_that_are_wrong_are_refused(mask, old, new, words):
    change(mask / "keypose.toml", old, new)
    with pytest.raises(LoadError, match=words) as caught:
        read_keypose(mask)
    assert str(mask / "keypose.toml") in str(caught.value)


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ('smirk = "smile"', "unknown phase in stands_for: 'smirk'"),
        ('open = "opne"', "unknown standard phase 'opne'"),
        ('open = "smile"', "two phases are 'smile'"),
    ],
)
def test_phases_stand_for_standard_ones_once(mask, rows, words):
    (mask / "keypose.toml").write_text((mask / "keypose.toml").read_text() + "\n[stands_for]\n" + rows + "\n")
    with pytest.raises(LoadError, match=words):
        read_keypose(mask)


def test_a_right_half_a_wide_midline_and_polygons_inside_out_are_told(mask):
    change(mask / "smile.phase", "4 0 ", "4 12 ")
    with pytest.raises(LoadError, match=r"smile\.phase: point 4 is on the midline, but its x is 12 mm"):
        read_keypose(mask)
    change(mask / "smile.phase", "4 12 ", "4 0.5 ")
    assert read_keypose(mask).places[1, 3, 0] == 0.0
    whole = read_keypose(mask)
    turned = [
        replace(part, polygons=tuple(replace(polygon, points=polygon.points[::-1]) for polygon in part.polygons))
        for part in whole.topology.parts
    ]
    with pytest.raises(MienError, match=r"mask\.keypose/topology\.txt: is inside out"):
        write_keypose(mask, replace(whole, topology=replace(whole.topology, parts=tuple(turned))))
    with pytest.raises(MienError, match="right half"):
        write_keypose(mask, replace(whole, places=whole.places * (-1.0, 1.0, 1.0)))
    assert read_keypose(mask).places.tobytes() == whole.places.tobytes()


def test_files_that_are_missing_are_named(mask, tmp_path):
    (mask / "blink.phase").unlink()
    with pytest.raises(LoadError, match=r"there is no blink\.phase"):
        read_keypose(mask)
    (mask / "topology.txt").unlink()
    with pytest.raises(LoadError, match=r"has no topology\.txt"):
        read_keypose(mask)
    with pytest.raises(LoadError, match="no such folder"):
        read_keypose(tmp_path / "nobody.keypose")


@pytest.mark.parametrize("unit", ["mm", "cm", "m", "inch"])
def test_what_is_written_is_read_again(mask, tmp_path, unit):
    read = read_keypose(mask)
    named = replace(read, unit=unit, pivot=(0.0, -0.05, 0.001), stands_for={}, sided=("open",), doc='A "mask".')
    write_keypose(tmp_path / "copy.keypose", named)
    again = read_keypose(tmp_path / "copy.keypose")
    np.testing.assert_allclose(again.places, read.places, atol=1e-9)
    np.testing.assert_allclose(again.pivot, named.pivot, atol=1e-9)
    assert (
        replace(again, places=named.places, pivot=named.pivot, eyes=named.eyes).__dict__.items()
        >= {key: value for key, value in named.__dict__.items() if key not in ("places", "on_midline")}.items()
    )
    first = {path.name: path.read_bytes() for path in (tmp_path / "copy.keypose").iterdir()}
    write_keypose(tmp_path / "copy.keypose", again)
    assert {path.name: path.read_bytes() for path in (tmp_path / "copy.keypose").iterdir()} == first
    assert sorted(path.name for path in tmp_path.iterdir()) == ["copy.keypose", "mask.keypose"]


def test_an_older_face_stays_when_the_new_one_cannot_take_its_place(mask, monkeypatch):
    before, rename = read_keypose(mask), Path.rename

    def refuse(self, target):
        if self.parent.name.startswith(".mien-") and self.name == mask.name:
            raise PermissionError(13, "Permission denied")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", refuse)
    with pytest.raises(MienError, match="cannot be written: Permission denied"):
        write_keypose(mask, replace(before, doc="newer"))
    assert read_keypose(mask).doc == before.doc
    assert [path.name for path in mask.parent.iterdir()] == [mask.name]


def test_nothing_else_is_written_over(mask, tmp_path):
    read = read_keypose(mask)
    (mask / "thesis.txt").write_text("all of it")
    with pytest.raises(MienError, match="other things"):
        write_keypose(mask, read)
    assert (mask / "thesis.txt").read_text() == "all of it"
    with pytest.raises(MienError, match=r"end in \.keypose"):
        write_keypose(tmp_path / "mask", read)
    with pytest.raises(MienError, match="does not exist"):
        write_keypose(tmp_path / "none" / "mask.keypose", read)
