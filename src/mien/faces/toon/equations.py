"""Thórisson's equations: how vertices follow the lines between control points, and how states become one another.

Source: Thórisson 1996, A1.2.3, equations A1.1 to A1.6.
"""

from __future__ import annotations

import numpy as np

from .records import Floats

JOINT_SHARE = 0.05
"""A vertex that is nearer to its second line than this share of its length follows both: outlines do not tear there."""

NO_LENGTH = 1e-9


def place_along(vertices: Floats, start: Floats, end: Floats) -> tuple[Floats, Floats]:
    """Place of vertices (N, 2) along a line, as a share of it (N,), and signed distance from it (N,).

    Thórisson measures the share along the horizontal and the distance along the vertical, which an upright line leaves
    undefined; along the line and across it they are the same for level lines and exist for all.
    """
    along, length = _direction(start, end)
    offset = vertices - start
    share = (offset[:, 0] * along[0] + offset[:, 1] * along[1]) / (length if length > NO_LENGTH else 1.0)
    return share, offset[:, 1] * along[0] - offset[:, 0] * along[1]


def put_along(share: Floats, distance: Floats, start: Floats, end: Floats) -> Floats:
    """(N, 2) vertices at a share of a line and a distance from it: X = H0 + vrl (H1 - H0) (A1.3), Y = X SL + IYL + d
    (A1.4), the distance taken across the line.

    With SL = (V1 - V0) / (H1 - H0) (A1.1) and IYL = V0 - SL H0 (A1.2), X SL + IYL is V0 + vrl (V1 - V0), which needs no
    slope and so exists for upright lines.
    """
    along, _ = _direction(start, end)
    x = start[0] + share * (end[0] - start[0]) - distance * along[1]
    y = start[1] + share * (end[1] - start[1]) + distance * along[0]
    return np.stack([x, y], axis=1)


def joint_shares(vertices: Floats, lines: list[tuple[Floats, Floats]]) -> Floats:
    """(L, N) share of each line in the movement of each vertex (N, 2).

    The nearest line moves a vertex. Which one that is changes along the halves of the angles between lines; near them
    the two nearest share it, so that neighbours never part. The paper leaves this open.
    """
    distances = np.stack([_distance(vertices, start, end) for start, end in lines])
    if len(lines) == 1:
        return np.ones_like(distances)
    order = np.argsort(distances, axis=0, kind="stable")
    near, next_near = (np.take_along_axis(distances, order[k : k + 1], axis=0)[0] for k in (0, 1))
    lengths = [_direction(start, end)[1] for start, end in lines]
    reach = max(JOINT_SHARE * min(lengths), NO_LENGTH)
    apart = np.clip((next_near - near) / reach, 0.0, 1.0)
    share = 0.5 + 0.5 * apart * apart * (3.0 - 2.0 * apart)
    shares = np.zeros_like(distances)
    np.put_along_axis(shares, order[:1], share[None], axis=0)
    np.put_along_axis(shares, order[1:2], (1.0 - share)[None], axis=0)
    return shares


def between_states(low: Floats, high: Floats, share: float) -> Floats:
    """Vertices (N, 2) between those of the minimum and those of the maximum: V_min + P_ctrl (V_max - V_min)
    (A1.5, A1.6)."""
    return low + share * (high - low)


def _direction(start: Floats, end: Floats) -> tuple[tuple[float, float], float]:
    """Direction of a line, level where it has no length, and its length."""
    run, rise = float(end[0] - start[0]), float(end[1] - start[1])
    length = (run * run + rise * rise) ** 0.5
    return ((run / length, rise / length) if length > NO_LENGTH else (1.0, 0.0)), length


def _distance(vertices: Floats, start: Floats, end: Floats) -> Floats:
    share = np.clip(place_along(vertices, start, end)[0], 0.0, 1.0)[:, None]
    apart = vertices - (start + share * (end - start))
    return np.sqrt((apart * apart).sum(axis=1))
