"""The main job on the real head: what is drawn has its lips shut at every p, b and m, at any frame rate."""

import numpy as np
import pytest

from mien.core import Cue, Pose, Sound, subdivide
from mien.faces import load_face
from mien.perform import perform
from mien.speech import Speech, strip_stress
from support import lip_gap_mm

HEAD = load_face("head")
SHUT_MM = 0.45
"""Lips at rest touch with edges 0.3 mm apart."""

LINES = (  # the poem's first two lines: phones of ordinary length, seconds
    ("SIL", 0.2), ("HH", 0.06), ("AW1", 0.17), ("HH", 0.05), ("AE1", 0.12), ("P", 0.08), ("IY0", 0.11), ("IH0", 0.06),
    ("Z", 0.08), ("DH", 0.04), ("AH0", 0.06), ("L", 0.05), ("IH1", 0.07), ("T", 0.04), ("AH0", 0.05), ("L", 0.07),
    ("S", 0.08), ("T", 0.05), ("OW1", 0.2), ("N", 0.1), ("SIL", 0.3), ("DH", 0.05), ("AE1", 0.1), ("T", 0.05),
    ("R", 0.06), ("AE1", 0.12), ("M", 0.05), ("B", 0.05), ("AH0", 0.05), ("L", 0.05), ("Z", 0.08), ("IH0", 0.05),
    ("N", 0.05), ("DH", 0.04), ("AH0", 0.05), ("R", 0.06), ("OW1", 0.16), ("D", 0.06), ("AH0", 0.06), ("L", 0.06),
    ("OW1", 0.2), ("N", 0.12), ("SIL", 0.35),
)  # fmt: skip


def cues():
    out, start = [], 0.0
    for symbol, length in LINES:
        out.append(Cue(start, start + length, symbol))
        start += length
    return tuple(out)


def speech():
    phones = cues()
    return Speech("the poem", Sound.silence(phones[-1].end_s), (), phones, (), "none")


def gap_mm(values):
    return lip_gap_mm(subdivide(HEAD.shape(Pose(HEAD.parameters, values)), 2).points)


@pytest.mark.parametrize("emotion", [name for name, preset in HEAD.presets.items() if preset.kind == "expression"])
@pytest.mark.parametrize("fps", [12, 24, 25, 30, 60])
def test_lips_are_shut_in_some_frame_of_every_p_b_m(fps, emotion):
    timeline = perform(speech(), HEAD, emotion=emotion).timeline
    times = timeline.frame_times(fps)
    values = timeline.values(times, HEAD.parameters)
    closed = [cue for cue in timeline.phones if strip_stress(cue.symbol) in ("P", "B", "M")]
    assert len(closed) == 3
    for cue in closed:
        near = np.flatnonzero((times > cue.start_s - 1 / fps) & (times < cue.end_s + 1 / fps))
        assert min(gap_mm(values[frame]) for frame in near) < SHUT_MM, cue


def test_lips_are_open_in_the_vowels():
    timeline = perform(speech(), HEAD).timeline
    vowels = [cue for cue in timeline.phones if cue.symbol in ("AW1", "AE1", "OW1")]
    values = timeline.values(np.array([cue.centre_s for cue in vowels]), HEAD.parameters)
    assert min(gap_mm(row) for row in values) > 2.0
