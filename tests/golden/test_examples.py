"""Examples are docs, tests and gallery pictures at once: each runs, and its picture is the one in docs/gallery."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted(path for path in (ROOT / "examples").glob("*.py") if "# mien:" in path.read_text(encoding="utf-8"))
MOST_APART = 1.0
"""Mean difference of 8-bit values that JPEG and font versions may make."""


@pytest.fixture(autouse=True)
def _examples_find_one_another(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "examples")


def told(path):
    line = next(line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("# mien:"))
    return dict(item.strip().split(" = ") for item in line.removeprefix("# mien:").split(","))


def run(path, out):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.main(str(out))


@pytest.mark.parametrize("path", [p for p in EXAMPLES if told(p)["test"] == "compare"], ids=lambda p: p.stem)
def test_example_makes_the_picture_of_the_gallery(path, tmp_path):
    out = tmp_path / f"{path.stem}.jpg"
    run(path, out)
    new = np.asarray(Image.open(out), dtype=float)
    shown = np.asarray(Image.open(ROOT / "docs/gallery" / out.name), dtype=float)
    assert new.shape == shown.shape
    assert np.abs(new - shown).mean() < MOST_APART, f"run python tools/gallery.py {path.stem} and look at the picture"


@pytest.mark.parametrize("path", [p for p in EXAMPLES if told(p)["test"] == "run"], ids=lambda p: p.stem)
def test_example_runs(path, tmp_path):
    out = tmp_path / f"{path.stem}{'.png' if told(path)['docs'] == 'picture' else '.mp4'}"
    run(path, out)
    assert out.stat().st_size > 10_000


def test_the_gallery_shows_every_example_with_a_picture():
    page = (ROOT / "docs/gallery.md").read_text(encoding="utf-8")
    for path in EXAMPLES:
        if told(path)["docs"] == "picture":
            assert f"gallery/{path.stem}." in page
            assert f"examples/{path.stem}.py" in page
