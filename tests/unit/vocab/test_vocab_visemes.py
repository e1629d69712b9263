"""Visemes and avatars' presets, which reach a face by way of another vocabulary."""

import pytest

from mien.core import MienError
from mien.speech.mouth_table import BLENDED, phone_table
from mien.vocab import families, load_remap, next_step, pose_from, vocabulary
from support import face

SHAPES = {"oculus": 15, "rhubarb": 9, "preston-blair": 10, "sapi": 22, "mpeg4": 15}
NAMES = [(name, each) for name in SHAPES for each in vocabulary(name).names]


@pytest.mark.parametrize("name", SHAPES)
def test_all_shapes_are_there_and_played(name: str) -> None:
    assert len(vocabulary(name)) == SHAPES[name]
    assert set(load_remap(name, "channels").from_names) == set(vocabulary(name).names)
    assert next_step(name, "head") == "channels"
    assert families(name) == families("channels")


@pytest.mark.parametrize(("name", "shape"), NAMES)
def test_a_shape_is_the_mean_of_the_phones_that_its_source_names(name: str, shape: str) -> None:
    remap, table = load_remap(name, "channels"), phone_table()
    source = next(link.source for link in remap.links if link.name == shape)
    phones = source.removeprefix("mean of the phones ").removesuffix(", which speech plays").split()
    rows = [table.rows[table.index[phone]] for phone in phones]
    want = {channel: sum(row.targets[n] for row in rows) / len(rows) for n, channel in enumerate(BLENDED)}
    want |= {row.hold: 1.0 for row in rows if row.hold}
    got = remap.apply({shape: 1.0})
    assert got == pytest.approx({channel: value for channel, value in want.items() if channel in got}, abs=6e-4)
    assert all(value == 0.0 for channel, value in want.items() if channel not in got)


def test_shut_lips_are_shut_and_silence_is_rest() -> None:
    head = face("head")
    for name, shut, silent in (
        ("oculus", "PP", "sil"),
        ("rhubarb", "A", "X"),
        ("preston-blair", "MBP", "rest"),
        ("sapi", "21", "0"),
    ):
        assert pose_from(name, {shut: 1.0}, head)["mouth.closure"] == 1.0
        assert pose_from(name, {silent: 1.0}, head) == head.neutral


def test_names_of_other_programs_are_read() -> None:
    head = face("head")
    assert pose_from("oculus", {"viseme_I": 1.0}, head) == pose_from("oculus", {"ih": 1.0}, head)
    assert pose_from("vrm", {"Blink_L": 1.0}, head).changed() == {"eyelid.opening.left": 0.0}


def test_avatars_go_by_way_of_action_units() -> None:
    head = face("head")
    assert next_step("vrm", "head") == "facs"
    assert pose_from("vrm", {"lookLeft": 0.5}, head).changed() == {"eye.turn.left": 15.0, "eye.turn.right": 15.0}
    happy = pose_from("vrm", {"happy": 1.0}, head)
    assert happy == pose_from("facs", {"AU6": 0.7, "AU12": 0.8}, head)
    assert pose_from("vrm", {"neutral": 1.0}, head) == head.neutral


def test_fighting_presets_settle_as_action_units() -> None:
    pose = pose_from("vrm", {"happy": 1.0, "sad": 1.0}, face("head"))
    # 12 = 0.8 and 15 = 0.8 take 0.4 of one another.
    assert pose["mouth.expression.left"] == pytest.approx(1.0 - 0.8 * 0.6)
    assert pose["mouth.frown.left"] == pytest.approx(0.8 * 0.6)


def test_a_family_without_any_way_is_refused() -> None:
    with pytest.raises(MienError, match=r"'oculus' cannot play .* 'marionette' — there is a table for head"):
        next_step("oculus", "marionette")
