"""A film of mien plays in a real browser: Debian's Chromium, a page on the loopback, a video element."""

import contextlib
import functools
import http.server
import shutil
import threading

import pytest

mien = pytest.importorskip("mien")
sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed (extras: test)")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--mute-audio",
    "--autoplay-policy=no-user-gesture-required",
]
PAGE = """<!doctype html><meta charset="utf-8"><title>film</title>
<video src="stone.mp4" preload="auto" playsinline></video>"""

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(CHROMIUM is None, reason="Debian's chromium is not installed (apt install chromium)"),
]


class Handler(http.server.SimpleHTTPRequestHandler):
    """Files of one folder, without a line in the log for each."""

    def log_message(self, *_):
        pass

    def copyfile(self, source, outputfile):
        # The browser hangs up when it has seen enough of a file.
        with contextlib.suppress(ConnectionError):
            super().copyfile(source, outputfile)


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    """A short film with sound, made as a user makes it."""
    path = tmp_path_factory.mktemp("film") / "stone.mp4"
    mien.say("Happy.", face="head", seed=1, scene=mien.Scene(size_px=(192, 160), subdivide=0)).write(path)
    return path


@pytest.fixture(scope="module")
def address(film):
    """Where a page with the film is served."""
    (film.parent / "index.html").write_text(PAGE)
    handler = functools.partial(Handler, directory=film.parent)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture(scope="module")
def page(address):
    """The page, open in a headless browser; a message in the console is a fault."""
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, headless=True, args=FLAGS)
        page = browser.new_page()
        page.goto(address)
        page.wait_for_function(
            "() => { const v = document.querySelector('video'); return v.error || v.readyState >= 3 }", timeout=30_000
        )
        yield page
        browser.close()


def video(page, expression):
    return page.evaluate(f"() => {{ const v = document.querySelector('video'); return {expression} }}")


def test_the_browser_understands_the_film(page):
    assert video(page, "v.error && v.error.message") is None
    assert video(page, "v.readyState") >= 3
    assert video(page, "[v.videoWidth, v.videoHeight]") == [192, 160]
    assert 0.4 < video(page, "v.duration") < 5.0


def test_the_film_plays_to_its_end(page):
    video(page, "v.play()")
    page.wait_for_function("() => document.querySelector('video').ended", timeout=30_000)
    assert video(page, "v.currentTime") == pytest.approx(video(page, "v.duration"), abs=0.1)
    assert video(page, "v.getVideoPlaybackQuality().totalVideoFrames") > 5
    assert video(page, "v.webkitAudioDecodedByteCount") > 0


def test_the_picture_is_there_and_changes(page):
    # Frames are taken as they are shown: the little server cannot seek.
    watch = """() => new Promise(done => {
        const v = document.querySelector('video')
        const c = document.createElement('canvas')
        ;[c.width, c.height] = [v.videoWidth, v.videoHeight]
        const g = c.getContext('2d', { willReadFrequently: true })
        const frames = []
        const take = () => {
            g.drawImage(v, 0, 0)
            frames.push(Array.from(g.getImageData(0, 0, c.width, c.height).data))
            v.requestVideoFrameCallback(take)
        }
        v.requestVideoFrameCallback(take)
        v.addEventListener('ended', () => done(frames), { once: true })
        v.load()
        v.play()
    })"""
    frames = page.evaluate(watch)
    assert len(frames) >= 3
    assert all(max(frame) - min(frame) > 100 for frame in frames)
    assert len({bytes(frame) for frame in frames}) >= 3
