"""Films of mien play in a real browser: Debian's Chromium, pages on the loopback, video and image elements."""

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
<video src="{name}" preload="auto" playsinline></video>"""

VIDEOS = ("happy.mp4", "happy.webm", "clear.webm")
IMAGES = ("clear.gif", "clear.apng", "clear.webp")
SIZE = (192, 160)

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
def folder(tmp_path_factory):
    """Short films with sound, made as a user makes them, some on no background; a page for each video."""
    path = tmp_path_factory.mktemp("film")
    nothing = (0.0, 0.0, 0.0, 0.0)
    for kind, background in (("happy", {}), ("clear", {"background": (nothing, nothing)})):
        scene = mien.Scene(size_px=SIZE, subdivide=0, **background)
        performance = mien.say("Happy.", face="head", seed=1, scene=scene)
        for name in VIDEOS + IMAGES:
            if name.startswith(kind):
                performance.write(path / name)
    for name in VIDEOS:
        (path / f"{name}.html").write_text(PAGE.format(name=name))
    (path / "index.html").write_text("<!doctype html><title>images</title>")
    return path


@pytest.fixture(scope="module")
def address(folder):
    """Where the pages are served."""
    handler = functools.partial(Handler, directory=folder)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture(scope="module")
def browser():
    """A headless browser."""
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, headless=True, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture(scope="module", params=VIDEOS)
def page(browser, address, request):
    """The page of a film, open in the browser."""
    page = browser.new_page()
    page.goto(f"{address}{request.param}.html")
    page.wait_for_function(
        "() => { const v = document.querySelector('video'); return v.error || v.readyState >= 3 }", timeout=30_000
    )
    yield page
    page.close()


def video(page, expression):
    return page.evaluate(f"() => {{ const v = document.querySelector('video'); return {expression} }}")


def test_the_browser_understands_the_film(page):
    assert video(page, "v.error && v.error.message") is None
    assert video(page, "v.readyState") >= 3
    assert video(page, "[v.videoWidth, v.videoHeight]") == list(SIZE)
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
        let last = []
        const take = () => {
            g.clearRect(0, 0, c.width, c.height)
            g.drawImage(v, 0, 0)
            last = g.getImageData(0, 0, c.width, c.height).data
            // The pixels themselves would take seconds on their way out of the browser: range and a sum that changes.
            frames.push(last.reduce(([low, high, sum], code) =>
                [Math.min(low, code), Math.max(high, code), (31 * sum + code) % 1000003], [255, 0, 0]))
            v.requestVideoFrameCallback(take)
        }
        v.requestVideoFrameCallback(take)
        v.addEventListener('ended', () => done([frames, Array.from(last)]), { once: true })
        v.load()
        v.play()
    })"""
    frames, last = page.evaluate(watch)
    assert len(frames) >= 3
    assert all(high - low > 100 for low, high, _ in frames)
    assert len({total for _, _, total in frames}) >= 3
    check_corners(last, clear="clear" in page.url)


@pytest.mark.parametrize("name", IMAGES)
def test_an_animated_picture_is_understood_and_clear_where_nothing_is(browser, address, name):
    page = browser.new_page()
    page.goto(address)
    # The first and the last frame, decoded as for an image element.
    decode = """async name => {
        const answer = await fetch(name)
        const type = {gif: 'image/gif', apng: 'image/png', webp: 'image/webp'}[name.split('.').pop()]
        const decoder = new ImageDecoder({ data: answer.body, type })
        await decoder.completed
        const track = decoder.tracks.selectedTrack
        const found = []
        for (const frameIndex of [0, track.frameCount - 1]) {
            const { image } = await decoder.decode({ frameIndex })
            const c = new OffscreenCanvas(image.displayWidth, image.displayHeight)
            const g = c.getContext('2d')
            g.drawImage(image, 0, 0)
            found.push(Array.from(g.getImageData(0, 0, c.width, c.height).data))
        }
        return [track.frameCount, track.repetitionCount, found]
    }"""
    count, repeats, frames = page.evaluate(decode, name)
    page.close()
    assert count > 5
    assert repeats is None or repeats > 1000
    assert len(frames[0]) == SIZE[0] * SIZE[1] * 4
    assert frames[0] != frames[1]
    for frame in frames:
        check_corners(frame, clear=True)


def check_corners(frame, clear):
    """The upper corners show the background, the middle the face."""
    alpha = frame[3::4]
    width = SIZE[0]
    middle = alpha[SIZE[1] // 2 * width + width // 2]
    assert middle >= 250
    # VP9 codes alpha as it does light: not to the last code.
    assert [alpha[0], alpha[width - 1]] == pytest.approx([0, 0] if clear else [255, 255], abs=3)
