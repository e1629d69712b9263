"""Eyebrows: interpolation between high and low arch, translation of the inner end; and the strips of hair."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from dataclasses import dataclass

from mien.compiling import kernel
from mien.core.mesh import Ints

from .falloff import along, bell, own_side
from .measured import Archive, Floats, Measured
from .moves import Move
from .rest import REST_ARCH
from .units import PARKE_UNIT_M as UNIT
from .vectors import bind, cross, unit, unit_or_ahead

HIGH = (("browOuterUp", 0.95), ("browInnerUp", 0.30))
LOW = (("browOuterUp", -0.40),)
INNER_END = (0.0105, 0.0235)

ROWS = 4
"""Vertices across a strip of hair, from its lower edge to the upper one."""

SHAPE_M = 0.007
PEAK, BREADTH = 0.62, 0.55
"""How far ``eyebrow.shape`` lifts the peak of a brow over its ends; where the peak lies along it, and its breadth."""


@dataclass(frozen=True, eq=False)
class BrowRegions:
    """(V,) weights of the inner end of the left and right brow."""

    inner: tuple[Floats, Floats]


def brow_regions(measured: Measured) -> BrowRegions:
    """The weights, from the neutral points."""
    points = measured.points
    left, right = (
        bell(points, (side * INNER_END[0], INNER_END[1]), (0.018, 0.013)) * own_side(points, side, 0.008)
        for side in (1, -1)
    )
    return BrowRegions((left, right))


def brow_moves(regions: BrowRegions, measured: Measured) -> list[Move]:
    """Arch and separation of the brows.

    Two sets of points are interpolated, high arch at 0 and low at 1; the measured face lies between, at rest.

    Source: Parke 1974, section 3.2.
    """
    out = []
    for number, (side, letter, sign) in enumerate((("left", "L", 1.0), ("right", "R", -1.0))):
        arch = f"eyebrow.arch.{side}"
        for rows, span in ((HIGH, -REST_ARCH), (LOW, 1.0 - REST_ARCH)):
            out += [
                Move(arch, measured.morphs[f"{name}_{letter}"], share, REST_ARCH, span, one_way=True)
                for name, share in rows
            ]
        outwards = along(0, regions.inner[number])
        out.append(Move(f"eyebrow.separation.{side}", outwards, sign * UNIT))
    return out


@dataclass(frozen=True, eq=False)
class BrowStrips:
    """A tapered strip bound to the skin: point = sum of weights times cage points, plus an offset along the normal."""

    index: tuple[Ints, Ints]
    weight: tuple[Floats, Floats]
    offset: Floats
    quads: Ints
    along: Floats
    across: Floats


def brow_strips(archive: Archive, lift_m: float) -> BrowStrips:
    """The strips, lifted off the skin by ``lift_m`` more than measured (flat pictures need it)."""
    return BrowStrips(
        (archive.ints("brow_left_index"), archive.ints("brow_right_index")),
        (archive.floats("brow_left_weight"), archive.floats("brow_right_weight")),
        archive.floats("brow_offset") + lift_m,
        archive.ints("brow_quads"),
        archive.floats("brow_along"),
        archive.floats("brow_across"),
    )


@kernel()
def sum_normals(points, quads, vertices, starts, columns, normals):
    """Fill the rows ``vertices`` of ``normals`` (V, 3): each the sum of its polygons' normals, twice their areas long.

    The polygons of vertex n of the list are ``columns[starts[n]:starts[n + 1]]``.
    """
    for n in range(len(vertices)):
        x, y, z = 0.0, 0.0, 0.0
        for k in range(starts[n], starts[n + 1]):
            a, b, c, d = quads[columns[k], 0], quads[columns[k], 1], quads[columns[k], 2], quads[columns[k], 3]
            first = points[c, 0] - points[a, 0], points[c, 1] - points[a, 1], points[c, 2] - points[a, 2]
            second = points[d, 0] - points[b, 0], points[d, 1] - points[b, 1], points[d, 2] - points[b, 2]
            nx, ny, nz = cross(first, second)
            x, y, z = x + nx, y + ny, z + nz
        vertex = vertices[n]
        normals[vertex, 0], normals[vertex, 1], normals[vertex, 2] = x, y, z


@kernel()
def place_brows(index, weight, offset, skin, normals, out):
    """Fill ``out`` (B, 3) m with a strip on posed skin (V, 3): on sums of its points, off it by ``offset`` (B,)."""
    for n in range(len(offset)):
        x, y, z = bind(index, weight, skin, n)
        nx, ny, nz = bind(index, weight, normals, n)
        nx, ny, nz = unit(nx, ny, nz)
        out[n, 0], out[n, 1], out[n, 2] = x + offset[n] * nx, y + offset[n] * ny, z + offset[n] * nz


@kernel()
def shape_brow(thickness, shape, brow):
    """Thicken a placed strip (B, 3) m, and bend it: ``shape`` is 0 straight, 0.5 as it rests, 1 arched."""
    stations = len(brow) // ROWS
    for station in range(stations):
        first, last = station * ROWS, station * ROWS + ROWS - 1
        x, y, z = brow[last, 0] - brow[first, 0], brow[last, 1] - brow[first, 1], brow[last, 2] - brow[first, 2]
        up = unit_or_ahead(x, y, z)
        off_peak = (station / (stations - 1.0) - PEAK) / BREADTH
        lift = (shape - 0.5) * SHAPE_M * (1.0 - min(off_peak * off_peak, 1.0) - 0.5)
        for axis in range(3):
            middle = 0.5 * (brow[first, axis] + brow[last, axis])
            for vertex in range(first, last + 1):
                brow[vertex, axis] = middle + thickness * (brow[vertex, axis] - middle) + lift * up[axis]
