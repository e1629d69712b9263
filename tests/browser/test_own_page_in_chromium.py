"""A page of somebody else moves a face, from an origin that is allowed, and from no other."""

import functools
import http.server
import re
import shutil
import threading
from pathlib import Path

import pytest

from live_process import live_process

sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed (extras: test)")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FOLDER = Path(__file__).parents[2] / "examples" / "live"

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(CHROMIUM is None, reason="Debian's chromium is not installed (apt install chromium)"),
]


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def port():
    handler = functools.partial(Quiet, directory=FOLDER)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server.server_port
        server.shutdown()
        thread.join()


@pytest.fixture(scope="module")
def page():
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        yield browser.new_page()
        browser.close()


def test_a_page_moves_a_face_from_an_origin_that_is_allowed(tmp_path, port, page):
    with live_process(tmp_path, "--no-voice", "--face", "toon:olav", "--allow", f"http://127.0.0.1:{port}") as live:
        answer = page.locator("#answer")
        for host, words in (("127.0.0.1", "connected"), ("localhost", re.compile("no connection"))):
            page.goto(f"http://{host}:{port}/browser.html")
            page.fill("#link", live.link)
            page.click("#connect")
            sync_api.expect(answer).to_have_text(words)
            if host == "127.0.0.1":
                page.click("#smile")
                sync_api.expect(answer).to_contain_text('"kind": "ok"')
