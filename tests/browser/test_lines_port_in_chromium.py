"""A page of any site tries to send commands to the port of text lines, which needs no token."""

from __future__ import annotations

import asyncio
import shutil
from types import SimpleNamespace

import pytest

from mien.live import Session
from mien.live.serving.animator import Animator
from mien.live.serving.tcp import serve_tcp
from support import face

async_api = pytest.importorskip("playwright.async_api", reason="Playwright is not installed (extras: test)")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(CHROMIUM is None, reason="Debian's chromium is not installed (apt install chromium)"),
]

WAYS = """async (port) => {
  const link = `http://127.0.0.1:${port}/`, body = "PLAY smile\\nELU 0\\n", tried = [];
  const attempt = async (name, work) => {
    try { await work(); tried.push(`${name}: done`); } catch (error) { tried.push(`${name}: refused`); }
  };
  await attempt("simple", () => fetch(link, { method: "POST", mode: "no-cors", body }));
  await attempt("put", () => fetch(link, { method: "PUT", body }));
  await attempt("long", () => fetch(link + "a".repeat(20000), { method: "POST", mode: "no-cors", body }));
  await attempt("socket", () => new Promise((done, fail) => {
    const socket = new WebSocket(`ws://127.0.0.1:${port}/`);
    socket.onopen = done; socket.onerror = fail;
  }));
  await attempt("picture", () => new Promise((done, fail) => {
    const picture = new Image();
    picture.onload = done; picture.onerror = fail; picture.src = `${link}?\\nPLAY smile`;
  }));
  return tried;
}"""


def test_a_page_cannot_send_lines():
    async def whole() -> None:
        animator = Animator(Session(face("toon:pip")), SimpleNamespace(number=1, setup=b""), clock=lambda: 0.0)
        server = await serve_tcp(animator, "127.0.0.1", 0)
        port = server.sockets[0].getsockname()[1]
        async with async_api.async_playwright() as playwright:
            browser = await playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
            page = await browser.new_page()
            tried = await page.evaluate(WAYS, port)
            await browser.close()
        server.close()
        assert tried == [f"{name}: refused" for name in ("simple", "put", "long", "socket", "picture")]
        assert animator.messages == 0

    asyncio.run(whole())
