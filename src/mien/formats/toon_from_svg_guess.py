"""Which shapes of a drawing are which features of a face: by their names, else by where they lie.

Names tell which feature it is; which side it is on is told by where it lies: on a face that one looks at, its own
right is on the left.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from mien.core import LoadError

from .toon_from_svg_judging import (
    LIGHT,
    box_size,
    close,
    could_be_head,
    inside,
    is_arch,
    is_flat,
    is_thin,
    lighter,
    same,
    within,
)
from .toon_from_svg_pieces import Box, Piece, contrast, join, luminance

SIDES = ("R", "L")
EYE_ROLES = ("eye", "white", "pupil", "lid", "lash")
MOUTH_ROLES = ("mouth", "lip", "teeth", "tongue")

ALIKE = 0.3
"""How much the sides of two shapes may differ to be taken for a pair, as a share of the larger."""

ASIDE = 0.08
"""How far the middle of a pair, or of a mouth, may lie from that of the face, as a share of its width."""

EYES_AT, EYES_SPREAD = 0.4, 0.2
MOUTH_AT, MOUTH_SPREAD = 0.74, 0.17
"""Where eyes and mouth are looked for, as a share of the height of the face, and how far from there they may be."""

PALE = 0.4
"""What a shape that is lighter than the skin has of the score of a mouth: it may be a muzzle, or teeth."""

LIPS = 0.65
"""Share of a mouth from which a shape in it is its opening, and what is around it are lips."""

LEAST = 0.08
"""Of the score that a face as in most drawings has: what is less sure is not taken for eyes or a mouth."""


@dataclass(frozen=True, eq=False)
class Part:
    """A piece with what it is.

    Attributes:
        piece: the shape.
        role: ``face outline brow white pupil ring arc lid lash mouth mouth_ring mouth_line lip teeth tongue nose ear
            cheek hair body``, or nothing for what moves with the head only.
        side: the face's own, ``R`` or ``L``; empty for what there is once.
    """

    piece: Piece
    role: str
    side: str = ""


@dataclass(frozen=True)
class Found:
    """A face in a drawing.

    Attributes:
        parts: all pieces, in the order in which they are painted.
        face: the box of the face.
        remarks: what was decided that one may want to know.
    """

    parts: tuple[Part, ...]
    face: Box
    remarks: tuple[str, ...]

    def of(self, *roles: str, side: str = "") -> list[Part]:
        """The parts of some roles, on one side of the face or of all."""
        return [part for part in self.parts if part.role in roles and (not side or part.side == side)]


def find_face(path: Path, size: tuple[float, float], pieces: Sequence[Piece]) -> Found:
    """The features among the pieces.

    Raises:
        LoadError: there are no two eyes, or no mouth.
    """
    if not pieces:
        raise LoadError(path, "shows nothing on its canvas", hint="does its viewBox fit what is drawn?")
    search = _Search(path, size, pieces)
    search.find_eyes()
    search.find_mouth()
    search.find_rest()
    parts = tuple(Part(piece, *search.roles.get(piece, ("", ""))) for piece in pieces)
    return Found(parts, search.face, tuple(search.remarks))


class _Search:
    """What was found so far: the role and side of pieces."""

    def __init__(self, path: Path, size: tuple[float, float], pieces: Sequence[Piece]) -> None:
        self.roles: dict[Piece, tuple[str, str]] = {}
        self.remarks: list[str] = []
        self._path, self._pieces = path, pieces
        self._find_head(size)

    def _find_head(self, size: tuple[float, float]) -> None:
        """The largest shape that is called so, else the largest that could hold a face; else all there is."""
        named = [
            piece for piece in self._pieces if piece.role == "face" and min(piece.box.width, piece.box.height) > 1.0
        ]
        large = [piece for piece in self._free() if could_be_head(piece, size)]
        found = max([piece for piece in named if piece.named] or named or large, key=box_size, default=None)
        self.skin = (1.0, 1.0, 1.0, 1.0)
        if found is None:
            self.face = join(piece.box for piece in self._pieces).grown(1.0)
            return
        self.face = found.box
        for piece in self._pieces:
            if piece is found or (piece.named and piece.role == "face"):
                self.roles[piece] = ("face", "")
            elif piece.stroked and piece.role in ("", "face") and same(piece.box, found.box):
                self.roles[piece] = ("outline", "")
        if not found.stroked:
            self.skin = found.shape.color

    def _free(self) -> list[Piece]:
        """Pieces that nothing is known of yet, by name or otherwise."""
        return [
            piece
            for piece in self._pieces
            if piece not in self.roles and (not piece.role or (piece.role == "face" and not piece.named))
        ]

    def _candidates(self) -> list[Piece]:
        """Free pieces that lie in the face and are much smaller."""
        room = self.face.grown(0.02 * self.face.width)
        return [
            piece
            for piece in self._free()
            if room.holds(piece.box)
            and piece.box.width < 0.72 * self.face.width
            and piece.box.height < 0.6 * self.face.height
        ]

    def _take(self, pieces: Iterable[Piece], role: str, side: str = "") -> None:
        for piece in pieces:
            self.roles[piece] = (role, side)

    def _side(self, box: Box) -> str:
        return "R" if box.x < self.face.x else "L"

    def find_eyes(self) -> None:
        """Both eyes.

        Raises:
            LoadError: there are none, or only one.
        """
        named = [piece for piece in self._pieces if piece.role in EYE_ROLES and not self._covers_both(piece)]
        self.guessed = not named
        if named:
            sides = {side: [piece for piece in named if self._side(piece.box) == side] for side in SIDES}
            if not all(sides.values()):
                raise self._error(f"only one eye is named, line {named[0].shape.line}")
        else:
            pair = self._guess_eyes()
            if pair is None:
                raise self._error("no two shapes alike, left and right in the upper half of a face, are found")
            room = self._candidates()
            sides = {
                side: [each for each in room if within(each, piece)] for side, piece in zip(SIDES, pair, strict=True)
            }
        for side in SIDES:
            self._sort_eye(sides[side], side)

    def _covers_both(self, piece: Piece) -> bool:
        return piece.box.left < self.face.x < piece.box.right

    def _pairs(self) -> list[tuple[Piece, Piece]]:
        """Right and left one of all shapes that lie alike on both sides of the face, those inside others left out."""
        candidates = self._candidates()
        pairs = []
        for one in candidates:
            if one.box.right >= self.face.x:
                continue
            others = [other for other in candidates if other.box.left >= self.face.x and self._alike(one, other)]
            if others:
                pairs.append((one, min(others, key=lambda other: abs(other.box.y - one.box.y))))
        return [pair for pair in pairs if not any(inside(pair, other) for other in pairs)]

    def _alike(self, one: Piece, other: Piece) -> bool:
        a, b, face = one.box, other.box, self.face
        wide, high = max(a.width, b.width, 1e-6), max(a.height, b.height, 1e-6)
        return (
            one.stroked == other.stroked
            and abs(a.width - b.width) < ALIKE * wide + 0.01 * face.width
            and abs(a.height - b.height) < ALIKE * high + 0.01 * face.width
            and abs(a.y - b.y) < ASIDE * face.height
            and abs((a.x + b.x) / 2.0 - face.x) < ASIDE * face.width
            and contrast(one.shape.color, other.shape.color) < 0.2
        )

    def _guess_eyes(self) -> tuple[Piece, Piece] | None:
        scored = [(self._eye_score(pair), number, pair) for number, pair in enumerate(self._pairs())]
        best = max(scored, default=None)
        return best[2] if best is not None and best[0] > LEAST else None

    def _eye_score(self, pair: tuple[Piece, Piece]) -> float:
        """How much a pair looks like eyes: in their place, round, in strong contrast, with something in them."""
        piece = pair[0]
        inner = [each for each in self._candidates() if within(each, piece)]
        strength = max(contrast(each.shape.color, self.skin) for each in inner)
        height = (piece.box.y - self.face.top) / self.face.height
        place = math.exp(-(((height - EYES_AT) / EYES_SPREAD) ** 2))
        roundness = min(1.0, 0.35 + piece.box.height / max(piece.box.width, 1e-6))
        small = min(1.0, max(piece.box.width, piece.shape.width) / (0.06 * self.face.width))
        return strength * place * roundness * small * (1.0 if len(inner) > 1 else 0.75)

    def _sort_eye(self, pieces: list[Piece], side: str) -> None:
        """What in an eye is white, pupil, outline, lid and lashes."""
        whole = join(piece.box for piece in pieces)
        filled = [piece for piece in pieces if not piece.stroked and piece.role in ("eye", "white", "")]
        inner = [piece for piece in pieces if piece.role == "pupil"]
        open_white = [
            piece
            for piece in filled
            if piece.role == "white"
            or ((luminance(piece.shape.color) > LIGHT or inner) and piece.box.width > 0.55 * whole.width)
            or any(
                within(other, piece) and other.box.width > 0.3 * piece.box.width and lighter(piece, other)
                for other in filled
            )
        ]
        whites = [max(open_white, key=box_size)] if open_white else []
        for piece in pieces:
            if piece.role in ("lid", "lash"):
                self._take([piece], piece.role, side)
            elif piece in whites:
                self._take([piece], "white", side)
            elif not whites and is_arch(piece):
                self._take([piece], "arc", side)
            elif piece.role == "pupil" or not piece.stroked:
                self._take([piece], "pupil", side)
            elif piece.ring:
                around = max(whites, key=box_size, default=piece)
                self._take([piece], "ring" if close(piece.box, around.box) else "pupil", side)
            else:
                self._take([piece], "lash" if whites or inner or len(pieces) > 1 else "arc", side)
        if not whites and not any(self.roles[piece][0] in ("pupil", "ring", "arc") for piece in pieces):
            self._take(pieces, "arc", side)

    def find_mouth(self) -> None:
        """The mouth.

        Raises:
            LoadError: there is none.
        """
        pieces = [piece for piece in self._pieces if piece.role in MOUTH_ROLES]
        if not any(piece.role in ("mouth", "lip") for piece in pieces):
            outer = self._guess_mouth()
            if outer is None:
                raise self._error("eyes are there, but no shape or line in the middle below them")
            pieces += [piece for piece in self._candidates() if within(piece, outer)]
        self._sort_mouth(pieces)

    def _guess_mouth(self) -> Piece | None:
        low = max(self._eye_box(side).bottom for side in SIDES)
        scored = []
        for number, piece in enumerate(self._candidates()):
            if abs(piece.box.x - self.face.x) < ASIDE * self.face.width * 1.5 and piece.box.y > low:
                height = (piece.box.y - self.face.top) / self.face.height
                place = math.exp(-(((height - MOUTH_AT) / MOUTH_SPREAD) ** 2))
                strength = contrast(piece.shape.color, self.skin)
                if not piece.stroked and luminance(piece.shape.color) > max(LIGHT, luminance(self.skin)):
                    strength *= PALE
                wide = min(1.0, piece.box.width / (0.3 * self.face.width))
                scored.append((strength * place * wide, piece.box.area, -number, piece))
        best = max(scored, default=None, key=lambda each: (round(each[0], 2), *each[1:3]))
        if best is None or best[0] < LEAST:
            return None
        # A light shape around a line is a muzzle, one around a dark shape may be the lips.
        line = best[3].stroked and not best[3].ring
        outer = [each[3] for each in scored if within(best[3], each[3]) and each[0] > LEAST]
        holding = [piece for piece in outer if not line or piece is best[3] or luminance(piece.shape.color) < LIGHT]
        return max(holding, key=box_size)

    def _eye_box(self, side: str) -> Box:
        return join(
            piece.box.grown(piece.shape.width / 2.0)
            for piece, (role, at) in self.roles.items()
            if at == side and role in ("white", "pupil", "ring", "arc", "lid", "lash")
        )

    def _sort_mouth(self, pieces: list[Piece]) -> None:
        """What is the opening, its outline or line, lips, teeth and tongue."""
        for piece in pieces:
            if piece.role in ("teeth", "tongue"):
                self._take([piece], piece.role)
            elif piece.role == "lip":
                self._take([piece], "lip")
        rest = [piece for piece in pieces if piece not in self.roles]
        lines = [piece for piece in rest if is_thin(piece)]
        # With what is between shut lips, or alone, narrow shapes are the lips; with teeth in it one is an opening.
        if len(lines) == len(pieces) or any(map(is_flat, rest)):
            self._take(lines, "mouth_line")
        rest = [piece for piece in rest if piece not in self.roles]
        filled = sorted((piece for piece in rest if not piece.stroked), key=box_size, reverse=True)
        if filled:
            base = filled[0]
            self._take([base], "mouth")
            for piece in filled[1:]:
                if close(piece.box, base.box) and box_size(piece) > LIPS * box_size(base):
                    self._take([piece], "mouth_ring")
                    continue
                upper = piece.box.y < base.box.y
                self._take([piece], "teeth" if luminance(piece.shape.color) > LIGHT or upper else "tongue")
        for piece in rest:
            if piece.stroked:
                ringed = bool(filled) and not is_flat(filled[0]) and close(piece.box, filled[0].box)
                self._take([piece], "mouth_ring" if piece.ring or ringed else "mouth_line")

    def find_rest(self) -> None:
        """Brows, nose, ears and cheeks; without names only beside eyes that have none either."""
        ears = {self._side(piece.box) for piece in self._pieces if piece.role == "ear" and not self._covers_both(piece)}
        for piece in self._pieces:
            if piece in self.roles:
                continue
            if piece.role in ("brow", "ear", "cheek"):
                single = self._covers_both(piece) or (piece.role == "ear" and len(ears) == 1)
                self._take([piece], "" if single else piece.role, "" if single else self._side(piece.box))
            elif piece.role in ("nose", "hair", "body"):
                self._take([piece], piece.role)
        if self.guessed:
            self._guess_brows_and_cheeks()
            self._guess_nose()

    def _guess_brows_and_cheeks(self) -> None:
        eyes = {side: self._eye_box(side) for side in SIDES}
        taken = any(role == "brow" for role, _ in self.roles.values())
        for pair in sorted(self._pairs(), key=lambda pair: -pair[0].box.y):
            box, eye = pair[0].box, eyes["R"]
            beside = abs(box.x - eye.x) < max(eye.width, box.width)
            if box.y < eye.y and box.bottom < eye.y and beside and box.width > 1.2 * box.height and not taken:
                role, taken = "brow", True
            elif box.y > eye.y and box.x < eye.x + 0.5 * eye.width and not pair[0].stroked:
                role = "cheek"
            else:
                continue
            for piece in pair:
                self._take([piece], role, self._side(piece.box))

    def _guess_nose(self) -> None:
        high = min(self._eye_box(side).y for side in SIDES)
        low = min(piece.box.top for piece, (role, _) in self.roles.items() if role.startswith(("mouth", "lip")))
        for piece in self._candidates():
            beside = abs(piece.box.x - self.face.x) < 2.0 * ASIDE * self.face.width
            if beside and high < piece.box.y < low and piece.box.width < 0.3 * self.face.width:
                self._take([piece], "nose")

    def _error(self, why: str) -> LoadError:
        return LoadError(
            self._path,
            f"no face is found: {why}",
            hint="name layers or ids after features (eye_right, eye_left, pupil, mouth, brow, nose, ear, head), "
            "or draw two eyes and, below them, a mouth",
        )
