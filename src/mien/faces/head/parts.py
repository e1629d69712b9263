"""Parts of the head in one list of vertices: where each lies, how it takes the light, what colours it has."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from mien.core import Material, Pose, Topology, UnknownNameError, build_topology
from mien.core.mesh import Ints, Points

from . import shades
from .brows import brow_strips
from .creases import creased_skin
from .eyes import CLASSIC, SMOOTH, SPOT_SIDES, eye_polygons, eye_shades
from .lashes import CARUNCLE_QUADS, lashes
from .measured import Archive, Floats, Kind

SKIN = Material(gloss=0.055, gloss_power=14, subdivide=True)
EYE = Material(gloss=0.1, gloss_power=60, round=True)
SPOT = Material(lit=False)
WET = Material(gloss=0.035, gloss_power=20)
TOOTH = Material(gloss=0.22, gloss_power=36)
BROW = Material(gloss=0.015, gloss_power=10)
LASH = Material(two_sided=True)
CLOTH = Material(gloss=0.012, gloss_power=8, subdivide=True)
HAIR = {
    "afro": Material(gloss=0.015, gloss_power=8, two_sided=True),
    "crop": Material(gloss=0.06, gloss_power=20, two_sided=True),
}
HAIR_DEFAULT = Material(gloss=0.11, gloss_power=22, two_sided=True)

DEEP_TOOTH = (0.10, 0.055, 0.045)
DEEP_FLESH = (0.10, 0.05, 0.05)
"""What light is left deep in the mouth: it is lit as if it lay in the open, so it must be painted dark."""


@dataclass(frozen=True, eq=False)
class Layout:
    """The order of the parts.

    Attributes:
        topology: of the whole head.
        span: part -> its run of vertices.
        rest: part -> (N, 3) m of the parts that are modelled in place.
        lower: part -> (N,) whether a vertex belongs to the lower jaw.
        mirror: (V,) vertex in the mirror, -1 for hair.
        skin: (N,) measured vertex of each vertex of the skin, which doubles some along creases.
    """

    archive: Archive
    topology: Topology
    span: Mapping[str, slice]
    rest: Mapping[str, Points]
    lower: Mapping[str, np.ndarray[tuple[int], np.dtype[np.bool_]]]
    mirror: Ints
    hair: str
    sides: int
    skin: Ints

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
        out = {
            "skin": shades.blend(self._region_weights(), shades.regions(pose)) * shades.skin_shade(archive)[self.skin]
        }
        eye = np.concatenate([of(name) * factor for name, factor in eye_shades(self.sides)])
        corner = 0.5 * of("blush") + 0.5 * np.array([0.57, 0.147, 0.133])
        lash = lashes(archive)
        dark = np.tile(of("eyebrow") * 0.12, (len(lash.index[0]), 1))
        dark[np.unique(lash.quads[lash.lower])] = 0.12 * of("eyebrow") + 0.62 * of("shade")
        strip = brow_strips(archive, 0.0)
        brow = shades.brow_color(pose, strip.along, strip.across)
        for side in ("left", "right"):
            out[f"eye.{side}"] = np.minimum(eye, 1.0)
            out[f"spot.{side}"] = np.tile(of("spot"), (SPOT_SIDES, 1))
            out[f"caruncle.{side}"] = np.tile(corner, (7, 1))
            out[f"lash.{side}"] = dark
            out[f"brow.{side}"] = brow
        out["teeth"] = (
            of("tooth") * shades.tooth_light(archive) * shades.depth_shade(rest["teeth"], 0.086, 0.03, DEEP_TOOTH)
        )
        out["gums"] = of("gum") * shades.depth_shade(rest["gums"], 0.092, 0.024, DEEP_FLESH)
        out["tongue"] = of("tongue") * shades.depth_shade(rest["tongue"], 0.088, 0.034, DEEP_FLESH)
        band = archive.ints("collar_band").astype(bool)
        cloth = np.tile(of("garment"), (len(archive.floats("collar_points")), 1))
        cloth[np.unique(archive.ints("collar_quads")[band])] *= 0.82
        out["collar"] = cloth
        if self.hair != "bald":
            out["hair"] = shades.hair_color(pose, archive.floats(f"hair_{self.hair}_shade"))
        else:
            out["hair"] = np.zeros((0, 3))
        return out

    def _region_weights(self) -> Floats:
        """(N, R) weights of the skin's colour regions; at a crease around the lips each side has its own colour."""
        weights = self.archive.floats("region_weights")[self.skin]
        if self.sides == CLASSIC:
            beside = creased_skin(self.archive).beside_lips
            weights[beside] = 0.0
            weights[beside, 0] = 1.0
        return weights


@lru_cache(maxsize=32)
def lay_out(archive: Archive, hair: str, kind: Kind) -> Layout:
    """The layout of a head with a hair style, for one of the two position sets.

    The surface is for classic pictures: eyes of twelve sides, creases by doubled vertices.

    Raises:
        UnknownNameError: there is no such hair style.
    """
    if hair not in archive.hair_styles:
        raise UnknownNameError("hair style", hair, archive.hair_styles)
    lash, strip = lashes(archive), brow_strips(archive, 0.0)
    classic = kind == "surface"
    sides = CLASSIC if classic else SMOOTH
    creased = creased_skin(archive)
    quads, skin = (creased.quads, creased.source) if classic else (archive.quads, np.arange(len(archive.mirror)))
    pupil, rings = eye_polygons(sides)
    eye_count = int(rings.max()) + 1
    rest: dict[str, Points] = {name: archive.floats(f"{name}_points") for name in ("teeth", "gums", "tongue")}
    bald = hair == "bald"
    rest["hair"] = np.zeros((0, 3)) if bald else archive.floats(f"hair_{hair}_points")
    rows: list[tuple[str, int, list[Ints], Material]] = [("skin", len(skin), [quads], SKIN)]
    for side in ("left", "right"):
        flip = slice(None) if side == "right" else slice(None, None, -1)
        rows += [
            (f"eye.{side}", eye_count, [pupil, rings], EYE),
            (f"spot.{side}", SPOT_SIDES, [np.arange(SPOT_SIDES)[None]], SPOT),
            (f"caruncle.{side}", 7, [CARUNCLE_QUADS], WET),
            (f"lash.{side}", len(lash.index[0]), [lash.quads], LASH),
            (f"brow.{side}", len(strip.offset), [strip.quads[:, flip]], BROW),
        ]
    for name, material in (("teeth", TOOTH), ("gums", WET), ("tongue", WET)):
        rows.append((name, len(rest[name]), [archive.ints(f"{name}_quads")], material))
    rows.append(("collar", len(archive.floats("collar_points")), [archive.ints("collar_quads")], CLOTH))
    if not bald:
        rows.append(("hair", len(rest["hair"]), [archive.ints(f"hair_{hair}_quads")], HAIR.get(hair, HAIR_DEFAULT)))
    span: dict[str, slice] = {}
    polygons: list[tuple[str, Ints, Material]] = []
    first = 0
    for name, count, faces, material in rows:
        span[name] = slice(first, first + count)
        wide = max(face.shape[1] for face in faces)
        padded = [np.concatenate([f, np.repeat(f[:, -1:], wide - f.shape[1], axis=1)], axis=1) for f in faces]
        polygons.append((name, np.concatenate(padded) + first, material))
        first += count
    span.setdefault("hair", slice(first, first))
    lower = {name: archive.ints(f"{name}_lower").astype(bool) for name in ("teeth", "gums")}
    topology = build_topology(first, polygons)
    mirror = _mirror(archive, span, rest, first, sides)
    mirror[span["skin"]] = creased.mirror if classic else archive.mirror
    return Layout(archive, topology, span, rest, lower, mirror, hair, sides, skin)


def _mirror(archive: Archive, span: Mapping[str, slice], rest: Mapping[str, Points], count: int, sides: int) -> Ints:
    mirror = np.full(count, -1, dtype=np.int64)
    # Eyes: corner j lies at (j + 1/2) steps from the own left, so its mirror image is corner n/2 - 1 - j.
    for name, corners in (("eye", sides), ("spot", SPOT_SIDES)):
        length = span[f"{name}.left"].stop - span[f"{name}.left"].start
        ring, corner = np.divmod(np.arange(length), corners)
        twin = ring * corners + (corners // 2 - 1 - corner) % corners
        _pair(mirror, span, name, twin)
    _pair(mirror, span, "caruncle", np.array([0, 3, 6, 1, 4, 5, 2]))
    for name in ("lash", "brow"):
        _pair(mirror, span, name, np.arange(span[f"{name}.left"].stop - span[f"{name}.left"].start))
    for name in ("teeth", "gums", "tongue"):
        mirror[span[name]] = span[name].start + _nearest(rest[name])
    mirror[span["collar"]] = span["collar"].start + _nearest(archive.floats("collar_points"))
    return mirror


def _pair(mirror: Ints, span: Mapping[str, slice], name: str, twin: Ints) -> None:
    left, right = span[f"{name}.left"], span[f"{name}.right"]
    mirror[left] = right.start + twin
    mirror[right] = left.start + np.argsort(twin)


def _nearest(points: Points) -> Ints:
    """(N,) number of the point nearest to each point's mirror image."""
    flipped = points * np.array([-1.0, 1.0, 1.0])
    return np.array([int(np.argmin(((points - point) ** 2).sum(axis=1))) for point in flipped], dtype=np.int64)
