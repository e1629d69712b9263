"""The views of the live page show the face that the rasteriser draws, and go on after what happens to a canvas."""

import base64
import functools
import http.server
import io
import shutil
import threading
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import mien
from mien.live import Frame, frames
from mien.live.frames import FrameEncoder
from support import MASK

sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed (extras: test)")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
SOFTWARE = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
MODULES = Path(frames.__file__).parent / "page"
SIDE = 512
SCENE = mien.Scene(size_px=(SIDE, SIDE))
CLEAR = ((0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))
PAGE = """<!doctype html><link rel="icon" href="data:,"><style>
body { margin: 0 } canvas { width: 512px; height: 512px; display: block }</style><canvas></canvas><script type="module">
import { decode, makeView } from "/frames.js";
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
window.show = (setup, frame) => {
  window.view?.dispose();
  window.view = makeView(window.view?.canvas ?? document.querySelector("canvas"), decode(bytes(setup)));
  window.view.draw(decode(bytes(frame)));
};
window.read = (message) => decode(bytes(message)).type;
window.go = (frame) => window.view.draw(decode(bytes(frame)));
</script>"""

pytestmark = [
    pytest.mark.browser,
    pytest.mark.slow,
    pytest.mark.skipif(CHROMIUM is None, reason="Debian's chromium is not installed (apt install chromium)"),
]


class Modules(http.server.SimpleHTTPRequestHandler):
    """An empty page, and the modules of the live one."""

    def do_GET(self):
        if self.path != "/":
            super().do_GET()
            return
        self.send_response(200)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.end_headers()
        self.wfile.write(PAGE.encode())

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def address():
    with http.server.ThreadingHTTPServer(
        ("127.0.0.1", 0), functools.partial(Modules, directory=str(MODULES))
    ) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()
        thread.join()


@pytest.fixture(scope="module")
def browser():
    with sync_api.sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=CHROMIUM, args=SOFTWARE)
        yield found
        found.close()


@pytest.fixture
def page(browser, address):
    opened = browser.new_page(viewport={"width": SIDE, "height": SIDE})
    errors = []
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    opened.goto(address)
    opened.wait_for_function("() => Boolean(window.show)")
    yield opened
    opened.close()
    assert errors == []


def text(message):
    return base64.b64encode(message).decode()


def show(page, name, changes=None, scene=SCENE):
    """Sends a setup and a frame of a pose; the encoder that made them."""
    face = mien.load_face(name)
    encoder = FrameEncoder(face, scene, Fraction(60))
    frame = encoder.encode(Frame(3, face.neutral.replace(changes or {})))
    page.evaluate("([setup, frame]) => show(setup, frame)", [text(encoder.setup), text(frame)])
    return encoder


def shown(page, **options):
    return np.asarray(Image.open(io.BytesIO(page.screenshot(**options))).convert("RGBA")).astype(int)


def differences(page, name, changes=None, scene=SCENE):
    drawn = mien.draw(name, changes or {}, scene).pixels[:, :, :3]
    height, width = drawn.shape[:2]
    return np.abs(shown(page)[:height, :width, :3] - drawn).max(axis=2)


def assert_same_face(found):
    # Borders have other samples and light falls on every pixel; a missing part would be a patch.
    assert np.median(found) <= 1
    assert (found > 40).mean() < 0.003
    patches = found > 24
    for axis in (0, 1):
        patches = patches & np.roll(patches, 1, axis) & np.roll(patches, -1, axis)
    assert patches.mean() < 0.0003


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("head", {}),
        ("head", {"mouth.expression": 0.2, "jaw.rotation": 10.0}),
        ("head", {"head.turn": 30.0, "head.nod": -10.0, "eye.turn": -15.0, "eyelid.opening": 0.7}),
        ("head:kenji", {"jaw.rotation": 6.0}),
        (MASK, {"phase": 2.5, "head.turn": 15.0, "eye.turn": 10.0}),
        ("toon:olav", {}),
        ("toon:gus", {}),
        ("toon:pip", {}),
    ],
)
def test_a_view_shows_what_the_rasteriser_draws(page, name, changes):
    show(page, name, changes)
    assert_same_face(differences(page, name, changes))


@pytest.mark.parametrize("name", ["head", "toon:gus"])
def test_frames_follow_one_another(page, name):
    encoder = show(page, name)
    face, wide = mien.load_face(name), {"jaw.rotation": 14.0} if name == "head" else {"mouth.bottom": 1.0}
    for changes in (wide, {}):
        page.evaluate("frame => go(frame)", text(encoder.encode(Frame(4, face.neutral.replace(changes)))))
        assert_same_face(differences(page, name, changes))


def test_polygons_are_flat_where_the_scene_says_so(page):
    scene = replace(SCENE, shading="polygon", subdivide=1)
    face = mien.load_face("head")
    encoder = FrameEncoder(face, scene, Fraction(60), subdivide=1)
    frame = encoder.encode(Frame(0, face.neutral))
    page.evaluate("([setup, frame]) => show(setup, frame)", [text(encoder.setup), text(frame)])
    assert_same_face(differences(page, "head", {}, scene))


@pytest.mark.parametrize("name", ["head", "toon:gus"])
def test_nothing_is_behind_a_face_on_a_transparent_page(page, name):
    show(page, name, scene=replace(SCENE, background=CLEAR))
    alpha = shown(page, omit_background=True)[:, :, 3]
    assert alpha[4, 4] == 0
    assert alpha[SIDE // 2, SIDE // 2] == 255


@pytest.mark.parametrize("name", ["head", "toon:gus"])
def test_a_canvas_of_another_size_shows_all_of_the_face(page, name):
    show(page, name)
    page.evaluate("() => { Object.assign(view.canvas.style, { width: '300px', height: '420px' }); view.resize(); }")
    assert_same_face(differences(page, name, scene=replace(SCENE, size_px=(300, 420))))


def test_dragging_goes_around_a_head_and_a_double_click_back(page):
    show(page, "head")
    before = shown(page)
    page.mouse.move(200, 200)
    page.mouse.down()
    page.mouse.move(300, 230, steps=4)
    page.mouse.up()
    turned = shown(page)
    assert (np.abs(turned - before).max(axis=2) > 24).mean() > 0.05
    page.mouse.move(340, 200)
    np.testing.assert_array_equal(shown(page), turned)
    page.mouse.dblclick(200, 200)
    np.testing.assert_array_equal(shown(page), before)


def test_a_head_comes_back_with_its_graphics(page):
    show(page, "head")
    before = shown(page)
    page.evaluate(
        """async () => {
          const lost = view.gl.getExtension("WEBGL_lose_context");
          const event = (name) => new Promise((done) => view.canvas.addEventListener(name, done, { once: true }));
          const gone = event("webglcontextlost");
          lost.loseContext();
          await gone;
          view.paint();
          const back = event("webglcontextrestored");
          setTimeout(() => lost.restoreContext());
          await back;
        }"""
    )
    np.testing.assert_array_equal(shown(page), before)


def test_one_view_after_the_other_on_one_page(page):
    for name in ("head", "toon:gus", "head"):
        show(page, name)
        assert_same_face(differences(page, name))


@pytest.mark.parametrize(
    ("message", "says"), [(b"\x01\x09" + bytes(14), "version 9"), (b"\x07\x01" + bytes(14), "type 7")]
)
def test_messages_of_other_programs_are_refused(page, message, says):
    with pytest.raises(sync_api.Error, match=says):
        page.evaluate("message => read(message)", text(message))
