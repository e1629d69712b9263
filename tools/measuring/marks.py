"""Places of landmarks on our skin, and the skins of people as it moves."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from mien.capture.fitting_field import superpose
from mien.capture.fitting_shape import sphere
from mien.faces.head.measured import archive
from mien.faces.head.neck import neck_share

from .closest import bind, refinement, topology_of, vertex_normals
from .reference import CM, Reference
from .skin import FLIP

IBUG = Path(__file__).with_name("ibug.csv")
"""The 68 points of the 300-W annotation on ICT-FaceKit. Source: its documentation."""

EYES = ("sclera_L", "sclera_R")


def landmark_vertices(reference: Reference) -> dict[str, int]:
    """Name -> vertex of the reference head: its landmarks, and the 68 points as ``ibug_0`` to ``ibug_67``."""
    with IBUG.open(encoding="utf-8", newline="") as lines:
        return reference.scans.landmarks | {row["point"]: int(row["vertex"]) for row in csv.DictReader(lines)}


def on_refined_skin(reference: Reference, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where vertices of the reference lie on our once refined skin: corners (N, 3), their weights (N, 3), miss (N,) m.

    Args:
        reference: the folder.
        vertices: (N,) of its neutral head.
    """
    head, source = archive(), reference.scans
    matrix, topology = refinement(topology_of(head.quads, len(head.mirror)), 1)
    arrays = reference.read("ict_head")
    skin = topology_of(arrays["faces"][arrays["face_group"] <= 1], len(source.points))
    normals = vertex_normals(source.points, skin.triangles)
    refined = matrix @ head.floats("cage")
    bound = bind(source.points[vertices], normals[vertices], refined, topology.triangles)
    miss = np.linalg.norm(bound @ refined - source.points[vertices], axis=1)
    return bound.indices.reshape(-1, 3), bound.data.reshape(-1, 3), miss


def skins_of_people(reference: Reference) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Moves (N, S, 3) m of our skin that make people of it, (N, 2, 3) m of the eyes, and how these grow (N,).

    Each is turned and shifted, not scaled, so that all that moves with the head lies nearest to ours.
    """
    source, arrays = reference.scans, reference.read("ict_head")
    resting = source.onto_skin @ source.points
    neutral = arrays["verts"].astype(np.float64) * CM
    whole = neck_share(archive().floats("surface")) == 1.0
    names = arrays["group_names"].tolist()
    balls = [np.flatnonzero(arrays["vert_group"] == names.index(name)) for name in EYES]
    own = [sphere(neutral[ball]) for ball in balls]
    ours = archive().floats("eye_centre")
    skins, eyes, growths = [], [], []
    for person in neutral + source.people:
        skin = source.onto_skin @ person
        placing = superpose(skin[whole], resting[whole], scaled=False)
        skins.append(placing.to_world(skin) - resting)
        found = [sphere(person[ball]) for ball in balls]
        growth = float(np.mean([radius / before for (_, radius), (_, before) in zip(found, own, strict=True)]))
        # Our balls lie before those of the reference; they go along, and grow with them.
        before = np.array([centre for centre, _ in own])
        centres = np.array([centre for centre, _ in found]) + growth * (ours - before)
        eyes.append(placing.to_world(centres) - ours)
        growths.append(growth)
    return np.array(skins), np.array(eyes), np.array(growths)


def mirrored(moves: np.ndarray, mirror: np.ndarray) -> np.ndarray:
    """Moves (N, R, 3) in the mirror; ``mirror`` (R,) tells the row that each row becomes."""
    return moves[:, mirror] * FLIP
