"""Marked texts in sentences: nothing is lost, marks stay with their words, what cannot be followed is refused."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Cue, MienError
from mien.live import standard_motions
from mien.live.sentences import LEAD_S, SOON, Sentence, cut_sentence, read_marks, split_sentences, time_acts
from mien.perform.directions import follow_marks
from mien.speech.text import LONGEST_PASSAGE, SENTENCE_PAUSE_S

MOTIONS = tuple(standard_motions())


def sentences(text, language="en"):
    return list(split_sentences(read_marks(text, MOTIONS), language))


def marks(sentence):
    return [(type(mark.act).__name__, mark.place) for mark in sentence.marked.marks]


def test_sentences_end_where_a_voice_lets_them_end():
    found = sentences("Dr. Smith is in. Are you?\nYes")
    assert [sentence.text for sentence in found] == ["Dr. Smith is in.", "Are you?", "Yes"]
    assert found[0].tail_s == SENTENCE_PAUSE_S - LEAD_S
    assert [len(sentences("Am 3. Mai kam er. Gut.", language)) for language in ("de", "en")] == [2, 3]


def test_marks_go_with_the_words_they_stand_before():
    first, second, third = sentences("[smile] Well.\r\n[look left] So [nod] it goes. *Bye* now.[neutral]")
    assert (first.text, marks(first)) == ("Well.", [("Expression", 0)])
    assert (second.text, marks(second)) == ("So it goes.", [("Look", 0), ("Expression", 3)])
    assert (third.text, marks(third)) == ("Bye now.", [("Emphasis", 0), ("Expression", 8)])


def test_marks_without_words_are_kept_and_nothing_is_nothing():
    (alone,) = sentences(" [nod] ")
    assert (alone.text, marks(alone)) == ("", [("Expression", 0)])
    assert sentences(" \n") == []


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[dance]", "unknown motion in line 1, column 1: 'dance'"),
        ("Well [smile", "no ']'"),
        ("[au 1=0.5] Oh", "not played live"),
        ("<break time='50s'/> Oh <break time='50s'/>", "100 s in one text"),
        ("<emphasis>Oh", "not ended"),
    ],
)
def test_what_cannot_be_followed_is_refused(text, words):
    with pytest.raises(MienError) as caught:
        read_marks(text, MOTIONS)
    assert words in str(caught.value)


def test_a_long_sentence_begins_with_its_first_clauses_and_a_short_one_is_whole():
    long = "Since it was late, and the day had been long, we went home without a word to anybody, and slept until noon."
    first, rest = cut_sentence(*sentences(f"Since it was late, [smile] {long[19:]}"))
    assert f"{first.text} {rest.text}" == long
    assert len(first.text) <= SOON < len(long)
    assert first.text == "Since it was late, and the day had been long, we went home without a word to anybody,"
    assert (marks(first), marks(rest)) == ([("Expression", 19)], [])
    assert rest.tail_s == sentences(long)[0].tail_s > first.tail_s
    for whole in ("Short, though.", "x" * 20 + " and so on" * 10):
        assert len(cut_sentence(*sentences(whole))) == 1


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.sampled_from(["Hello ", "there. ", "Dr. ", "no, ", "and so on ", "[smile] ", "\n", "\r\n", "!? ", "(a) "]),
        max_size=90,
    )
)
def test_no_word_and_no_mark_is_lost(pieces):
    text = "".join(pieces)
    found = [part for sentence in sentences(text) for part in cut_sentence(sentence)]
    words = "".join("".join(sentence.text for sentence in found).split())
    assert words == "".join(text.replace("[smile]", "").split())
    assert sum(len(sentence.marked.marks) for sentence in found) == text.count("[smile]")
    assert all(len(sentence.text) <= LONGEST_PASSAGE and sentence.tail_s > 0 for sentence in found)
    assert all(0 <= mark.place <= len(sentence.text) for sentence in found for mark in sentence.marked.marks)


def test_marks_become_messages_at_their_words():
    (sentence,) = sentences("So [smile 0.5] it [look up] goes [neutral]")
    words = (Cue(0.5, 0.6, "So"), Cue(1.0, 1.2, "it"), Cue(2.0, 2.5, "goes"))
    acts = sorted(time_acts(follow_marks(sentence.marked, words, 4.0)), key=lambda act: act[0])
    assert acts == [
        (pytest.approx(0.8), {"kind": "play", "motion": "smile", "strength": 0.5}),
        (pytest.approx(1.88), {"kind": "look", "at": "up", "head": 1.0}),
        (pytest.approx(2.3), {"kind": "stop", "layer": "expression"}),
        (pytest.approx(3.18), {"kind": "look", "at": "viewer"}),
    ]
    assert isinstance(sentence, Sentence)
