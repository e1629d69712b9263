"""The example from photographs to a talking face, with fewer expressions, small and short."""

import importlib.util
from pathlib import Path

import av
import numpy as np
import pytest
from PIL import Image

import mien
from mien.capture import read_project

ROOT = Path(__file__).parents[3]
VERA = ROOT / "examples/capture/vera"


def load(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.slow
def test_photographs_become_faces_that_talk(tmp_path):
    load(ROOT / "tools/shrink_capture.py").shrink(VERA, tmp_path / "vera", 800, ["neutral", "open"])
    load(ROOT / "examples/capture/talking_face.py").main(tmp_path / "vera", tmp_path / "out", "Hi.", 96)
    out = tmp_path / "out"
    measured, fitted = mien.load_face(out / "vera.keypose"), mien.load_face(out / "vera.face.json")
    assert (measured.family, fitted.family) == ("keypose", "head")
    assert measured.keypose.phases == ("neutral", "open")
    for film in ("measured.mp4", "head.mp4"):
        with av.open(str(out / film)) as container:
            assert {stream.type for stream in container.streams} == {"video", "audio"}
    assert b"vera" in (out / "report.html").read_bytes()
    assert len(list(out.glob("[123]_*.png"))) == 3
    assert not (tmp_path / "vera/solution").exists(), "the photographs' own folder is left as it was"


def test_a_smaller_copy_has_smaller_clicks_of_the_same_places(tmp_path):
    load(ROOT / "tools/shrink_capture.py").shrink(VERA, tmp_path / "half", 400, ["smile"])
    whole, half = read_project(VERA), read_project(tmp_path / "half")
    assert [each.size_px for each in half.photographs] == [(400, 400)] * 4
    assert {each.moment for each in half.photographs} == {"smile"}
    with Image.open(half.photographs[0].path) as small:
        assert small.size == (400, 400)
    clicks = [
        {(o.photo, o.point): (o.u, o.v) for o in mien.capture.read_survey(each.folder).observations}
        for each in (whole, half)
    ]
    assert clicks[1]
    for key, place in clicks[1].items():
        np.testing.assert_allclose(place, np.array(clicks[0][key]) / 2.0, atol=0.01)
