"""The benchmark of filled polygons: what it draws, what it measures, and that it does without its peer."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from mien.core import Scene
from mien.render import draw_drawing

sys.path.insert(0, str(Path(__file__).parents[3] / "benchmarks"))

import fill


def test_its_drawing_is_seeded_and_has_holes_and_clips() -> None:
    drawing, again = fill.make_drawing(), fill.make_drawing()
    assert len(drawing.paths) == fill.POLYGONS
    assert sum(len(path.contours) == 2 for path in drawing.paths) == 20
    for one, other in zip(drawing.paths, again.paths, strict=True):
        np.testing.assert_array_equal(one.contours[0], other.contours[0])
    cut = [path for path in fill.clip_drawing(drawing).paths if path.inside or path.outside]
    assert len(cut) == 30
    assert len({id(region) for path in cut for region in (*path.inside, *path.outside)}) == 3


def test_an_error_is_that_of_the_area() -> None:
    scene = Scene(size_px=(fill.SIDE_PX,) * 2, background=((0.0,) * 4,) * 2)

    def paler(drawing: fill.Drawing) -> np.ndarray:
        picture = draw_drawing(drawing, scene)
        return picture - 5 * (picture > 5)

    drawing = fill.make_drawing()
    mean, most = fill.errors(lambda each: draw_drawing(each, scene), drawing, 1)
    assert mean < 0.5
    assert most < 6.0
    assert fill.errors(paler, drawing, 1)[0] == pytest.approx(5.0, abs=1.0)


def test_without_pycairo_it_says_so_and_measures_ours(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "cairo", None)
    monkeypatch.setattr(sys, "argv", ["fill.py", "--rounds", "1", "--frames", "1", "--compared", "1"])
    fill.main()
    out = capsys.readouterr().out
    assert "pycairo is left out" in out
    assert "mien, with clips" in out
    assert "target" not in out
