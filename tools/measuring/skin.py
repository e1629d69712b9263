"""Our skin: regions of it, smooth fields on it, and the control points that make the subdivided skin follow."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sl
from scipy.spatial import cKDTree

from mien.core import UnknownNameError
from mien.faces.head.measured import Archive, archive

from .closest import refinement, topology_of

FLIP = np.array([-1.0, 1.0, 1.0])
MM = 0.001
LIMIT_STEPS = 2
"""Catmull-Clark steps after which a vertex is taken to be where it stays."""
FIT_STEPS = 6
MIDLINE_M = 0.008
"""A one-sided field fades over the midline and is nothing this far on the other side."""
NOSE = re.compile(r"(n[2-6]\d|[pqruv]\d)")
"""Vertices below the root of the nose."""
CONTACT = ("m0", "mi", "mj", "mk")
"""Rings of the line where the lips meet, and of the inside of the mouth."""


@dataclass(frozen=True, eq=False)
class Skin:
    """The skin of the shipped head.

    Attributes:
        archive: its arrays.
        landmarks: name -> (3,) m, places on it.
    """

    archive: Archive
    landmarks: Mapping[str, np.ndarray]

    @cached_property
    def points(self) -> np.ndarray:
        """(S, 3) m, on the surface."""
        return self.archive.floats("surface")

    @cached_property
    def limit(self) -> sp.csr_matrix:
        """(S, S) where subdivision leads each control point."""
        return refinement(topology_of(self.archive.quads, len(self.points)), LIMIT_STEPS)[0][: len(self.points)]

    @cached_property
    def neighbours(self) -> sp.csr_matrix:
        """(S, S) mean over the vertices joined to each by an edge."""
        quads, count = self.archive.quads, len(self.points)
        pairs = np.concatenate([quads[:, [a, (a + 1) % 4]] for a in range(4)])
        pairs = np.unique(np.sort(pairs, axis=1), axis=0)
        joined = sp.csr_matrix((np.ones(len(pairs)), pairs.T), shape=(count, count))
        joined = joined + joined.T
        return sp.diags(1.0 / np.asarray(joined.sum(axis=1)).ravel()) @ joined

    def ring(self, *prefixes: str) -> np.ndarray:
        """Sorted vertices, of both sides, of rings such as ``m0``."""
        return self._left_and_right([name for name in self.archive.vertex if name.partition("_")[0] in prefixes])

    @cached_property
    def still(self) -> Mapping[str, np.ndarray]:
        """What a field may have to leave alone: name -> vertices."""
        ears = self.archive.group_names.index("ear")
        return {
            "lids": self.archive.ints("lid_index"),
            "contact": self.ring(*CONTACT),
            "lips": self.ring(*CONTACT, "mh", "m1", "mb"),
            "nose": self._left_and_right([name for name in self.archive.vertex if NOSE.fullmatch(name)]),
            "corners": self._left_and_right([f"{ring}_5" for ring in ("m0", "mh", "m1", "mb", "m2")]),
            "ears": np.unique(self.archive.quads[self.archive.groups == ears]),
        }

    def near(self, path: str, full_mm: float, reach_mm: float) -> np.ndarray:
        """(S,) 1 near lines through landmarks, falling smoothly to 0.

        Args:
            path: names joined by blanks make a line, several lines are joined by ``;``.
            full_mm: distance up to which it is 1.
            reach_mm: distance from which on it is 0.

        Raises:
            UnknownNameError: there is no such landmark.
        """
        distance = np.full(len(self.points), np.inf)
        for line in path.split(";"):
            stops = np.array([self._landmark(name) for name in line.split()])
            for start, end in zip(stops, stops[1:] if len(stops) > 1 else stops, strict=False):
                distance = np.minimum(distance, _distance_to_segment(self.points, start, end))
        return smooth_step((reach_mm * MM - distance) / ((reach_mm - full_mm) * MM))

    def region(self, path: str, full_mm: float, reach_mm: float, still: Sequence[str]) -> np.ndarray:
        """(S,) 1 near lines through landmarks and their mirror images, 0 beyond their reach and on what must stay.

        What must stay is written as ``lids:14``: over that distance, in mm, the region rises again.
        """
        out = self.near(path, full_mm, reach_mm)
        for each in still:
            name, _, fade_mm = each.partition(":")
            out = out * self.away_from(name, float(fade_mm))
        return as_stored(np.maximum(out, out[self.archive.mirror]))

    def away_from(self, name: str, fade_mm: float) -> np.ndarray:
        """(S,) 0 on what must stay where it is, rising smoothly to 1."""
        if name not in self.still:
            raise UnknownNameError("set of still vertices", name, self.still)
        vertices = self.still[name]
        out = smooth_step(cKDTree(self.points[vertices]).query(self.points)[0] / (fade_mm * MM))
        out[vertices] = 0.0
        return out

    @cached_property
    def left_share(self) -> np.ndarray:
        """(S,) how much of a symmetric field belongs to the left side; with its mirror image it makes 1."""
        return smooth_step((self.points[:, 0] + MIDLINE_M) / (2.0 * MIDLINE_M))

    def mirrored(self, field: np.ndarray) -> np.ndarray:
        """A field (..., S, 3) in the mirror."""
        return field[..., self.archive.mirror, :] * FLIP

    def symmetric(self, field: np.ndarray) -> np.ndarray:
        """A field (..., S, 3) averaged with its mirror image."""
        return 0.5 * (field + self.mirrored(field))

    def smoothed(self, field: np.ndarray, steps: int, share: float = 0.5) -> np.ndarray:
        """A field (S, 3) drawn towards the mean of its neighbours several times."""
        for _ in range(steps):
            field = (1.0 - share) * field + share * (self.neighbours @ field)
        return field

    def relative(self, field: np.ndarray, still: np.ndarray) -> np.ndarray:
        """A field (S, 3) less what the moves of some vertices spread over the skin between them explain.

        Args:
            field: m.
            still: (S,) whether a vertex must not move; the result is 0 there.
        """
        free = np.flatnonzero(~still)
        spread = (sp.identity(len(field)) - self.neighbours).tocsr()[free]
        out = np.zeros_like(field)
        inside = sl.splu(spread[:, free].tocsc()).solve(-(spread[:, still] @ field[still]))
        out[free] = field[free] - inside
        return out

    def control(self, field: np.ndarray) -> np.ndarray:
        """(S, 3) moves of the control points that make the subdivided skin move so; 0 where the field is."""
        moving = (field != 0.0).any(axis=1)[:, None]
        out = field.copy()
        for _ in range(FIT_STEPS):
            out += np.where(moving, field - self.limit @ out, 0.0)
        return out

    def _left_and_right(self, names: list[str]) -> np.ndarray:
        left = [self.archive.vertex[name] for name in names]
        return np.unique([*left, *self.archive.mirror[left]])

    def _landmark(self, name: str) -> np.ndarray:
        if name not in self.landmarks:
            raise UnknownNameError("landmark", name, self.landmarks)
        return self.landmarks[name]


def our_skin(landmarks: Mapping[str, np.ndarray]) -> Skin:
    """The skin of the head that ships."""
    return Skin(archive(), landmarks)


def as_stored(region: np.ndarray) -> np.ndarray:
    """A region (S,) rounded as it is stored: where it is 0 there, nothing may move."""
    return region.astype(np.float16).astype(np.float64)


def smooth_step(share: np.ndarray) -> np.ndarray:
    """0 up to 0, 1 from 1 on, with no kink where it begins and ends."""
    share = np.clip(share, 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def _distance_to_segment(points: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    along = end - start
    share = np.clip((points - start) @ along / max(along @ along, 1e-12), 0.0, 1.0)
    return np.linalg.norm(points - start - share[:, None] * along, axis=1)
