"""How near a head fitted to points comes to ten unseen people: ``python benchmarks/fit_head.py FOLDER``.

FOLDER holds the reference heads; the people of its ``ict_identities_dev`` are measured here at named points, with
noise, turned and put somewhere, and fitted by ``mien.capture.fitting``. The error is taken over the group ``face`` of
the reference, which reaches from the hairline over the ears to the front of the neck, where our resting head has skin
within a millimetre of it (its other vertices lie in the nostrils and below the collar): our skin, once subdivided, is
superposed rigidly by the points that correspond, then

- surface: its distance from the nearest point of the person's skin (root mean square; the mean of ten people),
- points: its distance from the points that correspond.

20 points are named below, 68 are those of 300-W, more are vertices of the cage spread evenly over the face.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy.sparse as sp

sys.path.insert(0, str(Path(__file__).parents[1] / "tools"))
from measuring.closest import bind, refinement, topology_of, vertex_normals
from measuring.marks import landmark_vertices
from measuring.reference import CM, Reference, rim_of_each

from mien.capture.fitting import fit_head
from mien.capture.fitting_field import superpose, turn_by
from mien.capture.fitting_places import known_places
from mien.faces.head.head import Head
from mien.faces.head.measured import archive

TWENTY = (
    "nasion", "glabella", "pronasale", "subnasale", "labrale_superius", "labrale_inferius", "pogonion", "trichion",
    *(f"{name}_{side}" for name in ("endocanthion", "exocanthion", "alare", "cheilion", "tragion", "gonion")
      for side in "LR"),
)  # fmt: skip
COUNTS, NOISES_MM = (20, 68, 120, 200, 400), (0.0, 0.5, 1.0, 2.0)
ALONE_AT_MM = 0.5
LEAST_MM = 0.2
"""Standard deviation that exact points are said to have."""
COUNTERPART_M = 0.001
TURN, SHIFT = turn_by(np.array([0.3, -0.8, 0.2])), np.array([0.4, 1.5, -0.7])


@dataclass(frozen=True, eq=False)
class Rig:
    """What does not change from person to person.

    Attributes:
        people: (N, V, 3) m.
        names: point -> weights (V,) of its place on the reference.
        face: vertices of the reference by which errors are taken.
        onto: (face, S') weights of our once subdivided skin at their counterparts.
        fine: (S', S) the subdivision.
        triangles: of that skin.
        outside: triangles of the reference's skin.
    """

    people: np.ndarray
    names: dict[str, sp.csr_matrix]
    face: np.ndarray
    onto: sp.csr_matrix
    fine: sp.csr_matrix
    triangles: np.ndarray
    outside: np.ndarray

    def errors(self, cage: np.ndarray, person: np.ndarray) -> tuple[float, float]:
        """RMS mm of a head from the surface of a person (V, 3) m, and from the points that correspond."""
        skin, wanted = self.fine @ cage, person[self.face]
        skin = superpose(self.onto @ skin, wanted, scaled=False).to_world(skin)
        own, normals = self.onto @ skin, self.onto @ vertex_normals(skin, self.triangles)
        nearest = bind(own, normals, person, self.outside) @ person
        return _rms_mm(own - nearest), _rms_mm(own - wanted)


def _rms_mm(missed: np.ndarray) -> float:
    return 1000.0 * float(np.sqrt((missed**2).sum(axis=1).mean()))


def make_rig(reference: Reference) -> Rig:
    head, source, arrays = archive(), reference.scans, reference.read("ict_head")
    fine, topology = refinement(topology_of(head.quads, len(head.mirror)), 1)
    outside = topology_of(arrays["faces"][arrays["face_group"] <= 1], len(source.points)).triangles
    normals = vertex_normals(source.points, outside)
    face = np.flatnonzero(arrays["vert_group"] == 0)
    onto = bind(source.points[face], normals[face], fine @ head.floats("cage"), topology.triangles)
    near = np.linalg.norm(onto @ fine @ head.floats("cage") - source.points[face], axis=1) < COUNTERPART_M
    people = arrays["verts"].astype(np.float64) * CM + reference.read("ict_identities_dev")["deltas"].astype(float) * CM
    return Rig(people, _names(reference, face), face[near], onto[near], fine, topology.triangles, outside)


def _names(reference: Reference, face: np.ndarray) -> dict[str, sp.csr_matrix]:
    """Landmarks, and those vertices of the cage that lie on the reference's group ``face`` and show."""
    source, head = reference.scans, archive()
    count = len(source.points)
    rows = {name: sp.csr_matrix(([1.0], ([0], [v])), (1, count)) for name, v in landmark_vertices(reference).items()}
    shown = rim_of_each(head) == np.arange(len(head.mirror))
    for name, number in head.vertex.items():
        for side, vertex in ((".left", number), (".right", int(head.mirror[number]))):
            row = source.onto_skin[vertex]
            twice = side == ".right" and vertex == number
            if name + side in known_places() and shown[vertex] and not twice and np.isin(row.indices, face).all():
                rows[name + side] = row
    return rows


def chosen(rig: Rig, count: int) -> list[str]:
    """Names of so many points."""
    if count == 20:
        return list(TWENTY)
    if count == 68:
        return [f"ibug_{number}" for number in range(68)]
    names = [name for name in rig.names if name.endswith((".left", ".right"))]
    places = np.array([(rig.names[name] @ rig.people[0])[0] for name in names])
    out, far = [int(places[:, 2].argmax())], np.full(len(names), np.inf)
    while len(out) < min(count, len(names)):
        far = np.minimum(far, np.linalg.norm(places - places[out[-1]], axis=1))
        out.append(int(far.argmax()))
    return [names[number] for number in out]


def measured(rig: Rig, person: np.ndarray, names: list[str], noise_mm: float, seed: int) -> dict[str, np.ndarray]:
    noise = np.random.default_rng(seed).normal(0.0, noise_mm / 1000.0, (len(names), 3))
    places = np.array([(rig.names[name] @ person)[0] for name in names]) @ TURN.T + SHIFT + noise
    return dict(zip(names, places, strict=True))


def fitted_error(rig: Rig, number: int, names: list[str], noise_mm: float, residual: bool) -> tuple[float, float]:
    person = rig.people[number]
    points = measured(rig, person, names, noise_mm, 1000 * len(names) + number)
    head = fit_head(points, max(noise_mm, LEAST_MM) / 1000.0, residual=residual).head()
    return rig.errors(head.shape(head.neutral).points[: rig.fine.shape[1]], person)


def _alone(rig: Rig, names: list[str], noise_mm: float, people: range) -> str:
    """Errors without a residual, for one noise only: they hardly depend on it."""
    if noise_mm != ALONE_AT_MM:
        return ""
    errors = np.mean([fitted_error(rig, number, names, noise_mm, False) for number in people], axis=0)
    return f"{errors[0]:.2f}, {errors[1]:.2f}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="the reference heads")
    parser.add_argument("--counts", type=int, nargs="+", default=COUNTS, help="of points")
    parser.add_argument("--noises", type=float, nargs="+", default=NOISES_MM, help="standard deviations, mm")
    parser.add_argument("--people", type=int, default=10, help="how many of the ten")
    arguments = parser.parse_args()
    rig = make_rig(Reference(arguments.folder))
    people = range(arguments.people)
    neutral = Head(hair="bald")
    resting = neutral.shape(neutral.neutral).points[: rig.fine.shape[1]]
    aligned = np.mean([rig.errors(resting, rig.people[number]) for number in people], axis=0)
    print(f"{len(rig.face)} vertices of the group face\n")
    print("| points | noise mm | surface RMS mm | worst of ten | points RMS mm | parameters alone: surface, points |")
    print("|---|---|---|---|---|---|")
    print(f"| none: resting head, aligned | | {aligned[0]:.2f} | | {aligned[1]:.2f} | |")
    for count in arguments.counts:
        names = chosen(rig, count)
        for noise in arguments.noises:
            errors = np.array([fitted_error(rig, number, names, noise, True) for number in people])
            surface, points = errors.mean(axis=0)
            cells = f"{surface:.2f} | {errors[:, 0].max():.2f} | {points:.2f}"
            print(f"| {len(names)} | {noise:g} | {cells} | {_alone(rig, names, noise, people)} |", flush=True)


if __name__ == "__main__":
    main()
