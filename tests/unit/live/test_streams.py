"""Texts in parts: cut only where a sentence is over, the same however they are cut up, bounded."""

from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import MienError
from mien.live.streams import LONGEST_MARKS, MOST_STREAMS, SILENCE_S, Streams


def feed(parts, identity="a"):
    streams = Streams()
    found = [streams.add(identity, part, "en", 0.0) for part in parts]
    return [part for part in found if part], streams.end(identity)


def test_a_sentence_is_complete_when_something_follows_it():
    assert feed(["Hel", "lo th", "ere", ".", " How", " are you"]) == (["Hello there. "], "How are you")
    assert feed(["Hello there. "]) == (["Hello there. "], "")
    assert feed(["It is 3", ".", "5 m. "]) == (["It is 3.5 m. "], "")


def test_abbreviations_and_initials_end_no_sentence():
    assert feed(["Ask Dr", ". ", "Smith", " or J. ", "K. Rowling", ". Now"]) == (
        ["Ask Dr. Smith or J. K. Rowling. "],
        "Now",
    )


def test_marks_are_not_torn_apart():
    parts = ["Oh. [smi", "le 0.5] Ye", "s. <emphasis>No. ", "Never. </emphasis> ", "Go."]
    assert feed(parts) == (["Oh. ", "[smile 0.5] Yes. "], "<emphasis>No. Never. </emphasis> Go.")


def test_what_a_mark_never_closes_is_refused_and_the_text_goes_on():
    streams = Streams()
    assert streams.add("a", "<emphasis>" + "Never. " * (LONGEST_MARKS // 7 - 1), "en", 0.0) == ""
    with pytest.raises(MienError, match="not ended"):
        streams.add("a", "Never. So ", "en", 0.0)
    assert streams.characters == 0
    assert streams.add("a", "Well. So", "en", 0.0) == "Well. "


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_however_a_text_is_cut_up_its_characters_come_in_order(data):
    pieces = st.sampled_from(
        ["Hello ", "there. ", "Dr. ", "no", ", ", "[smile] ", "\n", "\n\n", "! ", "e.g. ", "A", ". "]
    )
    text = "".join(data.draw(st.lists(pieces, max_size=60)))
    cuts = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=20)))
    edges = [0, *cuts, len(text)]
    complete, rest = feed([text[first:last] for first, last in pairwise(edges)])
    assert "".join(complete) + rest == text


def test_texts_are_kept_apart_and_what_falls_silent_is_told_once():
    streams = Streams()
    streams.add("a", "Hello", "en", 0.0)
    streams.add(None, "Well", "en", 0.5)
    assert streams.take_silent(SILENCE_S - 0.01) == []
    assert streams.take_silent(SILENCE_S) == [("a", "Hello")]
    assert streams.take_silent(9.0) == [(None, "Well")]
    assert streams.take_silent(99.0) == []
    assert "a" in streams
    assert streams.end("a") == ""
    assert "a" not in streams


def test_open_texts_are_bounded_and_those_that_were_left_make_room():
    streams = Streams()
    for number in range(MOST_STREAMS):
        streams.add(str(number), "Well", "en", float(number))
    with pytest.raises(MienError, match="texts are open"):
        streams.add("another", "Well", "en", 99.0)
    streams.take_silent(SILENCE_S)
    streams.add("another", "Well", "en", 99.0)
    assert "0" not in streams
    assert streams.characters == 4 * MOST_STREAMS
