"""Solve photographs of ``tools/photograph.py``, make the face, and tell how far its points are from the truth.

    python tools/measure_person.py ../vera src/mien/faces/keypose/data/vera.keypose

does what ``mien capture solve`` and ``mien capture keypose`` do, and prints a row for each phase: how many points were
measured and guessed, and how far they lie from where the dots truly were, in mm (RMS), both faces laid onto one another
once, at rest.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from mien.capture.making import make_keypose
from mien.capture.project import read_project, solve_project, write_solution
from mien.capture.registering import fit_robustly


def main(folder: Path, out: Path) -> None:
    solution = solve_project(folder, report=lambda text: print(text, file=sys.stderr))
    write_solution(folder, solution, read_project(folder).unit)
    made = make_keypose(folder, out, report=lambda text: print(text, file=sys.stderr))
    with np.load(folder / "truth.npz") as arrays:
        truth, phases = arrays["places"], arrays["phases"].tolist()
    faces, measured = made.keypose.places, made.phases.measured
    assert tuple(phases) == made.keypose.phases, "the truth is of another project"  # noqa: S101
    motion = fit_robustly(truth[0][measured[0]], faces[0][measured[0]])
    off_mm = 1000.0 * np.linalg.norm(faces - motion.apply(truth.reshape(-1, 3)).reshape(truth.shape), axis=2)
    print("| phase | measured | RMS mm | 95 % mm | guessed | RMS mm |")
    print("|---|---|---|---|---|---|")
    for phase, off, seen in zip(phases, off_mm, measured, strict=True):
        print(f"| {phase} | {seen.sum()} | {_rms(off[seen])} | {np.quantile(off[seen], 0.95):.2f} "
              f"| {(~seen).sum()} | {_rms(off[~seen])} |")  # fmt: skip
    print(f"| all | {measured.sum()} | {_rms(off_mm[measured])} | {np.quantile(off_mm[measured], 0.95):.2f} "
          f"| {(~measured).sum()} | {_rms(off_mm[~measured])} |")  # fmt: skip
    print(f"{made.colored} of {made.polygons} polygons coloured from photographs; χ² a degree of freedom "
          f"{solution.chi2_per_dof:.2f}, {len(solution.suspects)} suspects")  # fmt: skip
    for remark in made.remarks:
        print(remark)


def _rms(off_mm: np.ndarray) -> str:
    return f"{np.sqrt((off_mm**2).mean()):.2f}" if len(off_mm) else "–"


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
