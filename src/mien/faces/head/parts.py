"""Parts of the head in one list of vertices: where each lies, how it takes the light, what colours it has."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial

import numpy as np

from mien.core import Material, Pose, Topology, build_topology
from mien.core.mesh import Ints, Points

from . import shades
from .brows import brow_strips
from .creases import creased_skin
from .eyes import CLASSIC, SMOOTH, eye_polygons, eye_shades, spot_grid, spot_mirror, spot_polygons
from .hair import Hair, hair
from .lashes import CARUNCLE_MIRROR, CARUNCLE_QUADS, lashes
from .measured import Archive, Floats, Kind
from .wear import NONE, Beard, Glasses, beard, glasses

SKIN = Material(gloss=0.055, gloss_power=14, subdivide=True)
EYE = Material(gloss=0.1, gloss_power=60, round=True)
SPOT = Material(lit=False)
WET = Material(gloss=0.035, gloss_power=20)
TOOTH = Material(gloss=0.22, gloss_power=36)
BROW = Material(gloss=0.015, gloss_power=10)
BEARD = Material(gloss=0.02, gloss_power=10, subdivide=True)
FRAME = Material(gloss=0.25, gloss_power=40)
LASH = Material(two_sided=True)
CLOTH = Material(gloss=0.012, gloss_power=8, subdivide=True)
INSIDE = {"teeth": TOOTH, "gums": WET, "tongue": WET}

STUBBLE_SHADE = np.array([0.42, 0.45, 0.62])
"""Colour of hair just cut, over that of hair: seen end on it is darker and cooler."""

DEEP_TOOTH = (0.34, 0.19, 0.15)
DEEP_FLESH = (0.10, 0.05, 0.05)
"""What light is left deep in the mouth: it is lit as if it lay in the open, so it must be painted dark."""


@dataclass(frozen=True, eq=False)
class Layout:
    """The order of the parts.

    Attributes:
        archive: measured arrays.
        topology: of the whole head.
        span: part -> its run of vertices.
        rest: part -> (N, 3) m of the parts that are modelled in place.
        lower: part -> (N,) whether a vertex belongs to the lower jaw.
        hair: its style.
        beard: its style.
        glasses: their style.
        sides: of the pupil and of every ring of an eye.
        skin: (N,) measured vertex of each vertex of the skin, which doubles some along creases.
    """

    archive: Archive
    topology: Topology
    span: Mapping[str, slice]
    rest: Mapping[str, Points]
    lower: Mapping[str, np.ndarray[tuple[int], np.dtype[np.bool_]]]
    hair: Hair
    beard: Beard
    glasses: Glasses
    sides: int
    skin: Ints

    @cached_property
    def mirror(self) -> Ints:
        """(V,) vertex in the mirror, -1 for hair."""
        mirror = _mirror(self.span, self.rest, self.topology.vertex_count, self.sides)
        mirror[self.span["beard"]] = self.span["beard"].start + self.beard.twin
        classic = self.sides == CLASSIC
        mirror[self.span["skin"]] = creased_skin(self.archive).mirror if classic else self.archive.mirror
        return mirror

    def join(self, parts: Mapping[str, Floats]) -> Floats:
        """(V, 3) with each part's rows in its place; parts that are not given are 0."""
        out = np.zeros((self.topology.vertex_count, 3))
        for name, values in parts.items():
            out[self.span[name]] = values
        return out

    def colors(self, pose: Pose) -> dict[str, Floats]:
        """Part -> (N, 3) linear RGB; the eyes without the shadow of the lids."""
        archive, rest = self.archive, self.rest
        of = partial(shades.color_of, pose)
        band = archive.ints("collar_quads")[archive.ints("collar_band").astype(bool)]
        skin = shades.tinted(self._bare_skin(pose), STUBBLE_SHADE * of("hair"), self.beard.tint[self.skin])
        out = {
            "skin": skin,
            "beard": shades.hair_color(of("hair"), skin[self.beard.index[:, 0]], self.beard.shade),
            "glasses": np.tile(self.glasses.color, (len(self.glasses.points), 1)),
            "teeth": of("tooth")
            * shades.tooth_light(archive)
            * shades.depth_shade(rest["teeth"], 0.088, 0.042, DEEP_TOOTH),
            "gums": of("gum") * shades.depth_shade(rest["gums"], 0.092, 0.024, DEEP_FLESH),
            "tongue": of("tongue") * shades.depth_shade(rest["tongue"], 0.088, 0.034, DEEP_FLESH),
            "collar": shades.collar_color(pose, len(archive.floats("collar_points")), band),
            "hair": shades.hair_color(of("hair"), of("skin"), self.hair.shade),
        }
        strip = brow_strips(archive, 0.0)
        both_sides = {
            "eye": np.minimum(np.concatenate([of(name) * factor for name, factor in eye_shades(self.sides)]), 1.0),
            "spot": np.tile(of("spot"), (len(spot_grid()), 1)),
            "caruncle": np.tile(shades.caruncle_color(pose), (len(CARUNCLE_MIRROR), 1)),
            "lash": shades.lash_color(pose, lashes(archive)),
            "brow": shades.brow_color(pose, strip.along, strip.across),
        }
        return {**out, **{f"{name}.{side}": rgb for side in ("left", "right") for name, rgb in both_sides.items()}}

    def _bare_skin(self, pose: Pose) -> Floats:
        """(N, 3) linear RGB of the shaven skin."""
        lit = shades.skin_shade(self.archive)[self.skin]
        return shades.blend(self._region_weights(), shades.regions(pose)) * lit

    def _region_weights(self) -> Floats:
        """(N, R) weights of the skin's colour regions; at a crease around the lips each side has its own colour."""
        weights = self.archive.floats("region_weights")[self.skin]
        if self.sides == CLASSIC:
            beside = creased_skin(self.archive).beside_lips
            weights[beside] = 0.0
            weights[beside, 0] = 1.0
        return weights


@dataclass(frozen=True)
class Styles:
    """What a head is worn with, by name."""

    hair: str
    beard: str = NONE
    glasses: str = NONE


@lru_cache(maxsize=32)
def lay_out(archive: Archive, styles: Styles, kind: Kind) -> Layout:
    """The layout of a head with hair, beard and glasses, for one of the two position sets.

    The surface is for classic pictures: eyes of twelve sides, creases by doubled vertices.

    Raises:
        UnknownNameError: there is no such style.
    """
    classic = kind == "surface"
    sides = CLASSIC if classic else SMOOTH
    quads, skin = archive.quads, np.arange(len(archive.mirror))
    if classic:
        quads, skin = creased_skin(archive).quads, creased_skin(archive).source
    style, grown, worn = hair(styles.hair), beard(styles.beard), glasses(styles.glasses)
    rest = {name: archive.floats(f"{name}_points") for name in ("teeth", "gums", "tongue", "collar")}
    rest |= {"hair": style.points, "glasses": worn.points}
    span: dict[str, slice] = {}
    polygons: list[tuple[str, Ints, Material]] = []
    first = 0
    rows = [
        ("skin", len(skin), quads, SKIN),
        *_rows_of_an_eye(archive, "left", sides),
        *_rows_of_an_eye(archive, "right", sides),
        ("beard", len(grown.index), grown.quads, BEARD),
        *((name, len(rest[name]), archive.ints(f"{name}_quads"), material) for name, material in INSIDE.items()),
        ("collar", len(rest["collar"]), archive.ints("collar_quads"), CLOTH),
        ("hair", len(rest["hair"]), style.quads, style.material),
        ("glasses", len(rest["glasses"]), worn.quads, FRAME),
    ]
    for name, count, numbers, material in rows:
        span[name] = slice(first, first + count)
        if len(numbers):
            polygons.append((name, numbers + first, material))
        first += count
    lower = {name: archive.ints(f"{name}_lower").astype(bool) for name in ("teeth", "gums")}
    return Layout(archive, build_topology(first, polygons), span, rest, lower, style, grown, worn, sides, skin)


def _rows_of_an_eye(archive: Archive, side: str, sides: int) -> list[tuple[str, int, Ints, Material]]:
    """Name, number of vertices, polygons and material of each part around an eye."""
    lash, strip = lashes(archive), brow_strips(archive, 0.0)
    pupil, rings = eye_polygons(sides)
    return [
        (f"eye.{side}", int(rings.max()) + 1, _padded(pupil, rings), EYE),
        (f"spot.{side}", len(spot_grid()), _padded(*spot_polygons()), SPOT),
        (f"caruncle.{side}", len(CARUNCLE_MIRROR), CARUNCLE_QUADS, WET),
        (f"lash.{side}", len(lash.index[0]), lash.quads, LASH),
        (f"brow.{side}", len(strip.offset), strip.quads if side == "right" else strip.quads[:, ::-1], BROW),
    ]


def _padded(middle: Ints, around: Ints) -> Ints:
    """A polygon and smaller ones around it, whose last corners are repeated, as ``build_topology`` takes them."""
    missing = middle.shape[1] - around.shape[1]
    return np.concatenate([middle, np.concatenate([around, np.repeat(around[:, -1:], missing, axis=1)], axis=1)])


def _mirror(span: Mapping[str, slice], rest: Mapping[str, Points], count: int, sides: int) -> Ints:
    """(V,) vertex in the mirror, -1 for hair and skin."""
    mirror = np.full(count, -1, dtype=np.int64)
    # Eyes: corner j lies at (j + 1/2) steps from the own left, so its mirror image is corner n/2 - 1 - j.
    ring, corner = np.divmod(_numbers(span["eye.left"]), sides)
    _pair(mirror, span, "eye", ring * sides + (sides // 2 - 1 - corner) % sides)
    _pair(mirror, span, "spot", spot_mirror())
    _pair(mirror, span, "caruncle", np.array(CARUNCLE_MIRROR))
    for name in ("lash", "brow"):
        _pair(mirror, span, name, _numbers(span[f"{name}.left"]))
    for name in (*INSIDE, "collar", "glasses"):
        mirror[span[name]] = span[name].start + _nearest(rest[name])
    return mirror


def _numbers(run: slice) -> Ints:
    return np.arange(run.stop - run.start)


def _pair(mirror: Ints, span: Mapping[str, slice], name: str, twin: Ints) -> None:
    left, right = span[f"{name}.left"], span[f"{name}.right"]
    mirror[left] = right.start + twin
    mirror[right] = left.start + np.argsort(twin)


def _nearest(points: Points) -> Ints:
    """(N,) number of the point nearest to each point's mirror image."""
    flipped = points * np.array([-1.0, 1.0, 1.0])
    return np.array([int(np.argmin(((points - point) ** 2).sum(axis=1))) for point in flipped], dtype=np.int64)
