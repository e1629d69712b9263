"""Contact sheets: pictures side by side, with labels; on a labelled page, under headings."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError

from .picture import Picture

LABEL_PX = 22
PAPER, INK, GREY, RULE = (250, 249, 247, 255), (40, 38, 36, 255), (128, 122, 116, 255), (208, 203, 196, 255)

LONGEST_PX = 16384
"""Longest side of a page, as of any picture."""

PAGE_SHAPE = math.sqrt(2.0)
"""Of the longer side to the shorter one, as of a sheet of paper; the number of columns follows from it."""

MOST_COLUMNS = 24


def contact_sheet(pictures: Sequence[Picture], columns: int, labels: Sequence[str] = ()) -> Picture:
    """Pictures of one size in rows of ``columns``, each with its label beneath.

    Raises:
        MienError: there are no pictures, they differ in size, or there is not one label a picture.
    """
    from PIL import Image, ImageDraw

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
    for number, picture in enumerate(pictures):
        row, column = divmod(number, columns)
        sheet.paste(Image.fromarray(picture.pixels), (column * width, row * cell))
        if labels:
            middle = (column * width + width // 2, row * cell + height + LABEL_PX // 2)
            pen.text(middle, labels[number], fill=INK, font=_font(13), anchor="mm")
    return Picture(np.asarray(sheet), pictures[0].notes)


@dataclass(frozen=True)
class Block:
    """Pictures that belong together, side by side, with a name above.

    Attributes:
        name: what they show.
        remark: what follows the name in grey: a unit.
        pictures: numbers of pictures.
        captions: what stands under each.
    """

    name: str
    remark: str
    pictures: tuple[int, ...]
    captions: tuple[str, ...]


@dataclass(frozen=True)
class Section:
    """Blocks under a heading; without one when it is empty."""

    heading: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Page:
    """What is on a labelled sheet: a title, a remark at its right, sections."""

    title: str
    remark: str
    sections: tuple[Section, ...]


def check_page(page: Page, size_px: tuple[int, int]) -> tuple[int, int]:
    """(width, height) in pixels of a page with pictures of that size.

    Raises:
        MienError: it holds nothing, or would be larger than a picture may be.
    """
    if not any(section.blocks for section in page.sections):
        raise MienError(f"{page.title}: there is nothing to show on a sheet")
    setting = _set_page(page, size_px)
    longest = max(setting.width, setting.height)
    if longest > LONGEST_PX:
        fitting = int(min(size_px) * LONGEST_PX / longest)
        raise MienError(
            f"a sheet of {page.title} with pictures of {size_px[0]}x{size_px[1]} would be "
            f"{setting.width}x{setting.height} pixels, at most {LONGEST_PX} a side can be had — try --size {fitting}"
        )
    return setting.width, setting.height


def set_sheet(
    page: Page, size_px: tuple[int, int], picture: Callable[[int], NDArray[np.uint8]], notes: Mapping[str, str]
) -> Picture:
    """The page as a picture.

    Args:
        page: what is on it.
        size_px: size of its pictures.
        picture: (H, W, 4) sRGB pixels of a picture by its number; asked once for each.
        notes: text that goes into the file.

    Raises:
        MienError: as ``check_page``.
    """
    from PIL import Image, ImageDraw

    check_page(page, size_px)
    setting = _set_page(page, size_px)
    sheet = Image.new("RGBA", (setting.width, setting.height), PAPER)
    places: dict[int, list[tuple[int, int]]] = {}
    for number, x, y in setting.pictures:
        places.setdefault(number, []).append((x, y))
    for number in sorted(places):
        image = Image.fromarray(picture(number))
        for place in places[number]:
            sheet.paste(image, place, image)
    pen = ImageDraw.Draw(sheet)
    for x, y, end in setting.rules:
        pen.line((x, y, end, y), fill=RULE, width=setting.rule_px)
    for x, y, text, font_px, fill, anchor in setting.texts:
        pen.text((x, y), text, fill=fill, font=_font(font_px), anchor=anchor)
    return Picture(np.asarray(sheet), notes)


class _Setting:
    """Where everything on a page goes, for one number of columns; all measures follow the size of the pictures."""

    def __init__(self, page: Page, size_px: tuple[int, int], columns: int) -> None:
        self.cell, self.picture_height = size_px
        unit = math.sqrt(size_px[0] * size_px[1])
        self.gap, self.gutter, self.margin = (max(2, round(unit * k)) for k in (0.012, 0.14, 0.4))
        self.content = columns * (self.cell + self.gutter) - self.gutter
        self.width = 2 * self.margin + self.content
        self.text_px, self.heading_px = max(9, round(unit * 0.056)), max(12, round(unit * 0.09))
        self.title_px = max(18, round(0.083 * math.sqrt(self.width * unit)))
        self.rule_px = max(1, round(unit / 256))
        self.line = round(self.text_px * 1.35)
        self.pictures: list[tuple[int, int, int]] = []
        self.rules: list[tuple[int, int, int]] = []
        self.texts: list[tuple[int, int, str, int, tuple[int, ...], str]] = []
        self.height = self._set(page)

    @property
    def badness(self) -> float:
        """How far the shape is from that of a sheet of paper, upright or on its side, and how much of it is empty."""
        shown = len(self.pictures) * self.cell * self.picture_height / (self.width * self.height)
        return abs(abs(math.log(self.width / self.height)) - math.log(PAGE_SHAPE)) - 2.0 * shown

    def _set(self, page: Page) -> int:
        y = self.margin + self.title_px
        aside = _width(page.remark, self.heading_px) + self.gutter
        beside = _width(page.title, self.title_px) + aside <= self.content
        title = _shorten(page.title, self.content, self.title_px)
        self.texts.append((self.margin, y, title, self.title_px, INK, "ls"))
        if beside:
            self.texts.append((self.margin + self.content, y, page.remark, self.heading_px, GREY, "rs"))
        else:
            y += 2 * self.heading_px
            remark = _shorten(page.remark, self.content, self.heading_px)
            self.texts.append((self.margin, y, remark, self.heading_px, GREY, "ls"))
        y += self.gutter
        for band in self._bands(page.sections):
            y += self._set_band(band, y)
        return y + self.margin - self.gutter

    def _bands(self, sections: Sequence[Section]) -> Iterator[list[Section]]:
        """Sections that follow one another; short ones stand side by side."""
        band: list[Section] = []
        for section in sections:
            if band and self._span([block for each in (*band, section) for block in each.blocks]) > self.content:
                yield band
                band = []
            band.append(section)
        if band:
            yield band

    def _span(self, blocks: Sequence[Block]) -> int:
        """Width of blocks side by side."""
        return (
            sum(len(block.pictures) * (self.cell + self.gap) - self.gap + self.gutter for block in blocks) - self.gutter
        )

    def _set_band(self, band: Sequence[Section], y: int) -> int:
        """Height of sections side by side that begin at y."""
        x, most, headed = self.margin, 0, any(section.heading for section in band)
        for section in band:
            rows = list(self._rows(section.blocks))
            end = self.margin + self.content if section is band[-1] else x + self._span(section.blocks)
            below = y + self.gutter // 2
            self.rules.append((x, below, end))
            below += self.gutter // 2
            if headed:
                below += self.heading_px
                self.texts.append((x, below, section.heading, self.heading_px, INK, "ls"))
                below += self.heading_px
            for row in rows:
                below += self._set_row(row, x, below)
            x += self._span(section.blocks) + self.gutter
            most = max(most, below - y)
        return most

    def _rows(self, blocks: Sequence[Block]) -> Iterator[list[Block]]:
        row: list[Block] = []
        for block in blocks:
            if row and self._span([*row, block]) > self.content:
                yield row
                row = []
            row.append(block)
        yield row

    def _set_row(self, row: Sequence[Block], x: int, y: int) -> int:
        """Height of a row of blocks that begins at x and y."""
        below = y + self.text_px + self.line // 2
        most = 0
        for block in row:
            width = self._span([block])
            name = _shorten(block.name, width, self.text_px)
            self.texts.append((x, y + self.text_px, name, self.text_px, INK, "ls"))
            aside = _width(f"{name} ", self.text_px) + self.text_px // 3
            if aside + _width(block.remark, self.text_px) <= width:
                self.texts.append((x + aside, y + self.text_px, block.remark, self.text_px, GREY, "ls"))
            for number, caption in zip(block.pictures, block.captions, strict=True):
                self.pictures.append((number, x, below))
                lines = _wrap(caption, self.cell, self.text_px)
                for k, text in enumerate(lines, start=1):
                    place = below + self.picture_height + k * self.line
                    self.texts.append((x, place, text, self.text_px, GREY, "ls"))
                most = max(most, len(lines))
                x += self.cell + self.gap
            x += self.gutter - self.gap
        return below - y + self.picture_height + most * self.line + self.gutter


def _set_page(page: Page, size_px: tuple[int, int]) -> _Setting:
    """The best setting of all numbers of columns."""
    blocks = [block for section in page.sections for block in section.blocks]
    widest, most = max(len(block.pictures) for block in blocks), sum(len(block.pictures) for block in blocks)
    numbers = range(widest, max(widest, min(most, MOST_COLUMNS)) + 1)
    return min((_Setting(page, size_px, columns) for columns in numbers), key=lambda setting: setting.badness)


@cache
def _font(size_px: int) -> Any:
    from PIL import ImageFont

    return ImageFont.load_default(size_px)


def _width(text: str, size_px: int) -> int:
    """Pixels from the beginning of a line of text to its end."""
    return math.ceil(_font(size_px).getlength(text))


def _shorten(text: str, width: int, size_px: int) -> str:
    """As much of the text as fits into that width, with dots where the rest was."""
    if _width(text, size_px) <= width:
        return text
    kept = next((k for k in range(len(text) - 1, 0, -1) if _width(f"{text[:k]}…", size_px) <= width), 0)
    return f"{text[:kept]}…"


def _wrap(text: str, width: int, size_px: int) -> list[str]:
    """The text in lines that are no wider than that."""
    lines: list[str] = []
    for word in text.split():
        if lines and _width(f"{lines[-1]} {word}", size_px) <= width:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return [_shorten(line, width, size_px) for line in lines]
