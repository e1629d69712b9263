"""The benchmark of people finds a shape that the parameters can make, and leaves what they cannot."""

from pathlib import Path

import numpy as np
import pytest

from mien.faces.head.head import Head

pytest.importorskip("scipy")
BENCHMARKS = Path(__file__).parents[3] / "benchmarks"


@pytest.fixture
def identities(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import identities

    return identities


def test_a_shape_of_measured_directions_is_found(identities):
    fit = identities.Fit(identities.MEASURED)
    head = Head(hair="bald").unsubdivided
    posed, rest = (
        head.shape(head.neutral.replace(changes)).points[: len(fit.counted)][fit.counted]
        for changes in ({"nose.length": 0.9, "chin.shape": 0.2, "cheek.hollow.left": 0.8}, {})
    )
    assert identities.rms_mm(posed - rest) > 0.5
    assert identities.rms_mm(fit.miss(posed - rest)) < 0.1


def test_a_head_pushed_up_as_a_whole_is_left_as_it_is(identities):
    fit = identities.Fit(identities.MEASURED)
    field = np.tile([0.0, 0.002, 0.0], (int(fit.counted.sum()), 1))
    assert 1.0 < identities.rms_mm(fit.miss(field)) <= 2.0
