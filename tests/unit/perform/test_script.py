"""Scripts as tables, and every mistake in them with its line and column."""

from __future__ import annotations

from pathlib import Path

import pytest

from mien.core import LoadError
from mien.perform import read_script
from mien.perform.script import Line


def write(folder: Path, text: str) -> Path:
    path = folder / "talk.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_script_is_read(tmp_path: Path) -> None:
    text = (
        "\ufeffspeaker,line,face,emotion\r\n# a comment, with a comma\r\nann,Hello.,head:ada,smile=0.6\r\n,,,\r\n"
        'bob,"Oh, well!\nTwo ""lines"".",,\r\nann, [sad] Bye. ,head:ada,\r\n'
    )
    script = read_script(write(tmp_path, text))
    assert script.lines == (
        Line("ann", "Hello.", 3, "smile=0.6"),
        Line("bob", 'Oh, well!\nTwo "lines".', 5),
        Line("ann", "[sad] Bye.", 7),
    )
    assert [line.script for line in script.lines[::2]] == ["[smile=0.6] Hello.", "[sad] Bye."]
    assert script.speakers == ("ann", "bob")
    assert (script.faces, script.voices) == ({"ann": "head:ada"}, {})


def test_columns_come_in_any_order(tmp_path: Path) -> None:
    script = read_script(write(tmp_path, "voice,line,speaker\nhibari,Hi.,ann\n"))
    assert [(line.speaker, line.text) for line in script.lines] == [("ann", "Hi.")]
    assert script.voices == {"ann": "hibari"}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r"talk.csv:1: there is no column 'speaker' — want a first row speaker,line"),
        (
            "speaker,text\n",
            r"talk.csv:1: column 2: there is no column 'text' — the first row names them: speaker, line",
        ),
        ("speaker,line,line\n", r"talk.csv:1: column 3: there are two columns 'line'"),
        ("speaker,face\n", r"talk.csv:1: there is no column 'line'"),
        ("speaker,line\n", r"talk.csv: nobody says anything"),
        (
            "speaker,line\n#\nann,Hello, you.\n",
            r"talk.csv:3: want 2 columns \(speaker, line\), got 3 — .* double quotes",
        ),
        ("speaker,line\nann,\n", r"talk.csv:2: column 'line' is empty"),
        ("speaker,line\n,Hi.\n", r"talk.csv:2: column 'speaker' is empty"),
        ('speaker,line\nann,"Hi\n', r"talk.csv:2: is not CSV: unexpected end of data"),
        (
            "speaker,line,face\nann,Hi.,head\nann,Hi.,head:ada\n",
            r"talk.csv:3: column 'face': ann has the face 'head' already, here 'head:ada'",
        ),
        ("speaker,line\nann,Hi [smile.\n", r"talk.csv:2: column 'line': line 1, column 4: '\[' begins a mark"),
        ("speaker,line,emotion\nann,Hi,smile=2\n", r"talk.csv:2: column 'emotion': .* 2 is out of range"),
        ("speaker,line,emotion\nann,Hi,look left\n", r"talk.csv:2: column 'emotion': 'look left' is no expression"),
        ("speaker,line,emotion\nann,Hi,5\n", r"talk.csv:2: column 'emotion': '5' is no expression"),
    ],
)
def test_mistakes_name_line_and_column(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(LoadError, match=message):
        read_script(write(tmp_path, text))


def test_files_that_cannot_be_read_say_why(tmp_path: Path) -> None:
    with pytest.raises(LoadError, match="cannot be read"):
        read_script(tmp_path / "gone.csv")
    (tmp_path / "talk.csv").write_bytes("speaker,line\nann,é\n".encode("latin-1"))
    with pytest.raises(LoadError, match=r"is not UTF-8 text \(byte 17\)"):
        read_script(tmp_path / "talk.csv")
