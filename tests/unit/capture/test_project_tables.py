"""points.csv and references.csv: what is read, and what is told of every line that cannot be."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.capture.project_points import format_points, format_references, read_points, read_references
from mien.capture.project_records import METRES
from mien.capture.records import WORLD, Observation, Photograph, Reference
from mien.core import LoadError

PHOTOS = (Photograph("front.jpg", (400, 300), "a"), Photograph("left.jpg", (400, 300), "a"))


def written(folder: Path, text: str | bytes, name: str = "points.csv") -> Path:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def fault(folder: Path, text: str | bytes) -> str:
    with pytest.raises(LoadError) as caught:
        read_points(written(folder, text), PHOTOS)
    return str(caught.value).replace(f"{folder}/", "")


def test_points_with_their_lines(tmp_path: Path) -> None:
    path = written(tmp_path, "photo,point,u,v,sigma\nfront.jpg,nose,1.5,2,\n\nleft.jpg, nose ,3,4,0.5\n")
    assert read_points(path, PHOTOS) == (
        Observation("front.jpg", "nose", 1.5, 2.0, 1.0, 2),
        Observation("left.jpg", "nose", 3.0, 4.0, 0.5, 4),
    )


@pytest.mark.parametrize(
    "text",
    [
        "photo,point,u,v\r\nfront.jpg,nose,1.5,2\r\n",
        "\ufeffphoto,point,u,v\nfront.jpg,nose,1.5,2\n",
        "photo;point;u;v;sigma\nfront.jpg;nose;1,5;2;\n",
        "photo\tpoint\tu\tv\nfront.jpg\tnose\t1,5\t2\n",
        "Photo,Point,U,V,,\nfront.jpg,nose,1.5,2,,\n",
        "v,u,point,photo\n2,1.5,nose,front.jpg\n",
        'photo,point,u,v\n"front.jpg","nose",1.5e0,+2\n',
        "photo,point,u,v\rfront.jpg,nose,1.5,2\r",
    ],
)
def test_spreadsheets_write_tables_in_many_ways(tmp_path: Path, text: str) -> None:
    (point,) = read_points(written(tmp_path, text), PHOTOS)
    assert (point.photo, point.point, point.u, point.v, point.sigma_px) == ("front.jpg", "nose", 1.5, 2.0, 1.0)


def test_utf_16_of_spreadsheets(tmp_path: Path) -> None:
    text = "photo\tpoint\tu\tv\nfront.jpg\tNäse\t1\t2\n"
    assert read_points(written(tmp_path, text.encode("utf-16")), PHOTOS)[0].point == "Näse"


@pytest.mark.parametrize(
    ("line", "wanted"),
    [
        ("frnt.jpg,nose,1,2,", "unknown photograph 'frnt.jpg' — did you mean 'front.jpg'"),
        ("front.jpg,,1,2,", "column 'point' is empty"),
        ("front.jpg,nose,,2,", "column 'u' is empty"),
        ("front.jpg,nose,1,nan,", "column 'v': want a finite number, got 'nan'"),
        ("front.jpg,nose,inf,2,", "column 'u': want a finite number"),
        ("front.jpg,nose,1_0,2,", "column 'u': want a finite number"),
        ("front.jpg,nose,1.5x,2,", "column 'u': want a number, got '1.5x'"),
        ('front.jpg,nose,"1,5",2,', "want a number, got '1,5' — a decimal comma? Write a point, 12.5"),
        ("front.jpg,nose,1,5,2,5,1", "want 5 cells separated by commas, got 7 — decimal commas? Write points"),
        ("front.jpg,nose,1,2,0", "column 'sigma': want a number above 0, got 0"),
        ("front.jpg,nose,1,2,-1", "column 'sigma': want a number above 0, got -1"),
        ("front.jpg,nose,401,2,", "lies outside of front.jpg, which is 400x300 pixels upright"),
        ("front.jpg,nose,250,350,", "are u and v exchanged?"),
        ("front.jpg,chin,3,4,", "point 'chin' of front.jpg was told in line 2 already"),
    ],
)
def test_what_is_wrong_with_a_line(tmp_path: Path, line: str, wanted: str) -> None:
    message = fault(tmp_path, f"photo,point,u,v,sigma\nfront.jpg,chin,1,2,\n{line}\n")
    assert message.startswith("points.csv:3: ")
    assert wanted in message
    assert "\n" not in message


def test_every_malformed_line_is_told(tmp_path: Path) -> None:
    lines = ["front.jpg,nose,x,2,", "left.jpg,nose,3,4,", *["left.jpg,,3,4,"] * 20]
    message = fault(tmp_path, "\n".join(["photo,point,u,v,sigma", *lines, ""])).splitlines()
    assert message[0] == "points.csv:2: column 'u': want a number, got 'x'"
    assert [line.split(" ")[0] for line in message[1:8]] == [f"points.csv:{line}:" for line in range(4, 11)]
    assert message[8] == "points.csv: … and 13 more"
    assert len(message) == 9


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (b"", "points.csv: is empty"),
        ("front.jpg,nose,1,2\n", "points.csv:1: want a first row photo,point,u,v,sigma, got 'front.jpg,nose,1,2'"),
        ("photo,point,u,w\n", "points.csv:1: unknown column 'w'"),
        ("photo,point,u,v,sigm\n", "points.csv:1: unknown column 'sigm' — did you mean 'sigma'?"),
        ("photo,point,u\n", "points.csv:1: there is no column 'v'"),
        ("photo,point,u,v,u\n", "points.csv:1: there are 2 columns 'u'"),
        ("photo,point,u,v,\nfront.jpg,nose,1,2,hm\n", "points.csv:2: there is something in a column without a name"),
        ('photo,point,u,v\nfront.jpg,"nose,1,2\n', "points.csv:2: is not CSV"),
        (b"photo,point,u,v\nfront.jpg,n\xe4se,1,2\n", "points.csv: is no UTF-8 text (byte 27)"),
    ],
)
def test_what_is_wrong_with_a_file(tmp_path: Path, text: str | bytes, wanted: str) -> None:
    assert fault(tmp_path, text).startswith(wanted)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(LoadError, match="cannot be read"):
        read_points(tmp_path / "points.csv", PHOTOS)


def test_references_in_their_unit(tmp_path: Path) -> None:
    text = "point,x,y,z,sigma,target\na,254,0,0,0.5,\nb,10,-20,30,,board\n"
    found = read_references(written(tmp_path, text), "mm")
    assert found == (Reference("a", 0.254, 0.0, 0.0, 0.0005, WORLD), Reference("b", 0.01, -0.02, 0.03, 0.0, "board"))
    assert read_references(written(tmp_path, "point,x,y,z\na,10,0,0\n"), "inch")[0].x == pytest.approx(0.254)


@pytest.mark.parametrize(
    ("line", "wanted"),
    [
        ("a,1,2,3,,", "reference 'a' was told in line 2 already"),
        ("b,0,0,0,,", "reference 'b' is where 'a' of line 2 is"),
        ("b,1,2,3,-1,", "column 'sigma': want 0 or more, got -1"),
        ("b,1,2,,,", "column 'z' is empty"),
    ],
)
def test_what_is_wrong_with_a_reference(tmp_path: Path, line: str, wanted: str) -> None:
    path = written(tmp_path, f"point,x,y,z,sigma,target\na,0,0,0,,\n{line}\n", "references.csv")
    with pytest.raises(LoadError) as caught:
        read_references(path, "mm")
    assert str(caught.value).startswith(f"{path}:3: ")
    assert wanted in str(caught.value)


NAMES = st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Z"]), min_size=1, max_size=8)
PIXELS = st.floats(0.0, 300.0)


@given(
    st.dictionaries(
        st.tuples(st.sampled_from(["front.jpg", "left.jpg"]), NAMES), st.tuples(PIXELS, PIXELS, st.floats(1e-3, 50))
    )
)
def test_points_come_back_as_they_were_written(tmp_path_factory: pytest.TempPathFactory, points: dict) -> None:
    observations = [Observation(*key, *values) for key, values in points.items()]
    path = written(tmp_path_factory.mktemp("csv"), format_points(observations))
    found = read_points(path, PHOTOS)
    assert {(each.photo, each.point): (each.u, each.v, each.sigma_px) for each in found} == points
    again = format_points(found)
    assert again == path.read_text(encoding="utf-8")


LENGTHS = st.floats(-50.0, 50.0).map(lambda x: x + 0.0)


@given(st.dictionaries(NAMES, st.tuples(LENGTHS, LENGTHS, LENGTHS), max_size=5), st.sampled_from(sorted(METRES)))
def test_references_come_back_as_they_were_written(
    tmp_path_factory: pytest.TempPathFactory, places: dict, unit: str
) -> None:
    apart = {place: name for name, place in places.items()}
    references = [Reference(name, *place) for place, name in apart.items()]
    path = written(tmp_path_factory.mktemp("csv"), format_references(references, unit))
    for found, wanted in zip(read_references(path, unit), references, strict=True):
        assert (found.name, found.target) == (wanted.name, WORLD)
        assert (found.x, found.y, found.z) == pytest.approx((wanted.x, wanted.y, wanted.z), rel=1e-14)


def test_lengths_are_told_as_shortly_as_people_do() -> None:
    text = format_references([Reference("a", 0.254, 0.0123, -0.07, 0.0005)], "mm")
    assert text.splitlines()[1] == "a,254,12.3,-70,0.5,"
