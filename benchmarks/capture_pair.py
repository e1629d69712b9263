"""What a front and a side photograph give without a cube, as in 1972, and with perspective solved for.

    python benchmarks/capture_pair.py [--seeds 10] [--points 80]

Points of the built-in head are photographed in pairs at 3000 by 4000 px, a face that fills 60 % of the height, and
clicked with noise. Errors are root mean squares over points that both photographs show, in % of a head of 0.23 m, once
the found face is laid on the true one (turned and shifted, not scaled).
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator

import numpy as np

from mien.capture.pair import solve_pair
from mien.capture.pair_simulating import FRONT_FILE, HEAD_M, SIDE_FILE, Marks, PairSetup, marks_of_head, simulate_pair
from mien.capture.records import Survey

DISTANCES_M = (1.0, 1.5, 2.0, 3.0, 5.0)
CLICKS_PX = (0.5, 1.0, 3.0)
TURNS_DEG = (0.0, 1.0, 3.0)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=10, help="pairs of each kind")
    parser.add_argument("--points", type=int, default=80, help="points marked on half of the head")
    given = parser.parse_args()
    print("| camera, m | clicks, px | turns, ° | as in 1972, % | with perspective, % | distance found, m |")
    print("|---|---|---|---|---|---|", flush=True)
    for distance, click, turn in cases():
        flat, solved, found = measure(distance, click, turn, given.points, given.seeds)
        print(
            f"| {distance:g} | {click:g} | {turn:g} | {flat:.2f} | {solved:.2f} | {found:.2f} |",
            flush=True,
        )


def cases() -> Iterator[tuple[float, float, float]]:
    """Distances with clicks of a pixel and no turn; then other clicks; then turned heads."""
    yield from ((distance, 1.0, 0.0) for distance in DISTANCES_M)
    yield from ((1.5, click, 0.0) for click in CLICKS_PX if click != 1.0)
    yield from ((1.5, 1.0, turn) for turn in TURNS_DEG if turn)


def measure(distance_m: float, click_px: float, turn_deg: float, points: int, seeds: int) -> tuple[float, float, float]:
    """Errors without and with perspective, % of the head, and the median of the found distances, m."""
    flat, solved, found = [], [], []
    for seed in range(seeds):
        random = np.random.default_rng(seed)
        front, side = (random.normal(size=(2, 3)) * turn_deg).tolist()
        marks = marks_of_head(points, seed)
        setup = PairSetup((distance_m, distance_m), (tuple(front), (*side[:2], 0.0)), sigma_px=click_px)
        survey, _ = simulate_pair(setup, marks, seed)
        for orthographic, errors in ((True, flat), (False, solved)):
            error, distances = error_of(survey, marks, orthographic)
            errors.append(error)
        found += distances
    return (*(100.0 * math.sqrt(np.mean(np.square(each))) for each in (flat, solved)), float(np.median(found)))


def error_of(survey: Survey, marks: Marks, orthographic: bool) -> tuple[float, list[float]]:
    """Error of a solved pair as a share of the head, and the distances of its cameras."""
    seen = [{each.point for each in survey.observations if each.photo == name} for name in (FRONT_FILE, SIDE_FILE)]
    both = sorted(seen[0] & seen[1])
    low, *_, high = sorted(both, key=lambda name: float(marks.places[name][1]))
    length = float(np.linalg.norm(marks.places[low] - marks.places[high]))
    solution = solve_pair(
        survey,
        front=FRONT_FILE,
        side=SIDE_FILE,
        scale=(low, high, length),
        midline=[name for name in marks.midline if name in seen[0] | seen[1]],
        orthographic=orthographic,
        mirror=False,
    )
    found = {point.name: point.place for point in solution.points.values()}
    there = [name for name in both if name in found]
    off = laid_on([found[name] for name in there], [marks.places[name] for name in there])
    distances = [float(np.linalg.norm(camera.place)) for camera in solution.cameras.values()]
    return float(np.sqrt(np.mean(np.sum(off**2, axis=1)))) / HEAD_M, distances


def laid_on(found: list[np.ndarray], true: list[np.ndarray]) -> np.ndarray:
    """(N, 3) m, what is wrong once the found points are turned and shifted onto the true ones (Kabsch 1976)."""
    one, other = np.array(found) - np.mean(found, axis=0), np.array(true) - np.mean(true, axis=0)
    left, _, right = np.linalg.svd(one.T @ other)
    keep = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    return one @ left @ keep @ right - other


if __name__ == "__main__":
    main()
