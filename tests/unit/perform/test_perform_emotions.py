"""A mood keeps its character while the lips close."""

import numpy as np
import pytest

from mien.core import Cue, Pose, Sound, subdivide
from mien.core.mesh import Points
from mien.faces.head.measured import archive
from mien.perform import Style, perform
from mien.speech import Speech
from mien.vocab import pose_from
from mien.vocab.facs import parse_units
from support import face, lip_gap_mm

STILL = Style(blinks=0, head=0, brows=0, gaze=0)
SHUT_MM = 0.45
PHONES = "SIL:700 AA1:150 P:90 AA1:150 B:90 IY1:150 M:110 EH1:150 P:90 AA1:150 SIL:700"
MOODS = ("happy", "sad", "angry")
BESIDE_SPEECH = ("eyebrow", "eyelid", "cheek", "pupil")
HEAD = face("head")
UPRIGHT = {"head.nod": 0.0, "head.turn": 0.0, "head.tilt": 0.0}


def bilabials(script: str = "") -> Speech:
    phones, time = [], 0.0
    for part in PHONES.split():
        symbol, length = part.split(":")
        phones.append(Cue(time, time + int(length) / 1000.0, symbol))
        time = phones[-1].end_s
    words = (Cue(0.7, time - 0.7, "papabeemepa"),)
    return Speech("Papabeemepa.", Sound.silence(time), words, tuple(phones), (), "none", script)


def skin(pose: Pose) -> Points:
    """(V, 3) m as drawn, the head held upright."""
    return subdivide(HEAD.shape(pose.replace(UPRIGHT)), 2).points


@pytest.fixture(scope="module")
def plain() -> np.ndarray:
    timeline = perform(bilabials(), HEAD, style=STILL).timeline
    return timeline.values(timeline.frame_times(60), HEAD.parameters)


def check_mood(speech: Speech, preset: Pose, plain: np.ndarray, emotion: str | None = None) -> None:
    """Fails where lips stay apart at a bilabial, or where the mood of a preset does not show there."""
    timeline = perform(speech, HEAD, style=STILL, emotion=emotion).timeline
    values, table = timeline.values(timeline.frame_times(60), HEAD.parameters), HEAD.parameters
    frames = np.flatnonzero(values[:, table.index["mouth.closure"]] == 1.0)
    corner = archive().vertex["m0_5"]
    corners = [corner, int(archive().mirror[corner])]
    whole = (skin(preset) - skin(HEAD.neutral))[corners]
    closures = np.split(frames, np.flatnonzero(np.diff(frames) > 1) + 1)
    assert len(closures) == 4
    for frame in (run[len(run) // 2] for run in closures):
        moody = Pose(table, values[frame])
        drawn, unmoved = skin(moody), skin(Pose(table, plain[frame]))
        assert lip_gap_mm(drawn) < SHUT_MM
        for row in table:
            if row.name.startswith(BESIDE_SPEECH):
                assert moody[row.name] == pytest.approx(preset[row.name]), row.name
        kept = ((drawn - unmoved)[corners] * whole).sum() / (whole * whole).sum()
        assert kept >= 0.6


@pytest.mark.parametrize("mood", MOODS)
def test_lips_close_and_the_mood_stays(mood: str, plain: np.ndarray) -> None:
    check_mood(bilabials(), HEAD.neutral.replace(HEAD.presets[mood].values), plain, emotion=mood)


@pytest.mark.parametrize("mood", MOODS)
def test_lips_close_and_the_mood_of_a_mark_stays(mood: str, plain: np.ndarray) -> None:
    check_mood(bilabials(f"[{mood}] Papabeemepa."), HEAD.neutral.replace(HEAD.presets[mood].values), plain)


@pytest.mark.parametrize("units", ["1=0.5,2=0.5,12=0.7", "4=0.8,15=0.8"])
def test_lips_close_and_action_units_stay(units: str, plain: np.ndarray) -> None:
    check_mood(bilabials(f"[au {units}] Papabeemepa."), pose_from("facs", parse_units(units), HEAD), plain)
