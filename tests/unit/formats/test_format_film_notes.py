"""Every film says what it is, who made it, of which face and from which seed."""

from __future__ import annotations

import struct
import xml.etree.ElementTree
from pathlib import Path

import av
import pytest
from film_cases import PLAYED, SIZE, frames
from PIL import Image

from mien.formats.film import write_film

NOTES = {
    "Title": "Grüß <Gott> & “hello”",
    "Software": "mien 9",
    "Face": "head",
    "Seed": "7",
    "Description": "Synthetic: " + 60 * "computed ",
}

LINES = "\n".join(f"{key}: {value}" for key, value in NOTES.items())


def write(path: Path) -> Path:
    write_film(frames(3), path, fps=24, size_px=SIZE, notes=NOTES)
    return path


@pytest.mark.parametrize("suffix", PLAYED)
def test_tags_of_films(tmp_path: Path, suffix: str) -> None:
    with av.open(str(write(tmp_path / f"a{suffix}"))) as film:
        found = {key.lower(): value for key, value in film.metadata.items()}
    assert {key: found[key.lower()] for key in NOTES} == NOTES
    # What a clock or a random number would write is left out.
    assert "creation_time" not in found


def test_texts_of_an_animated_png(tmp_path: Path) -> None:
    with Image.open(write(tmp_path / "a.apng")) as image:
        assert {key: image.text[key] for key in NOTES} == NOTES


def test_comment_of_a_gif(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gif")
    assert path.read_bytes().endswith(b"\0\x3b")
    with Image.open(path) as image:
        image.seek(image.n_frames - 1)
        with pytest.raises(EOFError):
            image.seek(image.n_frames)
    data = path.read_bytes()
    comment, place = b"", data.index(b"\x21\xfe") + 2
    while data[place]:
        comment += data[place + 1 : place + 1 + data[place]]
        place += 1 + data[place]
    assert comment.decode() == LINES
    assert data[place + 1 :] == b"\x3b"


def test_description_of_an_animated_webp(tmp_path: Path) -> None:
    path = write(tmp_path / "a.webp")
    data = path.read_bytes()
    assert struct.unpack_from("<I", data, 4)[0] == len(data) - 8
    with Image.open(path) as image:
        text = image.info["xmp"].decode()
    (description,) = xml.etree.ElementTree.fromstring(text).iter("{http://www.w3.org/1999/02/22-rdf-syntax-ns#}li")
    assert description.text == LINES


@pytest.mark.parametrize("suffix", [".gif", ".apng", ".webp"])
def test_without_notes_there_are_none(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(2), path, fps=24, size_px=SIZE)
    data = path.read_bytes()
    assert not any(mark in data for mark in (b"\x21\xfe", b"iTXt", b"XMP "))
