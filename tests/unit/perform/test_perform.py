from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import pytest

from mien.core import Cue, Drawing, MienError, ParameterTable, Pose, Preset, RangeError, Sound, UnknownNameError
from mien.faces.head.table import head_table
from mien.perform import Performance, Style, perform
from mien.speech import Speech

RATES = (12, 24, 25, 30, 60)
NAMES = ("idle", "gaze", "expression", "speech", "shut", "direct")
STILL = Style(blinks=0, head=0, brows=0, gaze=0)

PHONES = """
SIL:200 HH:55 AW2:175 HH:30 AE1:125 P:75 IY0:125 IH0:50 Z:100 DH:30 AH0:70 L:30 IH1:50 T:30 AH0:50 L:100
S:50 T:50 OW1:225 N:260 SIL:165 DH:30 AE0:50 T:70 R:50 AE1:125 M:50 B:50 AH0:50 L:50 Z:100 SIL:350
"""
WORDS = (
    (0.2, 0.43, "How"),
    (0.43, 0.785, "happy"),
    (0.785, 0.935, "is"),
    (1.035, 1.295, "little"),
    (1.295, 1.88, "stone"),
)


def say(repeat: int = 1) -> Speech:
    phones, words, time = [], [], 0.0
    for _ in range(repeat):
        words += [Cue(time + start, time + end, word) for start, end, word in WORDS]
        for part in PHONES.split():
            symbol, length = part.split(":")
            phones.append(Cue(time, time + int(length) / 1000.0, symbol))
            time = phones[-1].end_s
    sound = Sound.silence(time)
    return Speech("How happy is the little stone that rambles.", sound, tuple(words), tuple(phones), (), "none")


@dataclass(frozen=True)
class Puppet:
    """The head's table without its geometry."""

    name: str = "puppet"
    family: str = "head"
    presets: Mapping[str, Preset] = field(
        default_factory=lambda: {
            "smile": Preset(
                "smile", "expression", {"mouth.expression": 0.4, "mouth.upper_raise": 0.4, "target.y": -0.2}
            ),
            "laugh": Preset("laugh", "expression", {"mouth.expression": 0.2, "jaw.rotation": 8.0}),
            "awake": Preset("awake", "expression", {"eyelid.opening": 1.0}),
            "pale": Preset("pale", "palette", {"skin.color.red": 0.9}),
        }
    )

    @property
    def parameters(self) -> ParameterTable:
        return head_table()

    @property
    def unsubdivided(self) -> Puppet:
        return self

    def shape(self, pose: Pose) -> Drawing:
        raise NotImplementedError


def column(performance: Performance, name: str, times: np.ndarray) -> np.ndarray:
    table = performance.face.parameters
    return performance.timeline.values(times, table)[:, table.index[name]]


def test_layers_are_named_and_ordered() -> None:
    assert tuple(layer.name for layer in perform(say(), Puppet()).timeline.layers) == NAMES


def test_performance_carries_words_phones_sound_title_and_seed() -> None:
    speech = say()
    performance = perform(speech, Puppet(), seed=3)
    assert performance.sound is speech.sound
    assert performance.timeline.length_s == pytest.approx(speech.phones[-1].end_s, abs=1e-4)
    assert performance.timeline.words == speech.words
    assert performance.timeline.phones == speech.phones
    assert (performance.timeline.title, performance.timeline.seed) == (speech.text, 3)


@pytest.mark.parametrize("fps", RATES)
@pytest.mark.parametrize("emotion", [None, "smile", "laugh", "awake"])
def test_lips_are_shut_at_every_bilabial_in_every_film_and_mood(fps: int, emotion: str | None) -> None:
    performance = perform(say(), Puppet(), emotion=emotion)
    times = performance.timeline.frame_times(fps)
    shut = column(performance, "mouth.closure", times) == 1.0
    parted = [column(performance, f"mouth.{name}", times) for name in ("upper_lip", "upper_raise.left")]
    parted.append(column(performance, "mouth.lower_depress.right", times))
    for cue in performance.timeline.phones:
        if cue.symbol in ("P", "B", "M"):
            frames = shut & (times > cue.start_s - 0.09) & (times < cue.end_s + 0.06)
            assert frames.any(), cue
            assert all(np.max(values[frames]) < 0.02 for values in parted)


@pytest.mark.parametrize("emotion", [None, "awake"])
def test_a_blink_shuts_the_eyes_whatever_the_mood(emotion: str | None) -> None:
    performance = perform(say(8), Puppet(), emotion=emotion, seed=1)
    opening = column(performance, "eyelid.opening.left", performance.timeline.frame_times(24))
    assert np.min(opening) == 0.0
    assert np.median(opening) > 0.7


def test_emotion_comes_and_goes_and_its_mouth_makes_room_for_speech() -> None:
    performance = perform(say(), Puppet(), emotion="laugh", style=STILL)
    middle, length = 1.0, performance.timeline.length_s
    expression = column(performance, "mouth.expression.left", np.array([0.0, middle, length]))
    assert expression == pytest.approx([1.0, 0.2, 1.0])
    plain = perform(say(), Puppet(), style=STILL)
    more = column(performance, "jaw.rotation", np.array([middle])) - column(plain, "jaw.rotation", np.array([middle]))
    assert more == pytest.approx([0.45 * 8.0])


def test_half_an_emotion_moves_half_as_far() -> None:
    middle = np.array([1.0])
    whole, half, plain = (
        column(
            perform(say(), Puppet(), style=STILL, emotion="smile", emotion_amount=amount),
            "mouth.expression.left",
            middle,
        )
        for amount in (1.0, 0.5, 0.0)
    )
    assert half - plain == pytest.approx(0.5 * (whole - plain))
    with pytest.raises(RangeError, match="from 0 to 1"):
        perform(say(), Puppet(), emotion="smile", emotion_amount=1.5)


def test_emotion_does_not_touch_what_the_scene_fills_in() -> None:
    assert "target.y" not in perform(say(), Puppet(), emotion="smile").timeline.layer("expression").tracks


def test_unknown_emotion_is_refused_and_palettes_are_none() -> None:
    with pytest.raises(UnknownNameError, match="did you mean 'smile'"):
        perform(say(), Puppet(), emotion="smiel")
    with pytest.raises(UnknownNameError):
        perform(say(), Puppet(), emotion="pale")


def test_family_without_a_table_is_refused() -> None:
    with pytest.raises(MienError, match="marionette"):
        perform(say(), Puppet(family="marionette"))


def test_everything_can_be_switched_off_and_only_the_mouth_moves() -> None:
    timeline = perform(say(), Puppet(), style=STILL).timeline
    assert not timeline.layer("idle").tracks
    assert not timeline.layer("gaze").tracks
    groups = {name.split(".")[0] for name in timeline.driven(head_table())}
    assert groups <= {"chin", "jaw", "mouth", "tongue"}


@pytest.mark.parametrize(
    ("switch", "names"),
    [
        ("blinks", ["eyelid.opening.left"]),
        ("head", ["head.turn", "head.nod", "head.tilt"]),
        ("gaze", ["eye.turn.left", "eye.nod.right"]),
        ("brows", ["eyebrow.outer_raise.left"]),
    ],
)
def test_each_switch_moves_what_it_says(switch: str, names: list[str]) -> None:
    alone = Style(
        **{name: float(name in (switch, "strength")) for name in ("blinks", "head", "brows", "gaze", "strength")}
    )
    without = Style(**{switch: 0.0})
    for name in names:
        times = np.arange(0.0, 16.0, 0.02)
        assert np.ptp(column(perform(say(8), Puppet(), style=alone, seed=2), name, times)) > 0.0
        if switch in ("head", "brows"):
            assert np.ptp(column(perform(say(8), Puppet(), style=without, seed=2), name, times)) == 0.0


def test_switching_one_thing_off_changes_no_other() -> None:
    times = np.arange(0.0, 8.0, 0.05)
    full, without = (perform(say(4), Puppet(), seed=5, style=style) for style in (Style(), Style(blinks=0)))
    for name in ("head.turn", "eye.turn.left", "jaw.rotation", "head.nod"):
        np.testing.assert_array_equal(column(full, name, times), column(without, name, times))


def test_head_amount_scales_movement() -> None:
    times = np.arange(0.0, 8.0, 0.05)
    usual, half = (column(perform(say(4), Puppet(), style=Style(head=a)), "head.turn", times) for a in (1.0, 0.5))
    np.testing.assert_allclose(half, 0.5 * usual, atol=1e-12)


def test_same_seed_same_bits_and_another_seed_another_life() -> None:
    times = np.arange(0.0, 8.0, 0.05)
    one, same, other = (perform(say(4), Puppet(), seed=seed).timeline.values(times, head_table()) for seed in (0, 0, 1))
    np.testing.assert_array_equal(one, same)
    assert np.any(one != other)


def test_every_value_is_in_range_before_it_is_brought_there() -> None:
    # A sum far outside a range would be cut off, and the cut would be seen.
    table = head_table()
    performance = perform(say(4), Puppet())
    times = np.arange(0.0, 9.0, 0.02)
    for name in performance.timeline.driven(table):
        total = np.full(len(times), table[name].default)
        for layer in performance.timeline.layers[:4]:
            for driven, track in layer.tracks.items():
                if name in table.resolve(driven):
                    total += track.evaluate(times)[0]
        slack = 0.1 * (table[name].high - table[name].low)
        assert np.all((total > table[name].low - slack) & (total < table[name].high + slack)), name


def test_long_text_gets_a_short_title() -> None:
    speech = say()
    long = Speech("stone " * 100, speech.sound, speech.words, speech.phones, (), "none")
    title = perform(long, Puppet()).timeline.title
    assert len(title) <= 80
    assert title.endswith("…")


def test_writing_is_left_to_the_formats(monkeypatch: pytest.MonkeyPatch) -> None:
    import mien.formats

    calls = []
    monkeypatch.setattr(mien.formats, "write_performance", lambda *args, **more: calls.append((args, more)))
    performance = perform(say(), Puppet())
    performance.write("stone.mp4", fps=30)
    assert calls == [((performance, "stone.mp4"), {"fps": 30})]
