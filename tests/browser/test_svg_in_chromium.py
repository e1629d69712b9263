"""An SVG of mien in a real browser looks like the same face in pixels, and no seams shine through."""

import io
import shutil

import numpy as np
import pytest
from PIL import Image

mien = pytest.importorskip("mien")
sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed (extras: test)")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
SIDE = 512

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(CHROMIUM is None, reason="Debian's chromium is not installed (apt install chromium)"),
]


@pytest.fixture(scope="module")
def page():
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        yield browser.new_page(viewport={"width": SIDE, "height": SIDE})
        browser.close()


@pytest.mark.parametrize("view", ["front", "three-quarter", "side"])
def test_the_browser_shows_what_the_rasteriser_draws(page, tmp_path, view):
    scene = mien.Scene(size_px=(SIDE, SIDE), shading="polygon", subdivide=1).seen(view)
    pose = {"jaw.rotation": 10.0, "eyelid.opening": 0.9}
    mien.draw_paths("head", pose, scene).write(tmp_path / "head.svg")
    page.goto((tmp_path / "head.svg").as_uri())
    shown = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)
    drawn = mien.draw("head", pose, scene).pixels[:, :, :3]
    difference = np.abs(shown - drawn).max(axis=2)
    # Outlines are mixed otherwise, by less than a pixel; a polygon out of order would be a patch, a seam a line.
    assert np.median(difference) <= 2
    assert (difference > 40).mean() < 0.012
    patches = difference > 40
    for axis in (0, 1):
        patches = patches & np.roll(patches, 1, axis) & np.roll(patches, -1, axis)
    assert patches.mean() < 0.0002


def test_no_light_background_shines_through_a_dark_head(page, tmp_path):
    scene = mien.Scene(size_px=(SIDE, SIDE), subdivide=1, background=((1.0, 1.0, 1.0, 1.0),) * 2)
    dark = {f"hair.color.{channel}": 0.0 for channel in ("red", "green", "blue")}
    mien.draw_paths("head", dark, scene).write(tmp_path / "dark.svg")
    page.goto((tmp_path / "dark.svg").as_uri())
    shown = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)
    drawn = mien.draw(
        "head", dark, mien.Scene(size_px=(SIDE, SIDE), subdivide=1, shading="polygon", background=scene.background)
    )
    inside = np.ones((SIDE, SIDE), dtype=bool)
    for axis in (0, 1):
        for way in (-2, -1, 0, 1, 2):
            inside &= np.roll((drawn.pixels[:, :, :3] < 80).all(axis=2), way, axis)
    brighter = (shown - drawn.pixels[:, :, :3]).max(axis=2)[inside]
    assert len(brighter) > 5000
    assert (brighter > 30).mean() < 0.004
