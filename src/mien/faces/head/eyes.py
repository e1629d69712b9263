"""Eyeballs by procedure: pupil, iris, fringe and whites as rings of quadrilaterals, and the reflection spot.

Source: Parke 1974, section 3.1.1, figures 3.2 to 3.4 and Appendix A. His formulas of the angles become unit
vectors here: the same directions, without arctangents whose average jumps where they wrap at +-pi.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from mien.core import exact
from mien.core.mesh import Ints, Points

from .measured import Floats
from .units import DEG
from .vectors import cross, dot, length

BACK_COS_SIN = ((-0.3420201433256687, 0.9396926207859084), (-0.6427876096865394, 0.766044443118978))
"""Cosine and sine of 110 and 130 degrees: two rings behind his hemisphere, so that no gap shows beside the lids."""

SPOT_SIDES = 6
SPOT_LIFT = 1.006
"""The spot is drawn just in front of the ball: his lens would pierce our lids, which lie closer than his."""

MOST_SIDEWAYS, MOST_UP = 1.0, 0.7
"""Tangents of the farthest that an eye turns: 45 degrees sideways, 35 up or down."""

KAPPA_DEG = 4.0
"""The pupil of an eye that looks at something points some 4 to 5 degrees outwards of it (angle kappa); without it a
head that looks at the viewer seems to squint. Parke's eyes have none."""

CLASSIC, SMOOTH = 12, 24
"""Sides of the pupil: his 12, and 24 for the subdivided head."""

BANDS = ("iris", "fringe", "white", "white", "back", "back")


@dataclass(frozen=True)
class Eye:
    """One eye in the head.

    Attributes:
        centre: (3,) m.
        radius: m.
        forward: (3,) unit vector, where it looks.
        iris, pupil, spot: radii as shares of the eyeball's; fringe: as a share of the iris's.
    """

    centre: Floats
    radius: float
    forward: Floats
    iris: float = 0.39
    pupil: float = 0.156
    fringe: float = 0.12
    spot: float = 0.058


def normalised(vector: Floats) -> Floats:
    """A vector (3,) of length 1; straight ahead if it has no length."""
    size = float(length(vector))
    return vector / size if size > 1e-12 else np.array([0.0, 0.0, 1.0])


def _aside_and_above(direction: Floats) -> tuple[Floats, Floats]:
    """Unit vectors (3,) across a direction: level, towards the own left when it points ahead; and upwards."""
    aside = normalised(np.array([direction[2], 0.0, -direction[0]]))
    return aside, cross(direction, aside)


def look_at(centre: Floats, target: Floats, turn_deg: float = 0.0, nod_deg: float = 0.0) -> Floats:
    """Direction (3,) in which an eye looks to see a target, within what an eye can turn, then offset by angles.

    Source: Parke 1974, Appendix A (alpha and beta of each eye by itself; his beta is positive downwards).
    """
    x, y, z = normalised(target - centre)
    level = max(float(z), 1e-9)
    x = min(max(float(x) / level, -MOST_SIDEWAYS), MOST_SIDEWAYS)
    flat = float(np.sqrt(1.0 + x * x))
    y = min(max(float(y) / level / flat, -MOST_UP), MOST_UP) * flat
    if turn_deg or nod_deg:
        turn, nod = turn_deg * DEG, nod_deg * DEG
        sin_turn, cos_turn, sin_nod, cos_nod = (float(f) for a in (turn, nod) for f in exact.sin_cos(a))
        ahead, aside = (cos_turn - x * sin_turn) / flat, (sin_turn + x * cos_turn) / flat
        whole = float(np.sqrt(flat * flat + y * y))
        level_part, up_part = flat / whole, y / whole
        level_part, up_part = level_part * cos_nod - up_part * sin_nod, level_part * sin_nod + up_part * cos_nod
        return np.array([aside * level_part, up_part, ahead * level_part])
    return normalised(np.array([x, y, 1.0]))


def lens_centre(iris: float) -> float:
    """Distance of the lens sphere's centre before the eye's, in eyeball radii; 0 or less for a very large iris.

    Source: Parke 1974, Appendix A: 1 = R_i^2 + (R_i + L_c)^2.
    """
    return float(np.sqrt(1.0 - iris * iris)) - iris


def spot_direction(eye: Eye, light: Floats, viewer: Floats) -> tuple[Floats, float]:
    """Unit vector from the eye's centre to the reflection spot, and how much of the spot is on the lens (0..1).

    The spot lies on the lens where its normal halves the angle between light and viewer. The lens meets the ball
    at the iris, 45 degrees from its own axis, so its radius is sqrt(2) R_i; without a bulge (R_i >= 0.707) the
    ball itself reflects.

    Source: Parke 1974, Appendix A, with the directions averaged instead of the angles. His lens centre is in the eye's
    coordinates, light and viewer are in the head's: the eye's place is added before they are compared.
    """
    iris = _iris(eye)
    bulge = lens_centre(iris)
    centre, radius = (bulge, iris * float(np.sqrt(2.0))) if bulge > 0.0 else (0.0, 1.0)
    lens = eye.centre + eye.radius * centre * eye.forward
    to_light = normalised(light - lens)
    half = normalised(to_light + normalised(viewer - lens))
    # The spot fades where the lens ends (45 degrees from its axis) and where the light only grazes it.
    on_lens, lit = (float(dot(half, eye.forward)) - 0.62) / 0.12, (float(dot(half, to_light)) - 0.15) / 0.15
    shown = min(max(min(on_lens, lit), 0.0), 1.0)
    return normalised(centre * eye.forward + radius * half), shown


def _iris(eye: Eye) -> float:
    """The iris without the ends of its range, at which rings would have no width."""
    return min(max(eye.iris, 0.02), 0.95)


@lru_cache(maxsize=4)
def eye_polygons(sides: int) -> tuple[Ints, Ints]:
    """(1, sides) the pupil and (K, 4) the rings of one eye; vertices as ``eye_points`` lists them."""
    pupil = np.arange(sides)[None]
    around = np.arange(sides)
    quads = []
    first = sides
    for band in BANDS:
        rings = _steps(band, sides) + 1
        for ring in range(rings - 1):
            a = first + ring * sides
            b = a + sides
            quads.append(np.stack([a + around, b + around, b + (around + 1) % sides, a + (around + 1) % sides], axis=1))
        first += rings * sides
    return pupil, np.concatenate(quads)


def _steps(band: str, sides: int) -> int:
    return 1 if sides == CLASSIC else {"iris": 4, "fringe": 1, "white": 2, "back": 1}[band]


def ring_radii(eye: Eye) -> tuple[tuple[float, float], ...]:
    """(cosine, sine) of the polar angle of each ring, from the pupil's edge to the back.

    Source: Parke 1974, figure 3.2: x_i = sqrt(R_e^2 - R_i^2), which is printed with a plus, but the rings lie on the
    ball; sizes are shares of R_e. The white's middle ring halves the angle that is left beside the fringe.
    """
    iris = _iris(eye)
    pupil = min(max(eye.pupil, 0.01), 0.96 * iris)
    fringe = min(iris * (1.0 + max(eye.fringe, 0.01)), 0.97)
    front = tuple((float(np.sqrt(1.0 - r * r)), r) for r in (pupil, iris, fringe))
    # Polar angle (phi + pi/2)/2 by the half-angle formulas, with cos(phi + pi/2) = -sin(phi).
    middle = (float(np.sqrt(0.5 * (1.0 - fringe))), float(np.sqrt(0.5 * (1.0 + fringe))))
    return (*front, middle, (0.0, 1.0), *BACK_COS_SIN)


def eye_points(eye: Eye, sides: int) -> tuple[Points, Points]:
    """(N, 3) m points and (N, 3) normals of one eyeball: pupil first, then each band's rings with its own vertices."""
    forward = eye.forward
    aside, above = _aside_and_above(forward)
    x, y = _circle(sides)
    spokes = x[:, None] * aside + y[:, None] * above
    radii = ring_radii(eye)
    rings = [radii[0]]
    for number, band in enumerate(BANDS):
        steps = _steps(band, sides)
        (c0, s0), (c1, s1) = radii[number], radii[number + 1]
        for k in range(steps + 1):
            t = k / steps
            c, s = c0 + t * (c1 - c0), s0 + t * (s1 - s0)
            size = float(np.sqrt(c * c + s * s))
            rings.append((c / size, s / size))
    normals = np.concatenate([c * forward + s * spokes for c, s in rings])
    return eye.centre + eye.radius * normals, normals


def spot_points(eye: Eye, light: Floats, viewer: Floats) -> Points:
    """(6, 3) m, the reflection spot: a hexagon on the eye where the light is mirrored to the viewer."""
    direction, shown = spot_direction(eye, light, viewer)
    aside, above = _aside_and_above(direction)
    size = max(eye.spot * shown, 1e-3)
    x, y = _circle(SPOT_SIDES)
    flat = direction + size * (x[:, None] * aside + y[:, None] * above)
    return eye.centre + eye.radius * SPOT_LIFT * flat


@lru_cache(maxsize=8)
def _circle(sides: int) -> tuple[Floats, Floats]:
    """Cosines and sines of a regular polygon's corners, anticlockwise, half a step off the horizontal."""
    angle = (np.arange(sides) + 0.5) * (360.0 / sides) * DEG
    sine, cosine = exact.sin_cos(angle)
    return cosine, sine


@lru_cache(maxsize=8)
def eye_shades(sides: int) -> tuple[tuple[str, Floats], ...]:
    """Runs of vertices as ``eye_points`` lists them: the colour's name and a factor (N, 3) on it."""
    spokes = np.arange(sides)
    streak = (
        np.array([1.0, 1.16, 0.9, 1.08, 0.94, 1.2, 0.88, 1.04])[(spokes * 5) % 8]
        if sides != CLASSIC
        else np.ones(sides)
    )
    out = [("pupil", np.ones((sides, 3)))]
    tints = ((1.0, 1.0, 1.0), (0.97, 0.91, 0.87), (0.88, 0.74, 0.69), (0.7, 0.55, 0.5))
    white = 0
    for band in BANDS:
        steps = _steps(band, sides)
        t = np.repeat(np.linspace(0.0, 1.0, steps + 1), sides)[:, None]
        if band == "iris":
            shade = (1.55 - 0.85 * t) * np.tile(streak, steps + 1)[:, None] * np.ones((1, 3))
            out.append(("iris", shade if sides != CLASSIC else np.ones((len(t), 3))))
        elif band == "fringe":
            out.append(("fringe", np.ones((len(t), 3))))
        else:
            a, b = (np.array(tints[min(white + k, 3)]) for k in (0, 1))
            out.append(("white", a + t * (b - a)))
            white += 1
    return tuple(out)
