"""Parke's sampling problem (1974, section 4.3): what lasts a frame or two is in every film, at every rate."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mouth_cases import cues

from mien.core import Cue
from mien.speech.articulation import Articulation, amounts
from mien.speech.mouth import articulate
from mien.speech.mouth_holds import NOISY, SHORT_VOWEL_S, find_holds
from mien.speech.mouth_passes import tidy
from mien.speech.mouth_table import phone_table
from mien.timeline import Track

RATES = (12, 24000 / 1001, 24, 25, 30, 60)
PHONES = [row.phone for row in phone_table().rows if "+" not in row.phone and "-" not in row.phone]
LABIALS = {row.phone: row.hold for row in phone_table().rows if row.hold}
ROUNDED = ("W", "UW", "OW")
SEEN = {"closure": 1.0, "tuck": 1.0, "round": 0.5}
"""From this value on a film shows it."""

# What the built-in voice says of "Please stop shouting, Bob: move over, we both know why you phoned five people."
SENTENCE = """
SIL:200 P:50 L:25 IY1:100 Z:75 S:50 T:50 AA1:125 P:100 SH:50 AW1:125 T:75 IH0:75 NG:175 B:50 AA1:225 B:150 SIL:300
M:75 UW1:125 V:50 OW1:150 V:50 ER0:125 SIL:60 W:75 IY1:100 B:75 OW1:125 TH:75 N:50 OW1:125 W:50 AY1:150 Y:50 UW1:75
F:75 OW1:150 N:75 D:50 F:75 AY1:150 V:50 P:75 IY1:100 P:50 AH0:50 L:100 SIL:350
"""

sounds = st.lists(
    st.tuples(st.sampled_from([*PHONES, *LABIALS, *ROUNDED]), st.integers(15, 250)), min_size=1, max_size=25
).map(lambda words: cues("SIL:300 " + " ".join(f"{symbol}:{length}" for symbol, length in words)))
shifts = st.floats(0.0, 0.1)
STYLES = st.fixed_dictionaries(
    {name: st.floats(0.0, row.high) for name, row in amounts().items() if name not in ("closures", "rounding")}
).map(lambda chosen: Articulation(**chosen))


def nearest_frame(time_s: float, fps: float) -> float:
    return round(time_s * fps) / fps


def later(phones: tuple[Cue, ...], shift_s: float) -> tuple[Cue, ...]:
    """The phones moved against the frames of a film."""
    return tuple(Cue(cue.start_s + shift_s, cue.end_s + shift_s, cue.symbol) for cue in phones)


def value(track: Track, time_s: float) -> float:
    return float(track.evaluate([time_s])[0][0])


@settings(deadline=None, max_examples=60)
@given(sounds, shifts, STYLES)
def test_the_frame_nearest_to_the_middle_of_a_closure_or_tuck_shows_it(
    phones: tuple[Cue, ...], shift_s: float, style: Articulation
) -> None:
    moved = later(phones, shift_s)
    tracks = articulate(moved, style)
    for hold in find_holds(tidy(moved)):
        for fps in RATES:
            frame = nearest_frame(0.5 * (hold.start_s + hold.end_s), fps)
            assert value(tracks[hold.channel], frame) >= SEEN[hold.channel], (hold, fps)


@settings(deadline=None, max_examples=60)
@given(sounds, shifts)
def test_the_frame_nearest_to_the_middle_of_a_labial_with_room_shows_it(
    phones: tuple[Cue, ...], shift_s: float
) -> None:
    moved = later(phones, shift_s)
    tracks = articulate(moved)
    for before, cue in roomy_labials(moved):
        beside_noise = phone_table()[before.symbol].kind in NOISY or not room_after(moved, cue)
        for fps in RATES[1:] if beside_noise else RATES:
            channel = LABIALS[cue.symbol]
            assert value(tracks[channel], nearest_frame(cue.centre_s, fps)) >= SEEN[channel], (cue, fps)


def roomy_labials(phones: tuple[Cue, ...]) -> list[tuple[Cue, Cue]]:
    """Labials, each with the phone before it, that have 120 ms to the next labial on either side."""
    found = [i for i, cue in enumerate(phones) if cue.symbol in LABIALS]
    out = []
    for i in found:
        gaps = [abs(phones[i].centre_s - phones[j].centre_s) - 0.5 * (phones[i].length_s + phones[j].length_s)
                for j in found if j != i]  # fmt: skip
        if min(gaps, default=1.0) > SHORT_VOWEL_S + 0.05:
            out.append((phones[i - 1], phones[i]))
    return out


def room_after(phones: tuple[Cue, ...], cue: Cue) -> bool:
    after = phones.index(cue) + 1
    return after == len(phones) or phone_table()[phones[after].symbol].kind not in NOISY


@settings(deadline=None, max_examples=60)
@given(sounds, shifts)
def test_the_frame_nearest_to_the_middle_of_a_rounded_sound_shows_round_lips(
    phones: tuple[Cue, ...], shift_s: float
) -> None:
    moved = later(phones, shift_s)
    track = articulate(moved)["round"]
    for cue in moved:
        if cue.symbol in ROUNDED:
            for fps in RATES:
                assert value(track, nearest_frame(cue.centre_s, fps)) >= SEEN["round"], (cue, fps)


@settings(deadline=None, max_examples=60)
@given(sounds, STYLES)
def test_lips_open_faster_than_they_close(phones: tuple[Cue, ...], style: Articulation) -> None:
    tracks = articulate(phones, style)
    for hold in find_holds(tidy(phones)):
        closing = np.linspace(hold.start_s - hold.rise_s, hold.start_s, 50)
        opening = np.linspace(hold.end_s, hold.end_s + hold.fall_s, 50)
        assert hold.fall_s <= 0.75 * hold.rise_s
        assert value(tracks[hold.channel], closing[0]) < 0.05 > value(tracks[hold.channel], opening[-1])
        assert np.all(np.diff(tracks[hold.channel].evaluate(closing)[0]) >= 0.0)
        assert np.all(np.diff(tracks[hold.channel].evaluate(opening)[0]) <= 0.0)


@settings(deadline=None, max_examples=60)
@given(sounds, STYLES)
def test_no_pass_parts_lips_that_another_has_shut(phones: tuple[Cue, ...], style: Articulation) -> None:
    tracks = articulate(phones, style)
    for hold in find_holds(tidy(phones)):
        held = np.linspace(hold.start_s, hold.end_s, 40)
        assert np.all(tracks[hold.channel].evaluate(held)[0] == 1.0)
        for channel in ("upper_lip", "lower_lip", "tongue_out") if hold.channel == "closure" else ("lower_lip",):
            assert np.max(tracks[channel].evaluate(held)[0]) < 0.01, (channel, hold)


@pytest.mark.parametrize("fps", RATES)
@pytest.mark.parametrize("shift_s", [0.0, 0.01, 0.02, 0.03])
def test_a_real_sentence_loses_nothing(fps: float, shift_s: float) -> None:
    phones = later(cues(SENTENCE), shift_s)
    tracks = articulate(phones)
    counted = {"closure": 0, "tuck": 0, "round": 0}
    for cue in phones:
        bare = cue.symbol.rstrip("012")
        channel = LABIALS.get(bare) or ("round" if bare in ROUNDED else "")
        if channel:
            counted[channel] += 1
            times = np.arange(np.ceil((cue.start_s - 0.05) * fps), (cue.end_s + 0.05) * fps) / fps
            assert np.max(tracks[channel].evaluate(times)[0]) >= SEEN[channel], cue
    assert counted == {"closure": 8, "tuck": 5, "round": 8}


@pytest.mark.parametrize(("pass_off", "channel"), [("closures", "closure"), ("rounding", "round")])
def test_without_the_guarantee_a_film_at_12_frames_a_second_misses_some(pass_off: str, channel: str) -> None:
    missed = 0
    for shift_s in np.arange(0.0, 0.083, 0.01):
        phones = later(cues(SENTENCE), shift_s)
        track = articulate(phones, Articulation(**{pass_off: 0.0}))[channel]
        for cue in phones:
            if LABIALS.get(cue.symbol) == channel or (channel == "round" and cue.symbol.rstrip("012") in ROUNDED):
                missed += value(track, nearest_frame(cue.centre_s, 12)) < 0.7
    assert missed > 0


@settings(deadline=None, max_examples=40)
@given(sounds, shifts)
def test_half_the_guarantee_is_enough_from_24_frames_a_second_on(phones: tuple[Cue, ...], shift_s: float) -> None:
    moved = later(phones, shift_s)
    tracks = articulate(moved, Articulation(closures=0.5))
    for hold in find_holds(tidy(moved), 0.5):
        for fps in RATES[1:]:
            frame = nearest_frame(0.5 * (hold.start_s + hold.end_s), fps)
            assert value(tracks[hold.channel], frame) == 1.0, (hold, fps)
