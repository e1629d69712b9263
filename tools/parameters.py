"""Build docs/parameters.md from the tables of the faces.

python tools/parameters.py
"""

from __future__ import annotations

from pathlib import Path

import mien

HEADER = "| name | from | rest | to | unit | meaning | source |"
PLACE = Path(__file__).parents[1] / "docs/parameters.md"


def page() -> str:
    face = mien.load_face("head")
    lines = [
        "# Parameters of the head",
        "",
        "Made by `python tools/parameters.py` from the table itself; `mien params head` prints the same. Left and",
        "right are the face's own. A name without its side sets both. One Parke unit is 0.16 mm (decision 0006).",
    ]
    for group, rows in face.parameters.groups().items():
        lines += [
            "",
            f"## {group.capitalize()}",
            "",
            "| name | from | rest | to | unit | meaning | source |",
            "|---|---|---|---|---|---|---|",
        ]
        for row in rows:
            if row.name.endswith(".right"):
                continue
            name, doc = f"`{row.name}`", row.doc
            if row.name.endswith(".left"):
                name = f"`{row.name.removesuffix('.left')}` .left .right"
                doc = doc.replace(" left ", " ")
            lines.append(
                f"| {name} | {row.low:g} | {row.default:g} | {row.high:g} | {row.unit} | {doc} | {row.source} |"
            )
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PLACE.write_text(page(), encoding="utf-8")
