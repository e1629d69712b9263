"""When marks act, and what the face then does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mien.core import Cue, MienError, Pose, Sound, UnknownNameError
from mien.faces import load_face
from mien.gaze import Glance
from mien.perform import Style, parse_marks, perform
from mien.perform.directions import LEAD_S, LOOK_LEAD_S, LOOK_S, find_places, follow_marks
from mien.perform.marks import Expression, Units
from mien.speech import Speech
from mien.vocab import pose_from

STILL = Style(blinks=0, head=0, brows=0, gaze=0)
HEAD = load_face("head")
WORDS = (Cue(1.0, 1.4, "Oh"), Cue(1.4, 2.0, "oh"), Cue(3.0, 3.5, "ah"), Cue(3.5, 4.0, "oh"))
PLAIN = "Oh, oh! Ah oh."
LENGTH_S = 6.0


def speech(script: str = "") -> Speech:
    """Words of one vowel each; silence between, before and after."""
    phones = [
        Cue(0.0, 1.0, "SIL"), Cue(1.0, 1.4, "OW1"), Cue(1.4, 2.0, "OW0"), Cue(2.0, 3.0, "SIL"), Cue(3.0, 3.5, "AA1"),
        Cue(3.5, 4.0, "OW0"), Cue(4.0, LENGTH_S, "SIL"),
    ]  # fmt: skip
    return Speech(PLAIN, Sound.silence(LENGTH_S), WORDS, tuple(phones), (), "none", script)


def column(script: str, name: str, times: list[float], *, style: Style = STILL, **options: object) -> np.ndarray:
    """(N,) values of a parameter at times."""
    timeline = perform(speech(script), HEAD, style=style, **options).timeline  # type: ignore[arg-type]
    return timeline.values(times, HEAD.parameters)[:, HEAD.parameters.index[name]]


def starts(text: str) -> list[float]:
    return [time_s for time_s, _ in follow_marks(parse_marks(text), WORDS, LENGTH_S).expressions]


@pytest.mark.parametrize(
    ("text", "time_s"),
    [
        ("[sad] Oh, oh! Ah oh.", 1.0),
        ("Oh [sad], oh! Ah oh.", 1.4),
        ("Oh, oh! [sad] Ah oh.", 3.0),
        ("Oh, oh! [sad] <break/> Ah oh.", 2.0),
        ("Oh, oh! <break/> [sad] Ah oh.", 3.0),
        ("[sad] <break/> Oh, oh! Ah oh.", 0.2),
        ("Oh, oh! Ah oh [sad].", 4.0),
        ("Oh, oh! Ah oh. <break/> [sad]", 4.0),
    ],
)
def test_an_expression_shows_from_its_word_on(text: str, time_s: float) -> None:
    assert starts(text) == pytest.approx([time_s - LEAD_S])


def test_words_are_found_in_order_whatever_their_case() -> None:
    assert find_places([*WORDS, Cue(4.0, 5.0, "no")], PLAIN) == [(0, 2), (4, 6), (8, 10), (11, 13), (13, 13)]
    assert find_places(WORDS[:1], "İOh") == [(1, 3)]


def test_looks_come_back_or_give_way() -> None:
    marked = parse_marks("[look left] Oh, [look up 0.5] oh! Ah [look viewer] oh.")
    first, second, third = (time - LOOK_LEAD_S for time in (1.0, 1.4, 3.5))
    assert follow_marks(marked, WORDS, LENGTH_S).glances == (
        Glance(first, second, "left"),
        Glance(second, second + LOOK_S, "up", 0.5),
        Glance(third, third + LOOK_S, "viewer"),
    )
    late = follow_marks(parse_marks("Oh, oh! Ah [look left] oh."), WORDS, 4.1)
    assert late.glances == (Glance(third, 4.1, "left"),)


def test_stress_is_on_the_words_inside() -> None:
    marked = parse_marks('Oh, <emphasis level="moderate">oh! *Ah*</emphasis> oh.')
    assert follow_marks(marked, WORDS, LENGTH_S).stressed == {WORDS[1]: 0.7, WORDS[2]: 1.0}


def test_without_marks_nothing_is_asked() -> None:
    directions = follow_marks(parse_marks(PLAIN), WORDS, LENGTH_S)
    assert (directions.expressions, directions.glances, dict(directions.stressed)) == ((), (), {})


def test_an_expression_stays_until_the_next_and_is_gone_at_the_end() -> None:
    row = "eyebrow.lower.left"
    table = HEAD.parameters
    rest, angry, sad = (HEAD.neutral.replace(HEAD.presets[name].values)[row] for name in ("neutral", "angry", "sad"))
    times = [0.0, 1.2, 1.3, 2.0, 2.7, 3.2, 4.0, 5.3, 6.0]
    values = column("[angry] Oh, oh! [sad 0.5] Ah oh.", row, times)
    half = rest + 0.5 * (sad - rest)
    assert table[row].default == rest
    assert values == pytest.approx([rest, angry, angry, angry, angry, half, half, half, rest])
    assert column("[angry] Oh, oh! [neutral] Ah oh.", row, times)[4:] == pytest.approx([angry, rest, rest, rest, rest])
    halfway = column("[angry] Oh, oh! [sad 0.5] Ah oh.", row, [0.9, 1.0, 1.1])
    assert halfway[1] == pytest.approx(0.5 * (rest + angry))
    assert abs(halfway[0] - rest) < 0.2 * abs(angry - rest)


def test_an_expression_behind_the_last_word_stays_to_the_end() -> None:
    late = replace(speech("Oh, oh! Ah oh. [angry]"), sound=Sound.silence(4.5))
    values = perform(late, HEAD, style=STILL).timeline.values([4.5], HEAD.parameters)[0]
    assert values[HEAD.parameters.index["eyebrow.lower.left"]] == pytest.approx(1.0)


def test_a_mark_takes_the_place_of_the_emotion() -> None:
    values = column("Oh, oh! [neutral] Ah oh.", "eyebrow.lower.left", [2.0, 3.5], emotion="angry")
    assert values == pytest.approx([1.0, 0.0])


def test_of_two_expressions_at_one_word_the_later_counts() -> None:
    both, one = (column(f"{marks} Oh, oh! Ah oh.", "eyebrow.inner_raise.left", [0.9, 1.0, 3.0]) for marks in
                 ("[angry] [sad]", "[sad]"))  # fmt: skip
    np.testing.assert_array_equal(both, one)


def test_action_units_are_those_of_the_face() -> None:
    wanted = pose_from("facs", {"AU1": 0.5, "AU2": 0.5}, HEAD)
    for row in ("eyebrow.inner_raise.left", "eyebrow.outer_raise.right"):
        assert wanted[row] != HEAD.neutral[row]
        assert column("[au 1=0.5,2=0.5] Oh, oh! Ah oh.", row, [2.5]) == pytest.approx([wanted[row]])
    assert isinstance(parse_marks("[au 1]").marks[0].act, Units)


@pytest.mark.parametrize(("direction", "turn"), [("left", -1), ("right", 1)])
def test_looks_turn_the_eyes_and_a_little_the_head_and_return(direction: str, turn: int) -> None:
    eyes, head = (
        column(f"Oh, [look {direction}] oh! Ah oh.", name, [1.2, 2.2, 3.6]) for name in ("eye.turn.left", "head.turn")
    )
    assert eyes == pytest.approx([0.0, 17.0 * turn, 0.0])
    assert head == pytest.approx([0.0, 6.0 * turn, 0.0])


def test_eyes_do_not_stray_while_they_are_told_where_to_look() -> None:
    times = list(np.arange(1.4, 2.5, 0.05))
    for seed in range(6):
        assert np.ptp(column("Oh, [look up] oh! Ah oh.", "eye.turn.left", times, style=Style(), seed=seed)) == 0.0
    strays = [np.ptp(column("", "eye.turn.left", times, style=Style(), seed=seed)) for seed in range(6)]
    assert max(strays) > 0.5


def test_looking_away_has_a_side_of_its_seed() -> None:
    sides = {float(column("[look away] Oh, oh! Ah oh.", "eye.turn.left", [1.5], seed=seed)[0]) for seed in range(9)}
    assert sides == {-13.0, 13.0}


@pytest.mark.parametrize("seed", range(5))
def test_stress_raises_the_brows_and_nods(seed: int) -> None:
    alone = Style(blinks=0, head=0, gaze=0)
    plain, stressed = (
        column(text, "eyebrow.outer_raise.left", [3.75], style=alone, seed=seed) for text in ("", "Oh, oh! Ah *oh*.")
    )
    assert stressed - plain > 0.3
    times = list(np.arange(3.6, 4.2, 0.02))
    nods = [
        column(text, "head.nod", times, style=Style(brows=0, gaze=0), seed=seed) for text in ("", "Oh, oh! Ah *oh*.")
    ]
    assert np.min(nods[1] - nods[0]) < -2.0


def test_unknown_expressions_are_named_with_their_place() -> None:
    with pytest.raises(UnknownNameError, match=r"mark in line 2, column 3: 'smiel' — did you mean 'smile'"):
        perform(speech("Oh,\noh[smiel]! Ah oh."), HEAD)
    assert Pose(HEAD.parameters, HEAD.neutral.values) == HEAD.neutral


def test_a_face_without_action_units_says_where_they_were_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*arguments: object) -> None:
        raise MienError("no table")

    monkeypatch.setattr("mien.perform.expressions.pose_from", refuse)
    with pytest.raises(MienError, match="line 1, column 5: no table"):
        perform(speech("Oh, [au 1] oh! Ah oh."), HEAD)


def test_expressions_are_of_this_face() -> None:
    assert follow_marks(parse_marks("[grin] Oh"), WORDS, LENGTH_S).expressions[0][1] == Expression("grin")
