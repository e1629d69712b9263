"""A spoken line, louder and softer: lips still shut at p, b and m, and open in the vowels."""

import numpy as np
import pytest

import mien
from mien.core import Cue, Pose, Sound, subdivide
from mien.faces import load_face
from mien.perform import perform
from mien.speech import Speech, strip_stress
from support import FACE_NAMES, face, lip_gap_mm

HEAD = load_face("head")
SHUT_MM = 0.45
"""Lips at rest touch with edges 0.3 mm apart."""
ROUND_SHUT_MM = 1.1
"""Where lips are pursed, other rings of them touch, and these edges are behind that."""

LINE = (  # happy people may be bound to move, phones of ordinary length, seconds
    ("SIL", 0.2), ("HH", 0.06), ("AE1", 0.12), ("P", 0.08), ("IY0", 0.11), ("P", 0.09), ("IY1", 0.13), ("P", 0.07),
    ("AH0", 0.06), ("L", 0.07), ("M", 0.07), ("EY1", 0.16), ("B", 0.06), ("IY0", 0.08), ("B", 0.06), ("AW1", 0.18),
    ("N", 0.06), ("D", 0.04), ("T", 0.06), ("AH0", 0.05), ("M", 0.07), ("UW1", 0.14), ("V", 0.07), ("SIL", 0.35),
)  # fmt: skip


def speech():
    phones, start = [], 0.0
    for symbol, length in LINE:
        phones.append(Cue(start, start + length, symbol))
        start += length
    return Speech("a line", Sound.silence(start), (), tuple(phones), (), "none")


def gap_mm(values):
    return lip_gap_mm(subdivide(HEAD.shape(Pose(HEAD.parameters, values)), 2).points)


@pytest.mark.parametrize("emotion", [None, "happy", "surprised", "disgusted"])
@pytest.mark.parametrize("amount", [0.5, 2.0, 3.0])
def test_lips_are_shut_at_p_b_m_at_every_amount(amount, emotion):
    timeline = mien.exaggerate(perform(speech(), HEAD, emotion=emotion), amount).timeline
    times = timeline.frame_times(24)
    values = timeline.values(times, HEAD.parameters)
    closed = [cue for cue in timeline.phones if strip_stress(cue.symbol) in ("P", "B", "M")]
    assert len(closed) == 7
    for cue, limit_mm in zip(closed, [*[SHUT_MM] * 6, ROUND_SHUT_MM], strict=True):  # the last stands before oo
        near = np.flatnonzero((times > cue.start_s - 1 / 24) & (times < cue.end_s + 1 / 24))
        assert min(gap_mm(values[frame]) for frame in near) < limit_mm, cue


@pytest.mark.parametrize("name", ["angry", "determined", "sad", "kiss", "pout", "neutral"])
@pytest.mark.parametrize("amount", [0.0, 0.5, 1.5, 3.0])
def test_closed_lips_of_an_expression_stay_closed(name, amount):
    pose = mien.make_pose(HEAD, presets=[name])
    assert gap_mm(pose.values) < SHUT_MM
    assert gap_mm(mien.exaggerate(pose, amount).values) < SHUT_MM


@pytest.mark.parametrize("amount", [0.5, 1.0, 2.0, 3.0])
def test_vowels_open_wider_the_larger_the_amount(amount):
    performance = perform(speech(), HEAD)
    middles = [cue.centre_s for cue in performance.timeline.phones if cue.symbol in ("AE1", "EY1", "AW1")]
    plain, scaled = (
        np.array([gap_mm(row) for row in each.timeline.values(middles, HEAD.parameters)])
        for each in (performance, mien.exaggerate(performance, amount))
    )
    assert np.all(np.sign(scaled - plain) == np.sign(amount - 1.0))
    assert np.all(scaled > 1.0)


@pytest.mark.parametrize("name", [name for name in FACE_NAMES if name.startswith("toon:")])
@pytest.mark.parametrize("amount", [0.5, 2.0, 3.0])
def test_drawn_lips_are_shut_at_p_b_m_and_part_in_vowels_at_every_amount(name, amount):
    subject = face(name)
    table = subject.parameters
    timeline = mien.exaggerate(perform(speech(), subject, emotion="surprised"), amount).timeline
    lips = [table.index[row] for row in ("mouth.bottom", "mouth.top") if row in table]
    shut = np.array([table.lows[row] for row in lips])
    for cue in timeline.phones:
        values = timeline.values(np.linspace(cue.start_s, cue.end_s, 9), table)[:, lips]
        if strip_stress(cue.symbol) in ("P", "B", "M"):
            assert np.abs(values - shut).max(axis=1).min() < 0.02, cue
        elif cue.symbol in ("AE1", "AW1"):
            assert values[4, 0] > 0.1, cue
