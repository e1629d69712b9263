"""How much of ten unseen people the measured directions explain: ``python benchmarks/identities.py FOLDER``.

FOLDER holds the reference heads; its ``ict_identities_dev`` is read here and nowhere else. Each person is freed of
size and pose as the people were from which the directions come, then fitted by least squares: without bounds, and
within the ends of the parameters.
"""

from __future__ import annotations

import argparse
import sys
from importlib.resources import files
from pathlib import Path

import numpy as np
from scipy.optimize import lsq_linear

sys.path.insert(0, str(Path(__file__).parents[1] / "tools"))
from measuring.people import align
from measuring.reference import CM, Reference, rim_of_each

from mien.faces.head.arrays import parse_arrays
from mien.faces.head.measured import archive

LOWEST = {"age": 0.0}
"""The lower end where it is not -1."""


def rms_mm(field: np.ndarray) -> float:
    """Root mean square length, mm, of displacements (N, 3) m."""
    return 1000.0 * float(np.sqrt((field**2).sum(axis=-1).mean()))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="the reference heads")
    reference = Reference(parser.parse_args().folder)
    arrays = parse_arrays(files("mien.faces.head").joinpath("data/conformation.arrays").read_bytes())
    names = [str(name) for name in arrays["names"]]
    shown = rim_of_each(archive()) == np.arange(len(archive().mirror))
    reached = shown & (arrays["region"].max(axis=0) > 0.5)
    people = reference.read("ict_identities_dev")
    fields, _ = align(reference.scans, people["deltas"].astype(np.float64) * CM)
    low = [LOWEST.get(name, -1.0) for name in names]
    rows = []
    for field in fields:
        row = []
        for part in (shown, reached):
            design = arrays["surface"][:, part].astype(np.float64).reshape(len(names), -1).T
            wanted = field[part].ravel()
            row.append(rms_mm(field[part]))
            for bounds in ((-np.inf, np.inf), (low, 1.0)):
                row.append(rms_mm((wanted - design @ lsq_linear(design, wanted, bounds).x).reshape(-1, 3)))
        rows.append(row)
    print("| RMS mm | all skin | fitted | within the ends | where directions reach | fitted | within the ends |")
    print("|---|---|---|---|---|---|---|")
    for name, row in [*zip(people["names"], rows, strict=True), ("mean", np.mean(rows, axis=0))]:
        print(f"| {name} | " + " | ".join(f"{value:.2f}" for value in row) + " |")


if __name__ == "__main__":
    main()
