"""The kernels that pose a head, and the order in which its parameters act.

Moves of the skin come first (``moves``): expressions, grooves of folds, interpolations of the shape. What is more
than moves follows here: lips, jaw, contact of the lips, and the lids, which ride on what lies beneath; the steps of
the shape, for the skin and what is inside the mouth; contact of lids with eyeballs and of lips with teeth; planes of
the classic skin; eyes, lashes, brows and beard; shadows; then the whole head is scaled, and turned on its neck. Folds
are shaded last.

Source: Parke 1974, chapter 3.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

from .brows import place_brows, shape_brow, sum_normals
from .conformation import shape_held, shape_points
from .contact import WAYS, give_way, keep_off_balls, lift_row, push_before, stretch_of, trace_rows
from .controls import (
    BROW_SHAPE,
    CLOSURE,
    CORNERS,
    EYE_NOD,
    EYE_TURN,
    FORWARD,
    FRINGE,
    IRIS,
    JAW,
    JAW_FORWARD,
    JAW_SIDE,
    LIGHT,
    NOD,
    OFFSET,
    OPENING,
    PUPIL,
    ROLLED,
    SCALE,
    SPOT,
    TARGET,
    THICKNESS,
    TILT,
    TIP,
    TUCK,
    TURN,
    UPPER_LIP,
    VIEWER,
    WIDTH,
)
from .eyes import fill_radii, look_at, place_eye, place_spot
from .folds import fold_skin
from .jaw import carry_with_jaw, chin_shift, open_jaw
from .lashes import place_caruncle, place_lashes
from .lids import closing, elevation_deg, meet_lids, move_lids
from .lips import bridge_lips, close_lips, seal_lips, stay_off_teeth
from .mouth import copy_rows, move_lips, tuck_lip
from .neck import scale_all, turn_all, turn_back
from .planing import plane_skin
from .shades import darken_eye, darken_mouth
from .tongue import move_tongue
from .units import DEG, MM

EYE, SPOTS, CARUNCLE, LASH, BROW, BEARD, TEETH, GUMS, TONGUE, END = 0, 2, 4, 6, 8, 10, 11, 12, 13, 14
"""Where the first vertex of each part stands in a row of part starts; of a pair, the left one."""

PARTS = (
    *(f"{name}.{side}" for name in ("eye", "spot", "caruncle", "lash", "brow") for side in ("left", "right")),
    *("beard", "teeth", "gums", "tongue"),
)

RED = 3
"""Ring of the red among ``mouth.CONTACT_RINGS``."""


@kernel()
def seen_from_rest(c, first, angles, pivot):
    """A place in the room, three controls from ``first`` on, as the head saw it before it was scaled and turned."""
    x, y, z = turn_back(c[first : first + 3], angles, pivot, c[FORWARD] * MM)
    return x / c[SCALE], y / c[SCALE + 1], z / c[SCALE + 2]


@kernel()
def aim_eyes(c, balls, kappa_deg, angles, pivot, gaze):
    """Fill ``gaze`` (2, 3), the directions of both eyes.

    Args:
        c: a row of controls.
        balls: (2.., 4) m, centre and radius.
        kappa_deg: (2,) angle added to the turn of each.
        angles: turn, nod and tilt of the head, radians.
        pivot: of the turned head, m.
        gaze: filled.
    """
    target = seen_from_rest(c, TARGET, angles, pivot)
    for side in range(2):
        forward = look_at(balls[side], target, c[EYE_TURN + side] + kappa_deg[side], c[EYE_NOD + side])
        gaze[side, 0], gaze[side, 1], gaze[side, 2] = forward


@kernel()
def deform_skin(c, skin, gaze, lips, jaw, contacts, lids, scratch, waves, touching):
    """Change a skin (S, 3) m, to which moves are added already: lips, jaw, contact of the lips, lids.

    Args:
        c: a row of controls.
        skin: changed.
        gaze: (2, 3) directions of the eyes.
        lips: (R,) vertices of the mouth, their weights in ``move_lips`` (R, 7), its two ends, and the shares in
            ``tuck_lip`` (R,).
        jaw: axis, share, angle of the measured open mouth, residual: of ``open_jaw``.
        contacts: bridge of ``bridge_lips``; numbers, shares, gaps of ``close_lips``; over_teeth and edge of
            ``stay_off_teeth``.
        lids: numbers, polar and rest of ``move_lids``; pairs and gaps of ``meet_lids``; opening at rest.
        scratch: (2, S, 3), overwritten.
        waves: (2, S), overwritten.
        touching: of ``close_lips``, filled.
    """
    rows, regions, ends, tuck_share = lips
    axis, share, open_angle_deg, residual = jaw
    bridge, numbers, shares, gaps, over_teeth, front = contacts
    lid_numbers, lid_polar, lid_rest, lid_pairs, lid_gaps, rest_opening = lids
    before_jaw, moves = scratch[0], scratch[1]
    move_lips(skin, rows, regions, ends, c[WIDTH], c[OFFSET], c[UPPER_LIP], c[CORNERS : CORNERS + 8])
    if c[TUCK] != 0.0:
        copy_rows(skin, rows, before_jaw)
    open_jaw(skin, c[JAW], axis, share, open_angle_deg, residual, waves)
    opened = c[JAW] / open_angle_deg
    bridge_lips(skin, c[CLOSURE] * opened, bridge)
    if c[TUCK] != 0.0:
        tuck_lip(skin, before_jaw, rows, tuck_share, c[TUCK])
    close_lips(skin, c[CLOSURE], opened, numbers, shares, gaps, moves, touching)
    stay_off_teeth(skin, over_teeth, front)
    closed = closing(c[OPENING], rest_opening), closing(c[OPENING + 1], rest_opening)
    move_lids(skin, lid_numbers, lid_polar, lid_rest, closed, (elevation_deg(gaze[0, 1]), elevation_deg(gaze[1, 1])))
    meet_lids(skin, lid_pairs, lid_gaps, closed)


@kernel()
def place_eyes(c, skin, gaze, parts, balls, rings, angles, pivot, radii, points, normals):
    """Fill the eyes of ``points`` and ``normals`` (V, 3): balls, spots, and the pink corners between the lids.

    Args:
        c: a row of controls.
        skin: (S, 3) m, posed.
        gaze: (2, 3) directions of the eyes.
        parts: first vertex of each of ``PARTS``.
        balls: (2, 4) m, centre and radius.
        rings: steps and circle of ``place_eye``, grid of ``place_spot``, corners (2, 5) of ``place_caruncle``.
        angles: turn, nod and tilt of the head, radians.
        pivot: of the turned head, m.
        radii: (7, 2), overwritten.
        points: filled.
        normals: filled.
    """
    steps, circle, grid, corners = rings
    light, viewer = seen_from_rest(c, LIGHT, angles, pivot), seen_from_rest(c, VIEWER, angles, pivot)
    # What the head's scale will stretch is squeezed before, so that irises stay round.
    wide = np.sqrt(c[SCALE + 1] / c[SCALE])
    for side in range(2):
        centre, radius, forward = balls[side], balls[side, 3], gaze[side]
        ball, spot, corner = parts[EYE + side], parts[SPOTS + side], parts[CARUNCLE + side]
        fill_radii(c[IRIS + side], c[PUPIL + side], c[FRINGE + side], radii)
        place_eye(centre, radius, forward, radii, wide, steps, circle, points[ball:], normals[ball:])
        sizes = c[IRIS + side], c[SPOT + side]
        place_spot(centre, radius, forward, sizes, light, viewer, grid, points[spot:])
        place_caruncle(skin, corners[side], centre, radius, side == 1, points[corner:])


@kernel()
def place_hairs(c, skin, parts, balls, lashes, brows, beard, under, normals, points):
    """Fill the lashes, brows and beard of ``points`` (V, 3) m.

    Args:
        c: a row of controls.
        skin: (S, 3) m, posed.
        parts: first vertex of each of ``PARTS``.
        balls: (2, 4) m, centre and radius.
        lashes: index, weight, reach (2, K, B) of ``place_lashes``.
        brows: index, weight (2, K, B), offset of ``place_brows``.
        beard: index, weight (K, 1), offset of ``place_brows``.
        under: quads, vertices, starts, columns of ``sum_normals``.
        normals: (S, 3), overwritten.
        points: filled.
    """
    index, weight, reach = lashes
    brow_index, brow_weight, offset = brows
    quads, vertices, starts, columns = under
    sum_normals(skin, quads, vertices, starts, columns, normals)
    beard_index, beard_weight, beard_offset = beard
    place_brows(beard_index, beard_weight, beard_offset, skin, normals, points[parts[BEARD] :])
    for side in range(2):
        lash, brow = points[parts[LASH + side] :], points[parts[BROW + side] :]
        place_lashes(index[side], weight[side], reach[side], skin, balls[side], 1.0 - 2.0 * side, lash)
        place_brows(brow_index[side], brow_weight[side], offset, skin, normals, brow)
        if c[THICKNESS + side] != 1.0 or c[BROW_SHAPE + side] != 0.5:
            shape_brow(c[THICKNESS + side], c[BROW_SHAPE + side], brow[: len(offset)])


@kernel()
def place_inside(c, parts, carried, tongue, jaw_axis, chin, lips, points):
    """Move teeth, gums and tongue of ``points`` (V, 3) m, which are at rest.

    Args:
        c: a row of controls.
        parts: first vertex of each of ``PARTS``.
        carried: (K,) whether a vertex, from the first of the teeth on, goes with the jaw.
        tongue: profile and edges of ``move_tongue``.
        jaw_axis: (2,) m.
        chin: (3, 3) m of ``chin_shift``.
        lips: of ``move_tongue``.
        points: changed.
    """
    first, behind, last = parts[TEETH], parts[TONGUE], parts[END]
    shift = chin_shift(c[JAW_FORWARD], c[JAW_SIDE], chin)
    carry_with_jaw(points[first:behind], carried, c[JAW], jaw_axis, shift)
    profile, edges = tongue
    tip = c[TIP], c[TIP + 1], c[TIP + 2], c[TIP + 3]
    move_tongue(points[behind:last], profile, edges, tip, c[JAW], jaw_axis, shift, lips)


@kernel()
def darken(parts, balls, lip_edge, points, colors):
    """Darken colours (V, 3) where lids and lips cast shadows on points (V, 3) m that are not turned yet.

    ``lip_edge`` is the vertex in the middle of the upper lip's edge.
    """
    for side in range(2):
        first, last = parts[EYE + side], parts[EYE + side] + parts[SPOTS] - parts[EYE]
        darken_eye(colors[first:last], points[first:last], balls[side])
    first, last = parts[TEETH], parts[END]
    darken_mouth(colors[first:last], points[first:last], points[lip_edge, 1])


@kernel("f8[:,:], i8[:], f8[:,:], f8[:,:]")
def weigh_moves(values, columns, rules, weights):
    """Fill ``weights`` (N, M) with how much of each move is added in the poses ``values`` (N, P)."""
    for frame in range(len(values)):
        for k in range(len(columns)):
            amount = (values[frame, columns[k]] - rules[k, 0]) / rules[k, 1]
            if rules[k, 3] > 0.0:
                amount = max(amount, 0.0)
            weights[frame, k] = amount * rules[k, 2]


@kernel("f8[:,:], f8[:,:], f8[:], f8[:,:]")
def add_moves(weights, deltas, rest, skins):
    """Fill ``skins`` (N, 3 V) m with the resting one (3 V,) and what the weights (N, M) add, move after move."""
    for frame in range(len(weights)):
        skin = skins[frame]
        for i in range(len(rest)):
            skin[i] = rest[i]
        for k in range(len(deltas)):
            weight, delta = weights[frame, k], deltas[k]
            if weight != 0.0:
                for i in range(len(rest)):
                    skin[i] += weight * delta[i]


@kernel("f8[:], i8[:,:], f8[:,:], i8[:,:], f8[:], f8[:], f8[:,:]")
def fold_colors(values, drivers, rules, places, dark, amounts, colors):
    """Darken the colours (V, 3) of a head in a pose (P,) where its skin folds: see ``fold_skin``."""
    fold_skin(values, drivers, rules, places, dark, amounts, colors)


# fmt: off
@kernel(
    "f8[:,:], i8[:], f8[:,:], f8[:], "  # who and how
    "i8[:], f8[:,:], i8[:], f8[:], "  # lips
    "f8[:], f8[:], f8, f8[:,:], "  # jaw
    "f8[:,:], i8[:,:,:], f8[:], f8[:,:], i8[:], f8[:], "  # contacts
    "i8[:,:], f8[:,:], f8[:,:], i8[:,:,:], f8[:,:], f8, f8[:], "  # lids
    "i8[:], "  # skin
    "i8[:], f8[:,:], f8[:,:], i8[:,:], "  # rings of the eyes
    "i8[:,:,:], f8[:,:,:], f8[:,:,:], "  # lashes
    "i8[:,:,:], f8[:,:,:], f8[:], "  # brows
    "i8[:,:], f8[:,:], f8[:], "  # beard
    "i8[:,:], i8[:], i8[:], i8[:], "  # polygons under the brows
    "b1[:], f8[:,:], f8[:,:], f8[:,:], "  # inside of the mouth
    "i8[:], f8[:,:], b1[:], i8, "  # skin before the teeth
    "i8[:,:,:], f8[:], "  # polygons that stay plane
    "i8, f8[:], "  # lip's edge, neck
    "f8[:], "  # what no expression moves
    "f8[:,:], i8[:], f8[:,:], f8[:,:], "  # steps of the shape
    "i8[:], i8[:], f8[:,:], "  # what the skin takes of them
    "i8[:], i8[:], f8[:,:], "  # what the inside of the mouth takes of them
    "i8[:], i8[:], f8[:,:], "  # what is held takes of them
    "f8[:,:], f8[:,:], f8[:,:,:], f8[:,:], f8[:,:], f8[:,:], "  # scratch
    "f8[:,:,:], f8[:,:,:], f8[:,:], f8[:,:,:], f8[:,:,:]"
)
def pose_heads(
    controls, parts, balls, kappa_deg,
    lips, lip_regions, mouth_ends, tuck_share,
    jaw_axis, jaw_share, open_angle_deg, jaw_residual,
    bridge, contact_numbers, contact_shares, contact_gaps, over_teeth, teeth_front,
    lid_numbers, lid_polar, lid_rest, lid_pairs, lid_gaps, rest_opening, clear_of_balls,
    source,
    steps, circle, grid, corners,
    lash_index, lash_weight, lash_reach,
    brow_index, brow_weight, brow_offset,
    beard_index, beard_weight, beard_offset,
    quads, brow_vertices, brow_starts, brow_quads,
    carried, tongue_profile, tooth_edges, chin,
    before, clearance, edge, chin_end,
    plane_pairs, plane_free,
    lip_edge, neck_share,
    rest,
    amounts, kinds, axes, origins,
    skin_starts, skin_rows, skin_weights,
    inside_starts, inside_rows, inside_weights,
    held_starts, held_rows, held_weights,
    gaze, radii, scratch, waves, held, touching,
    skins, points, flat, normals, colors,
):
    """Fill the points of N heads, and the normals and shadows of as many as there is room for.

    Args:
        controls: (N, D) values of ``CONTROLS``.
        parts: first vertex of each of ``PARTS``.
        balls: (3, 4) m, centre and radius of the eyes, and the neck's pivot; kappa_deg: of ``aim_eyes``.
        lips: lip_regions, mouth_ends, tuck_share, jaw, contacts, lids: of ``deform_skin``.
        source: (K,) vertex of the skin of each of the first K vertices.
        steps: circle, grid, corners: of ``place_eyes``.
        lash_index: and what follows: of ``place_hairs``.
        carried: and what follows: of ``place_inside``.
        clear_of_balls: of ``keep_off_balls``.
        before: clearance, edge: of ``push_before``; chin_end: of ``lift_row``.
        plane_pairs: and plane_free: of ``plane_skin``.
        lip_edge: of ``darken``.
        neck_share: of ``turn_all``.
        rest: (3 R,) m, of the vertices from the first of the teeth on: at rest inside the mouth, shaped beyond it.
        amounts: (N, K), and what follows: of ``shape_points``, for the skin, the inside of the mouth, and the balls.
        gaze: (2, 3), radii (7, 2), scratch (2, S, 3), waves (2, S), held (3, 4), touching (C, 4): overwritten.
        skins: (N, S, 3) m with their moves; changed.
        points: (N, V, 3) m, filled.
        flat: (N, 3 V), the same memory: a run of numbers is copied several at a time.
        normals: (1 or N, V, 3) of the eyes, filled; a single one again and again.
        colors: (0 or N, V, 3), darkened by shadows.
    """
    # fmt: on
    for frame in range(len(controls)):
        c, skin, out, around = controls[frame], skins[frame], points[frame], normals[min(frame, len(normals) - 1)]
        angles = c[TURN] * DEG, c[NOD] * DEG, c[TILT] * DEG
        shape = amounts[frame], kinds, axes, origins
        shape_held(balls, shape, held_starts, held_rows, held_weights, held)
        pivot = held[2, 0] * c[SCALE], held[2, 1] * c[SCALE + 1], held[2, 2] * c[SCALE + 2]
        aim_eyes(c, held, kappa_deg, angles, pivot, gaze)
        jaw = jaw_axis, jaw_share, open_angle_deg, jaw_residual
        contacts = bridge, contact_numbers, contact_shares, contact_gaps, over_teeth, teeth_front
        lids = lid_numbers, lid_polar, lid_rest, lid_pairs, lid_gaps, rest_opening
        mouth = lips, lip_regions, mouth_ends, tuck_share
        deform_skin(c, skin, gaze, mouth, jaw, contacts, lids, scratch, waves, touching)
        upper, lower, red = contact_numbers[0, 0, 0], contact_numbers[0, 1, 0], contact_numbers[0, 1, RED]
        edges = skin[upper, 1], max(skin[lower, 1], skin[red, 1]), skin[lower, 2], skin[red, 2]
        shape_points(skin, shape, skin_starts, skin_rows, skin_weights)
        stretch = stretch_of(amounts[frame], kinds, axes)
        keep_off_balls(skin, lid_numbers, clear_of_balls, stretch, balls, held)
        run = flat[frame, 3 * parts[TEETH] :]
        for i in range(len(rest)):
            run[i] = rest[i]
        place_inside(c, parts, carried, (tongue_profile, tooth_edges), jaw_axis, chin, edges, out)
        inside, outlines, pressed = out[parts[TEETH] : parts[END]], scratch[:, :WAYS], scratch[:, WAYS : 2 * WAYS]
        shape_points(inside, shape, inside_starts, inside_rows, inside_weights)
        lift_row(inside, carried, skin[chin_end, 1])
        upright = trace_rows(inside, carried[: parts[TONGUE] - parts[TEETH]], outlines)
        push_before(skin, (before, clearance, edge), c[ROLLED : ROLLED + 2], upright, outlines, pressed)
        give_way(inside, carried, upright, pressed)
        seal_lips(skin, contact_numbers, contact_shares, touching)
        plane_skin(skin, plane_pairs, plane_free, c[SCALE : SCALE + 3], scratch[0], scratch[1])
        for v in range(len(source)):
            for axis in range(3):
                out[v, axis] = skin[source[v], axis]
        place_eyes(c, skin, gaze, parts, held, (steps, circle, grid, corners), angles, pivot, radii, out, around)
        lashes, brows = (lash_index, lash_weight, lash_reach), (brow_index, brow_weight, brow_offset)
        beard = beard_index, beard_weight, beard_offset
        under = quads, brow_vertices, brow_starts, brow_quads
        place_hairs(c, skin, parts, held, lashes, brows, beard, under, scratch[0], out)
        if frame < len(colors):
            darken(parts, held, lip_edge, out, colors[frame])
        scale, ball = (c[SCALE], c[SCALE + 1], c[SCALE + 2]), parts[SPOTS] - parts[EYE]
        eyes = around[parts[EYE] : parts[EYE] + ball], around[parts[EYE + 1] : parts[EYE + 1] + ball]
        if scale != (1.0, 1.0, 1.0):
            scale_all(out, eyes, scale)
        if angles != (0.0, 0.0, 0.0) or c[FORWARD] != 0.0:
            turn_all(out, eyes, neck_share, angles, pivot, c[FORWARD] * MM)
