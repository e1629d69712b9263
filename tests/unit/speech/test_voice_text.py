from __future__ import annotations

import string

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.speech.text import (
    CLAUSE_PAUSE_S,
    LINE_PAUSE_S,
    LONGEST_PASSAGE,
    PARAGRAPH_PAUSE_S,
    SENTENCE_PAUSE_S,
    find_clause,
    find_complete,
    match_words,
    prepare_word,
    read_spoken_symbols,
    split_passages,
    split_words,
    trim_word,
)

ENGLISH = frozenset(string.printable.strip()) | frozenset("éï“”‘’—…²½")


def passages(text: str) -> list[str]:
    return [passage.text for passage in split_passages(text)]


def test_lines_of_a_poem_are_said_one_by_one():
    first, second = split_passages("How happy is the little stone\nThat rambles in the road alone,\n")
    assert first.text == "How happy is the little stone"
    assert (first.pause_s, first.goes_on) == (LINE_PAUSE_S, True)
    assert (second.text, second.goes_on) == ("That rambles in the road alone,", False)


def test_a_line_broken_by_an_editor_is_no_line_of_verse():
    wrapped = "It was the best of times, it was the worst of times, it was the age\nof wisdom."
    assert passages(wrapped) == ["It was the best of times, it was the worst of times, it was the age of wisdom."]
    assert passages("so much depends\nupon") == ["so much depends", "upon"]


@pytest.mark.parametrize(
    ("text", "want"),
    [
        ("Yes! No? (Maybe.) “Quote.” Next", ["Yes!", "No?", "(Maybe.)", "“Quote.”", "Next"]),
        ("Dr. Smith met J. K. Rowling. They left.", ["Dr. Smith met J. K. Rowling.", "They left."]),
        ("It costs 3.50 at 5 p.m. on weekdays.", ["It costs 3.50 at 5 p.m. on weekdays."]),
        ("Well ... maybe... Yes.", ["Well ... maybe...", "Yes."]),
        ("I said no. No. Never. See No. 5.", ["I said no.", "No.", "Never.", "See No. 5."]),
        ("So do I. You too.", ["So do I.", "You too."]),
        ("one\r\ntwo\u2028three", ["one", "two", "three"]),
        (" \n\t\n", []),
    ],
)
def test_sentences(text: str, want: list[str]):
    assert passages(text) == want


def test_sentences_of_a_text_that_is_being_written_are_complete_when_something_follows():
    assert find_complete("It is 3.") == []
    assert find_complete("It is 3. ") == [9]
    assert find_complete("It is 3.5 m. We") == [13]
    assert find_complete("Ask Dr. Smith. Or J. ") == [15]
    assert find_complete("Am 3. Mai. Oder am 4. ", "de") == [11]


def test_clauses_are_found_within_lengths():
    text = "So, as it is late, we go home: now."
    assert find_clause(text, 100, 1) == len("So, as it is late, we go home: ")
    assert find_clause(text, 25, 1) == len("So, as it is late, ")
    assert find_clause(text, 10, 5) == 0


def test_pauses_grow_with_the_boundary():
    pauses = [passage.pause_s for passage in split_passages("One. Two.\n\nThree\nFour")]
    assert pauses[:3] == [SENTENCE_PAUSE_S, PARAGRAPH_PAUSE_S, LINE_PAUSE_S]


def test_a_long_sentence_is_cut_after_a_clause():
    clause = "and the wind blew over the hill, "
    pieces = list(split_passages(clause * 20))
    assert all(piece.text.endswith("hill,") for piece in pieces)
    assert all(piece.pause_s == CLAUSE_PAUSE_S and not piece.goes_on for piece in pieces[:-1])


@settings(deadline=None, max_examples=60)
@given(st.text(alphabet=st.sampled_from("ab .,\n!?éX"), max_size=900))
def test_passages_hold_every_word_and_none_is_too_long(text: str):
    pieces = list(split_passages(text))
    assert "".join("".join(piece.text.split()) for piece in pieces) == "".join(text.split())
    assert all(len(piece.text) <= LONGEST_PASSAGE for piece in pieces)
    ends = [piece.end for piece in pieces]
    assert ends == sorted(ends)
    assert not ends or ends[-1] <= len(text)


@pytest.mark.parametrize(
    ("passage", "want"),
    [
        ("road—alone", ["road—", "alone"]),
        ("a -- b", ["a --", "b"]),
        ("wait...what", ["wait...", "what"]),
        ("well-known don't", ["well-known", "don't"]),
        ("- 你好", ["-", "你好"]),
    ],
)
def test_words_as_written(passage: str, want: list[str]):
    assert split_words(passage) == want


@pytest.mark.parametrize(
    ("word", "want"),
    [("alone,", "alone"), ("“quoted”", "quoted"), ("‘Don’t.’", "Don’t"), ("$9.99", "$9.99"), ("road—", "road"),
     ("'90s", "'90s"), ("zero\ufeff", "zero"), ("&", "&"), ("...", "...")],
)  # fmt: skip
def test_punctuation_around_a_word_is_left_out(word: str, want: str):
    assert trim_word(word) == want


@pytest.mark.parametrize(
    ("word", "spoken", "skipped"),
    [
        ("naïve", ("naïve",), ()),
        ("ＨＥＬＬＯ", ("HELLO",), ()),
        ("𝐛𝐨𝐥𝐝", ("bold",), ()),
        ("ế", ("e",), ()),
        ("٣", ("3",), ()),
        ("π", ("pi",), ()),
        ("λόγος", (), ("λόγος",)),
        ("hi🙂👍🏽there", ("hi", "there"), ("🙂👍🏽",)),
        ("👩‍👧", (), ("👩‍👧",)),
        ("你好。", (".",), ("你好",)),
        ("so\u00adft", ("soft",), ()),
        ("3≤4", ("3", "is", "at", "most", "4"), ()),
        ("«oui»", ("“oui”",), ()),
        ("a\udcffb", ("a", "b"), ("\ufffd",)),
    ],
)
def test_what_is_said_for_a_word(word: str, spoken: tuple[str, ...], skipped: tuple[str, ...]):
    prepared = prepare_word(word, ENGLISH)
    assert (prepared.spoken, prepared.skipped) == (spoken, skipped)


@settings(deadline=None, max_examples=200)
@given(st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=8))
def test_a_letter_is_either_said_or_skipped(word: str):
    prepared = prepare_word(word, ENGLISH)
    said = set("".join(prepared.spoken))
    assert said <= ENGLISH
    if any(character.isalpha() for character in word):
        assert prepared.spoken or prepared.skipped


def test_every_symbol_is_said_in_letters_and_marks_that_the_voice_has():
    for symbol, spoken in read_spoken_symbols().items():
        assert len(symbol) == 1
        assert set(spoken.replace(" ", "")) <= ENGLISH, symbol


@pytest.mark.parametrize(
    ("before", "after", "want"),
    [
        ("paid $5 million today", "paid 5 million dollars today", [0, 1, 2, 2, 3]),
        ("Dr. Smith", "Dr Smith", [0, 1]),
        ("x² is", "x squared is", [0, 0, 1]),
        ("3 / 4 cups", "three quarters cups", [0, 1, 3]),
        ("a", "", []),
    ],
)
def test_rewritten_words_stand_for_written_ones(before: str, after: str, want: list[int]):
    assert match_words(before.split(), after.split()) == want
