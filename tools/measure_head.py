"""Measure what people and expressions do to our skin, on reference heads, into the file that ships.

    python tools/measure_head.py FOLDER

FOLDER holds the reference heads, their people and landmarks. What is measured is said in two tables:

- tools/measuring/directions.csv, a row a parameter. Its measure is a sum of landmarks' coordinates, or of labels,
  that tells its two ends apart; the displacements of people's skin are regressed on it, ``apart`` from other measures
  whose effects are taken off. A person from scans counts 1, an adult drawn by artists a half, a child nothing. The
  result is taken relative to what stays, kept within the region and brought to the size of its end.
- tools/measuring/morphs.csv, a row an expression: which of the model's expressions are added, how much, and where.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from measuring.directions import measure_directions
from measuring.morphs import measure_morphs
from measuring.people import Population
from measuring.reference import Reference
from measuring.skin import Skin, our_skin

from mien.faces.head.arrays import format_arrays

OUT = Path(__file__).parents[1] / "src/mien/faces/head/data/conformation.arrays"
SMALLEST_M = 2e-6


def measure(folder: Path) -> dict[str, np.ndarray]:
    """The arrays of the file that ships, from a folder of reference heads."""
    reference = Reference(folder)
    skin = our_skin(reference.landmarks)
    directions = measure_directions(Population(reference), skin)
    morphs = measure_morphs(reference, skin)
    return {
        "names": np.array([each.name for each in directions]),
        **_both("", [each.field for each in directions], skin),
        "region": np.array([each.region for each in directions]).astype(np.float16),
        "end_mm": np.array([each.end_mm for each in directions]).astype(np.float32),
        "sd_mm": np.array([each.sd_mm for each in directions]).astype(np.float32),
        "morph_names": np.array(list(morphs)),
        **_both("morph_", list(morphs.values()), skin),
    }


def _both(prefix: str, fields: list[np.ndarray], skin: Skin) -> dict[str, np.ndarray]:
    """Fields (N, S, 3) m for the surface, and for the cage whose subdivision moves like it."""
    fields = [np.where(np.abs(field) < SMALLEST_M, 0.0, field) for field in fields]
    cage = [skin.control(field) for field in fields]
    return {
        f"{prefix}cage": np.array(cage).astype(np.float16),
        f"{prefix}surface": np.array(fields).astype(np.float16),
    }


def main(folder: Path) -> None:
    arrays = measure(folder)
    OUT.write_bytes(format_arrays(arrays))
    for name, end_mm, sd_mm in zip(arrays["names"], arrays["end_mm"], arrays["sd_mm"], strict=True):
        print(f"{name:24} one standard deviation {sd_mm:5.2f} mm, end {end_mm:4.1f} mm: {end_mm / sd_mm:4.1f} of them")
    print(f"{OUT}: {OUT.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
