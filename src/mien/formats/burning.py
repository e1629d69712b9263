"""Subtitles burned into pictures: white letters with a dark edge, at the foot of the part that every screen shows.

The letters are those that Pillow brings along (Aileron), so that no font of the system decides about a pixel.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError, RangeError

from .subtitles import GUIDE, Subtitle

if TYPE_CHECKING:
    from PIL import Image

Pixels = NDArray[np.uint8]

SAFE = 0.05
"""Share of the picture at each edge that is left free. Source: SMPTE ST 2046-1, safe title area; EBU R 95."""

LINE_SHARE = 0.08
"""Height of a line, as a share of the picture's, at most. Source: BBC, Subtitle Guidelines, presentation."""

LINE_EM, CHARACTER_EM = 1.25, 0.5
"""From line to line, and of a character of English text with room to spare, in sizes of the letters."""

EDGE_EM, BOLD_EM = 0.09, 0.012
"""Of the dark edge around the letters, and what they are thickened by, for they are drawn as light ones."""

WHITE, DARK = (255, 255, 255, 255), (0, 0, 0, 255)

LEAST_SIZE_PX = 8.0
"""Smaller letters cannot be read."""

LETTERS = frozenset(map(chr, range(32, 127))) | frozenset("©«°±´·»‘’“”…‹›⁄™")
"""Characters that the letters have."""

STANDINS: Mapping[str, str] = {
    **dict.fromkeys("‐‑‒–—―−", "-"),
    **dict.fromkeys("‚‛′", "’"),
    **dict.fromkeys("„‟″", "”"),
    **{"ß": "ss", "ẞ": "SS", "æ": "ae", "Æ": "AE", "œ": "oe", "Œ": "OE", "ø": "o", "Ø": "O", "đ": "d", "Đ": "D"},
    **{"ł": "l", "Ł": "L", "ı": "i", "ð": "d", "Ð": "D", "þ": "th", "Þ": "Th", "¿": "", "¡": ""},
    **{"€": "EUR", "£": "GBP ", "¥": "JPY ", "¢": "c", "×": "x", "÷": "/", "•": "·"},
}
"""What is written for characters that the letters lack; accents are left out by a rule of their own."""


@dataclass(frozen=True)
class _Letters:
    """Letters ready to be laid over a picture: places (N,) of the pixels that they touch, and these as one row."""

    places: NDArray[np.int64]
    row: Image.Image


class Burner:
    """Lays the subtitles of one film over its frames, one after another."""

    def __init__(self, subtitles: Sequence[Subtitle], size_px: tuple[int, int]) -> None:
        """Raises MienError where a subtitle has letters that cannot be drawn, RangeError for too small a picture."""
        check_size(size_px)
        check_letters(line for subtitle in subtitles for line in subtitle.lines)
        self._subtitles, self._size_px = subtitles, size_px
        self._number = 0
        self._letters: _Letters | None = None

    def at(self, time_s: float) -> int | None:
        """Number of the subtitle that is seen at a time; times are asked for in rising order."""
        while self._number < len(self._subtitles) and self._subtitles[self._number].end_s <= time_s:
            self._number, self._letters = self._number + 1, None
        if self._number < len(self._subtitles) and self._subtitles[self._number].start_s <= time_s:
            return self._number
        return None

    def burn(self, pixels: Pixels) -> None:
        """Draws the subtitle that was asked for last into a picture (H, W, 4) sRGB, straight alpha."""
        from PIL import Image

        if self._letters is None:
            self._letters = _draw(self._subtitles[self._number].lines, self._size_px)
        places, flat = self._letters.places, _whole(pixels).reshape(-1)
        under = Image.fromarray(flat[None, places].view(np.uint8).reshape(1, -1, 4))
        flat[places] = _whole(np.array(Image.alpha_composite(under, self._letters.row)))[0, :, 0]


def check_size(size_px: tuple[int, int]) -> None:
    """Makes sure that subtitles in a picture of this size can be read.

    Raises:
        RangeError: they cannot.
    """
    if _size(size_px) < LEAST_SIZE_PX:
        width = round(LEAST_SIZE_PX * GUIDE.line_length * CHARACTER_EM / (1.0 - 2.0 * SAFE) + 0.5)
        height = round(LEAST_SIZE_PX * LINE_EM / LINE_SHARE + 0.5)
        raise RangeError(
            f"subtitles in a picture of {size_px[0]}x{size_px[1]} pixels could not be read — give at least "
            f"--size {width}x{height}, or write them beside it: --subtitles FILE.srt"
        )


def check_letters(texts: Iterable[str]) -> None:
    """Makes sure that texts can be drawn; marks and pictures that the letters lack are left out, no letter or digit is.

    Raises:
        MienError: a letter or digit is lacking.
    """
    missing = sorted({character for text in texts for character in text if _standin(character) is None})
    if missing:
        raise MienError(
            f"burned subtitles: there are no letters for {' '.join(missing[:8])}{' …' if len(missing) > 8 else ''} — "
            "write them beside the film instead, where the player has them: --subtitles FILE.srt"
        )


@cache
def _standin(character: str) -> str | None:
    """What is drawn for a character; None when it says something and there is nothing for it."""
    if character in LETTERS:
        return character
    if character in STANDINS:
        return STANDINS[character]
    plain = "".join(part for part in unicodedata.normalize("NFKD", character) if unicodedata.category(part)[0] != "M")
    if plain != character:
        parts = [_standin(part) for part in plain]
        return None if None in parts else "".join(map(str, parts))
    return None if unicodedata.category(character)[0] in "LN" else ""


def _size(size_px: tuple[int, int]) -> float:
    """Size of the letters, pixels: a full line fits between the safe edges, and no line is too tall."""
    wide = size_px[0] * (1.0 - 2.0 * SAFE) / (GUIDE.line_length * CHARACTER_EM)
    return min(wide, size_px[1] * LINE_SHARE / LINE_EM)


def _draw(lines: Sequence[str], size_px: tuple[int, int]) -> _Letters:
    """The lines, centred, the last one on the safe edge; letters shrink where a line is wider than usual."""
    from PIL import Image, ImageDraw

    width, height = size_px
    texts = [" ".join("".join(_standin(character) or "" for character in line).split()) for line in lines]
    size = _size(size_px)
    # Widths are whole pixels a letter, so they do not shrink quite as the size does.
    while (share := width * (1.0 - 2.0 * SAFE) / _widest(texts, size)) < 1.0:
        size *= min(share, 0.99)
    font, pitch, edge = _font(size), round(size * LINE_EM), max(1, round(size * EDGE_EM))
    bottom = round(height * (1.0 - SAFE))
    top = max(0, bottom - pitch * len(texts) - edge)
    image = Image.new("RGBA", (width, min(height, bottom + edge) - top))
    pen = ImageDraw.Draw(image)
    for stroke, color in ((float(edge), DARK), (size * BOLD_EM, WHITE)):
        for number, text in enumerate(reversed(texts)):
            place = (width // 2, bottom - top - pitch * number - font.getmetrics()[1])
            pen.text(place, text, fill=color, font=font, anchor="ms", stroke_width=stroke, stroke_fill=color)
    drawn = np.asarray(image).reshape(-1, 4)
    seen = np.flatnonzero(drawn[:, 3])
    return _Letters(seen + top * width, Image.fromarray(drawn[None, seen]))


def _whole(pixels: Pixels) -> NDArray[np.uint32]:
    """(H, W, 1): the same memory, four bytes as one number, which are faster to gather."""
    return pixels.view(np.uint32)


def _widest(texts: Sequence[str], size: float) -> float:
    """Width of the widest line with its edge, pixels."""
    return max(float(_font(size).getlength(text)) for text in texts) + 2.0 * EDGE_EM * size


@cache
def _font(size: float) -> Any:
    from PIL import ImageFont

    return ImageFont.load_default(size)
