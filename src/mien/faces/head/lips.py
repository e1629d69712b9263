"""Contact of the lips, which speech needs: shut at any jaw, whatever shape and teeth ask; and off the upper teeth."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core.mesh import Ints, Points

from .angles import soft_step
from .measured import Archive, Floats

CONTACT_RINGS = {"m0": 1.0, "mj": 0.3, "mi": 1.0, "mh": 0.92, "m1": 0.7, "mb": 0.5, "m2": 0.2}
"""Shares of closing; the first ring is where the lips meet, whose gap is closed."""

INNER = list(CONTACT_RINGS).index("mi")
LOCK, LOCK_M, WHOLE_M = 1.5, 0.003, 0.0001
"""How far inner edges of closed lips reach past one another, by how far a shape has torn the lips apart; at most, so
that they stay inside; and what counts as not torn."""

CONTACT_STATIONS = (
    (0, 9, 0.0001, 0.0005),
    (1, 8, 0.0001, 0.0005),
    (2, 7, 0.0002, 0.0005),
    (3, 6, 0.0011, 0.0010),
    (4, 6, 0.0020, 0.0020),
)
"""Stations that meet, above and below; how far (m) they pass one another when shut: near the corner the measured
bridge alone, or a corner drawn aside, leaves a slit; and from how near (m) they stick together, as lips do that part
from the middle on: from twice as far on they do not."""

OVERLAP_FROM = 0.25
PRESSED = 0.5
"""Share of the measured open mouth from which on they pass one another fully, and how much of it they do over a shut
jaw."""

TEETH_RINGS = ("mh", "m1", "mb")
TEETH_ARCH, TEETH_CLEAR_M, TEETH_EDGE_M = 24.0, 0.0012, 0.002
"""Rings of the upper lip that stay in front of the upper teeth, which lie back by 24 x^2 metres at x metres from the
middle; how far in front; and over how much of their edge that begins."""

UPPER_PART = 0.35
"""Share of a gap between the lips that the upper lip closes; the lower lip does the rest."""


@dataclass(frozen=True, eq=False)
class Contacts:
    """Vertices of all rings at pairs of stations that meet when the lips close.

    Attributes:
        numbers: (C, 2, R) vertices above and below, the ring where the lips meet first.
        shares: (R,) share of the gap's closing.
        gaps: (C, 6) m from the upper to the lower lip at rest; how far (m) they pass one another when shut; the
            share of the gap that the upper lip closes: the lower one does the rest; and from how near (m) they stick.
    """

    numbers: Ints
    shares: Floats
    gaps: Floats


def contacts_of(archive: Archive, points: Points) -> Contacts:
    """What meets of a resting skin (V, 3) m."""
    numbers, gaps = [], []
    for side in (0, 1):
        for up, low, overlap_m, sticking_m in CONTACT_STATIONS:
            if up == 0 and side == 1:
                continue  # the midline, which belongs to both sides
            upper, lower = ([archive.vertex_at(ring, s, side) for ring in CONTACT_RINGS] for s in (up, low))
            # The lower corner station serves two stations above; the second meets it where it lies.
            upper_part = UPPER_PART if up != 4 else 1.0
            numbers.append((upper, lower))
            gaps.append((*(points[lower[0]] - points[upper[0]]), overlap_m, upper_part, sticking_m))
    return Contacts(np.array(numbers), np.array(list(CONTACT_RINGS.values())), np.array(gaps))


@kernel()
def bridge_lips(points, share, bridge):
    """Bring the lips of the skin (V, 3) m together over an open jaw by a share of the measured ``mouthClose`` (V, 3) m.

    That makes sense together with the jaw only.
    """
    if share != 0.0:
        for v in range(len(points)):
            for axis in range(3):
                points[v, axis] += share * bridge[v, axis]


@kernel()
def close_lips(points, closure, jaw_opening, numbers, shares, gaps, moves, touching):
    """Bring the lips of the skin into contact, whatever is left between them.

    Args:
        points: (V, 3) m, after the jaw; changed.
        closure: 1 is shut.
        jaw_opening: the jaw's angle as a share of the measured open mouth.
        numbers: of ``Contacts``.
        shares: of ``Contacts``.
        gaps: of ``Contacts``.
        moves: (V, 3) filled with what contact adds.
        touching: (C, 4) filled with how far each pair is closed, or lies together by itself, and the gap it should
            have then, m.
    """
    for v in range(len(points)):
        for axis in range(3):
            moves[v, axis] = 0.0
    pressed = max(PRESSED * closure, min(jaw_opening / OVERLAP_FROM, 1.0))
    for c in range(len(gaps)):
        upper, lower = numbers[c, 0, 0], numbers[c, 1, 0]
        slit = points[upper, 1] - points[lower, 1] + gaps[c, 1]
        sticking = gaps[c, 5]
        near = max(closure, 1.0 - soft_step((slit - sticking) / sticking))
        closed = near if slit > 0.0 else closure
        touching[c, 0] = near
        upwards, downwards = closed * (1.0 - gaps[c, 4]), closed * gaps[c, 4]
        for axis in range(3):
            gap = points[lower, axis] - points[upper, axis] - gaps[c, axis]
            if axis == 1:
                gap -= pressed * gaps[c, 3]
            touching[c, 1 + axis] = points[lower, axis] - points[upper, axis] - closed * gap
            for ring in range(numbers.shape[2]):
                moves[numbers[c, 0, ring], axis] += downwards * shares[ring] * gap
                moves[numbers[c, 1, ring], axis] -= upwards * shares[ring] * gap
    for v in range(len(points)):
        for axis in range(3):
            points[v, axis] += moves[v, axis]


@kernel()
def stay_off_teeth(points, over_teeth, edge):
    """Keep the upper lip of the skin (V, 3) m in front of the upper teeth, whatever rolls it in or lifts it.

    Args:
        points: changed.
        over_teeth: of ``MouthRegions``.
        edge: (2,) m, height of the edge of the front teeth, and how far forward they reach.
    """
    for n in range(len(over_teeth)):
        v = over_teeth[n]
        front = edge[1] + TEETH_CLEAR_M - TEETH_ARCH * points[v, 0] * points[v, 0]
        if points[v, 2] < front:
            points[v, 2] += soft_step((points[v, 1] - edge[0]) / TEETH_EDGE_M) * (front - points[v, 2])


@kernel()
def seal_lips(points, numbers, shares, touching):
    """Close again what shape and teeth have torn apart of closed lips of the skin (V, 3) m.

    The lip that lies farther back comes forward, never into the teeth; and the inner edges, which nobody sees, reach
    past one another, so that no slit lets one see through.

    Args:
        points: changed.
        numbers: of ``Contacts``.
        shares: of ``Contacts``.
        touching: of ``close_lips``.
    """
    for c in range(len(touching)):
        upper, lower, held = numbers[c, 0, 0], numbers[c, 1, 0], touching[c, 0]
        torn, ahead = 0.0, 0.0
        for axis in range(3):
            ahead = points[lower, axis] - points[upper, axis] - touching[c, 1 + axis]
            torn += ahead * ahead
        behind = 0 if ahead > 0.0 else 1
        for ring in range(numbers.shape[2]):
            points[numbers[c, behind, ring], 2] += held * shares[ring] * max(abs(ahead) - WHOLE_M, 0.0)
        lock = held * min(LOCK * max(np.sqrt(torn) - WHOLE_M, 0.0), LOCK_M)
        points[numbers[c, 0, INNER], 1] -= 0.5 * lock
        points[numbers[c, 1, INNER], 1] += 0.5 * lock
