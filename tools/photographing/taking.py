"""Photographs of a dressed and dotted person, and what would be clicked on them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mien.core import Material, Mesh, build_topology, exact
from mien.render import Renderer

from .halves import FLIP, Half, Polygon
from .paints import MATERIALS, paints, skin_paint
from .set_up import BEAD_M, Station, ball, beads, hold, stations, strings
from .subject import Subject, phase_rows

DOT_M, DOT_LIFT_M, DOT_SIDES = 0.0008, 0.0004, 6
SMALL = {"eyes": 0.0004, "lash": 0.0005, "caruncle": 0.0004, "teeth": 0.0005}
"""Radius of the dots on fine parts, m."""
HIDDEN_BELOW_M = -0.150
"""Height below which the scan is under the garment."""
SEEN_PX = 4
"""Pixels of a dot from which on it is clicked."""
DOT_COLOR, BEAD_COLOR, STRING_COLOR = (0.02, 0.05, 0.30), (0.75, 0.05, 0.04), (0.6, 0.6, 0.55)
PLAIN = Material()
STEP, LEVELS = 8, 30
"""Numbers are written into colours with so many steps of a channel, so far apart."""


@dataclass(frozen=True, eq=False)
class Click:
    """Where a point is seen in the photograph of a camera."""

    camera: str
    point: str
    place: np.ndarray


@dataclass(frozen=True, eq=False)
class Moment:
    """A phase as it was taken.

    Attributes:
        phase: its name.
        clicks: without noise.
        photographs: (H, W, 3) by camera.
        truth: (N, 3) m, of the half's points, in the frame of the scanned head.
    """

    phase: str
    clicks: tuple[Click, ...]
    photographs: dict[str, np.ndarray]
    truth: np.ndarray


@dataclass(frozen=True, eq=False)
class Studio:
    """A person before four cameras.

    Attributes:
        subject: who.
        half: the points that are marked.
        palette: colours.
        seed: of how cameras stand and the head is held.
    """

    subject: Subject
    half: Half
    palette: str
    seed: int

    @cached_property
    def stations(self) -> tuple[Station, ...]:
        """The cameras."""
        return stations(np.random.default_rng(self.seed))

    def moments(self) -> Iterator[Moment]:
        """All phases, one after the other."""
        rng = np.random.default_rng(self.seed + 1)
        renderers = {each.name: Renderer(each.scene, 2) for each in self.stations}
        for phase, expressions in phase_rows().items():
            turn, shift = hold(rng)
            left, right = self.subject.states(expressions)
            truth, other = self.half.places(left), self.half.places(right) * FLIP
            scanned = self.subject.points(expressions) @ turn.T + shift
            dots = truth @ turn.T + shift
            mesh, numbered = self._meshes(scanned, dots, other @ turn.T + shift)
            clicks, photographs = [], {}
            for station in self.stations:
                renderer = renderers[station.name]
                photographs[station.name] = station.develop(renderer.draw_mesh(mesh)[..., :3])
                clicks += self._clicks(station, numbered, dots)
            yield Moment(phase, tuple(clicks), photographs, truth)

    # ---------------------------------------------------------------- what is before the cameras

    @cached_property
    def _skin_colors(self) -> np.ndarray:
        return skin_paint(self.subject.scan, self.palette)

    @cached_property
    def _bust(self) -> np.ndarray:
        """(F, 4) polygons of the scan that no garment hides."""
        quads = self.subject.scan.polygons("face", "head_neck", "mouth_socket")
        return quads[self.subject.points({})[quads, 1].min(axis=1) > HIDDEN_BELOW_M]

    def _meshes(self, scanned: np.ndarray, dots: np.ndarray, other: np.ndarray) -> tuple[Mesh, Mesh]:
        """The mesh that is photographed, and one whose colours tell which dot is where."""
        paint = paints(self.palette)
        parts: list[tuple[str, np.ndarray, Material]] = []
        points: list[np.ndarray] = []
        colors: list[np.ndarray] = []
        numbers: list[np.ndarray] = []

        def add(
            name: str,
            places: np.ndarray,
            rows: np.ndarray,
            rgb: np.ndarray,
            ids: np.ndarray | None = None,
            material: Material = PLAIN,
        ) -> None:
            first = sum(map(len, points))
            parts.append((name, rows + first, material))
            points.append(places)
            colors.append(np.broadcast_to(rgb, (len(places), 3)))
            numbers.append(np.zeros((len(places), 3)) if ids is None else ids)

        add("scan", scanned, self._bust, self._skin_colors,
            material=Material(gloss=0.03, gloss_power=14))  # fmt: skip
        at = {name: number for number, name in enumerate(self.half.names)}
        for part, polygons in self.half.parts.items():
            if part == "skin":
                continue
            for side, places in (("left", dots), ("right", other)):
                corners, rgb = _faceted(polygons, at, places, paint, side == "right")
                add(f"{part}.{side}", *corners, rgb, material=_plain(MATERIALS[part], part))
        add("strings", *strings(), np.array(STRING_COLOR), material=Material(two_sided=True))
        normals = self._normals(dots)
        for number, bead in enumerate(beads().values(), start=len(dots)):
            places, faces = ball(bead, BEAD_M)
            add(f"bead{number}", places, faces, np.array(BEAD_COLOR), _code(number, len(places)))
        places, faces = _discs(dots, normals, self._sizes)
        ids = np.concatenate([_code(number, DOT_SIDES) for number in range(len(dots))])
        add("dots", places, faces, np.array(DOT_COLOR), ids, Material(two_sided=True))
        count = sum(map(len, points))
        widest = max(rows.shape[1] for _, rows, _ in parts)
        padded = [
            (name, np.pad(rows, ((0, 0), (0, widest - rows.shape[1])), mode="edge"), m) for name, rows, m in parts
        ]
        lit = build_topology(count, padded)
        # Roots of lashes are clicked between the lashes.
        dark = [(n, r, Material(lit=False, two_sided=m.two_sided)) for n, r, m in padded if not n.startswith("lash")]
        plain = build_topology(count, dark)
        where = np.concatenate(points)
        return Mesh(lit, where, np.concatenate(colors)), Mesh(plain, where, np.concatenate(numbers))

    @cached_property
    def _sizes(self) -> np.ndarray:
        part_of = {c: part for part, rows in self.half.parts.items() for row in rows for c in row.corners}
        part_of |= dict.fromkeys(self.half.pieces[0].names, "skin")
        return np.array([SMALL.get(part_of[name], DOT_M) for name in self.half.names])

    def _normals(self, dots: np.ndarray) -> np.ndarray:
        """(N, 3) unit normals of the half's polygons at its points."""
        at = {name: number for number, name in enumerate(self.half.names)}
        out = np.zeros_like(dots)
        for polygon in (row for rows in self.half.parts.values() for row in rows):
            index = [at[name] for name in polygon.corners]
            around = dots[index] - dots[index].mean(axis=0)
            out[index] += np.cross(around, np.roll(around, -1, axis=0)).sum(axis=0)
        return out / np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-12)

    def _clicks(self, station: Station, numbered: Mesh, dots: np.ndarray) -> Iterator[Click]:
        """What is seen by a camera: dots and beads."""
        with Renderer(station.scene, 2, samples=1) as renderer:
            seen = np.rint(renderer.draw_mesh(numbered)[..., :3].astype(float) / STEP).astype(int) - 1
        seen[(seen < 0).any(axis=2)] = -1
        codes = (seen[..., 0] * LEVELS + seen[..., 1]) * LEVELS + seen[..., 2]
        count = np.bincount(codes[codes >= 0], minlength=len(dots) + len(beads()))
        names = [*self.half.names, *beads()]
        places = station.project(np.concatenate([dots, np.array(list(beads().values()))]))
        for number in np.flatnonzero(count[: len(names)] >= SEEN_PX):
            yield Click(station.name, names[number], places[number])


def _plain(material: Material, part: str) -> Material:
    return Material(
        gloss=material.gloss, gloss_power=material.gloss_power, two_sided=material.two_sided or part == "hair"
    )


def _faceted(
    polygons: list[Polygon], at: dict[str, int], places: np.ndarray, paint: dict[str, np.ndarray], mirrored: bool
) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
    """Points and polygons with corners of their own wherever the colour changes, and their colours."""
    number: dict[tuple[int, str], int] = {}
    rows = []
    for polygon in polygons:
        row = [number.setdefault((at[name], polygon.label), len(number)) for name in polygon.corners]
        rows.append(row[::-1] if mirrored else row)
    widest = max(map(len, rows))
    padded = np.array([row + [row[-1]] * (widest - len(row)) for row in rows])
    points = places[[point for point, _ in number]]
    return (points, padded), np.array([paint[label] for _, label in number])


def _discs(dots: np.ndarray, normals: np.ndarray, sizes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (N * sides, 3) m and polygons (N, sides) of dots a little off the skin."""
    aside = np.cross(normals, np.where(np.abs(normals[:, 1:2]) > 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
    aside /= np.linalg.norm(aside, axis=1, keepdims=True)
    above = np.cross(normals, aside)
    angle = np.arange(DOT_SIDES) * 2.0 * np.pi / DOT_SIDES
    ring = aside[:, None] * np.cos(angle)[:, None] + above[:, None] * np.sin(angle)[:, None]
    places = (dots + DOT_LIFT_M * normals)[:, None] + sizes[:, None, None] * ring
    return places.reshape(-1, 3), np.arange(len(dots) * DOT_SIDES).reshape(-1, DOT_SIDES)


def _code(number: int, count: int) -> np.ndarray:
    """(count, 3) linear RGB that tells a number."""
    digits = (number // LEVELS**2, number // LEVELS % LEVELS, number % LEVELS)
    return np.tile([exact.srgb_to_linear((digit + 1) * STEP / 255.0) for digit in digits], (count, 1))
