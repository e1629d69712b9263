"""Make the pictures of docs/gallery from examples/, and docs/gallery.md from their docstrings.

python tools/gallery.py [NAME ...]
"""

from __future__ import annotations

import ast
import importlib.util
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]
ORDER = (
    "hero",
    "three_views",
    "shading",
    "expressions",
    "presets",
    "blink",
    "jaw",
    "strip",
    "filmstrip",
    "curves",
    "mouth",
    "gaze",
    "people",
    "one_light",
)


def load(name: str):
    spec = importlib.util.spec_from_file_location(name, ROOT / "examples" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def picture(name: str) -> str:
    """File name of an example's picture: what its ``main`` would write."""
    return load(name).main.__defaults__[0]


def page() -> str:
    lines = [
        "# Gallery",
        "",
        "Every picture is the output of a program in `examples/`; `python tools/gallery.py` makes them anew,",
        "and a test compares them. None was touched up.",
        "",
    ]
    for name in ORDER:
        doc = ast.get_docstring(ast.parse((ROOT / "examples" / f"{name}.py").read_text()))
        lines += [
            f"## {name.replace('_', ' ').capitalize()}",
            "",
            doc,
            "",
            f"![{doc}](gallery/{picture(name)})",
            "",
            f"[`examples/{name}.py`](../examples/{name}.py)",
            "",
        ]
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
    for name in names or ORDER:
        start = time.perf_counter()
        load(name).main(str(ROOT / "docs/gallery" / picture(name)))
        print(f"{name}: {time.perf_counter() - start:.1f} s")
    (ROOT / "docs/gallery.md").write_text(page())


if __name__ == "__main__":
    main(sys.argv[1:])
