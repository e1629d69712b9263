"""What a shape of a drawing could be, judged by itself or beside another."""

from __future__ import annotations

from .toon_from_svg_lenses import fit_lens
from .toon_from_svg_pieces import Box, Piece, area, luminance

FACE_SHARE = 0.12
"""Of the canvas that a shape covers at least to be taken for the face."""

LIGHT = 0.62
"""Luminance above which a shape may be the white of an eye or teeth."""

THIN = 0.2
"""A mouth is drawn shut where its height is less than this share of its width."""

ARCH = 0.5
"""Share of its box that an eye fills at most to be taken for the line of a smiling one."""

FLAT = 0.01
"""Area of a shape without height, as a share of the square of its width."""


def is_flat(piece: Piece) -> bool:
    """Whether a shape has no height to speak of, as the opening of a shut mouth."""
    return not piece.stroked and abs(area(piece.points)) < FLAT * piece.box.width**2


def is_thin(piece: Piece) -> bool:
    """Whether a shape is so narrow that it stands for the line between lips."""
    if piece.stroked or is_flat(piece) or luminance(piece.shape.color) > LIGHT:
        return False
    lens = fit_lens(piece.contours, closed=True)
    return lens.opening < THIN * lens.box.width


def is_arch(piece: Piece) -> bool:
    """Whether a filled shape is a curved line, as of eyes that smile."""
    wide = piece.box.width > 1.1 * piece.box.height
    return not piece.stroked and wide and area(piece.points) < ARCH * piece.box.area


def could_be_head(piece: Piece, size: tuple[float, float]) -> bool:
    """Whether a shape is large, closed and not much wider or higher than a head."""
    box = piece.box
    closed = not piece.stroked or piece.ring
    return closed and box.area > FACE_SHARE * size[0] * size[1] and 0.5 < box.width / max(box.height, 1e-6) < 2.0


def box_size(piece: Piece) -> float:
    """Of the box that it lies in."""
    return piece.box.area


def same(one: Box, other: Box) -> bool:
    """Whether two boxes are the same, nearly."""
    return one.grown(0.02 * one.width).holds(other) and other.grown(0.02 * one.width).holds(one)


def close(one: Box, other: Box) -> bool:
    """Whether two shapes are nearly as large, and in the same place."""
    margin = 0.2 * max(one.width, one.height)
    return one.grown(margin).holds(other) and other.grown(margin).holds(one)


def within(piece: Piece, outer: Piece) -> bool:
    """Whether a piece lies in another, which its stroke makes larger."""
    return outer.box.grown(outer.shape.width / 2.0 + 0.02 * outer.box.width + 0.5).holds(piece.box)


def inside(pair: tuple[Piece, Piece], other: tuple[Piece, Piece]) -> bool:
    """Whether a pair lies within another; of two in the same place the first counts."""
    if pair is other or not within(pair[0], other[0]):
        return False
    return (
        not within(other[0], pair[0])
        or other[0].shape.line < pair[0].shape.line
        or (other[0].shape.line == pair[0].shape.line and pair[0].stroked and not other[0].stroked)
    )


def lighter(one: Piece, other: Piece) -> bool:
    """Whether a piece is clearly lighter than another."""
    return luminance(one.shape.color) > luminance(other.shape.color) + 0.15
