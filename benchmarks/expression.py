"""How near each action unit comes to the reference's shape: ``python benchmarks/expression.py FOLDER``.

FOLDER holds the reference heads: ``ict_head.npz`` and ``ict_expressions.npz``. The head is posed by the vocabulary
``facs``, its skin is subdivided once, and every point of it that is seen is bound to the nearest point of the
reference's skin that faces the same way. What moves by more than a tenth of the most is the moving region; there both
displacements are compared: Pearson's correlation of their components, and the difference in millimetres. Which shapes
make a unit is said in ``expression.csv``; of the open jaw the reference has one state, at 25.3 degrees, and half the
shape is half that move along straight lines.

Our head departs from the reference on purpose: smaller eyeballs with lids that meet lower, and lips that are closed at
rest where the reference leaves 0.8 mm.
"""

from __future__ import annotations

import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tools"))
from measuring.closest import bind, refinement, topology_of, vertex_normals  # noqa: E402
from measuring.reference import CM, Reference  # noqa: E402

from mien.core import Pose  # noqa: E402
from mien.faces.head import Head  # noqa: E402
from mien.faces.head.measured import archive  # noqa: E402
from mien.faces.registry import load_face  # noqa: E402
from mien.vocab import pose_from  # noqa: E402

WANTED = (0.9, 1.0)
"""Correlation, and millimetres RMS."""

MOVING = 0.1
HIDDEN = ("mouth", "nostril", "lidin")
FARTHEST_M = 0.004
"""A point of our skin this far from the reference's has no counterpart there."""


FOLDS = ("AU1", "AU2", "AU4", "AU6", "AU7", "AU9", "AU10", "AU11", "AU12", "AU17")
"""Units that are known by their folds: forehead, glabella, eye corner, lower lid, nose, cheek, chin."""


@dataclass(frozen=True)
class Row:
    """One unit: shapes, points of the moving region, largest move, RMS and largest difference, mm, and correlation."""

    unit: str
    shapes: str
    count: int
    largest_mm: float
    correlation: float
    rms_mm: float
    worst_mm: float
    where: str

    @property
    def good(self) -> bool:
        """Whether it is as near as wanted."""
        return self.correlation >= WANTED[0] and self.rms_mm <= WANTED[1]


class Comparison:
    """Our skin on the reference's.

    Args:
        folder: of the reference heads.
        head: to compare.
    """

    def __init__(self, folder: Path, head: Head) -> None:
        reference = Reference(folder)
        expressions = reference.read("ict_expressions")
        self.head, self.names = head, expressions["names"].tolist()
        self.deltas = expressions["deltas"]
        own = archive()
        topology = topology_of(own.quads, len(own.mirror))
        self.refine, fine = refinement(topology, 1)
        points = self.refine @ own.floats("cage")
        ict = reference.read("ict_head")
        skin = topology_of(ict["faces"][ict["face_group"] <= 1], len(ict["verts"]))
        surface = reference.scans.points
        self.onto = bind(points, vertex_normals(points, fine.triangles), surface, skin.triangles)
        hidden = np.isin(own.groups, [own.group_names.index(name) for name in HIDDEN])
        seen = np.zeros(len(points), dtype=bool)
        quads = fine.corners.reshape(-1, 4)
        seen[quads[~hidden.repeat(4)]] = True
        seen[quads[hidden.repeat(4)]] = False
        near = np.linalg.norm(self.onto @ surface - points, axis=1) < FARTHEST_M
        self.seen = seen & near
        self.rest = self._skin(head.neutral)
        self.labels = np.array(_nearest_names(points))

    def row(self, unit: str, shapes: str) -> Row:
        """The unit compared."""
        wanted = self.wanted(shapes)
        given = self._skin(pose_from("facs", {unit: 1.0}, self.head)) - self.rest
        length = np.linalg.norm(wanted, axis=1)
        moving = self.seen & (length > MOVING * length[self.seen].max())
        a, b = 1000.0 * wanted[moving], 1000.0 * given[moving]
        missed = np.linalg.norm(a - b, axis=1)
        where = self.labels[moving][missed.argmax()]
        correlation = float(np.corrcoef(a.ravel(), b.ravel())[0, 1])
        rms = float(np.sqrt((missed**2).mean()))
        return Row(
            unit, shapes, len(a), 1000.0 * length[moving].max(), correlation, rms, float(missed.max()), str(where)
        )

    def wanted(self, shapes: str) -> np.ndarray:
        """(S', 3) m, what the reference's shapes do at the points of our subdivided skin."""
        total = np.zeros((self.onto.shape[1], 3))
        for each in shapes.split():
            name, _, share = each.partition("=")
            total += float(share or 1.0) * self.deltas[self.names.index(name)].astype(np.float64)
        return self.onto @ total * CM

    def fold(self, unit: str) -> tuple[str, float]:
        """Vertex of the skin that a unit darkens most, and the share of its light that is gone."""
        count = self.refine.shape[1]
        rest = self.head.shape(self.head.neutral).colors[:count]
        light = (self.head.shape(pose_from("facs", {unit: 1.0}, self.head)).colors[:count] / rest).min(axis=1)
        vertex = int(light.argmin())
        return self.labels[vertex], 1.0 - float(light[vertex])

    def _skin(self, pose: Pose) -> np.ndarray:
        return self.refine @ self.head.shape(pose).points[: self.refine.shape[1]]


def _nearest_names(points: np.ndarray) -> list[str]:
    own = archive()
    cage, names = own.floats("cage"), {number: name for name, number in own.vertex.items()}
    named = np.array(sorted(names))
    return [names[int(named[((cage[named] - (abs(p[0]), p[1], p[2])) ** 2).sum(axis=1).argmin()])] for p in points]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--face", default="head")
    arguments = parser.parse_args()
    head = load_face(arguments.face)
    if not isinstance(head, Head):
        raise SystemExit(f"{arguments.face} is no head")
    comparison = Comparison(arguments.folder, head)
    with (Path(__file__).parent / "expression.csv").open(encoding="utf-8") as file:
        rows = [comparison.row(row["unit"], row["shapes"]) for row in csv.DictReader(file)]
    print(f"{'unit':6s}{'points':>7s}{'largest':>9s}{'correlation':>13s}{'RMS':>7s}{'worst':>8s}  at     shapes")
    for row in rows:
        print(
            f"{row.unit:6s}{row.count:7d}{row.largest_mm:6.1f} mm{row.correlation:13.3f}{row.rms_mm:7.2f}"
            f"{row.worst_mm:8.1f}  {row.where:6s} {row.shapes}{'' if row.good else '  <-- short'}"
        )
    print(f"\n{sum(row.good for row in rows)} of {len(rows)} as near as wanted: {WANTED[0]}, {WANTED[1]} mm RMS\n")
    for unit in FOLDS:
        where, share = comparison.fold(unit)
        print(f"{unit:6s}darkest fold {share:4.0%} at {where}")


if __name__ == "__main__":
    main()
