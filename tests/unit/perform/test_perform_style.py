import re

import pytest

from mien.cli.say import say
from mien.core import MienError, RangeError, UnknownNameError
from mien.perform import Style, named_styles, parse_style, style_table


@pytest.mark.parametrize(
    ("text", "style"),
    [
        ("", Style()),
        ("blinks=off,head=0.5", Style(blinks=0.0, head=0.5)),
        (" brows = ON , gaze=no ", Style(brows=1.0, gaze=0.0)),
        ("strength=1.5", Style(strength=1.5)),
        ("head=1,", Style()),
        ("mumbling", Style(jaw=0.3, lips=0.35, tongue=0.6, dominance=1.3, brows=0.5)),
        ("jaw=1,mumbling,still,head=1", Style(jaw=1, lips=0.35, tongue=0.6, dominance=1.3, blinks=0, brows=0, gaze=0)),
    ],
)
def test_style_is_parsed(text: str, style: Style) -> None:
    assert parse_style(text) == style


def test_switches_may_be_booleans() -> None:
    assert Style(blinks=False, head=True) == Style(blinks=0.0)


def test_unknown_amount_is_refused_with_near_matches() -> None:
    with pytest.raises(UnknownNameError, match="did you mean 'blinks'"):
        parse_style("blink=off")


@pytest.mark.parametrize(
    ("text", "message"), [("head", "name=value"), ("head=much", "on or off"), ("head=1,head=0", "twice")]
)
def test_what_cannot_be_read_is_refused(text: str, message: str) -> None:
    with pytest.raises(MienError, match=message):
        parse_style(text)


@pytest.mark.parametrize("text", ["head=-1", "head=2.1", "head=nan", "strength=inf", "closures=1.1"])
def test_amount_out_of_range_is_refused(text: str) -> None:
    with pytest.raises(RangeError, match="out of range"):
        parse_style(text)


def test_the_help_names_everything_that_a_style_can_set() -> None:
    words = re.findall(r"\w+", say.__annotations__["style"])
    for name in [*style_table(), *named_styles()]:
        assert name in words


def test_every_amount_says_what_it_does_and_every_pass_what_it_is_measured_by() -> None:
    for row in style_table().values():
        assert row.doc
        assert row.source
    assert [name for name, row in style_table().items() if not row.measure] == [
        "strength", "blinks", "head", "brows", "gaze",
    ]  # fmt: skip
