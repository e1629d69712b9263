from dataclasses import replace

import numpy as np
import pytest
from mouth_cases import cues

from mien.core import RangeError
from mien.speech.articulation import USUAL, Articulation, amounts
from mien.speech.mouth import articulate, reach
from mien.speech.mouth_holds import NEAR_S, Hold, nearness
from mien.speech.mouth_table import GROUPS


@pytest.mark.parametrize("name", amounts())
def test_an_amount_goes_from_off_to_its_greatest(name: str) -> None:
    high = amounts()[name].high
    for value in (0.0, high):
        assert getattr(Articulation(**{name: value}), name) == value
    for value in (-0.01, high + 0.01, float("nan"), float("inf")):
        with pytest.raises(RangeError, match=f"style {name}="):
            Articulation(**{name: value})


def test_all_is_usual_unless_said() -> None:
    assert replace(USUAL, jaw=1.0) == Articulation()
    assert {getattr(USUAL, name) for name in amounts()} == {1.0}


def test_larger_movements_come_nearer_to_the_widest_and_are_not_cut_off() -> None:
    share = np.array([0.0, 0.2, 0.5, 1.0])
    assert reach(share, 0.5) == pytest.approx(0.5 * share)
    assert reach(share, 1.0) == pytest.approx(share)
    assert reach(share, 2.0) == pytest.approx([0.0, 0.4 / 1.2, 1.0 / 1.5, 1.0])
    assert np.all(np.diff(reach(np.linspace(0.0, 1.0, 50), 4.0)) > 0.0)


@pytest.mark.parametrize("group", GROUPS)
def test_jaw_lips_and_tongue_are_axes_of_their_own(group: str) -> None:
    phones = cues("SIL:200 L:70 AA1:150 TH:80 UW1:120 SIL:300")
    times = np.arange(0.0, 0.9, 0.01)
    usual, half = articulate(phones), articulate(phones, Articulation(**{group: 0.5}))
    for other, channels in GROUPS.items():
        for channel in channels:
            share = 0.5 if other == group else 1.0
            np.testing.assert_allclose(
                half[channel].evaluate(times)[0], share * usual[channel].evaluate(times)[0], atol=0.005
            )


def test_the_jaw_comes_up_for_a_closure_smoothly() -> None:
    times = np.linspace(0.0, 0.5, 501)
    near = nearness((Hold(0.2, 0.3, "closure"),), "closure", times)
    assert np.all(near[(times >= 0.2) & (times <= 0.3)] == 1.0)
    assert near[160] == pytest.approx(0.5, abs=1e-9), "half of the way 40 ms before"
    assert not near[times < 0.2 - NEAR_S - 1e-9].any()
    assert np.max(np.abs(np.diff(near))) < 1.6 * 0.001 / NEAR_S
    assert not nearness((Hold(0.2, 0.3, "tuck"),), "closure", times).any()


def test_the_jaw_never_moves_faster_than_a_real_one() -> None:
    # 200 mm/s at the front teeth, which are 20 mm apart at a full jaw.
    tracks = articulate(cues("SIL:200 " + "AA1:90 B:60 AA1:90 M:50 S:80 AA1:100 P:70 " * 3 + "SIL:300"))
    jaw = tracks["jaw"].evaluate(np.arange(0.0, 2.2, 0.01))[0]
    assert 20.0 * np.max(np.abs(np.diff(jaw))) / 0.01 < 200.0
