"""Pages that are built from the code are up to date."""

from pathlib import Path

import pytest

from mien.live import Motion, standard_motions
from mien.live.motions import Key
from support import load_tool

ROOT = Path(__file__).parents[2]
PAGES = ("parameters", "structure", "gallery", "toon_format", "messages", "motions")


@pytest.mark.parametrize("tool", PAGES)
def test_page_is_what_its_tool_makes(tool):
    page = ROOT / "docs" / f"{tool.replace('_', '-')}.md"
    assert page.read_text(encoding="utf-8") == load_tool(tool).page(), f"run python tools/{tool}.py"


def test_every_motion_has_its_filmstrip_and_none_is_left_over():
    pictures = sorted((ROOT / "docs/motions").iterdir())
    assert {picture.name for picture in pictures} == {f"{name}.png" for name in standard_motions()}
    assert sum(picture.stat().st_size for picture in pictures) <= 2_500_000


def test_a_filmstrip_shows_the_keys_and_halves_the_longest_ways():
    moments = load_tool("motions").moments
    few = Motion("few", "", (Key(400, {"AU12": 1}), Key(1000, {})))
    many = Motion("many", "", (*(Key(100 * time, {"AU12": 1}) for time in (1, 2, 4, 5, 7, 9)), Key(1200, {})))
    assert moments(few, 2) == [400, 700]
    assert moments(many, 5) == [200, 400, 500, 700, 900]
