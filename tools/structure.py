"""Build docs/structure.md: the parts of the head and the order in which the parameters act, from their table.

python tools/structure.py
"""

from __future__ import annotations

from itertools import groupby
from pathlib import Path

from mien.faces.head.order import acts, nodes, titles_by_mechanism

PLACE = Path(__file__).parents[1] / "docs/structure.md"
HEADER = """# How a head is made

Made by `python tools/structure.py` from `src/mien/faces/head/data/order.csv`; tests compare that file with the table of
parameters, with the rows of the shape and with the order in which the compiled functions really run.

## What changes which part

As in Parke's figure 3.1 an asterisk marks what is done by interpolation.

![the tree](gallery/figure_3_1.jpg)
"""
ORDER = """
## In which order

A step finds the points where the steps before it left them. The steps of the shape (`shape_points`) act one after the
other in the order of this list; before all else they also move and scale the centres of the eyes and the pivot of the
neck, so that eyes are aimed from where they will be. Teeth, gums and tongue take the same steps after the tongue has
moved.
"""


def page() -> str:
    lines = [HEADER, "```mermaid", "flowchart LR", *tree(), "```", ORDER, "```mermaid", "flowchart TD", *flow(), "```"]
    lines += ["", "| | function | part | how | parameters |", "|---|---|---|---|---|"]
    for number, act in enumerate(acts(), start=1):
        names = " ".join(f"`{title.removesuffix('*')}`" for title in act.titles)
        lines.append(f"| {number} | `{act.function}` | {act.node[-1]} | {act.mechanism} | {names} |")
    return "\n".join(lines) + "\n"


def tree() -> list[str]:
    """Lines of a Mermaid chart: a box for each part, with what changes it."""
    lines = []
    for node in nodes():
        texts = [f"{how}: {', '.join(titles)}" for how, titles in titles_by_mechanism(node).items()]
        lines.append(f'    {node[-1]}["{"<br>".join((f"<b>{node[-1]}</b>", *texts))}"]')
        if len(node) > 1:
            lines.append(f"    {node[-2]} --> {node[-1]}")
    return lines


def flow() -> list[str]:
    """Lines of a Mermaid chart: one function after the other."""
    lines, before = [], ""
    for function, together in groupby(acts(), key=lambda act: act.function):
        text = "<br>".join(dict.fromkeys(f"{act.node[-1]}: {act.mechanism}" for act in together))
        lines.append(f'    {function}["<b>{function}</b><br>{text}"]')
        if before:
            lines.append(f"    {before} --> {function}")
        before = function
    return lines


if __name__ == "__main__":
    PLACE.write_text(page(), encoding="utf-8")
