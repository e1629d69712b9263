"""The page about a solution in a real browser: it draws the points, sorts, and asks nobody for anything."""

from __future__ import annotations

import shutil

import pytest

from mien.capture.report import write_report
from mien.capture.simulating import Setup, cube, simulate
from mien.capture.solving import solve

sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed (extras: test)")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(CHROMIUM is None, reason="Debian's chromium is not installed (apt install chromium)"),
]


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    survey = simulate(Setup(references=cube(), points=12, views=3), 1).survey
    out = tmp_path_factory.mktemp("report") / "report.html"
    write_report(solve(survey), out, name="anna")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        page.complaints, page.requests = [], []
        page.on("console", lambda message: page.complaints.append(message.text))
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        page.on("request", lambda request: page.requests.append(request.url))
        page.goto(out.as_uri())
        yield page
        browser.close()


def test_nothing_is_asked_for_and_nothing_goes_wrong(page):
    assert page.complaints == []
    assert len(page.requests) == 1


def test_page_is_as_wide_as_the_window(page):
    assert page.evaluate("document.documentElement.scrollWidth") <= 1280


def test_points_are_sorted_by_number_both_ways(page):
    table = page.locator("table.sortable").last.evaluate_handle("_ => [...document.querySelectorAll('table')].at(-2)")
    read = "table => [...table.tBodies[0].rows].map(row => Number(row.cells[2].dataset.key))"
    press = "table => table.tHead.rows[0].cells[2].querySelector('button').click()"
    table.evaluate(press)
    rising = table.evaluate(read)
    assert len(rising) == 12
    assert rising == sorted(rising)
    table.evaluate(press)
    assert table.evaluate(read) == sorted(rising, reverse=True)


def test_points_in_space_turn_with_the_arrow_keys(page):
    canvas = page.locator("canvas")
    assert canvas.is_visible()
    before = canvas.evaluate("canvas => canvas.toDataURL()")
    canvas.press("ArrowLeft")
    after = canvas.evaluate("canvas => canvas.toDataURL()")
    assert after != before
    canvas.press("ArrowRight")
    assert canvas.evaluate("canvas => canvas.toDataURL()") == before
