"""The table of file formats: which suffix holds what."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from mien.core import MienError, UnknownNameError

from .codecs import CODECS


@dataclass(frozen=True)
class Format:
    """One row.

    Attributes:
        name: short name.
        suffixes: lower case; an empty one stands for a folder.
        holds: what a user asks for when he names such a file: picture, pixels (a picture made of them), performance,
            timeline (to play), plot, subtitles (beside a film),
            cues (to write), timing (cues to read).
        doc: what is in the file.
    """

    name: str
    suffixes: tuple[str, ...]
    holds: tuple[str, ...]
    doc: str


FORMATS: tuple[Format, ...] = (
    Format("film", tuple(codec.suffix for codec in CODECS), ("performance",), "moving pictures: table ``codecs``"),
    Format("folder", ("",), ("performance",), "a folder of PNG frames and the sound"),
    Format("png", (".png",), ("picture", "pixels"), "PNG, with transparency"),
    Format("jpeg", (".jpg", ".jpeg"), ("picture", "pixels"), "JPEG, over white"),
    Format("svg", (".svg",), ("picture",), "filled paths, sharp at every size"),
    Format("obj", (".obj",), ("picture",), "the mesh: points with colours and normals, polygons, parts"),
    Format("glb", (".glb",), ("picture", "performance"), "the mesh with morph targets and joints, for other programs"),
    Format("series", (".png",), ("performance",), "numbered PNG frames: frame_%04d.png"),
    Format("wav", (".wav",), ("performance",), "the sound alone"),
    Format("subtitles", (".srt", ".vtt"), ("performance", "subtitles"), "what is said, as SubRip or WebVTT subtitles"),
    Format("textgrid", (".textgrid",), ("performance",), "when each word and phone is said, for Praat"),
    Format("json", (".json",), ("performance", "timeline"), "everything needed to play it again, sound beside it"),
    Format("csv", (".csv",), ("performance", "timeline"), "one row a frame, one column a parameter"),
    Format("specification", (".spec",), ("timeline",), "Parke's specification list"),
    Format(
        "cues",
        (".textgrid", ".json", ".tsv", ".xml", ".srt", ".vtt", ".dat"),
        ("cues", "timing"),
        "words, phones and mouth shapes with their times: table ``cue_files``",
    ),
    Format("chart", (".csv", ".html"), ("cues",), "an exposure sheet: a row a frame with its word, phone and mouth"),
    Format("plot", (".png", ".svg", ".pdf"), ("plot",), "curves over time"),
)


def find_format(path: Path | str, holds: str) -> Format:
    """The row for a path of which ``holds`` is wanted; the suffix decides, in either case.

    Raises:
        UnknownNameError: no row has the suffix; the text lists near ones.
        MienError: there is no suffix.
    """
    path = Path(path)
    rows = [row for row in FORMATS if holds in row.holds]
    suffix = path.suffix.lower()
    if os.path.isdir(path) and any("" in row.suffixes for row in rows):
        suffix = ""
    for row in rows:
        if suffix in row.suffixes:
            return row
    known = [each or "(a folder: no suffix)" for row in rows for each in row.suffixes]
    if not suffix:
        raise MienError(f"{path}: has no suffix to tell the format by — end it in one of {', '.join(known)}")
    raise UnknownNameError(f"suffix of {path.name!r}:", suffix, known)
