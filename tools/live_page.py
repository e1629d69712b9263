"""Build docs/live/page.jpg: the live page in a browser, as people see it. Needs Debian's Chromium.

python tools/live_page.py
"""

from __future__ import annotations

import io
import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

import mien

OUT = Path(__file__).parents[1] / "docs" / "live" / "page.jpg"
SIDE = (560, 420)
FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
SOUND = ["--autoplay-policy=no-user-gesture-required"]
SHOTS = (
    ("head:ada", "captions", "What can I do for you today, [smile] my friend?"),
    ("toon:olav", "captions", "Nobody knew who had left the window open."),
)
"""A face, flags of the page and what is said."""


def wait_until(page: Page, told: str) -> None:
    """Wait until the page tells so; its policy forbids what Playwright waits with."""
    while not page.evaluate(f"window.mien?.statistics().{told}"):
        page.wait_for_timeout(50)


def shoot(page: Page, face: str, flags: str, text: str) -> Image.Image:
    """The page of a face in the middle of a sentence."""
    command = [sys.executable, "-m", "mien", "live", "--face", face, "--port", "0", "--quiet"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            link = process.stdout.readline().strip() if process.stdout else ""
            page.goto(f"{link}&bare&{flags}")
            wait_until(page, "drawnFps > 1")
            with mien.Client(link) as client:
                client.say(text)
                wait_until(page, "sounding")
                page.wait_for_timeout(1500)
                return Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        finally:
            process.terminate()


def main() -> None:
    width, height = SIDE
    sheet = Image.new("RGB", (width * len(SHOTS), height))
    with sync_playwright() as playwright:
        chromium = shutil.which("chromium")
        browser = playwright.chromium.launch(executable_path=chromium, args=[*FLAGS, *SOUND])
        for number, (face, flags, text) in enumerate(SHOTS):
            page = browser.new_page(viewport={"width": width, "height": height})
            sheet.paste(shoot(page, face, flags, text), (width * number, 0))
            page.close()
        browser.close()
    sheet.save(OUT, quality=88)


if __name__ == "__main__":
    main()
