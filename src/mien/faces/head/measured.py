"""The measured head: cage and surface points, shares, lids, parts; loaded once, read-only.

Two position sets belong to one topology: ``cage`` is fitted so that its subdivision meets the reference (0.24 mm
RMS after one step), ``surface`` lies on the reference itself and is for pictures without subdivision, once
its points have moved by ``surface_flatter``, which makes the polygons of smooth skin nearly plane.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError, UnknownNameError
from mien.core.mesh import Ints, Points

from .arrays import parse_arrays
from .derived import derived_morphs

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Scalar = TypeVar("Scalar", bound=np.generic)
Kind = Literal["cage", "surface"]

LID_RINGS = ("hidden", "inner", "margin", "lip", "crease", "fold")


@dataclass(frozen=True, eq=False)
class Lids:
    """Polar coordinates of the lid vertices about their eye: what is interpolated between open and shut.

    Attributes:
        index: (L,) vertex numbers.
        side: (L,) 1 left, -1 right.
        upper: (L,) 1 upper lid, -1 lower lid, 0 corners.
        ring: (L,) number into ``LID_RINGS``.
        azimuth: (L,) rad, outwards positive.
        elevation, elevation_shut: (L,) rad.
        radius, radius_shut: (L,) m.
    """

    index: Ints
    side: Floats
    upper: Ints
    ring: Ints
    azimuth: Floats
    elevation: Floats
    elevation_shut: Floats
    radius: Floats
    radius_shut: Floats


@dataclass(frozen=True, eq=False)
class Measured:
    """Arrays of one position set.

    Attributes:
        kind: cage or surface.
        points: (V, 3) m.
        jaw_share: (V,) share of the jaw's angle.
        jaw_residual: (V, 3) m, what the rotation misses of the reference's open jaw, at ``jaw_open_angle``.
        morphs: expression name -> (V, 3) m.
        lids: the eyelids.
    """

    kind: Kind
    points: Points
    jaw_share: Floats
    jaw_residual: Points
    morphs: Mapping[str, Points]
    lids: Lids


LIP_END, BEFORE_LIP_END = ("mi_4", "m0_4"), "mh_4"
"""The end of the upper lip's inner edge, and the red before it: in the corner the reference's nearest skin is the lower
lip, which goes elsewhere."""


@dataclass(frozen=True, eq=False)
class Archive:
    """A data file, its arrays converted when first asked for."""

    arrays: Mapping[str, NDArray[np.generic]]

    def floats(self, name: str) -> Floats:
        """An array as float64."""
        return _locked(self.arrays[name].astype(np.float64))

    def ints(self, name: str) -> Ints:
        """An array as int64."""
        return _locked(self.arrays[name].astype(np.int64))

    @cached_property
    def quads(self) -> Ints:
        """(F, 4) skin, ears, lips, lid rims, nostrils, inside of the mouth."""
        return self.ints("quads")

    @cached_property
    def groups(self) -> Ints:
        """(F,) number into ``group_names`` of each polygon of the skin."""
        return self.ints("groups")

    @cached_property
    def group_names(self) -> tuple[str, ...]:
        """Names of the groups: ear, lids, lips, mouth, nostril, skin."""
        return tuple(str(name) for name in self.arrays["group_names"])

    @cached_property
    def mirror(self) -> Ints:
        """(V,) vertex that each vertex becomes in the mirror."""
        return self.ints("mirror")

    @cached_property
    def vertex(self) -> Mapping[str, int]:
        """Vertex number of each name of the left half, such as ``m0_5`` (ring m0, station 5: the mouth corner)."""
        return {str(name): number for number, name in enumerate(self.arrays["half_names"])}

    def vertex_at(self, ring: str, station: int, side: int) -> int:
        """Number of the vertex at a ring's station, on the left (0) or the right (1); the same on the midline."""
        left = self.vertex[f"{ring}_{station}"]
        return left if side == 0 else int(self.mirror[left])

    def ring(self, prefix: str, count: int) -> Ints:
        """(count,) left-half vertices ``prefix_0`` ...; raises UnknownNameError for a ring that is not there."""
        names = [f"{prefix}_{station}" for station in range(count)]
        for name in names:
            if name not in self.vertex:
                raise UnknownNameError("vertex", name, self.vertex)
        return np.array([self.vertex[name] for name in names], dtype=np.int64)

    @cache  # noqa: B019 - one archive lives as long as the process
    def measured(self, kind: Kind) -> Measured:
        """One of the two position sets."""
        points = self.floats(kind)
        if kind == "surface":
            points = _locked(points + self.floats("surface_flatter"))
        measured = {n: self._mended(delta) for n, delta in (self._morphs(kind) | conformation()._morphs(kind)).items()}
        lids = Lids(
            self.ints("lid_index"),
            self.floats("lid_side"),
            self.ints("lid_upper"),
            self.ints("lid_ring"),
            *(self.floats(f"lid_{kind}_{key}") for key in ("az", "el", "el_closed", "r", "r_closed")),
        )
        return Measured(
            kind,
            points,
            self._mended(self.floats(f"jaw_share_{kind}")),
            self._mended(self.floats(f"jaw_residual_{kind}")),
            measured | derived_morphs(measured, points, self.vertex),
            lids,
        )

    def _mended(self, measured: Floats) -> Floats:
        """What was measured at each vertex (V, ...), at the inner edge of the upper lip's end as before it."""
        edge = [self.vertex[name] for name in LIP_END]
        before = self.vertex[BEFORE_LIP_END]
        mended = measured.copy()
        mended[edge], mended[self.mirror[edge]] = measured[before], measured[self.mirror[before]]
        return _locked(mended)

    def _morphs(self, kind: Kind) -> dict[str, Points]:
        """Expression -> (V, 3) m, as measured."""
        return {
            str(n): delta for n, delta in zip(self.arrays["morph_names"], self.floats(f"morph_{kind}"), strict=True)
        }


@cache
def archive() -> Archive:
    """The data file that ships."""
    return read_archive("head")


@cache
def conformation() -> Archive:
    """The data file of what people have in different measure, and of expressions of another reference."""
    return read_archive("conformation")


def read_archive(name: str) -> Archive:
    """A data file by name.

    Raises:
        MienError: it is not there.
    """
    place = files(__package__).joinpath(f"data/{name}.arrays")
    if not place.is_file():
        raise MienError(f"{place}: the head's data is missing — was mien installed completely?")
    return Archive(parse_arrays(place.read_bytes()))


def _locked(array: NDArray[Scalar]) -> NDArray[Scalar]:
    array.flags.writeable = False
    return array
