from pathlib import Path

import pytest

from mien.core import LoadError
from mien.perform import Style, load_style, read_style


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_text_file_has_amounts_on_lines_and_comments(tmp_path: Path) -> None:
    path = write(tmp_path, "calm.style", "mumbling  # to begin with\n\njaw=0.5, blinks=off\nlips = 0.2\n")
    style = load_style(f"@{path}")
    assert (style.jaw, style.blinks, style.lips, style.brows, style.head) == (0.5, 0.0, 0.2, 0.5, 1.0)


def test_a_json_file_has_numbers_switches_and_a_style_to_start_from(tmp_path: Path) -> None:
    path = write(tmp_path, "calm.json", '{"style": "mumbling", "jaw": 0.5, "blinks": false, "gaze": "off"}')
    style = load_style(str(path))
    assert (style.jaw, style.blinks, style.gaze, style.lips) == (0.5, 0.0, 0.0, 0.35)
    assert load_style(f"@{path}") == style


def test_what_is_no_file_is_the_style_itself() -> None:
    assert load_style("jaw=0.5") == Style(jaw=0.5)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.txt", "jaw=1\nlisp=2\n", "a.txt:2: unknown style 'lisp' — did you mean 'lips'"),
        ("a.txt", "jaw=1\n\njaw=2\n", "a.txt:3: style 'jaw=2': jaw is given twice"),
        ("a.txt", "jaw=3", "a.txt:1: style jaw=3 is out of range — it goes from 0 (off) to 2"),
        ("a.txt", "closures=2", "a.txt:1: style closures=2 is out of range — it goes from 0 (off) to 1"),
        ("a.txt", "mumble", "a.txt:1: unknown style 'mumble' — did you mean 'mumbling'"),
        ("a.json", '{\n"jaw": 1,\n"lisp": 2}', "a.json:3: unknown style 'lisp' — did you mean 'lips'"),
        ("a.json", '{\n"jaw": 1,\n"jaw": 2}', "a.json:3: style 'jaw=2': jaw is given twice"),
        ("a.json", '{"jaw": NaN}', "a.json:1: style jaw=nan is out of range"),
        ("a.json", '{\n"jaw": [1]}', "a.json:2: jaw: want a number, true, false or a text, got [1]"),
        ("a.json", '{"jaw": {"more": 1}}', "a.json:1: jaw: want a number, true, false or a text, got an object"),
        ("a.json", '{"jaw": "much"}', "a.json:1: style jaw=much: want a number from 0 to 2, on or off"),
        ("a.json", '{"jaw": 1', "a.json:1: column 10: "),
        ("a.json", "[1, 2]", "a.json: want an object of amounts"),
    ],
)
def test_a_mistake_names_file_and_place(tmp_path: Path, name: str, text: str, message: str) -> None:
    with pytest.raises(LoadError) as caught:
        read_style(write(tmp_path, name, text))
    assert message in str(caught.value)


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(LoadError, match="cannot be read"):
        load_style(f"@{tmp_path / 'nothing.txt'}")
    (tmp_path / "bytes.txt").write_bytes(b"\xff\xfe")
    with pytest.raises(LoadError, match="is not UTF-8 text"):
        load_style(f"@{tmp_path / 'bytes.txt'}")
