import importlib.util
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mouth_cases import cues, poem

from mien.core import Cue
from mien.speech.articulation import Articulation
from mien.speech.mouth import MOUTH_CHANNELS, articulate
from mien.speech.mouth_table import phone_table
from mien.timeline import Track

RATES = (12, 24000 / 1001, 24, 25, 30, 60)
PHONES = [row.phone for row in phone_table().rows if "+" not in row.phone and "-" not in row.phone]


@pytest.fixture(scope="module")
def tracks() -> dict[str, Track]:
    return articulate(poem())


def value(tracks: dict[str, Track], channel: str, time_s: float) -> float:
    return float(tracks[channel].evaluate(np.array([time_s]))[0][0])


def seen(track: Track, cue: Cue, fps: float, offset: float) -> float:
    """The greatest value in the frames that fall on a phone, or up to 75 ms before and 60 ms after it."""
    frames = (np.arange(int((cue.end_s + 0.06) * fps) + 2) + offset) / fps
    frames = frames[(frames >= cue.start_s - 0.075) & (frames <= cue.end_s + 0.06)]
    return float(np.max(track.evaluate(frames)[0])) if len(frames) else 0.0


@pytest.mark.parametrize("fps", RATES)
@pytest.mark.parametrize("offset", [0.0, 0.25, 0.5, 0.75])
def test_every_film_sees_lips_shut_at_every_bilabial_of_the_poem(
    tracks: dict[str, Track], fps: float, offset: float
) -> None:
    bilabials = [cue for cue in poem() if cue.symbol in ("P", "B", "M")]
    assert len(bilabials) == 8
    for cue in bilabials:
        assert seen(tracks["closure"], cue, fps, offset) == 1.0, cue


@pytest.mark.parametrize("fps", RATES)
@pytest.mark.parametrize("offset", [0.0, 0.25, 0.5, 0.75])
def test_every_film_sees_the_tuck_of_every_f_and_v_of_the_poem(
    tracks: dict[str, Track], fps: float, offset: float
) -> None:
    labiodentals = [cue for cue in poem() if cue.symbol in ("F", "V")]
    assert len(labiodentals) == 4
    for cue in labiodentals:
        assert seen(tracks["tuck"], cue, fps, offset) >= 0.9, cue


def test_shut_lips_are_not_parted_by_other_channels(tracks: dict[str, Track]) -> None:
    times = np.arange(0.0, poem()[-1].end_s, 0.001)
    shut = tracks["closure"].evaluate(times)[0] == 1.0
    assert shut.any()
    for channel in ("upper_lip", "lower_lip", "tongue_out"):
        assert np.max(tracks[channel].evaluate(times)[0][shut]) <= 0.002


def test_shuffled_phones_of_equal_length_give_other_tracks() -> None:
    order = [cue.symbol for cue in poem()]
    equal = [Cue(0.1 * i, 0.1 * (i + 1), symbol) for i, symbol in enumerate(order)]
    shuffled = [replace(cue, symbol=symbol) for cue, symbol in zip(equal, order[::-1], strict=True)]
    times = np.arange(0.0, equal[-1].end_s, 0.02)
    one, other = articulate(equal), articulate(shuffled)
    for channel in MOUTH_CHANNELS:
        difference = one[channel].evaluate(times)[0] - other[channel].evaluate(times)[0]
        assert np.max(np.abs(difference)) > 0.15, channel


def test_the_mouth_is_no_jaw_flap(tracks: dict[str, Track]) -> None:
    times = np.arange(0.0, poem()[-1].end_s, 0.01)
    jaw = tracks["jaw"].evaluate(times)[0]
    for channel in ("round", "spread", "closure", "tongue_up"):
        assert abs(np.corrcoef(jaw, tracks[channel].evaluate(times)[0])[0, 1]) < 0.6


@pytest.mark.parametrize("rounded", ["UW1", "OW1", "W"])
def test_rounded_sounds_round(rounded: str) -> None:
    tracks = articulate(cues(f"SIL:300 IY1:100 {rounded}:120 IY1:100"))
    assert value(tracks, "round", 0.46) > 0.55
    assert value(tracks, "round", 0.33) < 0.4
    assert value(tracks, "round", 0.1) < 0.15


def test_spread_for_ee_and_none_for_oo() -> None:
    assert value(articulate(cues("SIL:200 S:90 IY1:120")), "spread", 0.35) > 0.5
    assert value(articulate(cues("SIL:200 S:90 UW1:120")), "spread", 0.35) < 0.1


@pytest.mark.parametrize("sibilant", ["S", "Z", "SH", "ZH", "CH", "JH"])
def test_sibilants_narrow_the_jaw_between_open_vowels(sibilant: str) -> None:
    tracks = articulate(cues(f"AA1:120 {sibilant}:70 AA1:120"))
    # The jaw comes 15 ms after the lips.
    assert value(tracks, "jaw", 0.17) < 0.25
    assert value(tracks, "jaw", 0.06) > 0.45 < value(tracks, "jaw", 0.25)


@pytest.mark.parametrize("tongue", ["T", "D", "N", "K", "G", "L"])
def test_short_tongue_sounds_leave_lips_and_jaw_to_the_vowels(tongue: str) -> None:
    tracks = articulate(cues(f"AA1:120 {tongue}:60 AA1:120"))
    for channel, least in (("jaw", 0.6), ("lower_lip", 0.3)):
        assert value(tracks, channel, 0.15) > least
    if tongue in "TDNL":
        assert value(tracks, "tongue_up", 0.15) > 0.6


def test_tongue_shows_between_the_teeth_in_th() -> None:
    assert value(articulate(cues("AH1:100 TH:80 IH1:100")), "tongue_out", 0.14) > 0.6
    assert value(articulate(cues("AH1:100 T:80 IH1:100")), "tongue_out", 0.14) < 0.1


def test_lip_heavy_sounds_start_early() -> None:
    early = articulate(cues("AH1:200 UW1:120"))
    late = articulate(cues("AH1:200 UH1:120"))
    share = [value(tracks, "round", 0.2) / value(tracks, "round", 0.26) for tracks in (early, late)]
    assert share[0] > 0.65
    assert share[0] > share[1]


def test_lips_part_before_the_jaw_is_down() -> None:
    tracks = articulate(cues("SIL:300 B:70 AA1:150 SIL:300"))
    times = np.arange(0.3, 0.6, 0.001)
    parted = times[np.argmax(tracks["closure"].evaluate(times)[0] < 0.5)]
    down = times[np.argmax(tracks["jaw"].evaluate(times)[0])]
    assert parted + 0.02 < down < 0.5


def test_lips_pop_open_and_close_slowly() -> None:
    tracks = articulate(cues("AA1:200 B:90 AA1:200"))
    times = np.arange(0.0, 0.5, 0.001)
    half = np.flatnonzero((closure := tracks["closure"].evaluate(times)[0]) > 0.02)
    full = np.flatnonzero(closure == 1.0)
    assert full[0] - half[0] > 1.3 * (half[-1] - full[-1])


def test_diphthong_ends_elsewhere_than_it_begins() -> None:
    tracks = articulate(cues("SIL:200 AW1:200 T:60"))
    assert value(tracks, "jaw", 0.27) > value(tracks, "jaw", 0.38) + 0.1
    assert value(tracks, "round", 0.27) + 0.2 < value(tracks, "round", 0.38)


@pytest.mark.parametrize(("pause_ms", "low", "high"), [(100, 0.5, 0.9), (300, 0.02, 0.45), (1000, 0.0, 0.01)])
def test_pauses_hold_relax_or_rest(pause_ms: int, low: float, high: float) -> None:
    tracks = articulate(cues(f"AA1:150 SIL:{pause_ms} AA1:150"))
    assert low <= value(tracks, "jaw", 0.15 + 0.0005 * pause_ms) <= high


def test_stressed_vowels_open_wider() -> None:
    assert value(articulate(cues("T:80 AE1:120 T:80")), "jaw", 0.14) > 1.3 * value(
        articulate(cues("T:80 AE0:120 T:80")), "jaw", 0.14
    )


def test_strength_scales_movement_but_not_closure() -> None:
    weak, full = (articulate(cues("AA1:150 M:60 AA1:150"), Articulation(strength=s)) for s in (0.5, 1.0))
    assert value(weak, "jaw", 0.08) == pytest.approx(0.5 * value(full, "jaw", 0.08), abs=0.005)
    assert value(weak, "closure", 0.18) == value(full, "closure", 0.18) == 1.0


@settings(deadline=None, max_examples=40)
@given(st.lists(st.tuples(st.sampled_from(PHONES), st.integers(0, 400)), max_size=30), st.floats(0.0, 2.0))
def test_any_phones_give_shares_from_rest_to_rest(words: list[tuple[str, int]], strength: float) -> None:
    tracks = articulate(
        cues(" ".join(f"{symbol}:{length}" for symbol, length in words)), Articulation(strength=strength)
    )
    assert tuple(tracks) == MOUTH_CHANNELS
    for channel, track in tracks.items():
        _, values = track.given()
        assert np.all((values >= 0.0) & (values <= 1.0)), channel
        assert values[-1] <= 0.02, channel
        assert track.first_s == 0.0


def test_a_film_begins_with_the_mouth_at_rest() -> None:
    assert value(articulate(poem()), "jaw", 0.0) < 0.05


def test_no_phones_are_a_mouth_at_rest() -> None:
    for track in articulate([]).values():
        assert not np.any(track.given()[1])


def test_closure_stays_whole_across_the_pieces_of_a_long_text() -> None:
    # A hold lies on the 30 s boundary between two pieces of the work.
    text = "AA1:100 T:100 " * 149 + "AA1:170 M:60 AA1:120"
    tracks = articulate(cues(text))
    assert np.all(tracks["closure"].evaluate(np.arange(29.97, 30.026, 0.001))[0] == 1.0)


def test_work_grows_linearly_in_keys() -> None:
    one = sum(len(track) for track in articulate(poem()).values())
    length = poem()[-1].end_s
    four = [Cue(cue.start_s + i * length, cue.end_s + i * length, cue.symbol) for i in range(4) for cue in poem()]
    assert sum(len(track) for track in articulate(four).values()) == pytest.approx(4 * one, rel=0.05)


def test_same_phones_same_bits() -> None:
    for one, other in zip(articulate(poem()).values(), articulate(poem()[::-1]).values(), strict=True):
        assert one == other


@pytest.mark.skipif(importlib.util.find_spec("hibari") is None, reason="the default voice is not installed")
def test_bilabials_of_the_real_voice_are_shut_in_every_film() -> None:
    speech = pytest.importorskip("mien.speech")
    if not hasattr(speech, "speak"):
        pytest.skip("there is no voice yet")
    said = speech.speak("How happy is the little stone, that rambles in the road alone.")
    tracks = articulate(said.phones)
    bilabials = [cue for cue in said.phones if cue.symbol in ("P", "B", "M")]
    assert len(bilabials) >= 3
    for fps in RATES:
        for cue in bilabials:
            assert seen(tracks["closure"], cue, fps, 0.0) >= 0.99, (fps, cue)
