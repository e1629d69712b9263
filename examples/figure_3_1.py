"""Parke's figure 3.1 for our head: what changes each part, and how; as in his, an asterisk marks interpolation."""

# mien: docs = picture, test = compare
import sys
import textwrap
from dataclasses import replace

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from plates import plate_scene

import mien
from mien.faces.head.order import MECHANISMS, nodes, titles_by_mechanism

GROUND, LINE, INK = (48, 48, 48, 255), (104, 104, 104, 255), (244, 242, 238, 255)
COLORS = dict(zip(MECHANISMS, ("#f0c674", "#8abeb7", "#9cc3e6", "#e39a82", "#c9b0dc", "#b9c98a"), strict=True))
WIDTH, MARGIN, LINE_PX, INDENT, LETTERS = 1360, 40, 21, 46, 100
HEAD_PX = (500, 560)

Node = tuple[str, ...]


def main(out: str = "figure_3_1.jpg") -> None:
    lines = [line for node in nodes() for line in lines_of(node)]
    sheet = Image.new("RGBA", (WIDTH, 2 * MARGIN + LINE_PX * len(lines)), GROUND)
    view = plate_scene(HEAD_PX, 24, 0.95, -0.03)
    for top, scene in ((0.08, replace(view, subdivide=0, shading="wire")), (0.55, view)):
        head = mien.draw("head:parke1974", scene=scene)
        sheet.paste(Image.fromarray(head.pixels).convert("L"), (WIDTH - HEAD_PX[0], int(top * sheet.height)))
    draw_tree(ImageDraw.Draw(sheet), lines)
    mien.Picture(np.asarray(sheet)).write(out)


def lines_of(node: Node) -> list[tuple[Node, str, str]]:
    """The name of a part, then what changes it, by mechanism."""
    lines = [(node, "", node[-1])]
    for mechanism, titles in titles_by_mechanism(node).items():
        lines += [(node, mechanism, text) for text in textwrap.wrap("   ".join(titles), LETTERS)]
    return lines


def draw_tree(pen: ImageDraw.ImageDraw, lines: list[tuple[Node, str, str]]) -> None:
    font, large = ImageFont.load_default(14), ImageFont.load_default(18)
    heights: dict[Node, int] = {}
    for number, (node, mechanism, text) in enumerate(lines):
        x, y = MARGIN + INDENT * (len(node) - 1), MARGIN + LINE_PX * number
        if mechanism:
            pen.text((x + 16, y), text, fill=COLORS[mechanism], font=font)
            continue
        heights[node] = y + 11
        pen.text((x, y - 2), text, fill=INK, font=large)
        if len(node) > 1:
            left, above = x - INDENT + 6, heights[node[:-1]] + 14
            pen.line([(left, above), (left, y + 11), (x - 6, y + 11)], fill=LINE, width=2)
    for number, mechanism in enumerate(MECHANISMS):
        pen.text((WIDTH - 460 + 160 * (number % 3), MARGIN + 26 * (number // 3)), mechanism, COLORS[mechanism], font)


if __name__ == "__main__":
    main(*sys.argv[1:])
