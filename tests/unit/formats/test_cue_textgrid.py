"""TextGrids: as Praat writes them, in both forms and all encodings, and what is said of broken ones."""

from __future__ import annotations

import codecs
from pathlib import Path

import pytest
from cue_cases import hello, sheets
from hypothesis import given

from mien.core import Cue, LoadError
from mien.formats import CueSheet, read_cue_file, write_cue_file
from mien.formats.cue_textgrid import format_textgrid, parse_textgrid

LONG = """File type = "ooTextFile"
Object class = "TextGrid"

xmin = 0 
xmax = 1.5 
tiers? <exists> 
size = 2 
item []: 
    item [1]:
        class = "IntervalTier" 
        name = "words" 
        xmin = 0 
        xmax = 1.5 
        intervals: size = 3 
        intervals [1]:
            xmin = 0 
            xmax = 0.25 
            text = "" 
        intervals [2]:
            xmin = 0.25 
            xmax = 1 
            text = "say ""Ah""\" 
        intervals [3]:
            xmin = 1 
            xmax = 1.5 
            text = "" 
    item [2]:
        class = "IntervalTier" 
        name = "phones" 
        xmin = 0 
        xmax = 1.5 
        intervals: size = 1 
        intervals [1]:
            xmin = 0 
            xmax = 1.5 
            text = "ɑː" 
"""

SHEET = CueSheet(1.5, {"words": (Cue(0.25, 1.0, 'say "Ah"'),), "phones": (Cue(0.0, 1.5, "ɑː"),)})

SHORT = """File type = "ooTextFile"
Object class = "TextGrid"

0
1.5
<exists>
2
"IntervalTier"
"words"
0
1.5
3
0
0.25
""
0.25
1
"say ""Ah""\"
1
1.5
""
"IntervalTier"
"phones"
0
1.5
1
0
1.5
"ɑː"
"""


def test_the_long_form_is_what_praat_writes() -> None:
    assert "".join(format_textgrid(SHEET)) == LONG


@pytest.mark.parametrize(
    "text", [LONG, SHORT, SHORT.replace("\n", " "), SHORT.replace('"ooTextFile"', '"ooTextFile short"')]
)
def test_both_forms_are_read(text: str) -> None:
    assert parse_textgrid(text, "a.TextGrid") == SHEET


@pytest.mark.parametrize(
    ("mark", "encoding"),
    [
        (b"", "utf-8"),
        (codecs.BOM_UTF8, "utf-8"),
        (codecs.BOM_UTF16_LE, "utf-16-le"),
        (codecs.BOM_UTF16_BE, "utf-16-be"),
        (b"", "utf-16-le"),
        (b"", "utf-16-be"),
    ],
)
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_every_encoding_and_line_ending_is_read(tmp_path: Path, mark: bytes, encoding: str, newline: str) -> None:
    path = tmp_path / "a.textGrid"
    path.write_bytes(mark + LONG.replace("\n", newline).encode(encoding))
    assert read_cue_file(path) == SHEET


@given(sheets())
def test_any_sheet_reads_back_to_the_last_bit(sheet: CueSheet) -> None:
    read = parse_textgrid("".join(format_textgrid(sheet)), "a.TextGrid")
    assert (read.length_s, dict(read.tiers)) == (sheet.length_s, dict(sheet.tiers))


def test_a_file_reads_back(tmp_path: Path) -> None:
    write_cue_file(hello(), tmp_path / "hello.TextGrid")
    assert dict(read_cue_file(tmp_path / "hello.TextGrid").tiers) == dict(hello().tiers)


def test_comments_units_and_words_between_are_passed_over() -> None:
    text = '"ooTextFile" "TextGrid" ! "a comment" 7\n0s 2s <exists> 1 tiers\n"IntervalTier" "a" 0 2 1 0.0 2e0 "b!c"'
    assert parse_textgrid(text, "a.TextGrid") == CueSheet(2.0, {"a": (Cue(0.0, 2.0, "b!c"),)})


def test_tiers_of_points_are_left_out_and_equal_names_kept_apart() -> None:
    tier = '"IntervalTier" "a" 0 1 1 0 1 "b"\n'
    points = '"TextTier" "tones" 0 1 2 0.2 "H*" 0.8 "L%"\n'
    sheet = parse_textgrid(f'"ooTextFile" "TextGrid" 0 1 <exists> 3\n{tier}{points}{tier}', "a.TextGrid")
    assert list(sheet.tiers) == ["a", "a (2)"]


def test_a_line_break_in_a_label_stays() -> None:
    text = SHORT.replace('"ɑː"', '"two\nlines"')
    assert parse_textgrid(text, "a.TextGrid").tiers["phones"] == (Cue(0.0, 1.5, "two\nlines"),)


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ('"TextGrid"', '"Sound"', 2, "holds 'Sound', want a TextGrid"),
        ('"ooTextFile"\nObject class = "TextGrid"', "17", 1, "is no TextGrid — in Praat: Save as text file"),
        (
            '"ooTextFile"',
            '"Praat chronological TextGrid text file"',
            1,
            "holds 'Praat chronological TextGrid text file'",
        ),
        ("<exists>", "<absent>", 6, "has no tiers"),
        ("xmax = 1.5 \ntiers", "xmax = 0 \ntiers", 5, "no span of time"),
        ("size = 2", "size = 3", 36, "size is 3, but the tiers end after 2"),
        ("size = 2", "size = 1", 26, "size is 1, but more tiers follow"),
        ("size = 2", "size = two", 10, 'size: want a number, got "IntervalTier"'),
        ("size = 2", "size = 1.5", 7, "want a whole number, got 1.5"),
        ("intervals: size = 3", "intervals: size = 2", 22, "tier 'words': its size is 2, but more follow"),
        (
            "intervals: size = 3",
            "intervals: size = 4",
            26,
            "tier 'words': its size is 4, but the intervals end after 3",
        ),
        (
            "intervals: size = 1",
            "intervals: size = 2",
            36,
            "tier 'phones': its size is 2, but the intervals end after 1",
        ),
        ("xmin = 1 ", "xmin = 0.9 ", 24, "tier 'words', interval 3: '' from 0.9 to 1.5 s begins before"),
        ("xmax = 1 ", "xmax = 0.2 ", 20, "tier 'words', interval 2: .* does not end after it begins"),
        ("xmin = 0.25", "xmin = -0.25", 20, "tier 'words', interval 2: .* begins before 0"),
        ("xmin = 0.25", "xmin = nan", 20, "tier 'words', interval 2: xmin: want a number, got nan"),
        ("xmin = 0.25", "xmin = 0,25", 20, "want a number, got 0,25"),
        ("xmax = 1 ", "xmax = 1.6 ", 20, "tier 'words', interval 2: .* ends after everything does, at 1.5 s"),
        ('"IntervalTier"', '"FormantTier"', 11, "tier 1 is a 'FormantTier'"),
        ('""Ah""" ', '""Ah"" ', 22, "tier 'words'"),
        ('text = "ɑː"', "text = 5", 36, "tier 'phones', interval 1: text: want a text, got 5"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(old: str, new: str, line: int, said: str) -> None:
    assert old in LONG
    with pytest.raises(LoadError, match=said) as caught:
        parse_textgrid(LONG.replace(old, new, 1), "a.TextGrid")
    assert caught.value.line == line


@pytest.mark.parametrize("text", [LONG, SHORT])
def test_a_file_cut_off_anywhere_is_refused(text: str) -> None:
    whole = text.rstrip()
    for end in range(len(whole)):
        with pytest.raises(LoadError):
            parse_textgrid(whole[:end], "a.TextGrid")
