"""The left half of a face as polygons over named points: skin, and what a head has and wears besides."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np
from hair.shells import Cap, cap_shell
from hair.skull import Skull

from mien.faces.head.carrying import bind_to_skin
from mien.faces.head.measured import archive

FLIP = np.array([-1.0, 1.0, 1.0])
SIDES = 12
EYE_RINGS = (0.20, 0.36, 0.475, 0.525, 0.72, 0.95)
"""Sines of the rings of an eye: pupil, iris in two, the dark ring around it, and two rings of white."""
EYE_LABELS = ("iris", "iris", "fringe", "white", "white")
SPOT = 0.085
TOOTH_RINGS, TOOTH_CORNERS = (0, 1, 3), (7, 0, 2, 3)
FRONT_TEETH = {"upper": tuple(range(4, 16, 2)), "lower": tuple(range(24, 32, 2))}
"""Of the left crowns, the upper first molar or the lower first premolar to the central incisor."""
LOWER_M = {"upper": 0.002, "lower": -0.0015}
"""How much lower the teeth of a jaw stand than in the shipped head: lips that open show both rows."""
LINING = {"mj": (0.8, 0.004), "mk": (0.8, 0.0)}
"""Rings of the inside of the mouth: how wide they are, and how much further back than in the shipped head, m. What no
photograph shows is guessed roughly, and a lining as wide as the shipped head's came through the chin."""
TONGUE_LOWER_M = 0.002
"""And how much lower the tongue lies, which goes along with all of the jaw's turn."""
BROW_STATIONS, BROW_ROWS = (0, 2, 4, 6, 8, 10, 12, 14), (0, 1, 2, 3)
BROW_LIFT_M = 0.0018
CHIN_SHARE = 0.65
"""Points below the mouth with so much of the jaw's angle go along with the lower teeth."""
COLLAR_ROWS = (0, 2, 4, 6, 9, 12)
LID = (0, 1, 2, 3, 4, 5, 6)
"""Stations of the upper lid from the inner corner to the outer one."""
LASH_M, LASH_RISE = 0.0038, 0.55
LASH_SHARES = (0.35, 0.55, 0.75, 0.85, 0.8, 0.4)
"""Lashes: how long the longest are, how far they rise, and how long they are from station to station."""
TONGUE_RINGS, TONGUE_CORNERS = (0, 1, 2, 4, 6, 8, 10, 13), (4, 2, 0, 14, 12)
"""Of the tongue's rings from the tip to the root, and on its left half from above to below."""


@dataclass(frozen=True, eq=False)
class State:
    """What the parts of a half are placed by.

    Attributes:
        skin: (S, 3) m, both halves; its left is the half that is placed.
        eye: (3,) m, centre of the ball.
        radius: m, of it.
        gaze: (3,) unit vector.
        jaw: (3, 4) m, how the lower teeth have moved from where they rest.
        rest: (S, 3) m, the skin at rest.
    """

    skin: np.ndarray
    eye: np.ndarray
    radius: float
    gaze: np.ndarray
    jaw: np.ndarray
    rest: np.ndarray

    def mirrored(self, eye: np.ndarray, gaze: np.ndarray) -> State:
        """The state of the other half, seen in the mirror; its own eye is given as it stands."""
        turn = self.jaw.copy()
        turn[:, :3] *= np.outer(FLIP, FLIP)
        turn[:, 3] *= FLIP
        mirror = archive().mirror
        return State(self.skin[mirror] * FLIP, eye * FLIP, self.radius, gaze * FLIP, turn, self.rest[mirror] * FLIP)


@dataclass(frozen=True, eq=False)
class Piece:
    """Points of one part: their names, how they are placed, and what they are modelled by.

    Attributes:
        names: of its points.
        place: gives (N, 3) m.
        body: it keeps its shape, and goes by this name: ``eye``; empty for what bends.
        follows: points that it goes along with while too little of it is seen; empty for the skull.
    """

    names: tuple[str, ...]
    place: Callable[[State], np.ndarray]
    body: str = ""
    follows: tuple[str, ...] = ()


@dataclass(frozen=True)
class Polygon:
    """Names of corners, anticlockwise from outside, and the colour that it is drafted in."""

    corners: tuple[str, ...]
    label: str


@dataclass(eq=False)
class Half:
    """All pieces, and polygons by part."""

    pieces: list[Piece] = field(default_factory=list)
    parts: dict[str, list[Polygon]] = field(default_factory=dict)
    midline: list[str] = field(default_factory=list)

    @property
    def names(self) -> tuple[str, ...]:
        """Of all points, in their order."""
        return tuple(name for piece in self.pieces for name in piece.names)

    def places(self, state: State) -> np.ndarray:
        """(N, 3) m."""
        return np.concatenate([piece.place(state) for piece in self.pieces])

    def add(self, piece: Piece, part: str, polygons: Iterable[tuple[tuple[str, ...], str]]) -> None:
        """Put in a piece with its polygons."""
        self.pieces.append(piece)
        self.parts.setdefault(part, []).extend(Polygon(corners, label) for corners, label in polygons)


def draft(cap: Cap) -> Half:
    """The half that all people are measured by, with the hair of one of them."""
    half = Half()
    _skin(half)
    _eye(half)
    _lashes(half)
    _brow(half)
    _teeth(half)
    _tongue(half)
    _collar(half)
    _hair(half, cap)
    return half


# ---------------------------------------------------------------- skin


def _skin(half: Half) -> None:
    head = archive()
    names = list(head.vertex)
    count = len(names)
    groups = [head.group_names[number] for number in head.groups]
    weights, regions = head.floats("region_weights"), [str(name) for name in head.arrays["region_names"]]
    polygons = []
    for quad, group in zip(head.quads.tolist(), groups, strict=True):
        if max(quad) >= count:
            continue
        corners = tuple(names[corner] for corner in dict.fromkeys(quad))
        label = {"lips": "lip", "mouth": "cavity", "nostril": "nostril", "lidrim": "rim", "lidin": "rim"}.get(group)
        if label is None:
            blush = weights[quad][:, regions.index("warm")].mean() if "warm" in regions else 0.0
            label = "blush" if blush > 0.5 else "skin"
        polygons.append((corners, label))
    half.midline += [name for number, name in enumerate(names) if head.mirror[number] == number]
    rim = np.array([head.vertex[f"m0_{k}"] for k in range(10)])
    rings = [(np.array([head.vertex[f"{ring}_{k}"] for k in range(10)]), *moved) for ring, moved in LINING.items()]

    def place(state: State) -> np.ndarray:
        skin = state.skin[:count].copy()
        middle = skin[rim].mean(axis=0) * [0.0, 1.0, 0.0]
        for rows, wide, back in rings:
            skin[rows] = middle + (skin[rows] - middle) * [wide, wide, 1.0] - [0.0, 0.0, back]
        return skin

    half.add(Piece(tuple(names), place), "skin", polygons)


# ---------------------------------------------------------------- eyes


def _eye(half: Half) -> None:
    angle = (np.arange(SIDES) + 0.5) * 2.0 * np.pi / SIDES
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)

    def frame(state: State) -> tuple[np.ndarray, np.ndarray]:
        aside = np.cross([0.0, 1.0, 0.0], state.gaze)
        aside /= np.linalg.norm(aside)
        return aside, np.cross(state.gaze, aside)

    def ball(state: State) -> np.ndarray:
        aside, above = frame(state)
        rows = []
        for number, size in enumerate((*EYE_RINGS, 1.0)):
            ahead = np.sqrt(1.0 - size * size) if number < len(EYE_RINGS) else -0.2
            around = circle[:, :1] * aside + circle[:, 1:] * above
            way = ahead * state.gaze + size * around
            rows.append(state.eye + state.radius * way / np.linalg.norm(way, axis=1, keepdims=True))
        return np.concatenate(rows)

    def spot(state: State) -> np.ndarray:
        aside, above = frame(state)
        turn = np.arange(6) * np.pi / 3.0
        size = SPOT * np.stack([np.cos(turn), np.sin(turn)], axis=1) + [0.03, 0.19]
        way = state.gaze + size[:, :1] * aside + size[:, 1:] * above
        return state.eye + 1.014 * state.radius * way / np.linalg.norm(way, axis=1, keepdims=True)

    def corner(state: State) -> np.ndarray:
        skin, at = state.skin, archive().vertex
        e, up, low, far_up, far_low = (skin[at[name]] for name in ("e0_0", "e0_1", "e0_11", "ei_1", "ei_11"))
        out = [e + (state.eye - e) * 0.015, *(far + (state.eye - far) * 0.01 for far in (far_up, far_low))]
        out += [(0.4 * near + 0.6 * e) * 0.985 + state.eye * 0.015 for near in (up, low)]
        way = 0.5 * (out[1] + out[2]) - state.eye
        out.append(state.eye + way / np.linalg.norm(way) * (state.radius - 0.0005))
        out.append(0.25 * (out[0] + out[3] + out[4] + out[5]) + [0.0, 0.0, 0.0005])
        return np.array(out)

    rings = [tuple(f"eye{ring}_{corner}" for corner in range(SIDES)) for ring in range(len(EYE_RINGS) + 1)]
    polygons: list[tuple[tuple[str, ...], str]] = [(rings[0], "pupil")]
    for inner, outer, label in zip(rings, rings[1:], (*EYE_LABELS, "white"), strict=False):
        for k in range(SIDES):
            n = (k + 1) % SIDES
            polygons.append(((inner[k], outer[k], outer[n], inner[n]), label))
    half.add(Piece(tuple(name for ring in rings for name in ring), ball, "eye"), "eyes", polygons)
    names = tuple(f"spot_{k}" for k in range(6))
    half.add(Piece(names, spot, "eye"), "eyes", [(names, "spot")])
    c = tuple(f"caruncle_{k}" for k in range(7))
    quads = ((0, 3, 6, 4), (3, 1, 5, 6), (4, 6, 5, 2))
    half.add(
        Piece(c, corner, follows=("e0_0", "e0_1", "e0_11")),
        "caruncle",
        [(tuple(c[k] for k in quad), "caruncle") for quad in quads],
    )


def _lashes(half: Half) -> None:
    """A strip along the margin of the upper lid; those of the lower one are too short for polygons."""
    names = tuple(f"lash_{station}" for station in LID[1:])

    def place(state: State) -> np.ndarray:
        at, out = archive().vertex, []
        for number, (station, share) in enumerate(zip(LID[1:], LASH_SHARES, strict=True), start=1):
            base = state.skin[at[f"e0_{station}"]]
            way = (base - state.eye) / np.linalg.norm(base - state.eye)
            way = way + np.array([0.12 * (number - 2.5), LASH_RISE + 3.0 * min(way[1], 0.0), 0.0])
            out.append(base + LASH_M * share * way / np.linalg.norm(way))
        return np.array(out)

    polygons = []
    for k in range(len(LID) - 1):
        a, b = f"e0_{LID[k]}", f"e0_{LID[k + 1]}"
        polygons.append(((a, b, names[k]) if k == 0 else (a, b, names[k], names[k - 1]), "lash"))
    half.add(Piece(names, place, follows=tuple(f"e0_{station}" for station in LID)), "lash", polygons)


def _brow(half: Half) -> None:
    head = archive()
    index, weight = head.ints("brow_left_index"), head.floats("brow_left_weight")
    kept = [station * 4 + row for station in BROW_STATIONS for row in BROW_ROWS]
    index, weight, offset = index[kept], weight[kept], head.floats("brow_offset")[kept] + BROW_LIFT_M

    def place(state: State) -> np.ndarray:
        normals = vertex_normals(state.skin)
        on = (weight[..., None] * state.skin[index]).sum(axis=1)
        out = (weight[..., None] * normals[index]).sum(axis=1)
        return on + offset[:, None] * out / np.linalg.norm(out, axis=1, keepdims=True)

    rows = len(BROW_ROWS)
    names = tuple(f"brow_{station}_{row}" for station in range(len(BROW_STATIONS)) for row in range(rows))
    polygons = [
        (tuple(names[k] for k in (a, a + rows, a + rows + 1, a + 1)), "brow")
        for station in range(len(BROW_STATIONS) - 1)
        for a in range(station * rows, station * rows + rows - 1)
    ]
    follows = tuple(list(head.vertex)[number] for number in np.unique(index[weight > 0.1]))
    half.add(Piece(names, place, follows=follows), "brow", polygons)


def vertex_normals(skin: np.ndarray) -> np.ndarray:
    """(S, 3) unit normals of the skin."""
    quads, out = archive().quads, np.zeros_like(skin)
    cross = np.cross(skin[quads[:, 2]] - skin[quads[:, 0]], skin[quads[:, 3]] - skin[quads[:, 1]])
    for corner in range(4):
        np.add.at(out, quads[:, corner], cross)
    return out / np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-12)


# ---------------------------------------------------------------- mouth, garment, hair


def _carried(points: np.ndarray) -> Callable[[State], np.ndarray]:
    """Places of what stands still on a head: carried by how its skin at rest differs from that of the shipped one."""
    surface = archive().floats("surface")
    bound = bind_to_skin(points, surface)
    return lambda state: points + bound.moves(state.rest - surface)


def _teeth(half: Half) -> None:
    crowns = archive().floats("teeth_points").reshape(32, 33, 3)
    for jaw, teeth in FRONT_TEETH.items():
        chosen = np.array([[ring * 8 + corner for corner in TOOTH_CORNERS] for ring in TOOTH_RINGS])
        points = crowns[list(teeth)][:, chosen].reshape(-1, 3)
        points = points - [0.0, LOWER_M[jaw], 0.0]
        rest = _carried(points)

        def place(state: State, rest: Callable[[State], np.ndarray] = rest, moves: bool = jaw == "lower") -> np.ndarray:
            out = rest(state)
            return out @ state.jaw[:, :3].T + state.jaw[:, 3] if moves else out

        rows, columns = len(TOOTH_RINGS), len(TOOTH_CORNERS)
        names = tuple(
            f"tooth_{jaw}{tooth}_{row}_{column}"
            for tooth in range(len(teeth), 0, -1)
            for row in range(rows)
            for column in range(columns)
        )
        polygons = []
        for tooth in range(len(teeth)):
            for row in range(rows - 1):
                for column in range(columns - 1):
                    a = (tooth * rows + row) * columns + column
                    corners = (a, a + 1, a + columns + 1, a + columns)
                    way = 1 if jaw == "lower" else -1  # upper crowns point the other way
                    polygons.append((tuple(names[k] for k in corners[::way]), "tooth"))
        follows = _chin() if jaw == "lower" else ()
        half.add(Piece(names, place, f"{jaw} teeth", follows), "teeth", polygons)


def _tongue(half: Half) -> None:
    """It lies between the lower teeth and goes along with them."""
    grid = archive().floats("tongue_points").reshape(14, 16, 3)[list(TONGUE_RINGS)][:, list(TONGUE_CORNERS)]
    rest = _carried(grid.reshape(-1, 3) - [0.0, TONGUE_LOWER_M, 0.0])
    rows, columns = grid.shape[:2]
    names = np.array([[f"tongue_{row}_{column}" for column in range(columns)] for row in range(rows)])
    polygons = _outwards(_grid_polygons(names, lambda row, _: "tongue"), names, grid)
    half.midline += [str(name) for row in names for name in (row[0], row[-1])]

    def place(state: State) -> np.ndarray:
        return rest(state) @ state.jaw[:, :3].T + state.jaw[:, 3]

    half.add(Piece(tuple(names.ravel()), place, "lower teeth", _chin()), "tongue", polygons)


def _chin() -> tuple[str, ...]:
    """Points of the chin, which go along with the lower teeth."""
    head = archive()
    share = head.floats("jaw_share_surface")
    return tuple(name for name, k in head.vertex.items() if name.startswith("k") and share[k] > CHIN_SHARE)


def _collar(half: Half) -> None:
    grid = archive().floats("collar_points").reshape(13, 40, 3)[list(COLLAR_ROWS)]
    left = np.concatenate([[0], np.flatnonzero(grid[-1, :, 0] > 1e-6)[::-1], [20]])
    grid = grid[:, left]
    keep = np.arange(0, len(left), 2)
    grid = grid[:, keep]
    rows, columns = grid.shape[:2]
    names = np.array([[f"collar_{row}_{column}" for column in range(columns)] for row in range(rows)])
    polygons = _grid_polygons(names, lambda row, _: "band" if row < 1 else "garment")
    points = grid.reshape(-1, 3)
    half.midline += [name for name, point in zip(names.ravel(), points, strict=True) if abs(point[0]) < 1e-6]
    half.add(Piece(tuple(names.ravel()), _carried(points)), "collar", _outwards(polygons, names, grid))


def _hair(half: Half, cap: Cap) -> None:
    shell = cap_shell(cap, Skull(archive()))
    grid = shell.points.reshape(cap.columns, -1, 3)
    count = cap.columns // 2
    left, right = grid[:count], grid[::-1][:count] * FLIP
    left = 0.5 * (left + right)
    ends = [(left[k] + left[k] * FLIP) * 0.5 for k in (0, -1)]
    grid = np.concatenate([ends[:1], left, ends[1:]]).transpose(1, 0, 2)
    rows, columns = grid.shape[:2]
    names = np.array([[f"hair_{row}_{column}" for column in range(columns)] for row in range(rows)])
    polygons = _outwards(_grid_polygons(names, lambda row, _: "hair"), names, grid)
    polygons.append((tuple(names[0]), "hair"))
    half.midline += [name for row in names for name in (row[0], row[-1])]
    half.add(Piece(tuple(names.ravel()), _carried(grid.reshape(-1, 3))), "hair", polygons)


def _grid_polygons(names: np.ndarray, label: Callable[[int, int], str]) -> list[tuple[tuple[str, ...], str]]:
    rows, columns = names.shape
    return [
        (
            tuple(
                str(names[r, c])
                for r, c in ((row, column), (row + 1, column), (row + 1, column + 1), (row, column + 1))
            ),
            label(row, column),
        )
        for row in range(rows - 1)
        for column in range(columns - 1)
    ]


def _outwards(
    polygons: list[tuple[tuple[str, ...], str]], names: np.ndarray, grid: np.ndarray
) -> list[tuple[tuple[str, ...], str]]:
    """The polygons turned so that most of them face away from the middle of both halves."""
    at = dict(zip(names.ravel().tolist(), grid.reshape(-1, 3), strict=True))
    middle = grid.reshape(-1, 3).mean(axis=0) * [0.0, 1.0, 1.0]
    total = 0.0
    for corners, _ in polygons:
        a, b, c, d = (at[name] for name in corners)
        total += float(np.cross(c - a, d - b) @ (0.25 * (a + b + c + d) - middle))
    return polygons if total > 0 else [(corners[::-1], label) for corners, label in polygons]
