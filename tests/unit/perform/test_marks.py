"""Marks in a text: what is left of it, what they say, and every mistake with its place."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.core import MienError, RangeError, UnknownNameError
from mien.perform import parse_marks
from mien.perform.marks import Break, Emphasis, Expression, Look, Mark, Units

HELLO = 'I am [smile 0.6] so *happy* <break time="400ms"/> to see you.\n[look left] Who is <emphasis>that</emphasis>?'


def acts(text: str) -> list[object]:
    return [mark.act for mark in parse_marks(text).marks]


def test_marks_are_taken_out_and_have_their_places() -> None:
    marked = parse_marks(HELLO)
    assert marked.text == "I am so happy to see you.\nWho is that?"
    assert marked.marks == (
        Mark(Expression("smile", 0.6), 5, 1, 6),
        Mark(Emphasis(13), 8, 1, 21),
        Mark(Break(0.4), 14, 1, 29),
        Mark(Look("left"), 26, 2, 1),
        Mark(Emphasis(37), 33, 2, 20),
    )
    assert [marked.text[mark.place :].split()[0] for mark in marked.marks] == ["so", "happy", "to", "Who", "that?"]
    assert marked.pauses == {14: 0.4}


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("[smile] Hello.", "Hello."),
        ("Hello [smile].", "Hello."),
        ("Hello [smile], you.", "Hello, you."),
        ("Hello.\n[smile]\nYou.", "Hello.\nYou."),
        ("Hello.\n\n[smile]\n\nYou.", "Hello.\n\nYou."),
        ("Hello [smile]\nyou.", "Hello \nyou."),
        ("un<break/>like", "unlike"),
        ("a [smile] [look up] b", "a b"),
        ("*so [smile] happy*", "so happy"),
        ("**so** ***far***", "so far"),
    ],
)
def test_blanks_around_a_mark_stay_once(text: str, plain: str) -> None:
    assert parse_marks(text).text == plain


@pytest.mark.parametrize(
    "text",
    [
        "Shown before [1], and [2, 3].",
        "I <3 you",
        "1 < 2 > 0",
        "5 * 3 * 2",
        "* one\n* two",
        "Price* and *more",
        "[…]",
        "a*b*c",
        "***",
    ],
)
def test_what_is_no_mark_stays_as_it_is(text: str) -> None:
    assert (parse_marks(text).text, parse_marks(text).marks) == (text, ())


@given(st.text("ab \n.,1é☃", max_size=40))
def test_a_text_without_signs_is_its_own_plain_text(text: str) -> None:
    assert parse_marks(text).text == text


@given(st.text("ab[]<>*\\1 /=\n", max_size=30))
def test_escaped_signs_are_text(text: str) -> None:
    escaped = "".join("\\" + sign if sign in "[]<>*\\" else sign for sign in text)
    assert (parse_marks(escaped).text, parse_marks(escaped).marks) == (text, ())


@given(st.lists(st.sampled_from(["[smile]", "[", "]", "<break/>", "</emphasis>", "<emphasis>", "*", "a", " ", "\n"])))
def test_any_text_is_understood_or_refused_with_its_place(parts: list[str]) -> None:
    text = "".join(parts)
    try:
        marked = parse_marks(text)
    except MienError:
        with pytest.raises(MienError, match=r"line \d+, column \d+"):
            parse_marks(text)
    else:
        assert all(0 <= mark.place <= len(marked.text) for mark in marked.marks)


def test_action_units_are_written_as_on_the_command_line() -> None:
    assert acts("[au 1=0.5,2=0.5] a") == [Units({"AU1": 0.5, "AU2": 0.5})]
    assert acts("[au 12C] a") == [Units({"AU12": 0.6})]


@pytest.mark.parametrize(
    ("tag", "length_s"),
    [
        ("<break/>", 0.5),
        ("<break time='0.25s'/>", 0.25),
        ('<break  time = "60s" />', 60.0),
        ('<break time="0ms">', 0.0),
    ],
)
def test_breaks(tag: str, length_s: float) -> None:
    assert acts(tag) == [Break(length_s)]


def test_breaks_at_one_place_add_up() -> None:
    assert parse_marks("a <break/> <break time='100ms'/> b").pauses == {2: 0.6}


def test_levels_of_emphasis() -> None:
    assert acts('<emphasis level="moderate">so <emphasis>very</emphasis></emphasis> *a*') == [
        Emphasis(7, 0.7),
        Emphasis(7, 1.0),
        Emphasis(9, 1.0),
    ]


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("a\n [smile", MienError, r"line 2, column 2: '\[' begins a mark that no '\]' in its line ends"),
        ("a <emphasis", MienError, r"line 1, column 3: '<' begins a mark"),
        ("a\nb <emphasis>c", MienError, r"line 2, column 3: the emphasis is not ended — add </emphasis>"),
        ("a </emphasis>", MienError, r"line 1, column 3: </emphasis> ends what was not begun"),
        ("<brake/>", UnknownNameError, r"unknown tag in line 1, column 1: 'brake' — did you mean 'break'\?"),
        ("<break tim='1s'/>", UnknownNameError, r"attribute of <break> in line 1, column 1: 'tim' .* 'time'"),
        ("<break time=1s/>", MienError, r"line 1, column 1: 'time=1s' in <break> is no attribute"),
        ("<break time='soon'/>", MienError, r"line 1, column 1: 'soon' is no time"),
        ("<break time='61s'/>", RangeError, r"line 1, column 1: a break of 61 s is too long — it goes up to 60 s"),
        ("<emphasis level='huge'>a</emphasis>", UnknownNameError, r"level of <emphasis> in line 1, column 1: 'huge'"),
        ("</break>", MienError, r"</break> ends what was not begun"),
        ("a [look lef]", UnknownNameError, r"direction in line 1, column 3, \[look lef\]: 'lef' — did you mean 'left'"),
        ("[look]", UnknownNameError, r"unknown direction in line 1, column 1, \[look\]: ''"),
        ("[smile 1.5]", RangeError, r"line 1, column 1, \[smile 1.5\]: 1.5 is out of range"),
        ("[smile nan]", RangeError, r"nan is out of range"),
        ("[so it goes]", MienError, r"line 1, column 1: \[so it goes\] is no mark .* written \\\["),
        ("[au]", MienError, r"line 1, column 1: \[au\] names no action unit"),
        ("[au 1=2]", RangeError, r"line 1, column 1, \[au 1=2\]: AU1: 2 is out of range"),
        ("[au x]", MienError, r"line 1, column 1, \[au x\]: 'x' is not an action unit"),
        ("[au 999]", MienError, r"line 1, column 1, .*AU999"),
    ],
)
def test_mistakes_name_their_place(text: str, error: type[MienError], message: str) -> None:
    with pytest.raises(error, match=message):
        parse_marks(text)


def test_a_long_text_with_many_marks_is_read_in_time_that_grows_with_it() -> None:
    text = "[smile] one *two* <break/> three.\n" * 20000
    marked = parse_marks(text)
    assert len(marked.marks) == 60000
    assert (marked.marks[-1].line, marked.marks[-1].column) == (20000, 19)
    assert marked.text == "one two three.\n" * 20000
