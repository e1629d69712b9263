"""Contact sheets: pictures side by side, with labels."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mien.core import MienError

from .picture import Picture

LABEL_PX = 22
PAPER, INK = (250, 249, 247, 255), (40, 38, 36, 255)


def contact_sheet(pictures: Sequence[Picture], columns: int, labels: Sequence[str] = ()) -> Picture:
    """Pictures of one size in rows of ``columns``, each with its label beneath.

    Raises:
        MienError: there are no pictures, they differ in size, or there is not one label a picture.
    """
    from PIL import Image, ImageDraw, ImageFont

    if not pictures or columns < 1:
        raise MienError(f"a contact sheet of {len(pictures)} pictures in {columns} columns: want at least one of each")
    sizes = {picture.size_px for picture in pictures}
    if len(sizes) > 1:
        raise MienError(f"pictures of a contact sheet must be of one size, got {sorted(sizes)}")
    if labels and len(labels) != len(pictures):
        raise MienError(f"{len(labels)} labels for {len(pictures)} pictures: want one each, or none")
    width, height = pictures[0].size_px
    cell = height + (LABEL_PX if labels else 0)
    columns = min(columns, len(pictures))
    rows = -(-len(pictures) // columns)
    sheet = Image.new("RGBA", (columns * width, rows * cell), PAPER)
    pen = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(13)
    for number, picture in enumerate(pictures):
        row, column = divmod(number, columns)
        sheet.paste(Image.fromarray(picture.pixels), (column * width, row * cell))
        if labels:
            middle = (column * width + width // 2, row * cell + height + LABEL_PX // 2)
            pen.text(middle, labels[number], fill=INK, font=font, anchor="mm")
    return Picture(np.asarray(sheet), pictures[0].notes)
