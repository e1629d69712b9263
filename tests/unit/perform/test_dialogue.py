"""Turns one after the other: who speaks moves the mouth, the others look there."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from mien.core import Cue, MienError, Sound
from mien.faces import load_face
from mien.perform import Style
from mien.perform.dialogue import REACT_S, Dialogue, Turn, converse
from mien.speech import Speech

FACES = {"ann": load_face("head"), "bob": load_face("head:ada"), "cem": load_face("head")}
STILL = Style(blinks=0, head=0, brows=0, gaze=0)


def say(text: str) -> Speech:
    """One word of a second between pauses of half a second."""
    phones = (Cue(0.0, 0.5, "SIL"), Cue(0.5, 1.5, "AA1"), Cue(1.5, 2.0, "SIL"))
    return Speech(text, Sound(np.full(200, len(text), np.int16), 100), (Cue(0.5, 1.5, text),), phones, (), "none", text)


def talk(*who: str, style: Style = STILL) -> Dialogue:
    return converse([Turn(name, say(name)) for name in who], FACES, style=style)


def column(dialogue: Dialogue, who: str, name: str, times: list[float]) -> np.ndarray:
    part = dialogue.parts[who]
    return part.timeline.values(times, part.face.parameters)[:, part.face.parameters.index[name]]


def test_turns_follow_each_other_in_one_sound() -> None:
    dialogue = talk("ann", "bob", "ann")
    assert dialogue.turns == ((0.0, "ann"), (2.0, "bob"), (4.0, "ann"))
    heard = dialogue.heard
    assert heard.sound is not None
    np.testing.assert_array_equal(heard.sound.samples, np.full(600, 3, np.int16))
    assert [(word.start_s, word.symbol) for word in heard.timeline.words] == [(0.5, "ann"), (2.5, "bob"), (4.5, "ann")]
    assert heard.timeline.text == "ann\nbob\nann"
    assert list(dialogue.parts) == ["ann", "bob"]
    assert dialogue.parts["bob"].face.name == "head:ada"


def test_each_part_has_its_own_words_and_phones_without_holes() -> None:
    part = talk("ann", "bob", "ann").parts["ann"].timeline
    assert [word.start_s for word in part.words] == [0.5, 4.5]
    assert part.length_s == 6.0
    assert part.phones[0].start_s == 0.0
    assert part.phones[-1].end_s == 6.0
    assert all(one.end_s == two.start_s for one, two in pairwise(part.phones))
    assert sum(cue.length_s for cue in part.phones if cue.symbol == "AA1") == pytest.approx(2.0)


def test_only_who_speaks_moves_the_mouth() -> None:
    dialogue = talk("ann", "bob")
    assert column(dialogue, "ann", "jaw.rotation", [1.0])[0] > 1.0 > column(dialogue, "ann", "jaw.rotation", [3.0])[0]
    assert column(dialogue, "bob", "jaw.rotation", [3.0])[0] > 1.0 > column(dialogue, "bob", "jaw.rotation", [1.0])[0]


def test_who_listens_looks_at_the_speaker() -> None:
    dialogue = talk("ann", "bob", "cem", "ann")
    moments = [1.0, 3.0, 5.0, 7.0]
    signs = {who: np.sign(column(dialogue, who, "eye.turn.left", moments)).tolist() for who in dialogue.parts}
    assert signs == {"ann": [0, 1, 1, 0], "bob": [-1, 0, 1, -1], "cem": [-1, -1, 0, -1]}
    early = column(dialogue, "bob", "eye.turn.left", [0.5 + REACT_S - 0.01, 0.5 + REACT_S + 0.1])
    assert early == pytest.approx([0.0, -17.0])


def test_who_listens_blinks() -> None:
    turns = [Turn("ann", say("ann"))] * 20 + [Turn("bob", say("bob"))]
    dialogue = converse(turns, FACES)
    lids = column(dialogue, "bob", "eyelid.opening.left", list(np.arange(0.0, 40.0, 0.04)))
    assert lids.min() == 0.0
    assert (np.diff((lids < 0.2).astype(int)) == 1).sum() >= 4


def test_marks_act_in_the_turn_they_are_written_in() -> None:
    turns = [Turn("ann", say("ann")), Turn("bob", say("bob")), Turn("ann", replace(say("ann"), script="[angry] ann"))]
    dialogue = converse(turns, FACES, style=STILL)
    assert column(dialogue, "ann", "eyebrow.lower.left", [1.0, 5.0]) == pytest.approx([0.0, 1.0])
    assert column(dialogue, "bob", "eyebrow.lower.left", [1.0, 5.0]) == pytest.approx([0.0, 0.0])


def test_chance_differs_between_speakers() -> None:
    dialogue = talk("ann", "bob", style=Style())
    times = list(np.arange(0.0, 4.0, 0.1))
    assert np.any(column(dialogue, "ann", "head.turn", times) != column(dialogue, "bob", "head.turn", times))


def test_voices_of_different_rates_are_refused() -> None:
    other = replace(say("bob"), sound=Sound.silence(2.0, 200))
    with pytest.raises(MienError, match="of 100 and of 200 samples a second"):
        converse([Turn("ann", say("ann")), Turn("bob", other)], FACES)
