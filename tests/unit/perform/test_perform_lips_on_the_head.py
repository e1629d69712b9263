"""The main job on the real head: lips shut at every p, b and m, tucked at f and v, round at oo, at any frame rate."""

import numpy as np
import pytest

from mien.core import Cue, Pose, Sound, subdivide
from mien.faces import load_face
from mien.faces.head.measured import archive
from mien.perform import Style, named_styles, parse_style, perform, style_table
from mien.speech import Speech, strip_stress
from support import lip_gap_mm

HEAD = load_face("head")
EMOTIONS = [name for name, preset in HEAD.presets.items() if preset.kind == "expression"]
RATES = (12, 24000 / 1001, 24, 25, 30, 60)
UPRIGHT = {"head.nod": 0.0, "head.turn": 0.0, "head.tilt": 0.0}
SHUT_MM = 0.45
"""Lips at rest touch with edges 0.3 mm apart."""
ROUND_SHUT_MM = 0.95
"""Where lips are pursed, other rings of them touch, and these edges are behind that."""

LINES = (  # the poem's first two lines: phones of ordinary length, seconds
    ("SIL", 0.2), ("HH", 0.06), ("AW1", 0.17), ("HH", 0.05), ("AE1", 0.12), ("P", 0.08), ("IY0", 0.11), ("IH0", 0.06),
    ("Z", 0.08), ("DH", 0.04), ("AH0", 0.06), ("L", 0.05), ("IH1", 0.07), ("T", 0.04), ("AH0", 0.05), ("L", 0.07),
    ("S", 0.08), ("T", 0.05), ("OW1", 0.2), ("N", 0.1), ("SIL", 0.3), ("DH", 0.05), ("AE1", 0.1), ("T", 0.05),
    ("R", 0.06), ("AE1", 0.12), ("M", 0.05), ("B", 0.05), ("AH0", 0.05), ("L", 0.05), ("Z", 0.08), ("IH0", 0.05),
    ("N", 0.05), ("DH", 0.04), ("AH0", 0.05), ("R", 0.06), ("OW1", 0.16), ("D", 0.06), ("AH0", 0.06), ("L", 0.06),
    ("OW1", 0.2), ("N", 0.12), ("SIL", 0.35),
)  # fmt: skip


ROUND_LINES = (  # move over, we food a boom
    ("SIL", 0.2), ("M", 0.07), ("UW1", 0.12), ("V", 0.05), ("OW1", 0.15), ("V", 0.05), ("ER0", 0.12), ("SIL", 0.06),
    ("W", 0.05), ("IY1", 0.1), ("F", 0.06), ("UW1", 0.1), ("D", 0.05), ("AH0", 0.06), ("B", 0.05), ("UW1", 0.11),
    ("M", 0.07), ("SIL", 0.35),
)  # fmt: skip


def cues(lines=LINES):
    out, start = [], 0.0
    for symbol, length in lines:
        out.append(Cue(start, start + length, symbol))
        start += length
    return tuple(out)


def speech(lines=LINES):
    phones = cues(lines)
    return Speech("the poem", Sound.silence(phones[-1].end_s), (), phones, (), "none")


def gap_mm(values):
    return lip_gap_mm(subdivide(HEAD.shape(Pose(HEAD.parameters, values)), 2).points)


@pytest.mark.parametrize("emotion", EMOTIONS)
@pytest.mark.parametrize("fps", RATES)
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


def upright(values):
    """(V, 3) mm of a head that neither nods nor turns."""
    return 1000.0 * HEAD.shape(Pose(HEAD.parameters, values).replace(UPRIGHT)).points


def width_mm(points):
    corner = archive().vertex["m0_5"]
    return points[corner, 0] - points[archive().mirror[corner], 0]


def tuck_mm(points):
    """How far the edge of the lower lip lies above the edge of the upper front teeth, and before them."""
    teeth = points[HEAD._layout.span["teeth"]][~HEAD._layout.lower["teeth"]]
    front = teeth[np.abs(teeth[:, 0]) < 8.0]
    lip = points[archive().vertex["m0_9"]]
    return lip[1] - front[:, 1].min(), lip[2] - front[:, 2].max()


@pytest.fixture(scope="module")
def round_timeline():
    return perform(speech(ROUND_LINES), HEAD).timeline


@pytest.mark.parametrize("fps", RATES)
def test_lips_are_round_and_tucked_in_the_frame_nearest_to_the_middle(fps, round_timeline):
    rest = upright(HEAD.neutral.values)
    seen = {"F": 0, "V": 0, "W": 0, "UW": 0, "OW": 0}
    for cue in round_timeline.phones:
        sound = strip_stress(cue.symbol)
        if sound in seen:
            frame = round(cue.centre_s * fps) / fps
            points = upright(round_timeline.values([frame], HEAD.parameters)[0])
            if sound in ("F", "V"):
                above, before = tuck_mm(points)
                assert abs(above) < 3.5, cue
                assert before < tuck_mm(rest)[1] - 3.0, cue
            else:
                assert width_mm(points) < 0.75 * width_mm(rest), cue
            seen[sound] += 1
    assert seen == {"F": 1, "V": 2, "W": 1, "UW": 3, "OW": 1}


@pytest.mark.parametrize("fps", RATES)
def test_lips_shut_between_round_sounds_too(fps, round_timeline):
    for cue in round_timeline.phones:
        if cue.symbol in ("M", "B"):
            frame = round(cue.centre_s * fps) / fps
            values = round_timeline.values([frame], HEAD.parameters)[0]
            assert gap_mm(values) < ROUND_SHUT_MM, cue


@pytest.mark.parametrize("emotion", EMOTIONS)
def test_no_mood_frees_a_tucked_lip_or_parts_round_shut_ones(emotion):
    timeline = perform(speech(ROUND_LINES), HEAD, emotion=emotion).timeline
    rest = tuck_mm(upright(HEAD.neutral.values))[1]
    for cue in timeline.phones:
        if cue.symbol in ("F", "V", "M", "B"):
            values = timeline.values([round(cue.centre_s * 24) / 24], HEAD.parameters)[0]
            if cue.symbol in ("F", "V"):
                assert tuck_mm(upright(values))[1] < rest - 3.0, cue
            else:
                assert gap_mm(values) < ROUND_SHUT_MM, cue


STYLES = {name: parse_style(name) for name in named_styles()}
STYLES["all at most"] = Style(**{name: row.high for name, row in style_table().items()})
STYLES["all off but closures"] = Style(**{name: 0.0 for name in style_table() if name != "closures"})
CHANCE = np.random.default_rng(7)
STYLES |= {
    f"chance {number}": Style(**{name: CHANCE.uniform(0.0, row.high) for name, row in style_table().items()
                                 if name != "closures"})
    for number in range(4)
}  # fmt: skip


@pytest.mark.parametrize("style", STYLES.values(), ids=STYLES)
@pytest.mark.parametrize("lines", [LINES, ROUND_LINES], ids=["stone", "round"])
def test_no_style_parts_shut_lips_or_frees_a_tucked_one(style, lines):
    timeline = perform(speech(lines), HEAD, style=style, seed=3).timeline
    rest = tuck_mm(upright(HEAD.neutral.values))[1]
    for cue in timeline.phones:
        hold = {"P": "closure", "B": "closure", "M": "closure", "F": "tuck", "V": "tuck"}.get(cue.symbol)
        if hold is None:
            continue
        times = np.arange(cue.start_s - 0.05, cue.end_s + 0.05, 0.01)
        values = timeline.values(times, HEAD.parameters)
        if hold == "closure":
            assert min(gap_mm(row) for row in values) < ROUND_SHUT_MM, cue
        else:
            assert min(tuck_mm(upright(row))[1] for row in values) < rest - 3.0, cue
