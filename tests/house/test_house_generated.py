"""Pages that are built from the code are up to date."""

import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def load(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "tools" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


PAGES = ("parameters", "structure", "gallery")


@pytest.mark.parametrize("tool", PAGES)
def test_page_is_what_its_tool_makes(tool):
    assert (ROOT / f"docs/{tool}.md").read_text(encoding="utf-8") == load(tool).page(), f"run python tools/{tool}.py"
