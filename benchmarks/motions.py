"""How far apart the standard motions are: for each, the most similar other one, on some faces.

The distance of two motions is that of their tracks at 60 frames a second, each row in shares of its range, root of
the sum over rows, mean over the time of the longer one. ``python benchmarks/motions.py [FACE ...]``
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from mien.core import Face
from mien.faces import load_face
from mien.live import Session, standard_motions
from mien.live.messages import IDLE_PARTS

FACES = ("head", "toon:olav", "toon:gus")
STILL = dict.fromkeys(IDLE_PARTS, 0.0)


def tracks(face: Face) -> dict[str, NDArray[np.float64]]:
    """(loops, P) distance from rest in shares of ranges, of each motion at 60 Hz."""
    table, found = face.parameters, {}
    room = np.where(table.highs > table.lows, table.highs - table.lows, 1.0)
    for name in standard_motions():
        session = Session(face, idle=STILL)
        loops = session.handle({"kind": "play", "motion": name})["loops"]
        found[name] = np.array([(session.step().pose.values - table.defaults) / room for _ in range(loops)])
    return found


def distance(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    """How far apart two motions are; the shorter one is at rest for the remaining time."""
    loops = max(len(one), len(other))
    first, second = (np.pad(each, ((0, loops - len(each)), (0, 0))) for each in (one, other))
    return float(np.sqrt(((first - second) ** 2).sum(axis=1)).mean())


def nearest(found: Mapping[str, NDArray[np.float64]]) -> dict[str, tuple[str, float]]:
    """For each motion the most similar other one, and how far it is."""
    best: dict[str, tuple[str, float]] = {}
    for one, other in combinations(found, 2):
        apart = distance(found[one], found[other])
        for name, neighbour in ((one, other), (other, one)):
            if name not in best or apart < best[name][1]:
                best[name] = (neighbour, apart)
    return best


def main() -> None:
    """Prints a table a face."""
    for address in sys.argv[1:] or FACES:
        best = nearest(tracks(load_face(address)))
        least = min(best, key=lambda name: best[name][1])
        print(f"{address}: {len(best)} motions; nearest pair {least} and {best[least][0]}, {best[least][1]:.3f} apart")
        for name, (neighbour, apart) in sorted(best.items(), key=lambda item: item[1][1]):
            print(f"  {name:<14} {neighbour:<14} {apart:.3f}")


if __name__ == "__main__":
    main()
