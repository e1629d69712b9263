"""Parameters that mechanisms of their own follow, as columns of a row of numbers."""

from __future__ import annotations

SINGLE = (
    *("jaw.rotation", "jaw.side", "jaw.forward", "mouth.width", "mouth.offset", "mouth.upper_lip", "mouth.tuck"),
    *("mouth.closure", "tongue.raise", "tongue.out", "tongue.side", "tongue.up"),
    *("head.turn", "head.nod", "head.tilt", "head.forward"),
    *("head.scale.width", "head.scale.height", "head.scale.depth"),
    *(f"{group}.{axis}" for group in ("target", "light", "viewer") for axis in "xyz"),
    *("mouth.roll_upper", "mouth.roll_lower"),
)
PAIRED = (
    *("mouth.corner.side", "mouth.corner.up", "mouth.corner.forward", "mouth.corner.width"),
    *("eyelid.opening", "eye.turn", "eye.nod", "iris.size", "pupil.size", "fringe.size", "spot.size"),
    *("eyebrow.thickness", "eyebrow.shape"),
)
CONTROLS = (*SINGLE, *(name + side for name in PAIRED for side in (".left", ".right")))
"""Parameters that these mechanisms follow: a pose arrives as a row of their values, named by number below."""

JAW, JAW_SIDE, JAW_FORWARD, WIDTH, OFFSET, UPPER_LIP, TUCK, CLOSURE, TIP = range(9)
TURN, NOD, TILT, FORWARD, SCALE, TARGET, LIGHT, VIEWER, ROLLED, CORNERS = *range(12, 17), *range(19, 31, 3), 30
OPENING, EYE_TURN, EYE_NOD, IRIS, PUPIL, FRINGE, SPOT, THICKNESS, BROW_SHAPE = range(38, 56, 2)
"""Columns of ``CONTROLS``; of a pair, of a place, or of the tongue's tip the first."""
