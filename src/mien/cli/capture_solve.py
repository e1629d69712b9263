"""``mien capture solve``: cameras and points of a project, and how good they are."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mien.capture.project_records import Project
    from mien.capture.records import Residual, Solution, SolvedPoint

WORST = 5
"""Points and suspects that a person is shown; all of them are in the files."""

Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A capture project, the folder of a project.toml.")]


def solve(
    folder: Folder,
    method: Annotated[
        str | None,
        typer.Option("--method", metavar="NAME", help="metric, or appendix-c as of 1974.  [default: metric]"),
    ] = None,
    quiet: options.Quiet = False,
    as_json: options.Json = False,
) -> None:
    """Find cameras and points from what was seen in photographs, and write them into DIR/solution.

    Tells how far points are seen from where the solution has them (RMS, pixels), how exact their places are, which
    clicks look like mistakes (they take no part), and what was assumed. A project with [pair] is solved as a front and
    a side photograph without references. Boards that were not looked for yet are looked for first.

    \b
    mien capture solve anna
    mien capture solve anna --method appendix-c
    mien capture solve anna --json --quiet > anna.json
    """
    from mien.capture.project import read_project, solve_project, write_solution

    from .listing import print_json, show
    from .stages import Stages

    stages = Stages(quiet)
    with stages.stage("solved"):
        solution = solve_project(folder, method=method, report=stages.say)
    project = read_project(folder)
    out = write_solution(folder, solution, project.unit)
    if as_json:
        print_json(described(solution, out))
    elif not quiet:
        show(summary_lines(solution, project))
        stages.say(f"{out}: cameras.json, points.csv, residuals.csv, solution.json")


def summary_lines(solution: Solution, project: Project) -> list[str]:
    """What a person is told of a solution."""
    from mien.capture.summaries import measured, worst_points

    found, suspects, clicks = measured(solution), solution.suspects, len(solution.residuals)
    lines = [
        f"{solution.method}: {len(solution.cameras)} photographs, {_points(found)}, {clicks} clicks",
        *_error_lines(solution),
        *([] if not found else _point_lines(found, worst_points(solution, WORST), project.unit)),
    ]
    if suspects:
        lines += [
            "",
            f"{_count(len(suspects), 'click')} that {'do' if len(suspects) > 1 else 'does'} not fit, left out:",
        ]
        lines += [f"  {_suspect(each, project)}" for each in suspects[:WORST]]
        lines += [f"  … and {len(suspects) - WORST} more, in residuals.csv"] * (len(suspects) > WORST)
    if solution.remarks:
        lines += ["", "Remarks:", *(f"  {remark}" for remark in solution.remarks)]
    return lines


def _error_lines(solution: Solution) -> list[str]:
    from mien.capture.summaries import errors_by_photo, rms_px

    errors = errors_by_photo(solution)
    if not errors:
        return []
    photo, worst = max(errors.items(), key=lambda item: item[1])
    return [
        f"clicks are {rms_px(solution):.2f} px from the solution (RMS), {worst:.2f} px in {photo}; "
        f"χ² a degree of freedom {solution.chi2_per_dof:.2f}, 1 where sigmas are right"
    ]


def _point_lines(found: Sequence[SolvedPoint], worst: Sequence[SolvedPoint], unit: str) -> list[str]:
    from mien.capture.summaries import places_rms, sigma_m

    def told(length_m: float) -> str:
        from mien.capture.project_records import METRES

        return f"{length_m / METRES[unit]:.3g} {unit}"

    several = len({point.moment for point in found}) > 1
    names = (f"{point.name}{f' of {point.moment}' if several else ''} {told(sigma_m(point))}" for point in worst)
    return [f"points are exact to {told(places_rms(found))} (RMS of their sigmas); least exact: {', '.join(names)}"]


def _suspect(each: Residual, project: Project) -> str:
    from mien.capture.project_records import BOARDS, POINTS

    seen = each.observation
    file = BOARDS if seen.point.partition(":")[0] in (board.target for board in project.boards) else POINTS
    place = f"{project.folder / file}:{seen.line}: " if seen.line else ""
    return (
        f"{place}{seen.point} in {seen.photo} is {abs(complex(each.du, each.dv)):.1f} px off "
        f"({each.du:+.1f}, {each.dv:+.1f})"
    )


def described(solution: Solution, out: Path) -> dict[str, object]:
    """What a program is told of a solution."""
    from mien.capture.summaries import errors_by_photo, measured, rms_px, sigma_m

    return {
        "solution": str(out),
        "method": solution.method,
        "rms_px": round(rms_px(solution), 4),
        "chi2_per_dof": round(solution.chi2_per_dof, 4),
        "photographs": {name: {"rms_px": round(error, 4)} for name, error in errors_by_photo(solution).items()},
        "points": [
            {
                "name": point.name,
                "moment": point.moment,
                "kind": point.kind,
                "place_m": [float(x) for x in point.place],
                "sigma_m": sigma_m(point),
            }
            for point in measured(solution)
        ],
        "suspects": [
            {
                "photo": each.observation.photo,
                "point": each.observation.point,
                "line": each.observation.line,
                "du": each.du,
                "dv": each.dv,
                "statistic": each.statistic,
            }
            for each in solution.suspects
        ],
        "remarks": list(solution.remarks),
    }


def _points(found: Sequence[SolvedPoint]) -> str:
    """How many points there are, and of which kinds if there are several."""
    kinds = Counter(point.kind for point in found)
    told = f" ({', '.join(f'{number} {kind}' for kind, number in kinds.most_common())})" if len(kinds) > 1 else ""
    return f"{_count(len(found), 'point')}{told}"


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'s' * (number != 1)}"
