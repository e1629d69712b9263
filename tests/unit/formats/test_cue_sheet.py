"""Sheets of cues: what they take, and what they refuse with the place where it is."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mien.core import Cue, MienError
from mien.formats import CueSheet
from mien.formats.cue_sheet import fill_gaps, sheet_of
from mien.timeline import Timeline


@pytest.mark.parametrize(
    ("cues", "said"),
    [
        ([Cue(0.0, 0.5, "a"), Cue(0.4, 0.6, "b")], r"tier 'phones', interval 2: 'b' from 0.4 to 0.6 s begins before"),
        ([Cue(0.5, 0.9, "a"), Cue(0.1, 0.2, "b")], r"interval 2: .* begins before the one before it ends, at 0.9 s"),
        ([Cue(0.5, 0.4, "a")], r"interval 1: 'a' from 0.5 to 0.4 s does not end after it begins"),
        ([Cue(0.5, 0.5, "a")], "does not end after it begins"),
        ([Cue(-0.1, 0.5, "a")], "begins before 0"),
        ([Cue(0.1, 1.5, "a")], "ends after everything does, at 1 s"),
        ([Cue(0.1, math.nan, "a")], "no finite number"),
        ([Cue(math.inf, 0.2, "a")], "no finite number"),
        ([Cue(0.1, 0.2, "  ")], "has no symbol"),
        ([Cue(0.1, 0.2, "a\x00")], r"interval 1: 'a\\x00' holds a character that no text can have"),
        ([Cue(0.1, 0.2, "\ud800")], "holds a character that no text can have"),
    ],
)
def test_cues_out_of_order_are_refused_with_tier_and_number(cues: list[Cue], said: str) -> None:
    with pytest.raises(MienError, match=said):
        CueSheet(1.0, {"phones": tuple(cues)})


@pytest.mark.parametrize("length_s", [0.0, -1.0, math.nan, math.inf, 1e9])
def test_a_length_that_nothing_has_is_refused(length_s: float) -> None:
    with pytest.raises(MienError, match="length"):
        CueSheet(length_s, {"words": ()})


def test_a_sheet_without_tiers_is_refused() -> None:
    with pytest.raises(MienError, match="no tier"):
        CueSheet(1.0, {})


def test_times_that_another_program_rounded_overlap_by_less_than_a_microsecond() -> None:
    sheet = CueSheet(1.0, {"phones": (Cue(0.0, 0.5000001, "a"), Cue(0.5, 1.0000001, "b"))})
    assert [(cue.start_s, cue.end_s) for cue in fill_gaps(sheet.tiers["phones"], 1.0)] == [
        (0.0, 0.5000001),
        (0.5000001, 1.0000001),
    ]


def test_numbers_of_numpy_become_plain_ones() -> None:
    sheet = CueSheet(np.float64(1.0), {"words": (Cue(np.float64(0.0), np.float64(1.0), "a"),)})
    assert type(sheet.length_s) is type(sheet.tiers["words"][0].end_s) is float


def test_gaps_are_filled_from_nothing_to_the_end() -> None:
    assert list(fill_gaps([Cue(0.2, 0.4, "a"), Cue(0.4, 0.5, "b"), Cue(0.7, 0.8, "c")], 1.0, "-")) == [
        Cue(0.0, 0.2, "-"),
        Cue(0.2, 0.4, "a"),
        Cue(0.4, 0.5, "b"),
        Cue(0.5, 0.7, "-"),
        Cue(0.7, 0.8, "c"),
        Cue(0.8, 1.0, "-"),
    ]


def test_the_sheet_of_a_timeline_has_its_words_phones_and_text() -> None:
    words, phones = (Cue(0.1, 0.3, "Oh"),), (Cue(0.0, 0.1, "SIL"), Cue(0.1, 0.4, "OW1"))
    sheet = sheet_of(Timeline((), 0.5, words=words, phones=phones, text="Oh!"))
    assert (sheet.length_s, sheet.text, dict(sheet.tiers)) == (0.5, "Oh!", {"words": words, "phones": phones})
    with pytest.raises(MienError, match="no word is said"):
        sheet_of(Timeline((), 1.0))
