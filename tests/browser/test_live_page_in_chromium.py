"""The page of a live face in a real Chromium: what comes in by each door is drawn, and heard in time."""

from __future__ import annotations

import http.server
import io
import json
import shutil
import signal
import socket
import threading
import time
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

import numpy as np
import pytest
from PIL import Image

import mien
from live_process import STILL, LiveProcess, live_process
from mien.live.osc import encode_call

sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed (extras: test)")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
SOFTWARE = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
SOUNDING = "--autoplay-policy=no-user-gesture-required"
EVIL = "--host-resolver-rules=MAP evil.example 127.0.0.1"
SIZE = {"width": 240, "height": 200}
TOKEN = "tokentoken"
TEXT = "Hello there, my friend. How happy is the little stone that rambles in the road alone."
DOORS = ("--token", TOKEN, "--idle", STILL, "--tcp-port", "0", "--osc-port", "0")
PATIENCE_S = 25.0
SMILE_S = 2.7
EXPECTED = ("WebSocket connection to", "Failed to load", "Access to fetch", "[.WebGL")

pytestmark = [
    pytest.mark.browser,
    pytest.mark.slow,
    pytest.mark.skipif(CHROMIUM is None, reason="Debian's chromium is not installed (apt install chromium)"),
]


@pytest.fixture(scope="module")
def playwright():
    with sync_api.sync_playwright() as found:
        yield found


@pytest.fixture(scope="module")
def browser(playwright):
    found = playwright.chromium.launch(executable_path=CHROMIUM, args=[*SOFTWARE, SOUNDING, EVIL])
    yield found
    found.close()


@pytest.fixture(scope="module")
def olav(tmp_path_factory):
    with live_process(tmp_path_factory.mktemp("olav"), "--face", "toon:olav", *DOORS) as live:
        yield live


@contextmanager
def opened(browser, link: str) -> Iterator[Any]:
    """A page with a picture in it; nothing may be wrong with it by the end."""
    context = browser.new_context(viewport=SIZE)
    page = context.new_page()
    wrong: list[str] = []
    page.on("console", lambda message: wrong.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: wrong.append(str(error)))
    # Buttons would be in the pictures until they fade.
    page.goto(f"{link}&bare")
    wait(page, lambda now: now["loop"] is not None)
    yield page
    context.close()
    assert [text for text in wrong if not text.startswith(EXPECTED)] == []


def wait(page, holds: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
    """What the page tells of itself, as soon as something holds."""
    until = time.monotonic() + PATIENCE_S
    while not holds(now := page.evaluate("window.mien.statistics()")):
        assert time.monotonic() < until, now
        page.wait_for_timeout(50)
    return now


def picture(page) -> np.ndarray:
    """What is on the screen, (H, W, 3)."""
    return np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)


def changed(one: np.ndarray, other: np.ndarray) -> int:
    """How many pixels around the mouth differ by more than a little."""
    low, middle = slice(100, 180), slice(70, 170)
    return int((np.abs(one - other).max(axis=2) > 24)[low, middle].sum())


def wait_picture(page, rest: np.ndarray, *, same: bool, again: Callable[[], None] | None = None) -> None:
    """Wait until the mouth is as it was, or is not; where little is drawn a smile is over before it was seen once."""
    until, last = time.monotonic() + PATIENCE_S, time.monotonic()
    while (changed(picture(page), rest) < 12) != same:
        assert time.monotonic() < until, f"the mouth is {'not ' if same else ''}as it was"
        if again is not None and time.monotonic() > last + SMILE_S:
            again()
            last = time.monotonic()


def about(live: LiveProcess) -> dict[str, Any]:
    link = live.link.replace(f"/?token={TOKEN}", "/about")
    request = urllib.request.Request(link, headers={"Authorization": f"Bearer {TOKEN}"})
    with urllib.request.urlopen(request, timeout=10) as answer:
        return json.load(answer)


def by_socket(live: LiveProcess) -> None:
    with mien.Client(live.link) as client:
        client.play("smile")


def by_post(live: LiveProcess) -> None:
    headers = {"Authorization": f"Bearer {TOKEN}", "Content-Type": "application/json"}
    data = json.dumps({"kind": "play", "motion": "smile"}).encode()
    link = live.link.replace(f"/?token={TOKEN}", "/messages")
    with urllib.request.urlopen(urllib.request.Request(link, data, headers), timeout=10) as answer:
        assert json.load(answer)["kind"] == "ok"


def by_line(live: LiveProcess) -> None:
    with socket.create_connection(("127.0.0.1", about(live)["ports"]["tcp"]), timeout=10) as line:
        line.sendall(b"PLAY smile\n")
        assert json.loads(line.makefile().readline())["kind"] == "ok"


def by_osc(live: LiveProcess) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as port:
        port.sendto(encode_call("/mien/play", "smile"), ("127.0.0.1", about(live)["ports"]["osc"]))


def see_smiles(page, live: LiveProcess) -> None:
    page.wait_for_timeout(300)
    rest = picture(page)
    assert rest.std() > 10
    for smile in (by_socket, by_post, by_line, by_osc):
        smile(live)
        wait_picture(page, rest, same=False, again=partial(smile, live))
        with mien.Client(live.link) as client:
            client.reset()
        wait_picture(page, rest, same=True)


def test_a_smile_by_each_door_is_drawn(browser, olav):
    with opened(browser, olav.link) as page:
        assert "token" not in page.url, "the token stays in the address"
        see_smiles(page, olav)
        assert page.get_by_role("img").get_attribute("aria-label") == "Face: toon:olav"


def test_what_is_said_is_heard_while_lips_move(browser, olav):
    with opened(browser, f"{olav.link}&captions&status") as page, mien.Client(olav.link) as client:
        rest = picture(page)
        client.say(TEXT)
        wait(page, lambda now: now["sounding"] and now["offsetP50S"] is not None)
        wait_picture(page, rest, same=False)
        sync_api.expect(page.locator("#captions .said").first).to_be_visible(timeout=10_000)
        assert page.locator("#said").text_content() in TEXT
        wait(page, lambda now: now["speaking"] is None and not now["sounding"])
        sync_api.expect(page.locator("#status")).to_contain_text("sound before picture")
        page.wait_for_timeout(2200)
        report = next(each for each in client.about()["clients"] if each["frames"])
        assert report["sound"] == "on"
        assert abs(report["offset_p50_ms"]) < 1000
        client.say(TEXT)
        wait(page, lambda now: now["sounding"])
        client.interrupt()
        wait(page, lambda now: not now["sounding"])


def test_a_page_that_may_not_sound_asks_and_its_lips_move_all_the_same(playwright, olav):
    browser = playwright.chromium.launch(executable_path=CHROMIUM, args=SOFTWARE)
    with opened(browser, olav.link) as page, mien.Client(olav.link) as client:
        rest = picture(page)
        hear = page.get_by_role("button", name="tap to hear")
        sync_api.expect(hear).to_be_visible(timeout=10_000)
        client.say(TEXT)
        wait(page, lambda now: now["speaking"] is not None)
        wait_picture(page, rest, same=False)
        assert not page.evaluate("window.mien.statistics().sounding")
        hear.click()
        # It joins in the middle.
        wait(page, lambda now: now["sounding"])
        sync_api.expect(hear).to_be_hidden()
    with opened(browser, f"{olav.link}&mute") as page:
        sync_api.expect(page.get_by_role("button", name="tap to hear")).to_be_hidden()
    browser.close()


@pytest.mark.parametrize("face", ["head", "toon:pip"])
def test_a_page_comes_back_by_itself_after_its_server_was_killed(browser, tmp_path, face):
    options = ("--face", face, "--no-voice", *DOORS)
    with live_process(tmp_path, *options) as live, opened(browser, live.link) as page:
        if face == "head":
            see_smiles(page, live)
        rest = picture(page)
        port = about(live)["ports"]["page"]
        live.process.send_signal(signal.SIGKILL)
        wait(page, lambda now: now["stale"])
        sync_api.expect(page.get_by_role("status")).to_contain_text("The face does not answer")
        with live_process(tmp_path, *options, "--port", str(port)) as again:
            now = wait(page, lambda now: now["connected"] and not now["stale"] and now["loop"] is not None)
            assert now["face"] == face
            sync_api.expect(page.get_by_role("status")).to_be_hidden()
            page.wait_for_timeout(800)  # what is stale fades
            wait_picture(page, rest, same=True)
            by_socket(again)
            wait_picture(page, rest, same=False, again=partial(by_socket, again))


def test_a_page_says_that_its_link_is_of_an_older_server(browser, tmp_path, olav):
    options = ("--face", "toon:pip", "--no-voice")
    with live_process(tmp_path, *options, "--token", "another-token") as live, opened(browser, live.link) as page:
        live.process.send_signal(signal.SIGKILL)
        wait(page, lambda now: now["stale"])
        port = live.link.split(":")[2].split("/")[0]
        with live_process(tmp_path, *options, "--token", TOKEN, "--port", port):
            sync_api.expect(page.get_by_role("status")).to_contain_text("no longer valid", timeout=15_000)


def test_a_background_is_what_the_link_says(browser, olav):
    for background, corner in (("transparent", (0, 0, 0, 0)), ("rgb(10,200,30)", (10, 200, 30, 255))):
        with opened(browser, f"{olav.link}&background={background}") as page:
            data = page.screenshot(omit_background=True)
            shown = np.asarray(Image.open(io.BytesIO(data)).convert("RGBA"))
            assert tuple(shown[2, 2]) == corner
            assert shown[100, 120, 3] == 255


class Quiet(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200)
        self.end_headers()

    def log_message(self, *_):
        pass


TRIED = """async (host) => {
  const read = await fetch(`http://${host}/about`, { credentials: "include" }).then(() => "read", () => "refused");
  const sent = await new Promise((done) => {
    const socket = new WebSocket(`ws://${host}/live`);
    socket.onopen = () => done("open");
    socket.onclose = () => done("refused");
  });
  return [read, sent];
}"""


def test_who_is_not_invited_is_refused(browser, olav):
    host = olav.link.split("/")[2]
    port = host.split(":")[1]
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Quiet) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        # The browser has the cookie, and sends it: to a browser all ports of a host are one site.
        with opened(browser, olav.link) as page:
            assert page.evaluate(TRIED, host) == ["read", "open"]
            page.goto(f"http://127.0.0.1:{server.server_port}/")
            assert page.evaluate(TRIED, host) == ["refused", "refused"]
        server.shutdown()
        thread.join()
    page = browser.new_page()
    assert page.goto(f"http://evil.example:{port}/?token={TOKEN}").status == 421
    assert page.goto(f"http://{host}/").status == 401
    sync_api.expect(page.locator("body")).to_contain_text("open the link that 'mien live' has printed")
    assert page.goto(f"http://{host}/?token=guessed").status == 401
    page.close()


CLOCKS = """async () => {
  const { Recent, pictureAt, retryPause, startOf } = await import("/page/clock.js");
  const recent = new Recent(2);
  [[5, 0], [1, 1], [-9, 2], [3, 2.5]].forEach(([value, now]) => recent.add(value, now));
  const pictures = [1, 2, 3].map((timeS) => ({ timeS }));
  return {
    percentiles: [recent.count, recent.percentile(0.5), recent.percentile(0.95, Math.abs), new Recent(1).percentile(1)],
    perSecond: recent.perSecond,
    pauses: [1, 2, 3, 9].map((failures) => [retryPause(failures, 0), retryPause(failures, 1)]),
    pictures: [0.9, 2, 2.9, 9].map((faceS) => pictureAt(pictures, faceS)?.timeS ?? null),
    starts: [startOf(5, 4, 1), startOf(5, 5.25, 1), startOf(5, 6, 1)],
  };
}"""


def test_clocks(browser, olav):
    with opened(browser, olav.link) as page:
        found = page.evaluate(CLOCKS)
    assert found["percentiles"] == [3, 1, 9, None]
    assert found["perSecond"] == pytest.approx(2 / 1.5)
    assert found["pauses"] == [[125, 250], [250, 500], [500, 1000], [2500, 5000]]
    assert found["pictures"] == [None, 2, 2, 3]
    assert found["starts"] == [{"whenS": 5, "offsetS": 0}, {"whenS": 5.25, "offsetS": 0.25}, None]
