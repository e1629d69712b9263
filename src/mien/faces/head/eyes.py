"""Eyeballs by procedure: pupil, iris, fringe and whites as rings of quadrilaterals, and the reflection spot.

Source: Parke 1974, section 3.1.1, figures 3.2 to 3.4 and Appendix A. His formulas of the angles become unit
vectors here: the same directions, without arctangents whose average jumps where they wrap at +-pi.
"""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from functools import lru_cache

import numpy as np

from mien.compiling import kernel
from mien.core import exact
from mien.core.mesh import Ints

from .angles import share, sin_cos
from .measured import Floats
from .units import DEG
from .vectors import cross, unit_or_ahead

BACK_COS_SIN = (-0.3420201433256687, 0.9396926207859084, -0.6427876096865394, 0.766044443118978)
"""Cosine and sine of 110 and 130 degrees: two rings behind his hemisphere, so that no gap shows beside the lids."""

SPOT_SIDES = 6
SPOT_LIFT = 1.012
SPOT_RINGS = (0.14, 0.4, 0.7, 1.0)
"""The spot is a cap just in front of the ball: his lens, and a large flat spot, would pierce our lids, which lie closer
than his. Its hexagons, shares of its size, are so near one another that it does not dip into the ball between them."""

MOST_SIDEWAYS, MOST_UP = 1.0, 0.7
"""Tangents of the farthest that an eye turns: 45 degrees sideways, 35 up or down."""

KAPPA_DEG = 4.0
"""The pupil of an eye that looks at something points some 4 to 5 degrees outwards of it (angle kappa); without it a
head that looks at the viewer seems to squint. Parke's eyes have none."""

CLASSIC, SMOOTH = 12, 24
"""Sides of the pupil: his 12, and 24 for the subdivided head."""

BANDS = ("iris", "fringe", "white", "white", "back", "back")


@kernel()
def look_at(centre, target, turn_deg, nod_deg):
    """Direction in which an eye looks to see a target, within what an eye can turn, then offset by angles.

    Source: Parke 1974, Appendix A (alpha and beta of each eye by itself; his beta is positive downwards).
    """
    x, y, z = unit_or_ahead(target[0] - centre[0], target[1] - centre[1], target[2] - centre[2])
    level = max(z, 1e-9)
    x = min(max(x / level, -MOST_SIDEWAYS), MOST_SIDEWAYS)
    flat = np.sqrt(1.0 + x * x)
    y = min(max(y / level / flat, -MOST_UP), MOST_UP) * flat
    if turn_deg == 0.0 and nod_deg == 0.0:
        return unit_or_ahead(x, y, 1.0)
    sin_turn, cos_turn = sin_cos(turn_deg * DEG)
    sin_nod, cos_nod = sin_cos(nod_deg * DEG)
    ahead, aside = (cos_turn - x * sin_turn) / flat, (sin_turn + x * cos_turn) / flat
    whole = np.sqrt(flat * flat + y * y)
    level, up = flat / whole, y / whole
    level, up = level * cos_nod - up * sin_nod, level * sin_nod + up * cos_nod
    return aside * level, up, ahead * level


@kernel()
def aside_and_above(direction):
    """Unit vectors across a direction: level, towards the own left when it points ahead; and upwards."""
    aside = unit_or_ahead(direction[2], 0.0, -direction[0])
    return aside, cross(direction, aside)


@kernel()
def lens_centre(iris):
    """Distance of the lens sphere's centre before the eye's, in eyeball radii; 0 or less for a very large iris.

    Source: Parke 1974, Appendix A: 1 = R_i^2 + (R_i + L_c)^2.
    """
    return np.sqrt(1.0 - iris * iris) - iris


@kernel()
def seen_iris(iris):
    """The iris without the ends of its range, at which rings would have no width."""
    return min(max(iris, 0.02), 0.95)


@kernel()
def spot_direction(centre, radius, forward, iris, light, viewer):
    """Unit vector from the eye's centre to the reflection spot, and how much of the spot is on the lens (0..1).

    The spot lies on the lens where its normal halves the angle between light and viewer. The lens meets the ball
    at the iris, 45 degrees from its own axis, so its radius is sqrt(2) R_i; without a bulge (R_i >= 0.707) the
    ball itself reflects.

    Source: Parke 1974, Appendix A, with the directions averaged instead of the angles. His lens centre is in the eye's
    coordinates, light and viewer are in the head's: the eye's place is added before they are compared.
    """
    iris = seen_iris(iris)
    bulge, lens_radius = lens_centre(iris), iris * np.sqrt(2.0)
    if not bulge > 0.0:
        bulge, lens_radius = 0.0, 1.0
    out = radius * bulge
    x, y, z = centre[0] + out * forward[0], centre[1] + out * forward[1], centre[2] + out * forward[2]
    lx, ly, lz = unit_or_ahead(light[0] - x, light[1] - y, light[2] - z)
    vx, vy, vz = unit_or_ahead(viewer[0] - x, viewer[1] - y, viewer[2] - z)
    hx, hy, hz = unit_or_ahead(lx + vx, ly + vy, lz + vz)
    # The spot fades where the lens ends (45 degrees from its axis) and where the light only grazes it.
    on_lens = ((hx * forward[0] + hy * forward[1] + hz * forward[2]) - 0.62) / 0.12
    lit = ((hx * lx + hy * ly + hz * lz) - 0.15) / 0.15
    x, y, z = bulge * forward[0] + lens_radius * hx, bulge * forward[1] + lens_radius * hy, lens_radius * hz
    return unit_or_ahead(x, y, bulge * forward[2] + z), share(min(on_lens, lit))


@lru_cache(maxsize=4)
def eye_polygons(sides: int) -> tuple[Ints, Ints]:
    """(1, sides) the pupil and (K, 4) the rings of one eye; vertices as ``place_eye`` lists them."""
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


def band_steps(sides: int) -> Ints:
    """(6,) rings less one of each band."""
    return np.array([_steps(band, sides) for band in BANDS], dtype=np.int64)


@kernel()
def fill_radii(iris, pupil, fringe, radii):
    """Fill ``radii`` (7, 2) with cosine and sine of the polar angle of each ring, from the pupil's edge to the back.

    Source: Parke 1974, figure 3.2: x_i = sqrt(R_e^2 - R_i^2), which is printed with a plus, but the rings lie on the
    ball; sizes are shares of R_e. The white's middle ring halves the angle that is left beside the fringe.
    """
    iris = seen_iris(iris)
    fringe = min(iris * (1.0 + max(fringe, 0.01)), 0.97)
    radii[0, 1], radii[1, 1], radii[2, 1] = min(max(pupil, 0.01), 0.96 * iris), iris, fringe
    for ring in range(3):
        radii[ring, 0] = np.sqrt(1.0 - radii[ring, 1] * radii[ring, 1])
    # Polar angle (phi + pi/2)/2 by the half-angle formulas, with cos(phi + pi/2) = -sin(phi).
    radii[3, 0], radii[3, 1] = np.sqrt(0.5 * (1.0 - fringe)), np.sqrt(0.5 * (1.0 + fringe))
    radii[4, 0], radii[4, 1] = 0.0, 1.0
    for ring in range(2):
        radii[5 + ring, 0], radii[5 + ring, 1] = BACK_COS_SIN[2 * ring], BACK_COS_SIN[2 * ring + 1]


@kernel()
def place_eye(centre, radius, forward, radii, wide, steps, circle, points, normals):
    """Fill ``points`` (N, 3) m and ``normals`` (N, 3) of a ball: the pupil, then the rings of each band.

    Args:
        centre: of the ball, m.
        radius: of the ball, m.
        forward: unit vector, where it looks.
        radii: of ``fill_radii``.
        wide: width of pupil, iris and fringe over what it is on a ball that nothing stretches; their height is 1/wide.
        steps: (6,) rings less one of each band.
        circle: (sides, 2) of ``circle``.
        points: filled.
        normals: filled.
    """
    aside, above = aside_and_above(forward)
    first, sides = 0, len(circle)
    for band in range(-1, len(steps)):
        inner, rings = max(band, 0), 0 if band < 0 else steps[band]
        for ring in range(rings + 1):
            c, s = radii[inner, 0], radii[inner, 1]
            if band >= 0:
                t = ring / rings
                c, s = c + t * (radii[band + 1, 0] - c), s + t * (radii[band + 1, 1] - s)
                size = np.sqrt(c * c + s * s)
                c, s = c / size, s / size
            colored = wide != 1.0 and (band < 2 or (band == 2 and ring == 0))
            for corner in range(sides):
                across, up, ahead = s * circle[corner, 0], s * circle[corner, 1], c
                if colored:
                    across, up, ahead = unit_or_ahead(across * wide, up / wide, ahead)
                for axis in range(3):
                    normal = ahead * forward[axis] + across * aside[axis] + up * above[axis]
                    normals[first + corner, axis] = normal
                    points[first + corner, axis] = centre[axis] + radius * normal
            first += sides


@kernel()
def place_spot(centre, radius, forward, sizes, light, viewer, grid, points):
    """Fill ``points`` (K, 3) m: a hexagon on the eye where the light is mirrored to the viewer.

    Args:
        centre: of the ball, m.
        radius: of the ball, m.
        forward: unit vector, where it looks.
        sizes: of iris and spot, shares of the ball's radius.
        light: its place as the head has it before it turns, m.
        viewer: likewise.
        grid: (K, 2) of ``spot_grid``.
        points: filled.
    """
    direction, shown = spot_direction(centre, radius, forward, sizes[0], light, viewer)
    size = max(sizes[1] * shown, 1e-3)
    aside, above = aside_and_above(direction)
    for n in range(len(grid)):
        across, up = size * grid[n, 0], size * grid[n, 1]
        away = radius * SPOT_LIFT / np.sqrt(1.0 + across * across + up * up)
        for axis in range(3):
            points[n, axis] = centre[axis] + away * (direction[axis] + across * aside[axis] + up * above[axis])


@lru_cache(maxsize=1)
def spot_grid() -> Floats:
    """(60, 2) points of hexagons inside one another, of which the k-th has k points a side."""
    corners = circle(SPOT_SIDES)
    rows = []
    for k, ring in enumerate(SPOT_RINGS, start=1):
        for side in range(SPOT_SIDES):
            start, end = corners[side], corners[(side + 1) % SPOT_SIDES]
            rows += [ring * (start + (end - start) * (step / k)) for step in range(k)]
    return np.array(rows)


@lru_cache(maxsize=1)
def spot_polygons() -> tuple[Ints, Ints]:
    """(1, 6) the hexagon in the middle and (90, 3) triangles around it; vertices as in ``spot_grid``."""
    triangles = []
    first = 0
    for k in range(1, len(SPOT_RINGS)):
        inner, outer = SPOT_SIDES * k, SPOT_SIDES * (k + 1)
        for side in range(SPOT_SIDES):
            for step in range(k + 1):
                a = first + inner + side * (k + 1) + step
                b = first + inner + (side * (k + 1) + step + 1) % outer
                c = first + (side * k + step) % inner
                triangles.append((a, b, c))
                if step < k:
                    triangles.append((c, b, first + (side * k + step + 1) % inner))
        first += inner
    return np.arange(SPOT_SIDES)[None], np.array(triangles, dtype=np.int64)


def spot_mirror() -> Ints:
    """(60,) the point of ``spot_grid`` that each becomes in the mirror."""
    rings = range(1, len(SPOT_RINGS) + 1)
    firsts = [SPOT_SIDES * k * (k - 1) // 2 for k in rings]
    # Corner j of ring k lies at (j + k/2) / k sixths of the way around.
    return np.concatenate(
        [first + (2 * k - np.arange(SPOT_SIDES * k)) % (SPOT_SIDES * k) for first, k in zip(firsts, rings, strict=True)]
    )


@lru_cache(maxsize=8)
def circle(sides: int) -> Floats:
    """(sides, 2) cosines and sines of a regular polygon's corners, anticlockwise, half a step off the horizontal."""
    angle = (np.arange(sides) + 0.5) * (360.0 / sides) * DEG
    sine, cosine = exact.sin_cos(angle)
    return np.stack([cosine, sine], axis=1)


@lru_cache(maxsize=8)
def eye_shades(sides: int) -> tuple[tuple[str, Floats], ...]:
    """Runs of vertices as ``place_eye`` lists them: the colour's name and a factor (N, 3) on it."""
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
