"""Exposure sheets: every frame a row, nothing lost between two of them, and a page that needs nothing else."""

from __future__ import annotations

import csv
import re
from fractions import Fraction
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest
from cue_cases import hello, sheets
from hypothesis import given
from hypothesis import strategies as st

from mien.core import Cue, MienError
from mien.formats import CueSheet, write_cue_file
from mien.formats.cue_chart import chart_rows, format_chart
from mien.formats.cue_frames import choose_shapes, place_cues
from mien.formats.cue_mouths import mouth_sayings, mouth_symbols
from mien.formats.cue_page import format_page
from mien.formats.cue_shapes import find_set, shape_sets
from mien.vocab import vocabulary

RATES = [Fraction(12), Fraction(24000, 1001), Fraction(24), Fraction(25), Fraction(30), Fraction(60)]
VOID = {"meta", "path", "rect", "ellipse", "use", "br"}


def symbols(cues: tuple[tuple[Cue, ...], ...]) -> list[str]:
    return ["".join(cue.symbol for cue in there) for there in cues]


def test_a_cue_is_on_the_frames_whose_moments_it_lasts_at() -> None:
    cues = (Cue(0.0, 0.25, "a"), Cue(0.25, 0.5, "b"), Cue(0.55, 0.8, "c"))
    assert symbols(place_cues(cues, 1.0, Fraction(10))) == ["a", "a", "a", "b", "b", "", "c", "c", "", ""]


def test_a_cue_between_two_frames_is_on_the_nearest() -> None:
    cues = (Cue(0.0, 0.12, "a"), Cue(0.12, 0.14, "b"), Cue(0.14, 0.16, "c"), Cue(0.16, 0.19, "d"), Cue(0.19, 0.4, "e"))
    assert symbols(place_cues(cues, 0.4, Fraction(10))) == ["a", "ab", "cde", "e"]
    assert symbols(place_cues((Cue(0.36, 0.4, "z"),), 0.4, Fraction(10))) == ["", "", "", "z"]


@given(sheet=sheets(), rate=st.sampled_from(RATES))
def test_every_cue_is_on_a_frame_and_in_order(sheet: CueSheet, rate: Fraction) -> None:
    short = CueSheet(sheet.length_s, sheet.tiers) if sheet.length_s < 60 else CueSheet(60.0, {"w": ()})
    for cues in short.tiers.values():
        placed = [cue for there in place_cues(cues, short.length_s, rate) for cue in there]
        assert set(placed) == set(cues)
        assert placed == sorted(placed)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize(("shut", "open_"), [("A", "D"), ("G", "C"), ("PP", "aa"), ("FV", "AI"), ("21", "2")])
def test_no_closure_is_lost_at_any_rate(rate: Fraction, shut: str, open_: str) -> None:
    for start in range(0, 100, 3):
        first = 0.3 + start / 1000
        shapes = (Cue(0.0, first, open_), Cue(first, first + 0.012, shut), Cue(first + 0.012, 0.9, open_))
        frames = choose_shapes(shapes, 1.0, rate, find_set([shut, open_]))
        on = [frame for frame, shape in enumerate(frames) if shape == shut]
        assert len(on) == 1
        assert abs(on[0] / rate - (first + 0.006)) <= 0.5 / rate + 1e-6


def test_a_gap_among_shapes_is_the_rest_of_their_set() -> None:
    shapes = (Cue(0.1, 0.2, "PP"), Cue(0.2, 0.3, "aa"))
    assert choose_shapes(shapes, 0.5, Fraction(10), find_set(["PP", "aa"])) == ("sil", "PP", "aa", "sil", "sil")


def test_sets_of_shapes_are_those_of_the_vocabularies_and_have_mouths() -> None:
    assert set(shape_sets()) == {"rhubarb", "preston-blair", "oculus", "sapi"}
    for name, shapes in shape_sets().items():
        assert list(shapes.mouths) == list(vocabulary(name).names)
        assert set(shapes.mouths.values()) <= set(mouth_sayings())
    assert find_set(["E", "ih", "sil"]).name == "oculus"
    assert find_set(["E", "A", "X"]).name == "rhubarb"
    assert find_set(["E", "etc"]).name == "preston-blair"
    assert find_set(["0", "12"]).name == "sapi"
    assert find_set(["hello"]).name == "rhubarb"


def test_a_chart_is_a_row_a_frame(tmp_path: Path) -> None:
    write_cue_file(hello(), tmp_path / "a.csv", fps=10)
    with (tmp_path / "a.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["frame", "time_s", "word", "phone", "shape"]
    assert len(rows) == 1 + 15
    assert rows[1] == ["0", "0", "", "SIL", "X"]
    assert rows[1 + 2] == ["2", "0.2", "Hello", "HH", "C"]
    assert rows[1 + 8] == ["8", "0.8", 'né"e', "N", "C"]
    assert rows[1 + 14] == ["14", "1.4", "", "SIL", "X"]


def test_a_chart_of_words_alone_has_no_mouths_and_one_of_nothing_is_refused() -> None:
    words = CueSheet(1.0, {"words": (Cue(0.0, 0.5, "Oh"),)})
    assert [row.shape for row in chart_rows(words, Fraction(2))] == ["", ""]
    assert "mouth-" not in "".join(format_page(words, Fraction(2)))
    with pytest.raises(MienError, match="want a tier 'words', 'phones' or 'shapes', got 'tones'"):
        list(format_chart(CueSheet(1.0, {"tones": ()}), Fraction(2)))


class Page(HTMLParser):
    """Counts frames and sheets of paper, and makes sure that what is opened is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.frames: list[int] = []
        self.sheets = 0
        self._covered = [0, 0]
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given_ = dict(attributes)
        if tag not in VOID:
            self.open.append(tag)
        self.sheets += given_.get("class") == "sheet"
        for place, kind in enumerate(("word", "phone")):
            if tag == "td" and (given_.get("class") or "").startswith(kind):
                assert self._covered[place] == 0
                self._covered[place] = int(given_["rowspan"] or 0)
        for name in ("href", "src"):
            assert (given_.get(name) or "#").startswith("#")

    def handle_endtag(self, tag: str) -> None:
        if tag in VOID:
            return
        assert self.open.pop() == tag
        if tag == "tr" and "tbody" in self.open:
            self._covered = [count - 1 for count in self._covered]
            assert min(self._covered) >= 0
        if tag == "table":
            assert self._covered == [0, 0]

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] == "th" and data.isdecimal():
            self.frames.append(int(data))


@pytest.mark.parametrize(
    ("rate", "length_s", "pages"), [(24, 4.0, 1), (24, 4.1, 2), (25, 4.0, 1), (60, 2.1, 2), (240, 1.0, 3)]
)
def test_a_page_has_every_frame_once_and_words_cover_their_rows(rate: int, length_s: float, pages: int) -> None:
    words = (Cue(0.1, 0.9, "one"), Cue(1.2, length_s - 0.1, "<two>")) if length_s > 2 else ()
    sheet = CueSheet(length_s, {"words": words, "phones": words, "shapes": (Cue(0.0, length_s, "A"),)})
    page = Page("".join(format_page(sheet, Fraction(rate))))
    assert page.frames == list(range(len(chart_rows(sheet, Fraction(rate)))))
    assert page.sheets == pages
    assert page.open == []


def test_a_page_says_what_it_shows_and_needs_nothing_else() -> None:
    sheet = CueSheet(
        1.0, {"words": (Cue(0.2, 0.8, "a<b"),), "shapes": (Cue(0.0, 1.0, "A"),)}, "a&b.wav", "He said a<b."
    )
    text = "".join(format_page(sheet, Fraction(24000, 1001)))
    for told in ("a&amp;b.wav · 23.976 frames a second · 1 s · 24 frames", "<h1>He said a&lt;b.</h1>", ">a&lt;b</td>"):
        assert told in text
    assert not re.search(r"https?:|@import|<script|<link", text)
    assert 'href="#mouth-shut"' in text
    assert 'id="mouth-shut"' in text


def test_mouths_are_well_drawn_and_open_as_far_as_they_say() -> None:
    root = ElementTree.fromstring(f"<svg>{mouth_symbols()}</svg>")
    mouths = {each.get("id"): each for each in root}
    assert set(mouths) == {f"mouth-{name}" for name in mouth_sayings()}

    def height(name: str) -> float:
        path = mouths[f"mouth-{name}"].find("path")
        assert path is not None
        numbers = [float(number) for number in re.findall(r"-?[\d.]+", path.get("d") or "")]
        return max(numbers[1::2]) - min(numbers[1::2])

    assert height("shut") < height("teeth") < height("open") < height("wide")
