"""Small passes from phones to shapes; each takes pieces of time and gives pieces of time without holes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mien.core import SILENCE, Cue

from .mouth_passes import split_diphthongs
from .mouth_table import phone_table
from .shapes_table import FORMER, NEXT, ShapeTable

ROUND_EARLY_S = 0.15
"""Free lips are rounded at most this long before the sound that asks for it.

Source: Daniloff and Moll 1968, Coarticulation of lip rounding, Journal of Speech and Hearing Research 11: it begins
several consonants early. The length is our choice.
"""

LEAST_HELD_S = 0.055
"""Shut and tucked lips are shown this long: more than a frame at 20 fps."""

LEAST_S = 0.035
"""Another shape that is shorter is no shape that the mouth reaches."""

BEFORE_SHARE = 0.65
"""Part of a lengthening that goes before the phone: lips are shut before a plosive is heard."""

BETWEEN_SHARE = 1.0 / 3.0
BETWEEN_S = (0.03, 0.08)
"""An in-between takes a share of the shape that gives it time; none that would be shorter, none longer."""


@dataclass(frozen=True)
class Piece:
    """A shape from ``start_s`` to ``end_s``; a held one is shut or tucked lips, which other passes leave alone."""

    start_s: float
    end_s: float
    shape: str
    held: bool = False

    @property
    def length_s(self) -> float:
        """Duration in seconds."""
        return self.end_s - self.start_s


def split(phones: Sequence[Cue], table: ShapeTable) -> tuple[Cue, ...]:
    """The phones with those diphthongs as two that show two shapes."""
    out: list[Cue] = []
    for cue in phones:
        out += split_diphthongs([cue]) if table.splits(cue.symbol) else [cue]
    return tuple(out)


def choose(phones: Sequence[Cue], table: ShapeTable) -> tuple[str, ...]:
    """The shape of each phone by itself; who has none of its own shows its neighbour's."""
    shapes = [table.shape(cue.symbol, cue.length_s) for cue in phones]
    rest = table.row(SILENCE).shape
    for i in reversed(range(len(shapes))):
        if shapes[i] == NEXT:
            shapes[i] = shapes[i + 1] if i + 1 < len(shapes) else rest
    for i in range(len(shapes)):
        if shapes[i] == FORMER:
            shapes[i] = shapes[i - 1] if i else rest
    return tuple(shapes)


def round_early(phones: Sequence[Cue], shapes: Sequence[str], table: ShapeTable) -> tuple[str, ...]:
    """The shapes with free lips already round where a round phone is near."""
    out = list(shapes)
    start_s = 0.0
    for i in reversed(range(len(out) - 1)):
        wanted = table.row(phones[i].symbol).before_round
        if wanted and out[i + 1] == wanted:
            if shapes[i + 1] == wanted:
                start_s = phones[i + 1].start_s
            if start_s - phones[i].start_s <= ROUND_EARLY_S:
                out[i] = wanted
    return tuple(out)


def hold(phones: Sequence[Cue], shapes: Sequence[str]) -> tuple[Piece, ...]:
    """Pieces in which lips are held for p b m and f v; those of p and b open with the burst for the next sound.

    Where nothing follows but a pause there is no burst to be seen.
    """
    table = phone_table()
    out: list[Piece] = []
    for i, (cue, shape) in enumerate(zip(phones, shapes, strict=True)):
        row = table[cue.symbol]
        if not row.hold:
            out.append(Piece(cue.start_s, cue.end_s, shape))
            continue
        bursts = row.kind == "stop" and i + 1 < len(phones) and table[phones[i + 1].symbol].kind != "pause"
        end_s = cue.start_s + row.hold_to * cue.length_s if bursts else cue.end_s
        out.append(Piece(cue.start_s, end_s, shape, held=True))
        if bursts:
            out.append(Piece(end_s, cue.end_s, shapes[i + 1]))
    return join(out)


def lengthen(pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """The pieces with held ones long enough to be seen, at the cost of what is around them.

    Held neighbours give nothing; the first piece begins no earlier and the last ends no later.
    """
    out = list(pieces)
    for i, piece in enumerate(out):
        lack = LEAST_HELD_S - piece.length_s
        if not piece.held or lack <= 0.0:
            continue
        room = [out[k].length_s if 0 <= k < len(out) and not out[k].held else 0.0 for k in (i - 1, i + 1)]
        after = min(room[1], (1.0 - BEFORE_SHARE) * lack)
        before = min(room[0], lack - after)
        after = min(room[1], lack - before)
        out[i] = replace(piece, start_s=piece.start_s - before, end_s=piece.end_s + after)
        if before:
            out[i - 1] = replace(out[i - 1], end_s=out[i].start_s)
        if after:
            out[i + 1] = replace(out[i + 1], start_s=out[i].end_s)
    return join(out)


def drop_short(pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """The pieces without those too short to be reached; neighbours that are not held share their time.

    What parts two closures is never too short.
    """
    out = list(pieces)
    while short := [i for i in range(len(out)) if _is_droppable(out, i)]:
        i = min(short, key=lambda i: (out[i].length_s, i))
        before, piece, after = out[i - 1 : i] if i else [], out[i], out[i + 1 : i + 2]
        giving = [bool(side) and not side[0].held for side in (before, after)]
        share = {(True, False): 1.0, (False, True): 0.0}.get((giving[0], giving[1]), 0.5)
        share = share if before and after else float(bool(before))
        middle_s = piece.start_s + share * piece.length_s
        around = [replace(each, end_s=middle_s) for each in before] + [
            replace(each, start_s=middle_s) for each in after
        ]
        out = list(join([*out[: max(0, i - 1)], *around, *out[i + 2 :]]))
    return tuple(out)


def put_between(pieces: Sequence[Piece], table: ShapeTable) -> tuple[Piece, ...]:
    """The pieces with a shape on the way where two shapes are far apart; held ones give no time for it."""
    out: list[Piece] = []
    for i, piece in enumerate(pieces):
        start_s, end_s = piece.start_s, piece.end_s
        length_s = min(BETWEEN_SHARE * piece.length_s, BETWEEN_S[1])
        into = table.between.get((pieces[i - 1].shape, piece.shape)) if i else None
        away = table.between.get((piece.shape, pieces[i + 1].shape)) if i + 1 < len(pieces) else None
        if piece.held or length_s < BETWEEN_S[0]:
            into = away = None
        if into and into.within == "second":
            start_s += length_s
            out.append(Piece(piece.start_s, start_s, into.shape))
        if away and away.within == "first":
            end_s -= length_s
        out.append(replace(piece, start_s=start_s, end_s=end_s))
        if away and away.within == "first":
            out.append(Piece(end_s, piece.end_s, away.shape))
    return tuple(out)


def join(pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """The pieces without empty ones, equal neighbours made one."""
    out: list[Piece] = []
    for piece in pieces:
        if piece.length_s <= 1e-9:
            continue
        if out and out[-1].shape == piece.shape:
            out[-1] = replace(out[-1], end_s=piece.end_s, held=out[-1].held or piece.held)
        else:
            out.append(piece)
    return tuple(out)


def _is_droppable(pieces: Sequence[Piece], i: int) -> bool:
    piece = pieces[i]
    if piece.held or piece.length_s >= LEAST_S or len(pieces) == 1:
        return False
    around = [*pieces[max(0, i - 1) : i], *pieces[i + 1 : i + 2]]
    return not (len(around) == 2 and all(each.held for each in around))
