"""How near the head's parameters come to ten unseen people: ``python benchmarks/identities.py FOLDER``.

FOLDER holds the reference heads; its ``ict_identities_dev`` is read here and nowhere else. Each person is freed of
size and pose, as the people were from whom the directions come, then fitted by least squares within the ends of the
parameters: by the measured directions, and by all parameters of the shape. What does not turn with the head is left
out: people hold their necks at angles of their own.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import lsq_linear

sys.path.insert(0, str(Path(__file__).parents[1] / "tools"))
from measuring.people import align
from measuring.reference import CM, Reference, rim_of_each

from mien.core import Parameter, Pose
from mien.faces.head.head import Head
from mien.faces.head.measured import archive
from mien.faces.head.neck import neck_share
from mien.faces.head.table import conformation_rows

MEASURED = ("blend",)
WHOLE = (*MEASURED, "scale", "move", "lids", "turn", "head")
STEPS = 6
SMALL = 0.05
"""Step of a finite difference, as a share of a parameter's range."""
EASE_M = 3e-4
"""What a parameter must gain, root mean square, to go to an end: two that do the same are not set against another."""


class Fit:
    """Fits of the head's parameters of some kinds (S of its skin is counted) to people."""

    def __init__(self, kinds: tuple[str, ...]) -> None:
        points = archive().floats("surface")
        self.counted = (rim_of_each(archive()) == np.arange(len(points))) & (neck_share(points) == 1.0)
        self._head = Head(hair="bald").unsubdivided
        self._rest = self._head.neutral
        self._rows = list(self._rows_of(kinds))

    def miss(self, field: np.ndarray) -> np.ndarray:
        """What is left (S, 3) m of the displacement (S, 3) of a person's skin by Gauss and Newton's steps."""
        rows = self._rows
        low, high, default = (np.array([getattr(row, name) for row in rows]) for name in ("low", "high", "default"))
        span, values, pose = high - low, default, self._rest
        ease = EASE_M * np.sqrt(len(field)) * np.eye(len(rows))
        for _ in range(STEPS):
            slopes = np.column_stack([self._moved(pose, row).ravel() for row in rows])
            design = np.vstack([slopes, ease])
            wanted = np.concatenate([self._left(field, pose).ravel(), ease @ (default - values) / span])
            values = values + span * lsq_linear(design, wanted, ((low - values) / span, (high - values) / span)).x
            values = np.clip(values, low, high)
            pose = self._rest.replace(dict(zip((row.name for row in rows), values.tolist(), strict=True)))
        return self._left(field, pose)

    def _rows_of(self, kinds: tuple[str, ...]) -> list[Parameter]:
        """The parameters of the table's rows, but those that move no skin."""
        rows = [row for row in conformation_rows() if row["kind"] in kinds]
        names = [row["name"] + side for row in rows for side in ((".left", ".right") if row["sides"] else ("",))]
        return [row for row in map(self._rest.table.__getitem__, names) if self._moved(self._rest, row).any()]

    def _left(self, field: np.ndarray, pose: Pose) -> np.ndarray:
        return field - (self._skin(pose) - self._skin(self._rest))

    def _skin(self, pose: Pose) -> np.ndarray:
        return self._head.shape(pose).points[: len(self.counted)][self.counted]

    def _moved(self, pose: Pose, row: Parameter) -> np.ndarray:
        """What the whole range of a parameter would move, by a small part of it towards the farther end."""
        value, span = pose[row.name], row.high - row.low
        share = SMALL if row.high - value > value - row.low else -SMALL
        return (self._skin(pose.replace({row.name: value + share * span})) - self._skin(pose)) / share


def rms_mm(field: np.ndarray) -> float:
    """Root mean square length, mm, of displacements (S, 3) m."""
    return 1000.0 * float(np.sqrt((field**2).sum(axis=-1).mean()))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="the reference heads")
    reference = Reference(parser.parse_args().folder)
    people = reference.read("ict_identities_dev")
    fields, _ = align(reference.scans, people["deltas"].astype(np.float64) * CM)
    fits = [Fit(MEASURED), Fit(WHOLE)]
    fields = fields[:, fits[0].counted]
    rows = [[rms_mm(field), *(rms_mm(fit.miss(field)) for fit in fits)] for field in fields]
    print("| RMS mm | neutral head | measured directions | all parameters of the shape |\n|---|---|---|---|")
    for name, row in [*zip(people["names"], rows, strict=True), ("mean", np.mean(rows, axis=0))]:
        print(f"| {name} | " + " | ".join(f"{value:.2f}" for value in row) + " |")


if __name__ == "__main__":
    main()
