"""What is heard moves brows, lids and eyes, and each can be switched off."""

from __future__ import annotations

import numpy as np
import pytest

from mien.core import Cue, Sound
from mien.faces import load_face
from mien.perform import Style, perform
from mien.speech import Speech

RATE = 16000
HEAD = load_face("head")
COUNT = 12
WORD_S, REST_S = 0.5, 0.1


def speech(loud: int | None) -> Speech:
    """Twelve equal words without pauses between them in groups of four, one of each group loud and high."""
    words, phones, samples, time = [], [], [], 0.0
    for number in range(COUNT):
        stressed = number % 4 == loud
        count = round(WORD_S * RATE)
        wave = np.sin(2.0 * np.pi * (170.0 if stressed else 120.0) * np.arange(count) / RATE)
        samples.append(np.rint((9000.0 if stressed else 3000.0) * wave).astype(np.int16))
        words.append(Cue(time, time + WORD_S, "stone"))
        phones.append(Cue(time, time + WORD_S, "OW1"))
        time += WORD_S
        if number % 4 == 3:
            samples.append(np.zeros(round(2 * REST_S * RATE), np.int16))
            phones.append(Cue(time, time + 2 * REST_S, "SIL"))
            time += 2 * REST_S
    return Speech("stone " * COUNT, Sound(np.concatenate(samples), RATE), tuple(words), tuple(phones), (), "none")


@pytest.mark.parametrize("loud", [0, 1, 2, 3])
def test_brows_and_nods_go_with_the_loud_and_high_word(loud: int) -> None:
    said = speech(loud)
    centres = [word.centre_s for word in said.words]
    heights = np.zeros((6, COUNT))
    for seed in range(6):
        timeline = perform(said, HEAD, seed=seed, style=Style(blinks=0, gaze=0, head=0)).timeline
        heights[seed] = timeline.values(centres, HEAD.parameters)[:, HEAD.parameters.index["eyebrow.outer_raise.left"]]
    by_place = heights.reshape(6, 3, 4).mean(axis=(0, 1))
    assert by_place.argmax() == loud
    assert by_place[loud] > 1.5 * np.delete(by_place, loud).max()


def test_what_a_style_switches_off_stays_off() -> None:
    table, times = HEAD.parameters, np.arange(0.0, 6.5, 0.05)
    for switch, name in (
        ("brows", "eyebrow.outer_raise.left"),
        ("gaze", "eye.turn.left"),
        ("blinks", "eyelid.opening.left"),
    ):
        still = Style(blinks=0, head=0, brows=0, gaze=0)
        moved = [
            np.ptp(perform(speech(1), HEAD, seed=3, style=style).timeline.values(times, table)[:, table.index[name]])
            for style in (
                Style(
                    **{switch: 1.0, **{other: 0.0 for other in ("blinks", "head", "brows", "gaze") if other != switch}}
                ),
                still,
            )
        ]
        assert moved[0] > 0.0 == moved[1], switch


def test_the_eyes_are_on_the_viewer_before_a_phrase_ends() -> None:
    said = speech(None)
    ends = [said.words[number].end_s - 0.1 for number in (3, 7, 11)]
    for seed in range(12):
        timeline = perform(said, HEAD, seed=seed, style=Style(blinks=0, head=0, brows=0)).timeline
        turned = timeline.values(ends, HEAD.parameters)[:, HEAD.parameters.index["eye.turn.left"]]
        assert turned == pytest.approx([0.0] * 3, abs=1e-9)
