"""The tongue of the real head is seen where it makes the sound, and not through shut lips."""

from dataclasses import replace

import numpy as np
import pytest

from mien.core import Cue, Pose, Scene, Sound
from mien.faces import load_face
from mien.perform import parse_style, perform
from mien.render import draw
from mien.speech import Speech

HEAD = load_face("head")
GREEN = {"tongue.color.red": 0.0, "tongue.color.green": 1.0, "tongue.color.blue": 0.0}
SCENE = replace(Scene(size_px=(300, 220)), at=(0.0, -0.067, 0.08)).turned(8, 2, 0.3)
PHONES = "SIL:300 TH:90 IH1:80 L:80 IY1:100 S:90 AA1:120 DH:60 AH0:80 M:90 AA1:150 N:70 AA1:100 SIL:350"


def seen_tongue(style: str) -> dict[str, int]:
    """Pixels of the tongue in the middle of each phone."""
    cues, time = [], 0.0
    for word in PHONES.split():
        symbol, length = word.split(":")
        cues.append(Cue(time, time + int(length) / 1000.0, symbol))
        time = cues[-1].end_s
    speech = Speech("", Sound.silence(time), (), tuple(cues), (), "none")
    timeline = perform(speech, HEAD, style=parse_style(f"still,{style}")).timeline
    found = {}
    for cue in cues:
        values = timeline.values([cue.centre_s], HEAD.parameters)[0]
        pixels = draw(HEAD, Pose(HEAD.parameters, values).replace(GREEN), SCENE).astype(int)
        green = (pixels[..., 1] > pixels[..., 0] + 25) & (pixels[..., 1] > pixels[..., 2] + 25)
        found[cue.symbol] = int(green.sum())
    return found


@pytest.fixture(scope="module")
def usual() -> dict[str, int]:
    return seen_tongue("")


@pytest.mark.parametrize("sound", ["TH", "DH", "L", "N"])
def test_the_tongue_shows_in_its_sounds(sound: str, usual: dict[str, int]) -> None:
    assert usual[sound] > 40


@pytest.mark.parametrize("sound", ["SIL", "M"])
def test_the_tongue_does_not_show_through_shut_lips(sound: str, usual: dict[str, int]) -> None:
    assert usual[sound] == 0


def test_th_shows_more_of_the_tongue_than_without_it(usual: dict[str, int]) -> None:
    still = seen_tongue("tongue=off")
    assert usual["TH"] > 1.5 * still["TH"] + 20
    assert usual["DH"] > 1.3 * still["DH"]
    assert np.isclose(usual["S"], still["S"], atol=120)
