"""How far random poses are from breaking a head: ``python benchmarks/never_breaks.py [--poses 2000] [--first SEED]``.

All of Parke's parameters are drawn at random, in every other pose many of them at the ends of their ranges, and the
eyes look anywhere ahead; ``--corners parke`` puts each of his parameters at one of its ends, ``--corners all`` every
one of the table. What needs pictures is measured on every ninth pose.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))  # where the measures are that the tests use

from breaking import MEASURES, Measure, corner_pose, parke_corner, parke_pose
from mien.faces.head import Head

EVERY = 9
CORNERS = {"parke": parke_corner, "all": corner_pose}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--poses", type=int, default=2000)
    parser.add_argument("--first", type=int, default=0, help="seed of the first pose")
    parser.add_argument("--corners", choices=CORNERS, help="Parke's parameters, or all, each at one of its ends")
    arguments = parser.parse_args()
    head, draw = Head(hair="bald"), CORNERS.get(arguments.corners, parke_pose)
    found: dict[str, dict[int, float]] = {measure.name: {} for measure in MEASURES}
    for seed in range(arguments.first, arguments.first + arguments.poses):
        posed = draw(head, seed)
        for measure in MEASURES:
            if not measure.dear or seed % EVERY == 0:
                found[measure.name][seed] = measure.of(posed)
    print("| measure | wanted | median | worst | seed | poses that fail |")
    print("|---|---|---|---|---|---|")
    for measure in MEASURES:
        print(row(measure, found[measure.name]))


def row(measure: Measure, values: dict[int, float]) -> str:
    """A line of the table."""
    worst = max(values, key=lambda seed: values[seed])
    numbers = np.array(list(values.values()))
    share = 100.0 * float((numbers > measure.most).mean())
    cells = f"{np.median(numbers):.2f} | {values[worst]:.2f} | {worst} | {share:.1f} % of {len(numbers)}"
    return f"| {measure.name} | {measure.most:g} | {cells} |"


if __name__ == "__main__":
    main()
