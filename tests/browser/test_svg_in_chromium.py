"""An SVG of mien in a real browser looks like the same face in pixels, and no seams shine through."""

import io
import shutil

import numpy as np
import pytest
from PIL import Image

from mien.core import Drawing, Path, Region
from mien.formats.svg import VectorPicture
from mien.render import draw_drawing

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


def wavy(middle: tuple[float, float], radius: float, phase: float, wave: float = 0.15) -> np.ndarray:
    angle = np.linspace(0.0, 2.0 * np.pi, 120, endpoint=False)
    rim = radius * (1.0 + wave * np.sin(3.0 * angle + phase))
    return np.array(middle) + rim[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def star(middle: tuple[float, float], radius: float) -> np.ndarray:
    angle = 0.8 * np.pi * np.arange(5)
    return np.array(middle) + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def test_the_browser_shows_a_drawing_with_rules_clips_and_holes_as_the_filler_does(page, tmp_path):
    skin, dark, white = (0.9, 0.5, 0.3, 1.0), (0.02, 0.01, 0.05, 1.0), (0.9, 0.9, 0.9, 1.0)
    left, right = (Region((wavy((x, 60.0), 14.0, x),)) for x in (30.0, 70.0))
    mouth = Region((star((50.0, 25.0), 18.0),), "nonzero")
    paths = (
        *(Path("eye", region.contours, white) for region in (left, right)),
        *(Path("pupil", (wavy((x, 62.0), 9.0, 1.0),), dark) for x in (38.0, 78.0)),
        Path("mouth", mouth.contours, dark, "nonzero"),
        Path("tongue", (wavy((50.0, 16.0), 10.0, 0.0),), (0.6, 0.05, 0.05, 1.0), inside=(mouth,)),
        Path("face", (wavy((50.0, 48.0), 45.0, 2.0, 0.03),), skin, outside=(left, right, mouth)),
        Path("mark", (star((50.0, 80.0), 9.0),), dark),
    )
    drawing = Drawing((100.0, 100.0), paths, (0.0, 1.0, 0.0, 1.0))
    scene = mien.Scene(size_px=(SIDE, SIDE))
    VectorPicture(drawing, scene).write(tmp_path / "drawing.svg")
    page.goto((tmp_path / "drawing.svg").as_uri())
    shown = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)
    drawn = draw_drawing(drawing, scene)[:, :, :3].astype(int)
    difference = np.abs(shown - drawn).max(axis=2)
    # A browser blends edges in sRGB, so that half dark, half light is another grey; inside, colours are the same.
    assert np.median(difference) <= 1
    assert (difference > 8).mean() < 0.02
    inside = np.ones((SIDE, SIDE), dtype=bool)
    for axis in (0, 1):
        for way in (-2, -1, 1, 2):
            inside &= (np.roll(drawn, way, axis) == drawn).all(axis=2)
    assert inside.mean() > 0.7
    assert difference[inside].max() <= 2
    # The green behind the face shines through nowhere along its holes: there is no green in white, skin and dark.
    around = np.zeros((SIDE, SIDE), dtype=bool)
    around[int(0.24 * SIDE) : int(0.75 * SIDE), int(0.25 * SIDE) : int(0.8 * SIDE)] = True
    for picture in (shown, drawn):
        green = picture[:, :, 1] - np.maximum(picture[:, :, 0], picture[:, :, 2])
        assert green[around].max() <= 3


@pytest.mark.parametrize("face", ["toon:gus", "toon:olav"])
def test_the_browser_shows_a_drawn_face_as_the_filler_does(page, tmp_path, face):
    scene = mien.Scene(size_px=(SIDE, SIDE))
    mien.draw_paths(face, {}, scene).write(tmp_path / "face.svg")
    page.goto((tmp_path / "face.svg").as_uri())
    shown = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)
    difference = np.abs(shown - mien.draw(face, {}, scene).pixels[:, :, :3]).max(axis=2)
    # Edges, and what is half transparent, are blended in sRGB there.
    assert np.median(difference) <= 1
    assert (difference > 40).mean() < 0.005
    patches = difference > 40
    for axis in (0, 1):
        patches = patches & np.roll(patches, 1, axis) & np.roll(patches, -1, axis)
    assert not patches.any()


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
