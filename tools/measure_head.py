"""Measure what people and expressions do to our skin, on reference heads, into the file that ships.

    python tools/measure_head.py FOLDER

FOLDER holds the reference heads, their people and landmarks. Which expressions are taken is said in
tools/measuring/morphs.csv.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from measuring.morphs import measure_morphs
from measuring.reference import Reference
from measuring.skin import Skin, our_skin

from mien.faces.head.arrays import format_arrays

OUT = Path(__file__).parents[1] / "src/mien/faces/head/data/conformation.arrays"
SMALLEST_M = 2e-6


def measure(folder: Path) -> dict[str, np.ndarray]:
    """The arrays of the file that ships, from a folder of reference heads."""
    reference = Reference(folder)
    skin = our_skin(reference.landmarks)
    morphs = measure_morphs(reference, skin)
    return {"morph_names": np.array(list(morphs)), **_both("morph_", list(morphs.values()), skin)}


def _both(prefix: str, fields: list[np.ndarray], skin: Skin) -> dict[str, np.ndarray]:
    """Fields (N, S, 3) m for the surface, and for the cage whose subdivision moves like it."""
    fields = [np.where(np.abs(field) < SMALLEST_M, 0.0, field) for field in fields]
    cage = [skin.control(field) for field in fields]
    return {
        f"{prefix}cage": np.array(cage).astype(np.float16),
        f"{prefix}surface": np.array(fields).astype(np.float16),
    }


def main(folder: Path) -> None:
    OUT.write_bytes(format_arrays(measure(folder)))
    print(f"{OUT}: {OUT.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
