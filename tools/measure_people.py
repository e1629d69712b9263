"""Measure where landmarks lie on our skin and how people's skins vary, into the files that ``mien fit`` ships with.

    python tools/measure_people.py FOLDER

FOLDER holds the reference heads. Only their fifty people ``ict_identities_more`` are read: the ten by whom fits are
judged are nowhere opened here. Each person and its mirror image count; so what varies parts into symmetric and
antisymmetric modes, each of which is told by the left half of the head.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from measuring.marks import landmark_vertices, mirrored, on_refined_skin, skins_of_people
from measuring.reference import Reference
from measuring.skin import our_skin

from mien.faces.head.arrays import format_arrays
from mien.faces.head.measured import archive
from mien.formats.atomic import writing

OUT = Path(__file__).parents[1] / "src/mien/faces/head/data"
EVEN, ODD = 40, 24
"""Modes that are kept: of the symmetric ones all but 0.7 % of the variance, of the others all but 0.5 %."""


def modes_of(fields: np.ndarray, count: int) -> np.ndarray:
    """(count, R, 3) directions of one standard deviation each, the largest first, of centred fields (N, R, 3)."""
    _, size, directions = np.linalg.svd(fields.reshape(len(fields), -1), full_matrices=False)
    directions *= np.where(directions[np.arange(len(directions)), np.abs(directions).argmax(axis=1)] < 0, -1.0, 1.0)[
        :, None
    ]
    scaled = directions * (size / np.sqrt(len(fields) - 1))[:, None]
    return scaled[:count].reshape(count, *fields.shape[1:])


def population(reference: Reference) -> dict[str, np.ndarray]:
    """The arrays of the file of people: rows are the left half of the cage, then the left eye, m."""
    skin, head = our_skin(reference.landmarks), archive()
    skins, eyes, growths = skins_of_people(reference)
    cages = np.array([skin.control(field) for field in skins])
    rows = np.concatenate([cages, eyes], axis=1)
    count = len(head.mirror)
    mirror = np.concatenate([head.mirror, [count + 1, count]])
    left = np.concatenate([np.arange(len(head.vertex)), [count]])
    flipped = mirrored(rows, mirror)
    even, odd = 0.5 * (rows + flipped)[:, left], 0.5 * (rows - flipped)[:, left]
    middle, growth = even.mean(axis=0), growths - growths.mean()
    # The growth of the eyes is one more row: as a length along x, in millimetres for a share.
    grown = np.concatenate([even - middle, (growth[:, None, None] * [1e-3, 0.0, 0.0])], axis=1)
    modes = modes_of(grown, EVEN)
    return {
        "mean": middle.astype(np.float32),
        "growth": np.float32(growths.mean()),
        "even": modes[:, :-1].astype(np.float16),
        "even_growth": (modes[:, -1, 0] * 1e3).astype(np.float32),
        "odd": modes_of(odd, ODD).astype(np.float16),
    }


def landmarks(reference: Reference) -> list[str]:
    """Rows of the table of landmarks.

    Name, triangle of the once refined cage, weights of its second and third corner, and how far apart the landmark of
    the reference lies from there.
    """
    named = landmark_vertices(reference)
    corners, weights, apart = on_refined_skin(reference, np.array(list(named.values())))
    return [
        f"{name},{a},{b},{c},{second:.4f},{third:.4f},{1e3 * far:.2f}"
        for name, (a, b, c), (_, second, third), far in zip(
            named, corners.tolist(), weights.tolist(), apart.tolist(), strict=True
        )
    ]


def main(folder: Path) -> None:
    reference = Reference(folder)
    with writing(OUT / "landmarks.csv") as path:
        path.write_text("\n".join(["name,a,b,c,second,third,apart_mm", *landmarks(reference)]) + "\n", encoding="utf-8")
    with writing(OUT / "population.arrays") as path:
        path.write_bytes(format_arrays(population(reference)))
    for name in ("landmarks.csv", "population.arrays"):
        print(f"{OUT / name}: {(OUT / name).stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
