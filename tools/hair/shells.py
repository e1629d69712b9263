"""Closed shells of hair: grids of strands from a parting to a hem that is turned under, and tubes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from .skull import CENTRE, Skull, directions

SUNK_M = 0.0016
"""How deep the end of a strand that thins out lies below the skin."""
MIN_STRAND_M = 0.004
OPAQUE_M = 0.005
"""How far off the skin hair has its own colour only, however near to the hem."""


@dataclass(frozen=True, eq=False)
class Shell:
    """Vertices (N, 3) m, polygons (F, 4), and brightness and share of skin (N, 2)."""

    points: np.ndarray
    quads: np.ndarray
    shade: np.ndarray


@dataclass(frozen=True)
class Cap:
    """A shell over the skull.

    Attributes:
        hem: azimuth in degrees from the front, and height (m) of the hem.
        thick: azimuth, and thickness (m).
        crown: elevation of the pole in degrees; more than 90 lies behind the top.
        part: length of the parting that stands for the pole, degrees.
        groove: depth of the locks, m.
        locks: how many there are around.
        lump: height of the lumps of curly hair, m; lump_size: how wide they are, m.
        taper: length over which a strand thins out into the skin, m; 0 for a hem that hangs.
        flat: whether it thins out little by little, not in a round.
        hang: elevation in degrees below which hair falls.
        flare: how far it swings outwards, m after a fall of 12 cm.
        top: thickness at the pole over that at the sides.
        rim: azimuth and height of the upper rim of a ring of hair.
        tuft: more thickness over the forehead, m.
        ragged: how uneven the hem is, m.
        line: azimuth of a side parting, degrees to the own left; 0 for none.
        swirl: how far locks in front run aslant, radians; away from a side parting on both sides.
        columns, rows: of the grid.
        seed: of the locks.
        fade: length over which its colour becomes the skin's, m.
    """

    hem: tuple[tuple[float, float], ...]
    thick: tuple[tuple[float, float], ...] = ((0, 0.008), (180, 0.008))
    crown: float = 100.0
    part: float = 0.0
    groove: float = 0.0012
    locks: int = 22
    lump: float = 0.0
    lump_size: float = 0.016
    taper: float = 0.0
    flat: bool = False
    hang: float = -8.0
    flare: float = 0.0
    top: float = 1.0
    rim: tuple[tuple[float, float], ...] = ()
    tuft: float = 0.0
    ragged: float = 0.0
    line: float = 0.0
    swirl: float = 0.0
    columns: int = 96
    rows: int = 21
    seed: int = 1
    fade: float = 0.0035

    @property
    def parting(self) -> float:
        """Azimuth of the side parting, radians."""
        return float(np.radians(self.line))


def smooth(x: np.ndarray) -> np.ndarray:
    """0..1 by a smooth step."""
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


def _table(rows: tuple[tuple[float, float], ...], azimuth: np.ndarray) -> np.ndarray:
    """Values at azimuths (radians), the same on both sides of the head."""
    away = np.degrees(np.abs(_turned(azimuth)))
    knots = np.array(sorted(rows))
    left = knots[knots[:, 0] > 0][:1] * [-1, 1]
    return PchipInterpolator(*np.concatenate([left, knots]).T, extrapolate=True)(away)


def _azimuths(cap: Cap) -> np.ndarray:
    """(M,) azimuths of the columns, denser where the hem is steep and beside a side parting."""
    fine = np.linspace(0.0, np.pi, 721)
    height = _table(cap.hem, fine)
    step = np.hypot(np.diff(fine) * 0.085, np.diff(height) * 0.8)
    along = np.concatenate([[0.0], np.cumsum(step)])
    half = cap.columns // 2
    left = np.interp((np.arange(half) + 0.5) / half * along[-1], along, fine)
    both = np.concatenate([left, 2 * np.pi - left[::-1]])
    if not cap.line:
        return both
    off = _turned(both - cap.parting)
    return cap.parting + off * (1.0 - 0.8 * np.exp(-((off / 0.25) ** 2)))  # five times as dense at the parting


def _turned(angle: np.ndarray) -> np.ndarray:
    """Angles in radians as -pi..pi."""
    return np.mod(angle + np.pi, 2 * np.pi) - np.pi


def _noise(rng: np.random.Generator, azimuth: np.ndarray, along: np.ndarray, cap: Cap) -> np.ndarray:
    """(M, R) of about -1..1: locks that run along the strands and wander a little."""
    out = np.zeros(along.shape)
    bend = cap.swirl * np.clip(np.cos(azimuth), 0.0, 1.0)
    if cap.line:
        bend = bend * np.tanh(_turned(azimuth - cap.parting) / 0.15)
    for share, count in ((0.55, cap.locks), (0.3, cap.locks * 0.55), (0.35, cap.locks * 1.6)):
        number = max(1, round(count))
        phase, wander = rng.uniform(0, 2 * np.pi, 2)
        drift = 0.8 * np.sin(2.2 * along + wander) + number * along * bend[:, None]
        out += share * np.sin(number * azimuth[:, None] + phase + drift + 0.7 * np.sin(3 * azimuth[:, None] + wander))
    return out * smooth(along / 0.25)


def _lumps(points: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """(...) 0..1: rounded lumps about ``size`` m across, with furrows between them."""
    flat = points.reshape(-1, 3)
    seeds: list[np.ndarray] = []
    for point in flat[rng.permutation(len(flat))]:
        if all(((point - seed) ** 2).sum() > (0.8 * size) ** 2 for seed in seeds):
            seeds.append(point + rng.normal(0.0, 0.08 * size, 3))
    near = np.sqrt(((flat[:, None] - np.array(seeds)[None]) ** 2).sum(axis=2)).min(axis=1)
    return np.sqrt(np.clip(1.0 - (near / (0.62 * size)) ** 2, 0.0, 1.0)).reshape(points.shape[:-1])


def cap_shell(cap: Cap, skull: Skull) -> Shell:
    """The shell of a cap: rows from the pole to the hem, then turned under into the skin."""
    rng = np.random.default_rng(cap.seed)
    azimuth = _azimuths(cap)
    grid, along, left = _strands(cap, skull, azimuth)
    noise = _noise(rng, azimuth, along, cap) if cap.locks else np.zeros(along.shape)
    line, lift = _parting(cap, azimuth, grid, along)
    lift = lift + cap.groove * noise
    if cap.lump:
        lift = lift + cap.lump * (_lumps(grid, cap.lump_size, rng) - 0.5)
    fade = np.zeros(along.shape)
    outward = _outward(grid)
    if cap.taper:
        thin = _thinned(cap, left)
        fade = np.maximum(fade, _faded(cap, left))
        if cap.rim:
            start = left[:, :1] - left
            thin = thin * _thinned(cap, start)
            fade = np.maximum(fade, _faded(cap, start))
        base, size = _grounded(grid, skull)
        height = np.maximum(size + lift, 0.0012) * thin - SUNK_M * (1.0 - thin)
        grid = base + outward * height[..., None]
        fade = np.maximum(fade * smooth((OPAQUE_M - height) / OPAQUE_M), 0.6 * line)
    else:
        grid = grid + outward * (lift * smooth(along * 3.0))[..., None]
    bright = 1.0 + 0.16 * noise + 0.07 * smooth((along - 0.6) / 0.4) + 0.16 * np.exp(-(((along - 0.38) / 0.13) ** 2))
    bright = bright - 0.22 * smooth(1.0 - along / 0.12) - 0.15 * line
    if cap.lump:
        bright = 0.72 + 0.42 * np.clip(0.5 + (lift / cap.lump), 0.0, 1.2)
    turned, dark = _turn_under(grid, cap)
    points = np.concatenate([grid, turned], axis=1)
    shade = np.stack([bright, fade], axis=2)
    under = np.stack([np.tile(dark, (len(azimuth), 1)), np.repeat(fade[:, -1:], len(dark), axis=1)], axis=2)
    shade = np.concatenate([shade, under], axis=1)
    return _close(points, shade, not cap.rim)


def _strands(cap: Cap, skull: Skull, azimuth: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(M, R, 3) m from the pole to the hem, the share (M, R) of the way gone, and what is left of it in m."""
    end = _table(cap.hem, azimuth)
    end = end + cap.ragged * (np.sin(13 * azimuth) + 0.6 * np.sin(22 * azimuth + 1.0))
    fine = _paths(cap, skull, azimuth, _table(cap.thick, azimuth))
    start = _table(cap.rim, azimuth) if cap.rim else np.full(len(azimuth), np.inf)
    grid = np.empty((len(azimuth), cap.rows, 3))
    left = np.empty(grid.shape[:2])
    for column, path in enumerate(fine):
        gone = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
        first, last = _down_to(start[column], path, gone), _down_to(end[column], path, gone)
        left[column] = _rows(cap, max(last - first, MIN_STRAND_M))
        at = first + left[column, 0] - left[column]
        grid[column] = np.stack([np.interp(at, gone, path[:, axis]) for axis in range(3)], axis=1)
    return grid, 1.0 - left / left[:, :1], left


def _down_to(height: float, path: np.ndarray, gone: np.ndarray) -> float:
    """How far, m, a path (K, 3) has gone, by ``gone`` (K,), when it first comes down to a height."""
    below = np.flatnonzero((path[:-1, 1] > height) & (path[1:, 1] <= height))
    if not len(below):
        return 0.0 if path[0, 1] <= height else float(gone[-1])
    k = below[0]
    return float(np.interp(-height, -path[k : k + 2, 1], gone[k : k + 2]))


def _rows(cap: Cap, length: float) -> np.ndarray:
    """(R,) m that is left of a strand at each row: denser where colour and thickness fade."""
    if not cap.taper:
        return length * np.linspace(1.0, 0.0, cap.rows)
    near = cap.fade * np.array([1.6, 1.0, 0.6, 0.3, 0.0]) * min(1.0, 0.2 * length / cap.fade)
    far = cap.rows - len(near)
    if cap.rim:
        far -= len(near)
        return np.concatenate([length - near[::-1], np.linspace(length - near[0], near[0], far + 2)[1:-1], near])
    # Steps that shrink towards the hem.
    return np.concatenate([near[0] + (length - near[0]) * np.linspace(1.0, 0.0, far + 1)[:-1] ** 1.4, near])


def _thinned(cap: Cap, left: np.ndarray) -> np.ndarray:
    """0..1 of the thickness so far from the hem, which lies below the skin."""
    way = np.clip(left / cap.taper, 0.0, 1.0)
    return way * (2.0 - way) if cap.flat else np.sqrt(way * (2.0 - way))


def _faded(cap: Cap, left: np.ndarray) -> np.ndarray:
    """0..1 of the skin's colour so far from the hem; all of it where the strand leaves the skin."""
    hidden = (0.12 if cap.flat else 0.015) * cap.taper
    return smooth(1.0 - (left - hidden) / cap.fade)


def _parting(cap: Cap, azimuth: np.ndarray, grid: np.ndarray, along: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(M, R) 0..1 on a side parting, and the lift (m) of the hair swept away from it to the own right."""
    if not cap.line:
        return np.zeros(along.shape), np.zeros(along.shape)
    across = _turned(azimuth - cap.parting)[:, None] * np.hypot(grid[..., 0], grid[..., 2] - CENTRE[2])
    on = smooth((along - 0.25) / 0.2)
    line = np.exp(-((across / 0.0016) ** 2)) * on
    swept = smooth(-across / 0.016) * smooth((0.135 + across) / 0.11) * smooth((grid[..., 1] - 0.05) / 0.03)
    front = smooth((grid[..., 2] - 0.005) / 0.05)
    return line, on * (cap.tuft * swept * (0.35 + 0.65 * front) - 0.007 * np.exp(-((across / 0.0035) ** 2)))


def _paths(cap: Cap, skull: Skull, azimuth: np.ndarray, thick: np.ndarray) -> np.ndarray:
    """(M, K, 3) m: each column over the skull, then straight down."""
    half = np.radians(cap.part) / 2.0
    pole = np.radians(cap.crown) - half
    offset = half * np.cos(azimuth)
    up = np.pi - (pole - offset)
    root = directions(np.full(len(azimuth), np.pi), up)
    root += 0.06 * directions(azimuth, np.zeros(len(azimuth)))
    root /= np.linalg.norm(root, axis=1, keepdims=True)
    side = directions(azimuth, np.full(len(azimuth), np.radians(cap.hang)))
    share = np.linspace(0.0, 1.0, 90)
    ways = root[:, None] * (1.0 - share[:, None]) + side[:, None] * share[:, None]
    ways /= np.linalg.norm(ways, axis=2, keepdims=True)
    a, e = np.arctan2(ways[..., 0], ways[..., 2]), np.arcsin(np.clip(ways[..., 1], -1, 1))
    # One thickness at the pole, where all columns meet.
    own = smooth(share / 0.7)
    size = (thick[:, None] * own + thick.mean() * (1.0 - own)) * (cap.top + (1.0 - cap.top) * smooth(share))
    if not cap.line:
        size = size + cap.tuft * smooth((ways[..., 2] - 0.25) / 0.5) * smooth((e - 0.35) / 0.5)
    over = CENTRE + ways * (skull.radius(a, e) + size)[..., None]
    heights = np.linspace(0.0, 1.0, 120)[None] * (-0.24 - over[:, -1, 1])[:, None] + over[:, -1, 1][:, None]
    first = np.hypot(over[:, -1, 0], over[:, -1, 2] - CENTRE[2])
    drop = (over[:, -1, 1][:, None] - heights) / 0.12
    free = first[:, None] + cap.flare * drop * drop
    reach = skull.reach(np.repeat(azimuth[:, None], 120, axis=1), heights) + 0.006
    if cap.taper:
        wide = reach - 0.006 + thick[:, None] * 1.0
        blend = smooth((over[:, -1, 1][:, None] - heights) / 0.03)
        wide = free * (1.0 - blend) + wide * blend
    else:
        wide = np.where(heights < -0.115, np.maximum(free, np.minimum(reach, free + 0.012)), free)
    way = directions(azimuth, np.zeros(len(azimuth)))[:, None]
    fall = way * wide[..., None]
    fall[..., 1] = heights
    fall[..., 2] += CENTRE[2]
    return np.concatenate([over, fall[:, 1:]], axis=1)


def _outward(grid: np.ndarray) -> np.ndarray:
    across = np.roll(grid, -1, axis=0) - np.roll(grid, 1, axis=0)
    along = np.gradient(grid, axis=1)
    normal = np.cross(along, across)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True) + 1e-12
    return normal


def _grounded(grid: np.ndarray, skull: Skull) -> tuple[np.ndarray, np.ndarray]:
    """The skin beneath a grid, and how far the grid stands off it."""
    way = grid - CENTRE
    radius = np.linalg.norm(way, axis=2)
    way = way / radius[..., None]
    skin = skull.radius(np.arctan2(way[..., 0], way[..., 2]), np.arcsin(np.clip(way[..., 1], -1, 1)))
    return CENTRE + way * skin[..., None], radius - skin


def _turn_under(grid: np.ndarray, cap: Cap) -> tuple[np.ndarray, np.ndarray]:
    """(M, T, 3) rows after the hem, and their brightness: rounded, then far into the head."""
    last, before = grid[:, -1], grid[:, -2]
    axis = np.stack([np.zeros(len(last)), np.minimum(last[:, 1] + 0.02, 0.02), np.full(len(last), -0.012)], axis=1)
    inward = axis - last
    size = np.linalg.norm(inward, axis=1, keepdims=True)
    inward = inward / size
    if cap.taper:
        return (last + inward * 0.006)[:, None], np.array([0.8])
    on = last - before
    on = on / (np.linalg.norm(on, axis=1, keepdims=True) + 1e-12)
    depth = 0.0035
    rows = [
        last + on * depth * 0.7 + inward * depth * 0.5,
        last + on * depth * 0.8 + inward * depth * 1.5,
        last + inward * 0.012,
        last + inward * np.minimum(size * 0.55, 0.05),
    ]
    return np.stack(rows, axis=1), np.array([0.92, 0.75, 0.5, 0.35])


def _close(points: np.ndarray, shade: np.ndarray, lid: bool) -> Shell:
    """A shell of a grid (M, R, 3) that closes around; with a lid over the parting."""
    count, rows = points.shape[:2]
    number = np.arange(count * rows).reshape(count, rows)
    beside = np.roll(number, -1, axis=0)
    quads = np.stack([number[:, :-1], number[:, 1:], beside[:, 1:], beside[:, :-1]], axis=2).reshape(-1, 4)
    if lid:
        first = number[:, 0]
        j = np.arange(count // 2 - 1)
        over = np.stack([first[j], first[j + 1], first[count - 2 - j], first[count - 1 - j]], axis=1)
        quads = np.concatenate([quads, over])
    return Shell(points.reshape(-1, 3), quads, shade.reshape(-1, 2))


def tube(
    spine: np.ndarray,
    radii: np.ndarray,
    sides: int = 14,
    flat: float = 1.0,
    locks: int = 5,
    twist: float = 0.0,
    furrow: float = 0.07,
) -> Shell:
    """A closed tube along a spine (K, 3) m with radii (K,): both ends rounded shut, locks between furrows."""
    ahead = np.gradient(spine, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    side = np.cross(ahead, np.array([0.3, 0.2, 1.0]))
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, ahead)
    angle = (np.arange(sides) + 0.5) * 2 * np.pi / sides
    turn = angle[None] + twist * np.linspace(0.0, 1.0, len(spine))[:, None]
    lock = np.sin(locks * angle)[None] * np.ones((len(spine), 1))
    size = radii[:, None] * (1.0 + furrow * lock)
    ring = spine[:, None] + size[..., None] * (
        side[:, None] * np.cos(turn)[..., None] + flat * up[:, None] * np.sin(turn)[..., None]
    )
    points = ring.transpose(1, 0, 2)
    shine = 1.0 + 2.0 * furrow * lock.T
    shell = _close(points, np.stack([shine, np.zeros_like(shine)], axis=2), True)
    rows = len(spine)
    last = np.arange(sides) * rows + rows - 1
    j = np.arange(sides // 2 - 1)
    end = np.stack([last[sides - 1 - j], last[sides - 2 - j], last[j + 1], last[j]], axis=1)
    return Shell(shell.points, np.concatenate([shell.quads, end]), shell.shade)


def rounded(count: int, body: np.ndarray, start: float = 0.25, end: float = 0.2) -> np.ndarray:
    """(K,) radii: those of a body, interpolated, that close in half circles at both ends."""
    t = np.linspace(0.0, 1.0, count)
    size = PchipInterpolator(np.linspace(0, 1, len(body)), body)(t)
    near, far = np.clip(t / start, 0.0, 1.0), np.clip((1.0 - t) / end, 0.0, 1.0)
    return size * np.sqrt(np.clip(1 - (1 - near) ** 2, 0.03, 1)) * np.sqrt(np.clip(1 - (1 - far) ** 2, 0.03, 1))


def joined(*shells: Shell) -> Shell:
    """Shells as one, each turned so that its polygons face outwards."""
    points, quads, shades, first = [], [], [], 0
    for shell in shells:
        points.append(shell.points)
        quads.append(_faced(shell) + first)
        shades.append(shell.shade)
        first += len(shell.points)
    return Shell(np.concatenate(points), np.concatenate(quads), np.concatenate(shades))


def _faced(shell: Shell) -> np.ndarray:
    a, b, c, d = (shell.points[shell.quads[:, k]] for k in range(4))
    normal = np.cross(c - a, d - b)
    middle = 0.25 * (a + b + c + d) - shell.points.mean(axis=0)
    return shell.quads if (normal * middle).sum() > 0 else shell.quads[:, ::-1]
