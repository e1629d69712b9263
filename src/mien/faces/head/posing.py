"""The kernels that pose a head, in the order in which the parameters act; each takes N poses at once.

A pose arrives twice: as the weights of the moves, and as its row of ``CONTROLS``, which are named by number here.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from mien.compiling import kernel

from .brows import place_brows, sum_normals
from .eyes import fill_radii, look_at, place_eye, place_spot
from .jaw import carry_with_jaw, chin_shift, open_jaw
from .lashes import place_caruncle, place_lashes
from .lids import closing, elevation_deg, move_lids
from .mouth import close_lips, move_lips, tuck_lip
from .neck import turn_axes, turn_back, turn_directions, turn_head
from .shades import darken_eye, darken_mouth
from .tongue import move_tongue
from .units import DEG

SINGLE = (
    *("jaw.rotation", "jaw.side", "jaw.forward", "mouth.width", "mouth.offset", "mouth.upper_lip", "mouth.tuck"),
    *("mouth.closure", "tongue.raise", "tongue.out", "head.turn", "head.nod", "head.tilt"),
    *(f"{group}.{axis}" for group in ("target", "light", "viewer") for axis in "xyz"),
)
PAIRED = (
    *("mouth.corner.side", "mouth.corner.up", "mouth.corner.forward", "mouth.corner.width"),
    *("eyelid.opening", "eye.turn", "eye.nod", "iris.size", "pupil.size", "fringe.size", "spot.size"),
)
CONTROLS = (*SINGLE, *(name + side for name in PAIRED for side in (".left", ".right")))
"""Parameters of the mechanisms that are more than moves."""

JAW, JAW_SIDE, JAW_FORWARD, WIDTH, OFFSET, UPPER_LIP, TUCK, CLOSURE, TIP_UP, TIP_OUT, TURN, NOD, TILT = range(13)
TARGET, LIGHT, VIEWER, CORNERS = 13, 16, 19, 22
OPENING, EYE_TURN, EYE_NOD, IRIS, PUPIL, FRINGE, SPOT = range(30, 44, 2)
"""Columns of ``CONTROLS``; of a pair, or of a place, the first."""

EYE, SPOTS, CARUNCLE, LASH, BROW, TEETH, GUMS, TONGUE, END = 0, 2, 4, 6, 8, 10, 11, 12, 13
"""Where the first vertex of each part stands in a row of part starts; of a pair, the left one."""

PARTS = (
    *(f"{name}.{side}" for name in ("eye", "spot", "caruncle", "lash", "brow") for side in ("left", "right")),
    *("teeth", "gums", "tongue"),
)

TONGUE_SHARE = 0.82
TONGUE_SHIFT = 0.7
"""How far the tongue goes with the jaw's rotation, and with its sideways and forward moves."""


@kernel("f8[:,:], f8[:,:], f8[:], f8[:,:,:]")
def aim_eyes(controls, balls, kappa_deg, gaze):
    """Fill ``gaze`` (N, 2, 3), the directions of the left and the right eye.

    Args:
        controls: (N, D).
        balls: (2, 4) m, centre and radius.
        kappa_deg: (2,) angle added to the turn of each eye.
        gaze: filled.
    """
    for frame in range(len(controls)):
        c = controls[frame]
        target = turn_back(c[TARGET : TARGET + 3], c[TURN] * DEG, c[NOD] * DEG, c[TILT] * DEG)
        for side in range(2):
            forward = look_at(balls[side], target, c[EYE_TURN + side] + kappa_deg[side], c[EYE_NOD + side])
            for axis in range(3):
                gaze[frame, side, axis] = forward[axis]


@kernel(
    "f8[:,:], f8[:,:,:], i8[:], f8[:,:], f8[:], f8[:], f8[:], f8, f8[:,:], f8[:,:], i8[:,:,:], f8[:], f8[:,:], "
    "i8[:,:], f8[:,:], f8[:,:], f8, f8[:,:,:], f8[:,:,:]"
)
def deform_skin(
    controls, gaze, lips, lip_regions, tuck_share, jaw_axis, jaw_share, open_angle_deg, jaw_residual, bridge,
    contacts, contact_shares, gaps, lids, lid_polar, lid_rest, rest_opening, scratch, skins,
):  # fmt: skip
    """Change ``skins`` (N, S, 3) m, to which moves are added already: lips, jaw, contact of the lips, lids.

    Args:
        controls: (N, D).
        gaze: (N, 2, 3) directions of the eyes.
        lips: (R,) vertices of the mouth, with
        lip_regions: (R, 7) of ``move_lips``, and
        tuck_share: (R,) of ``tuck_lip``.
        jaw_axis: (2,) m.
        jaw_share: (S,).
        open_angle_deg: of the measured open mouth.
        jaw_residual: (S, 3) m.
        bridge: (S, 3) m, contacts, contact_shares, gaps: of ``close_lips``.
        lids: lid_polar, lid_rest: of ``LidTable``.
        rest_opening: of the lids.
        scratch: (2, S, 3), overwritten.
        skins: changed.
    """
    before, moves = scratch[0], scratch[1]
    for frame in range(len(skins)):
        c, skin = controls[frame], skins[frame]
        move_lips(skin, lips, lip_regions, c[WIDTH], c[OFFSET], c[UPPER_LIP], c[CORNERS : CORNERS + 8])
        if c[TUCK] != 0.0:
            for n in range(len(lips)):
                for axis in range(3):
                    before[lips[n], axis] = skin[lips[n], axis]
        open_jaw(skin, c[JAW], jaw_axis, jaw_share, open_angle_deg, jaw_residual)
        if c[TUCK] != 0.0:
            tuck_lip(skin, before, lips, tuck_share, c[TUCK])
        close_lips(skin, c[CLOSURE], c[JAW] / open_angle_deg, bridge, contacts, contact_shares, gaps, moves)
        closed = closing(c[OPENING], rest_opening), closing(c[OPENING + 1], rest_opening)
        up = elevation_deg(gaze[frame, 0, 1]), elevation_deg(gaze[frame, 1, 1])
        move_lids(skin, lids, lid_polar, lid_rest, closed, up)


@kernel("f8[:,:,:], i8[:], f8[:], i8, f8[:,:,:], f8[:,:]")
def place_skin(skins, source, rest, first_at_rest, points, flat):
    """Fill ``points`` (N, V, 3) m with the skins (N, S, 3), and with what is at rest in the head.

    Args:
        skins: posed.
        source: (K,) vertex of the skin of each of the first K vertices.
        rest: (3 R,) m, of the vertices from
        first_at_rest: on.
        points: filled, but for the vertices between.
        flat: (N, 3 V), the same memory: a run of numbers is copied several at a time.
    """
    for frame in range(len(skins)):
        skin, out, run = skins[frame], points[frame], flat[frame, 3 * first_at_rest :]
        for v in range(len(source)):
            for axis in range(3):
                out[v, axis] = skin[source[v], axis]
        for i in range(len(rest)):
            run[i] = rest[i]


@kernel(
    "f8[:,:], f8[:,:,:], f8[:,:,:], i8[:], f8[:,:], i8[:], f8[:,:], f8[:,:], i8[:,:], f8[:,:], f8[:,:,:], f8[:,:,:]"
)
def place_eyes(controls, skins, gaze, parts, balls, steps, circle, hexagon, corners, radii, points, normals):
    """Fill the eyes of ``points`` and ``normals`` (N, V, 3): balls, spots, and the pink corners between the lids.

    Args:
        controls: (N, D).
        skins: (N, S, 3) m, posed.
        gaze: (N, 2, 3) directions of the eyes.
        parts: first vertex of each of ``PARTS``.
        balls: (2, 4) m, centre and radius.
        steps: of ``place_eye``.
        circle: of ``place_eye``.
        hexagon: of ``place_spot``.
        corners: (2, 5) of ``place_caruncle``.
        radii: (7, 2), overwritten.
        points: filled.
        normals: filled; where there are fewer than poses, the last one again and again.
    """
    for frame in range(len(skins)):
        c, out, around = controls[frame], points[frame], normals[min(frame, len(normals) - 1)]
        turned, nodded, tilted = c[TURN] * DEG, c[NOD] * DEG, c[TILT] * DEG
        light = turn_back(c[LIGHT : LIGHT + 3], turned, nodded, tilted)
        viewer = turn_back(c[VIEWER : VIEWER + 3], turned, nodded, tilted)
        for side in range(2):
            centre, radius, forward = balls[side], balls[side, 3], gaze[frame, side]
            fill_radii(c[IRIS + side], c[PUPIL + side], c[FRINGE + side], radii)
            first = parts[EYE + side]
            place_eye(centre, radius, forward, radii, steps, circle, out[first:], around[first:])
            spot = out[parts[SPOTS + side] :]
            place_spot(centre, radius, forward, c[IRIS + side], c[SPOT + side], light, viewer, hexagon, spot)
            place_caruncle(skins[frame], corners[side], centre, radius, side == 1, out[parts[CARUNCLE + side] :])


@kernel(
    "f8[:,:,:], i8[:], f8[:,:], i8[:,:,:], f8[:,:,:], f8[:,:,:], i8[:,:,:], f8[:,:,:], f8[:], "
    "i8[:,:], i8[:], i8[:], i8[:], f8[:,:], f8[:,:,:]"
)
def place_hairs(
    skins, parts, balls, lash_index, lash_weight, lash_reach, brow_index, brow_weight, brow_offset,
    quads, normal_vertices, normal_starts, normal_columns, scratch, points,
):  # fmt: skip
    """Fill the lashes and brows of ``points`` (N, V, 3) m.

    Args:
        skins: (N, S, 3) m, posed.
        parts: first vertex of each of ``PARTS``.
        balls: (2, 4) m, centre and radius.
        lash_index: (2, K, B), lash_weight, lash_reach: of ``place_lashes``.
        brow_index: (2, K, B), brow_weight, brow_offset: of ``place_brows``.
        quads: (F, 4) of the skin.
        normal_vertices: normal_starts, normal_columns: of ``sum_normals``.
        scratch: (S, 3), overwritten.
        points: filled.
    """
    for frame in range(len(skins)):
        skin, out = skins[frame], points[frame]
        sum_normals(skin, quads, normal_vertices, normal_starts, normal_columns, scratch)
        for side in range(2):
            lashes, brow = out[parts[LASH + side] :], out[parts[BROW + side] :]
            index, weight, reach = lash_index[side], lash_weight[side], lash_reach[side]
            place_lashes(index, weight, reach, skin, balls[side], 1.0 - 2.0 * side, lashes)
            place_brows(brow_index[side], brow_weight[side], brow_offset, skin, scratch, brow)


@kernel("f8[:,:], i8[:], b1[:], f8[:], f8[:], f8[:,:], f8[:,:,:]")
def place_mouth(controls, parts, carried, tip_share, jaw_axis, chin, points):
    """Move teeth, gums and tongue of ``points`` (N, V, 3) m, which are at rest.

    Args:
        controls: (N, D).
        parts: first vertex of each of ``PARTS``.
        carried: (K,) whether a vertex, from the first of the teeth on, goes with the jaw.
        tip_share: of ``move_tongue``.
        jaw_axis: (2,) m.
        chin: (3, 3) m of ``chin_shift``.
        points: changed.
    """
    first, behind = parts[TEETH], parts[TONGUE] - parts[TEETH]
    for frame in range(len(points)):
        c, inside = controls[frame], points[frame, first:]
        x, y, z = chin_shift(c[JAW_FORWARD], c[JAW_SIDE], chin)
        carry_with_jaw(inside[:behind], carried, c[JAW], jaw_axis, (x, y, z))
        tongue = inside[behind : behind + len(tip_share)]
        move_tongue(tongue, tip_share, c[TIP_UP], c[TIP_OUT])
        shift = TONGUE_SHIFT * x, TONGUE_SHIFT * y, TONGUE_SHIFT * z
        carry_with_jaw(tongue, carried[behind:], TONGUE_SHARE * c[JAW], jaw_axis, shift)


@kernel("i8[:], f8[:,:], i8, f8[:,:], f8[:,:]")
def shade_parts(parts, balls, lip_edge, points, colors):
    """Darken colours (V, 3) where lids and lips cast shadows; ``points`` (V, 3) m are of a head that is not turned yet.

    ``lip_edge`` is the vertex in the middle of the upper lip's edge.
    """
    for side in range(2):
        first, last = parts[EYE + side], parts[EYE + side] + parts[SPOTS] - parts[EYE]
        darken_eye(colors[first:last], points[first:last], balls[side])
    first, last = parts[TEETH], parts[END]
    darken_mouth(colors[first:last], points[first:last], points[lip_edge, 1])


@kernel("f8[:,:], i8[:], f8[:], f8[:,:,:], f8[:,:,:]")
def turn_heads(controls, parts, neck_share, points, normals):
    """Turn ``points`` (N, V, 3) m on the neck by their share (V,) of the angles, and the ``normals`` of the eyes."""
    for frame in range(len(points)):
        c, around = controls[frame], normals[min(frame, len(normals) - 1)]
        turned, nodded, tilted = c[TURN] * DEG, c[NOD] * DEG, c[TILT] * DEG
        if turned != 0.0 or nodded != 0.0 or tilted != 0.0:
            axes = turn_axes(turned, nodded, tilted)
            turn_head(points[frame], neck_share, axes, turned, nodded, tilted)
            for side in range(2):
                first, last = parts[EYE + side], parts[EYE + side] + parts[SPOTS] - parts[EYE]
                turn_directions(around[first:last], axes)
