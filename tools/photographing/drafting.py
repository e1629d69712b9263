"""The topology that the dots are corners of, without what hair hides, and what is known about the points."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from mien.capture.coloring import hex_color
from mien.capture.marks import Marks
from mien.core import Material
from mien.faces.head.measured import archive
from mien.faces.keypose.records import KeyposeTopology, Polygon, SkinPart
from mien.render.pixels import to_srgb

from .halves import Half, State
from .paints import paints

HIDDEN = ("skin", "blush", "hair", "garment", "band", "nostril")
"""Drafted so, a polygon is left out if nobody ever sees a corner of it: the skull beneath hair."""
WORDS = {
    "skin": Material(gloss=0.055, subdivide=True),
    "eyes": Material(gloss=0.1),
    "caruncle": Material(gloss=0.03),
    "lash": Material(two_sided=True),
    "brow": Material(gloss=0.015),
    "teeth": Material(gloss=0.2, two_sided=True),
    "tongue": Material(gloss=0.06, subdivide=True),
    "collar": Material(gloss=0.01, two_sided=True, subdivide=True),
    "hair": Material(gloss=0.06, subdivide=True),
}
"""What the topology file says of each part."""


TOUCHES = {f"e0_{upper}": (("blink", f"e0_{12 - upper}"),) for upper in range(1, 6)}
"""Margins of the upper lid lie on those of the lower one while the eye is shut."""
BLEND = ("skin", "tongue", "collar", "hair")
"""Parts whose colours flow into one another."""


@dataclass(frozen=True, eq=False)
class Draft:
    """What is to be measured.

    Attributes:
        topology: polygons, each in the colour that it is drafted in.
        marks: names of the points, what they go along with, and where they are on the shipped head.
        kept: (N,) numbers of the points among those of the half.
    """

    topology: KeyposeTopology
    marks: Marks
    kept: np.ndarray


def drafted(half: Half, palette: str, seen: Collection[str]) -> Draft:
    """The topology of a half of which some points were ever seen."""
    colors = {label: hex_color(to_srgb(rgb[None])[0].astype(float)) for label, rgb in paints(palette).items()}
    parts, used = {}, set()
    for part, polygons in half.parts.items():
        shown = [row for row in polygons if row.label not in HIDDEN or any(name in seen for name in row.corners)]
        parts[part] = shown
        used |= {name for row in shown for name in row.corners}
    kept = np.array([number for number, name in enumerate(half.names) if name in used])
    names = [half.names[number] for number in kept]
    at = {name: number for number, name in enumerate(names, start=1)}
    skin = tuple(
        SkinPart(
            part,
            tuple(Polygon(tuple(at[name] for name in row.corners[::-1]), colors[row.label]) for row in rows),
            WORDS[part],
            part in BLEND,
        )
        for part, rows in parts.items()
    )
    midline = tuple(at[name] for name in half.midline if name in at)
    piece_of = {name: piece for piece in half.pieces for name in piece.names}
    pieces = [piece_of[name] for name in names]
    marks = Marks(
        tuple(names),
        tuple(piece.body for piece in pieces),
        tuple(tuple(name for name in piece.follows if name in at) for piece in pieces),
        half.places(_shipped())[kept],
        tuple(TOUCHES.get(name, ()) for name in names),
    )
    return Draft(KeyposeTopology(skin, midline), marks, kept)


def _shipped() -> State:
    """The head that ships, by which is guessed what nobody sees."""
    head = archive()
    surface = head.floats("surface")
    still = np.column_stack([np.eye(3), np.zeros(3)])
    return State(
        surface, head.floats("eye_centre")[0], 0.985 * float(head.floats("eye_radius")), np.array([0.0, 0.0, 1.0]),
        still, surface,
    )  # fmt: skip
