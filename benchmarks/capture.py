"""How well faces are measured on photographs: ``python benchmarks/capture.py [--photographs FOLDER]``.

Simulated set-ups: 40 points of a face in a cube of 10 inches, seen by all cameras, which stand 90 degrees apart from
first to last. An error is the root mean square distance of the face's points from where they are, in percent of the
cube's side; of all seeds the median, and in brackets what 95 % of them stay below. ``parke``: prints of 14 by 11
inches, each enlarged by itself, clicked on a tablet of 0.05 inch in three readings. ``modern``: 1 px of 4000,
k1 = -0.15, 20 references. ``coverage`` and ``mis-clicks`` are of those set-ups. OpenCV calibrates on the same
references and triangulates the same clicks; it starts from the true focal lengths.

``boards``: the stereo photographs of a chessboard in Debian's opencv-doc, calibrated with some pairs left out and
judged on these. Without a FOLDER the package is fetched by apt-get. The pair of 1972 has a
benchmark of its own, ``capture_pair.py``.
"""

# ruff: noqa: E402
from __future__ import annotations

import argparse
import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, astuple, replace
from itertools import product
from pathlib import Path

for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")  # read when NumPy is imported

import numpy as np
from captured import chessboards, simulated
from captured.simulated import METHODS, READINGS, REFERENCES, VIEWS, Outcome

from mien.capture.simulating import Setup, simulate

Kept = dict[str, object]
RATIO = "metric / best OpenCV"
MIS_CLICKS = 0.03
TABLES = ("parke", "modern", "coverage", "mis-clicks", "boards")


def percentiles(outcomes: Sequence[Outcome | None]) -> tuple[float, float, int]:
    """Median and 95th percentile of the errors, and how many surveys were refused."""
    errors = [each.error for each in outcomes if each is not None]
    if not errors:
        return np.nan, np.nan, len(outcomes)
    return float(np.median(errors)), float(np.percentile(errors, 95)), len(outcomes) - len(errors)


def cell(outcomes: Sequence[Outcome | None]) -> str:
    """Median, 95th percentile and refusals."""
    middle, high, refused = percentiles(outcomes)
    told = [f"{refused} refused"] if refused else []
    if refused < len(outcomes):
        told.insert(0, f"{middle:.3f} ({high:.3f})" if middle < 1.0 else f"{middle:.2f} ({high:.2f})")
    return ", ".join(told)


def beside(outcomes: Mapping[str, Sequence[Outcome | None]]) -> tuple[float, float, float]:
    """Our error over that of the best setting of OpenCV, survey by survey: geometric mean and interval of 95 %."""
    best = min(
        (name for name in outcomes if name.startswith("OpenCV")), key=lambda name: percentiles(outcomes[name])[0]
    )
    both = [(one, other) for one, other in zip(outcomes["metric"], outcomes[best], strict=True) if one and other]
    ratios = np.log([one.error / other.error for one, other in both])
    middle, spread = ratios.mean(), 1.96 * ratios.std(ddof=1) / np.sqrt(len(ratios))
    low, high = np.exp([middle - spread, middle + spread])
    return float(np.exp(middle)), float(low), float(high)


def head(title: str, columns: Iterable[str], note: str = "") -> None:
    """Print the head of a table in Markdown."""
    names = list(columns)
    print(f"\n## {title}\n" + (f"\n{note}\n" if note else ""))
    print("| " + " | ".join(names) + " |\n|" + "---|" * len(names))


def row(*cells: object) -> None:
    """Print a row of a table."""
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def compare(setups: Iterable[tuple[tuple[object, ...], Setup]], seeds: range) -> Iterator[Kept]:
    """Print a row for each set-up, a column for each method."""
    for labels, setup in setups:
        outcomes = simulated.outcomes(setup, METHODS, seeds)
        against = beside(outcomes)
        row(*labels, *(cell(outcomes[method]) for method in METHODS), "{:.2f} ({:.2f} to {:.2f})".format(*against))
        yield {"setup": labels, "beside": against} | {method: percentiles(outcomes[method]) for method in METHODS}


def parke(seeds: range) -> Iterator[Kept]:
    """The errors of 1974."""
    head("Parke's cube: error, % of its side", ("tablet", "references", "views", *METHODS, RATIO))
    setups = (
        ((reading, references, views), simulated.parke(reading, references, views))
        for reading in READINGS
        for references in REFERENCES
        for views in VIEWS
    )
    yield from compare(setups, seeds)


def modern(seeds: range) -> Iterator[Kept]:
    """The errors of today."""
    head(
        "Clicks of 1 px in 4000, k1 = -0.15, 20 references: error, % of the side", ("cameras", "views", *METHODS, RATIO)
    )
    lenses = {"one, carried about": True, "one each": False}
    setups = (
        ((label, views), simulated.modern(views, one_lens=one_lens))
        for label, one_lens in lenses.items()
        for views in VIEWS
    )
    yield from compare(setups, seeds)


def coverage(seeds: range) -> Iterator[Kept]:
    """Whether ellipsoids of 95 % are that."""
    head("True places in their 95 % ellipsoids", ("set-up", "views", "points", "held, %", "χ² per degree of freedom"))
    setups = {"modern": simulated.modern} | {
        f"Parke's, {reading}, {references} references": lambda views, r=reading, n=references: simulated.parke(
            r, n, views
        )
        for reading, references in (("sigma 0.05 inch", 8), ("sigma 0.05 inch", 20), ("rounded to 0.05 inch", 8))
    }
    for label, make in setups.items():
        for views in (2, 4):
            outcomes = [each for each in simulated.outcomes(make(views), ["metric"], seeds)["metric"] if each]
            held, of = (sum(column) for column in zip(*(each.covered for each in outcomes), strict=True))
            chi2 = float(np.mean([each.chi2 for each in outcomes]))
            row(label, views, of, f"{100.0 * held / of:.1f}", f"{chi2:.3f}")
            yield {"setup": label, "views": views, "points": of, "held": held, "chi2_per_dof": chi2}


def mis_clicks(seeds: range) -> Iterator[Kept]:
    """How many are found."""
    columns = ("set-up", "views", "mis-clicks", "found, %", "their point found, %", "good clicks", "false alarms, %")
    head(f"Mis-clicks of 15 sigma, {100.0 * MIS_CLICKS:g} % of all", columns)
    setups: dict[str, Callable[[int], Setup]] = {
        "modern": lambda views: simulated.modern(views, mis_clicks=MIS_CLICKS),
        "Parke's, sigma 0.05 inch, 8 references": lambda views: replace(
            simulated.parke("sigma 0.05 inch", 8, views), mis_clicks=MIS_CLICKS
        ),
    }
    for (label, make), views in product(setups.items(), VIEWS):
        hunts = [simulated.hunt(simulate(make(views), seed)) for seed in seeds]
        total = simulated.Hunt(*np.array([astuple(each) for each in hunts]).sum(axis=0).tolist())
        found, named = (f"{100.0 * count / total.made:.1f}" for count in (total.found, total.named))
        row(label, views, total.made, found, named, total.good, f"{100.0 * total.false / total.good:.3f}")
        yield {"setup": label, "views": views} | asdict(total)


def boards(folder: Path | None, folds: int) -> Iterator[Kept]:
    """Held-out corners of real photographs."""
    head("Held-out corners of the stereo chessboards", ("calibration", "RMS, px", "RMS, % of a square"))
    with chessboards.photographs(folder) as there:
        for name, px, squares in chessboards.cross_validate(there, folds):
            row(name, f"{px:.4f}", f"{100.0 * squares:.3f}")
            yield {"calibration": name, "px": px, "squares": squares}


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--photographs", type=Path, help="folder with left01.jpg, right01.jpg, ...")
    parser.add_argument(
        "--seeds", type=int, default=12, help="surveys of each set-up; coverage takes five times as many"
    )
    parser.add_argument("--folds", type=int, default=4, help="of the chessboards")
    parser.add_argument("--json", type=Path, help="keep the figures in a file")
    parser.add_argument("--only", action="append", choices=TABLES, help="this table; may be told again")
    arguments = parser.parse_args()
    seeds, more = range(arguments.seeds), range(5 * arguments.seeds)
    tables: dict[str, Callable[[], Iterator[Kept]]] = {
        "parke": lambda: parke(seeds),
        "modern": lambda: modern(seeds),
        "coverage": lambda: coverage(more),
        "mis-clicks": lambda: mis_clicks(more),
        "boards": lambda: boards(arguments.photographs, arguments.folds),
    }
    kept = {name: list(tables[name]()) for name in arguments.only or tables}
    if arguments.json:
        arguments.json.write_text(json.dumps(kept, indent=1))


if __name__ == "__main__":
    main()
