"""The reference heads, in metres, and what they do to our skin.

The folder also holds identities for testing only; nothing here opens that file.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.interpolate import RBFInterpolator

from mien.faces.head.measured import Archive, archive

from .closest import bind, refinement, topology_of, vertex_normals

CM = 0.01
SMILE = 0.10
"""Share of the measured smile in our neutral face (see mend_head.py): ours lies on the reference that smiles so."""
WARP_SMOOTHING = 1e-5
CRANIUM_STEPS = 2
"""Catmull-Clark steps that make the coarse cranium of MakeHuman's head round."""
INSIDE = {"mi": "m0", "mj": "m0", "mk": "m0", "ei": "e0", "ej": "e0", "u": "r", "v": "r"}
"""Rings of hidden vertices -> the ring of the rim that they go along with."""


@dataclass(frozen=True, eq=False)
class Source:
    """A reference head and its people.

    Attributes:
        onto_skin: (S, V) weights that carry displacements of its vertices to ours.
        points: (V, 3) m, its neutral head in our frame.
        turn: (3, 3) turns and scales its displacements into our frame.
        landmarks: name -> its vertex.
        people: (N, V, 3) m, how each person differs from its neutral head.
        labels: what is known about each, empty where nothing is.
    """

    onto_skin: sp.csr_matrix
    points: np.ndarray
    turn: np.ndarray
    landmarks: dict[str, int]
    people: np.ndarray
    labels: tuple[dict[str, Any], ...]

    def on_skin(self, deltas: np.ndarray) -> np.ndarray:
        """(N, S, 3) m, displacements (N, V, 3) of its vertices carried to our skin."""
        return np.stack([self.onto_skin @ delta for delta in deltas]) @ self.turn.T


@dataclass(frozen=True, eq=False)
class Reference:
    """A folder of reference heads."""

    folder: Path

    def read(self, name: str) -> dict[str, np.ndarray]:
        """The arrays of one of its files."""
        with np.load(self.folder / f"{name}.npz") as arrays:
            return {key: arrays[key] for key in arrays.files}

    @cached_property
    def landmarks(self) -> dict[str, np.ndarray]:
        """Name -> (3,) m, landmarks on the skin of the head that ours was measured on."""
        numbers = self._landmark_vertices("ict")
        return {name: self._ict_points[number] for name, number in numbers.items()}

    @cached_property
    def scans(self) -> Source:
        """ICT-FaceKit Light: fifty people drawn from a model of scans."""
        people = self.read("ict_identities_more")["deltas"].astype(np.float64) * CM
        head = self.read("ict_head")
        skin = topology_of(head["faces"][head["face_group"] <= 1], len(self._ict_points))
        onto_skin = _onto_skin(self._ict_points, skin.triangles)
        return Source(
            onto_skin, self._ict_points, np.eye(3), self._landmark_vertices("ict"), people, ({},) * len(people)
        )

    @cached_property
    def models(self) -> Source:
        """MakeHuman: twenty-four people with labels of age, sex and weight."""
        head, people = self.read("mh_head"), self.read("mh_identities")
        points, numbers = head["verts"].astype(np.float64) * CM, self._landmark_vertices("mh")
        vertices = list(numbers.values())
        wanted = np.array([self.landmarks[name] for name in numbers])
        turn, shift = similarity(points[vertices], wanted)
        points = points @ turn.T + shift
        warp = RBFInterpolator(
            points[vertices], wanted, kernel="linear", degree=1, smoothing=WARP_SMOOTHING * len(vertices)
        )
        skin = topology_of(head["faces"][head["face_group"] == 0], len(points))
        fine, topology = refinement(skin, CRANIUM_STEPS)
        onto_skin = _onto_skin(warp(fine @ points), topology.triangles) @ fine
        labels = tuple(json.loads(str(people["labels"])))
        return Source(onto_skin, points, turn, numbers, people["deltas"].astype(np.float64) * CM, labels)

    @cached_property
    def _ict_points(self) -> np.ndarray:
        head, expressions = self.read("ict_head"), self.read("ict_expressions")
        names = expressions["names"].tolist()
        smile = [expressions["deltas"][names.index(f"mouthSmile_{side}")].astype(np.float64) for side in "LR"]
        return (head["verts"].astype(np.float64) + SMILE * (smile[0] + smile[1])) * CM

    def _landmark_vertices(self, head: str) -> dict[str, int]:
        marks = self.read(f"{head}_landmarks")
        # The centres of the eyes are no vertices.
        return {
            str(name): int(number) for name, number in zip(marks["names"], marks["ids"], strict=True) if number >= 0
        }


def similarity(points: np.ndarray, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Matrix (3, 3), a turn times a scale, and shift (3,) that bring points (N, 3) nearest to others.

    Source: Umeyama 1991, equations 40 to 42.
    """
    middle, goal = points.mean(axis=0), wanted.mean(axis=0)
    u, size, vt = np.linalg.svd((wanted - goal).T @ (points - middle))
    sign = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    turn = (size * sign).sum() / ((points - middle) ** 2).sum() * (u * sign) @ vt
    return turn, goal - turn @ middle


def _onto_skin(surface: np.ndarray, triangles: np.ndarray) -> sp.csr_matrix:
    """(S, V) weights of the points of a surface nearest to ours; hidden vertices go along with their rim."""
    head = archive()
    points = head.floats("surface")
    quads = topology_of(head.quads, len(points))
    onto = bind(points, vertex_normals(points, quads.triangles), surface, triangles)
    return onto[rim_of_each(head)]


def rim_of_each(head: Archive) -> np.ndarray:
    """(S,) for each vertex itself, for a hidden one the vertex of the rim that it goes along with."""
    out = np.arange(len(head.mirror))
    for name, number in head.vertex.items():
        ring = name[:1] if name[:1] in "uv" else name.partition("_")[0]
        if ring in INSIDE:
            rim = head.vertex[INSIDE[ring] + name.removeprefix(ring)]
            out[number], out[head.mirror[number]] = rim, head.mirror[rim]
    return out
