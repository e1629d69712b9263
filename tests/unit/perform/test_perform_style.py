import pytest

from mien.core import MienError, RangeError, UnknownNameError
from mien.perform import Style, parse_style


@pytest.mark.parametrize(
    ("text", "style"),
    [
        ("", Style()),
        ("blinks=off,head=0.5", Style(blinks=0.0, head=0.5)),
        (" brows = ON , gaze=no ", Style(brows=1.0, gaze=0.0)),
        ("strength=1.5", Style(strength=1.5)),
        ("head=1,", Style()),
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


@pytest.mark.parametrize("text", ["head=-1", "head=2.1", "head=nan", "strength=inf"])
def test_amount_out_of_range_is_refused(text: str) -> None:
    with pytest.raises(RangeError, match="out of range"):
        parse_style(text)
