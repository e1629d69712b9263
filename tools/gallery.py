"""Make the pictures of docs/gallery from examples/, and docs/gallery.md from their docstrings.

python tools/gallery.py [NAME ...]
"""

from __future__ import annotations

import ast
import importlib.util
import re
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"
SECTIONS = {
    "Faces": ("hero", "three_views", "people", "strangers", "shading"),
    "Expression": ("expressions", "presets", "mouth", "gaze", "caricature"),
    "Motion": ("blink", "jaw", "strip", "filmstrip", "curves"),
    "Measured faces": ("measured",),
    "Drawn faces": (
        "toons",
        "toon_presets",
        "toon_mouths",
        "toon_strip",
        "toon_turns",
        "toon_solids",
        "toon_gaze",
        "toon_hands",
        "toon_motors",
        "toon_from_svg",
        "toon_palettes",
    ),
    "Parke's pictures": (
        "one_light",
        "figure_1972",
        "figure_2_1",
        "figure_2_4",
        "figure_3_1",
        "figure_3_5",
        "figure_3_10",
        "figure_3_12",
        "figure_3_14",
        "figure_3_16",
    ),
}


def load(name: str):
    if str(EXAMPLES) not in sys.path:
        sys.path.insert(0, str(EXAMPLES))
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def heading(name: str) -> str:
    """``figure_3_16`` becomes ``Figure 3.16``."""
    return re.sub(r"(\d)_(\d)", r"\1.\2", name).replace("_", " ").capitalize()


def picture(name: str) -> str:
    """File name of an example's picture: what its ``main`` would write."""
    return load(name).main.__defaults__[0]


def anchor(title: str) -> str:
    """What a link to a heading says."""
    return title.lower().replace(" ", "-").replace("'", "")


def entry(name: str) -> list[str]:
    """Heading, words and picture of an example."""
    doc = ast.get_docstring(ast.parse((EXAMPLES / f"{name}.py").read_text()))
    shown = f"![{doc}](gallery/{picture(name)})"
    return [f"### {heading(name)}", "", doc, "", shown, "", f"[`examples/{name}.py`](../examples/{name}.py)", ""]


def page() -> str:
    lines = [
        "# Gallery",
        "",
        "Every picture is the output of a program in `examples/`; `python tools/gallery.py` makes them anew,",
        "and a test compares them. None was touched up.",
        "",
    ]
    lines += [*(f"- [{title}](#{anchor(title)})" for title in SECTIONS), ""]
    for title, names in SECTIONS.items():
        lines += [f"## {title}", ""]
        for name in names:
            lines += entry(name)
    lines += (
        [
            "## Mended",
            "",
            (ROOT / "docs/gallery/mended.txt").read_text().strip(),
            "",
            "![before and after](gallery/mended.jpg)",
            "",
        ]
        if (ROOT / "docs/gallery/mended.txt").exists()
        else []
    )
    return "\n".join(lines)


def main(names: list[str]) -> None:
    for name in names or [name for section in SECTIONS.values() for name in section]:
        start = time.perf_counter()
        load(name).main(str(ROOT / "docs/gallery" / picture(name)))
        print(f"{name}: {time.perf_counter() - start:.1f} s")
    (ROOT / "docs/gallery.md").write_text(page())


if __name__ == "__main__":
    main(sys.argv[1:])
