"""Pages that are built from the code are up to date."""

from pathlib import Path

import pytest

from support import load_tool

ROOT = Path(__file__).parents[2]
PAGES = ("parameters", "structure", "gallery", "toon_format", "messages")


@pytest.mark.parametrize("tool", PAGES)
def test_page_is_what_its_tool_makes(tool):
    page = ROOT / "docs" / f"{tool.replace('_', '-')}.md"
    assert page.read_text(encoding="utf-8") == load_tool(tool).page(), f"run python tools/{tool}.py"
