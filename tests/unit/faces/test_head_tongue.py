"""The tongue: how far it goes out, past which teeth and over which lip."""

import numpy as np
import pytest

from mien.faces import load_face
from mien.faces.head import tongue
from mien.faces.head.measured import archive
from soundness import Posed, tongue_in_teeth_mm
from support import in_python

HEAD = load_face("head")


def posed(values):
    """Points (N, 3) m of tongue, lower and upper teeth, and of the skin."""
    points = HEAD.shape(HEAD.neutral.replace(values)).points
    span, lower = HEAD._layout.span, HEAD._layout.lower["teeth"]
    teeth = points[span["teeth"]]
    return points[span["tongue"]], teeth[lower], teeth[~lower], points[span["skin"]]


def test_shut_teeth_hold_the_tip_back_and_shut_lips_stop_it_behind_them():
    way = in_python(tongue.way_out)
    assert way(1.0, -0.002, 0.02) == tongue.BEHIND_M
    assert way(1.0, 0.02, 0.0) == tongue.BEHIND_M + tongue.TO_LIPS_M
    assert way(1.0, 0.02, 0.02) == tongue.BEHIND_M + tongue.TO_LIPS_M + tongue.BEYOND_M
    assert way(0.25, 0.02, 0.02) == 0.25 * way(1.0, 0.02, 0.02)


@pytest.mark.parametrize("jaw", [8, 12, 16])
def test_a_tongue_that_is_out_lies_past_the_lower_teeth_and_on_the_lower_lip(jaw):
    out, lower, upper, skin = posed({"jaw.rotation": jaw, "tongue.out": 1})
    past_mm = 1000 * (out[:, 2].max() - lower[:, 2].max())
    assert 20.0 <= past_mm <= 28.0
    lip = skin[archive().vertex["m0_9"]]
    beyond = out[(np.abs(out[:, 0]) < 0.006) & (np.abs(out[:, 2] - lip[2]) < 0.005)]
    assert beyond[:, 1].min() > lip[1] - 0.0005
    assert beyond[:, 1].max() < upper[:, 1].min()


@pytest.mark.parametrize("more", [{}, {"tongue.up": 1}, {"tongue.up": -1}, {"tongue.side": 1}, {"tongue.raise": 1}])
@pytest.mark.parametrize("jaw", [4, 8, 14, 20])
def test_the_front_teeth_stay_out_of_the_tongue(jaw, more):
    out, lower, upper, _ = posed({"jaw.rotation": jaw, "tongue.out": 1, **more})
    front = out.reshape(-1, tongue.SIDES, 3)[:6]
    for teeth, sign in ((lower, 1.0), (upper, -1.0)):
        edges = teeth[np.abs(teeth[:, 0]) < 0.006]
        edge = edges[np.argmax(sign * edges[:, 1])]
        near = front.reshape(-1, 3)
        near = near[(np.abs(near[:, 0]) < 0.006) & (np.abs(near[:, 2] - edge[2]) < 0.0015)]
        assert (sign * (near[:, 1] - edge[1]) > -0.0005).all()


def test_the_tip_goes_aside_and_up():
    rest, *_ = posed({"jaw.rotation": 12, "tongue.out": 1})
    aside, *_ = posed({"jaw.rotation": 12, "tongue.out": 1, "tongue.side": 1})
    up, *_ = posed({"jaw.rotation": 12, "tongue.out": 1, "tongue.up": 1})
    assert (aside - rest)[0, 0] > 0.008
    assert (up - rest)[0, 1] > 0.006
    assert np.abs((aside - rest)[-tongue.SIDES :]).max() == 0.0


@pytest.mark.parametrize(
    ("values", "most_mm"),
    [
        ({"tongue.side": 1.0}, 0.3),
        ({"tongue.side": -1.0, "jaw.rotation": 20.0}, 0.3),
        ({"jaw.side": 1.0, "jaw.rotation": 8.0}, 0.3),
        ({"jaw.side": 1.0}, 1.3),
    ],
)
def test_a_tongue_that_goes_aside_stays_between_the_teeth(values, most_mm):
    assert tongue_in_teeth_mm(Posed(HEAD, HEAD.neutral.replace(values))) < most_mm
