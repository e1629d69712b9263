"""``solution/``: cameras, points and residuals in files that people, spreadsheets and later steps read."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mien.core import LoadError, MienError
from mien.core.mesh import Points
from mien.formats.atomic import writing_folder
from mien.formats.cue_text import read_text

from .project_records import BOARDS, METRES, POINTS, PROJECT, REFERENCES, SOLUTION
from .project_tables import Row, format_table, read_table, round_float
from .records import Camera, Lens, Observation, Residual, Solution, SolvedPoint, Survey

FORMAT, VERSION = "mien-capture-solution", 1

CAMERAS, SUMMARY, RESIDUALS = "cameras.json", "solution.json", "residuals.csv"

OURS = (CAMERAS, SUMMARY, POINTS, RESIDUALS, "report.html", "*.png")
"""What the folder may hold; anything else in it is somebody's work, and it is not written over."""

INPUTS = (PROJECT, POINTS, REFERENCES, BOARDS)
"""Files that a solution was found from."""

POINT_COLUMNS = ("moment", "point", "x", "y", "z", "sx", "sy", "sz", "xy", "xz", "yz", "photos", "kind")
RESIDUAL_COLUMNS = ("photo", "point", "u", "v", "sigma", "du", "dv", "statistic", "suspect", "line")

BETWEEN = " | "
"""What stands between names in a cell."""

CROSSES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}
"""Columns of correlations."""


def write_solution(folder: Path, solution: Solution, unit: str = "mm") -> Path:
    """Writes a solution into ``solution/`` of a project folder, instead of an older one; where it lies.

    Args:
        folder: of the project.
        solution: what was found.
        unit: of lengths in ``points.csv``; cameras are in metres.

    Raises:
        MienError: it cannot be written, or the folder holds other files.
    """
    out = folder / SOLUTION
    with writing_folder(out, OURS) as place:
        for name, text in solution_texts(folder, solution, unit).items():
            (place / name).write_text(text, encoding="utf-8", newline="\n")
    return out


def solution_texts(folder: Path, solution: Solution, unit: str) -> Mapping[str, str]:
    """Files of a solution by name."""
    summary = {
        "format": FORMAT,
        "version": VERSION,
        "method": solution.method,
        "unit": unit,
        "chi2_per_dof": round_float(solution.chi2_per_dof),
        "remarks": list(solution.remarks),
        "from": fingerprints(folder),
    }
    return {
        SUMMARY: _json(summary),
        CAMERAS: _json({"unit": "m", "cameras": _described_cameras(solution)}),
        POINTS: format_table(POINT_COLUMNS, _point_rows(solution.points.values(), METRES[unit])),
        RESIDUALS: format_table(RESIDUAL_COLUMNS, _residual_rows(solution)),
    }


def fingerprints(folder: Path) -> dict[str, str]:
    """What the files that a solution is found from are now."""
    files = {name: folder / name for name in INPUTS}
    return {name: hashlib.sha256(path.read_bytes()).hexdigest()[:16] for name, path in files.items() if path.is_file()}


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, indent=1) + "\n"


def _described_cameras(solution: Solution) -> list[dict[str, object]]:
    survey = solution.survey
    return [
        {
            "photo": photo.name,
            "camera": photo.camera,
            "size_px": list(photo.size_px),
            "focal_px": round_float(camera.lens.focal_px, 12),
            "principal_px": [round_float(x, 12) for x in camera.lens.principal_px],
            "k1": round_float(camera.lens.k1, 12),
            "k2": round_float(camera.lens.k2, 12),
            "p1": round_float(camera.lens.p1, 12),
            "p2": round_float(camera.lens.p2, 12),
            "aspect": round_float(camera.lens.aspect, 12),
            "freed": list(camera.lens.freed),
            "place_m": [round_float(x, 12) for x in camera.place],
            "rotation": [[round_float(x, 15) for x in row] for row in camera.rotation],
        }
        for photo in survey.photographs
        if (camera := solution.cameras.get(photo.name)) is not None
    ]


def _point_rows(points: Iterable[SolvedPoint], metres: float) -> Iterable[list[str | float]]:
    for point in sorted(points, key=lambda each: (each.moment, each.name)):
        sigmas = np.sqrt(np.diag(point.covariance))
        crosses = [_correlation(point.covariance, a, b) for a, b in CROSSES.values()]
        yield [
            point.moment,
            point.name,
            *(round_float(x / metres) for x in (*point.place, *sigmas)),
            *(round_float(x, 6) for x in crosses),
            BETWEEN.join(point.photos),
            point.kind,
        ]


def _correlation(covariance: Points, a: int, b: int) -> float:
    both = covariance[a, a] * covariance[b, b]
    return float(covariance[a, b] / np.sqrt(both)) if both > 0.0 else 0.0


def _residual_rows(solution: Solution) -> Iterable[list[str | float]]:
    suspects = {(each.observation.photo, each.observation.point) for each in solution.suspects}
    every = {
        (each.observation.photo, each.observation.point): each for each in (*solution.suspects, *solution.residuals)
    }
    for key in sorted(every):
        each, seen = every[key], every[key].observation
        found = (round_float(each.du, 6), round_float(each.dv, 6), round_float(each.statistic, 6))
        suspect = "yes" if key in suspects else ""
        yield [seen.photo, seen.point, seen.u, seen.v, seen.sigma_px, *found, suspect, str(seen.line or "")]


def read_solution_files(folder: Path, survey: Survey) -> Solution:
    """The solution in ``solution/`` of a project folder; a remark tells if its files have changed since.

    Args:
        folder: of the project.
        survey: what its files say now.

    Raises:
        LoadError: there is none, or it was damaged.
    """
    place = folder / SOLUTION
    if not (place / SUMMARY).is_file():
        raise LoadError(place, "there is no solution", hint=f"find it first: mien capture solve {folder}")
    summary = _read_json(place / SUMMARY)
    cameras = _read_json(place / CAMERAS)
    try:
        if summary["format"] != FORMAT or summary["version"] > VERSION:
            raise ValueError(f"{summary['format']} {summary['version']}")
        metres, method = METRES[summary["unit"]], str(summary["method"])
        chi2, remarks = float(summary["chi2_per_dof"]), tuple(map(str, summary["remarks"]))
        changed = _changed(dict(summary["from"]), fingerprints(folder))
        found = {str(each["photo"]): _camera(each) for each in cameras["cameras"]}
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise LoadError(
            place, f"is no solution of this mien ({error})", hint=f"find it again: mien capture solve {folder}"
        ) from None
    points = [point for _, point in read_table(place / POINTS, POINT_COLUMNS, (), lambda row: _point(row, metres))]
    rows = [row for _, row in read_table(place / RESIDUALS, RESIDUAL_COLUMNS, (), _residual)]
    suspects = sorted((each for each, suspect in rows if suspect), key=lambda each: -each.statistic)
    return Solution(
        survey=survey,
        cameras=found,
        points={(point.moment, point.name): point for point in points},
        residuals=tuple(each for each, _ in rows),
        suspects=tuple(suspects),
        chi2_per_dof=chi2,
        remarks=(*remarks, *changed),
        method=method,
    )


def _changed(then: Mapping[str, str], now: Mapping[str, str]) -> tuple[str, ...]:
    files = [name for name in INPUTS if then.get(name) != now.get(name)]
    if not files:
        return ()
    verb = "has" if len(files) == 1 else "have"
    return (f"{' and '.join(files)} {verb} changed since this was solved: mien capture solve finds it anew.",)


def _read_json(path: Path) -> Any:
    try:
        return json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise LoadError(path, f"column {error.colno}: {error.msg}", line=error.lineno, hint="want JSON") from None
    except (RecursionError, ValueError) as error:  # brackets without end, numbers of thousands of digits
        raise LoadError(path, f"is not JSON: {error}") from None


def _camera(values: Mapping[str, Any]) -> Camera:
    principal = tuple(map(float, values["principal_px"]))
    lens = Lens(
        float(values["focal_px"]),
        (principal[0], principal[1]),
        float(values["k1"]),
        float(values["k2"]),
        tuple(map(str, values["freed"])),
        float(values["p1"]),
        float(values["p2"]),
        float(values["aspect"]),
    )
    rotation, place = np.array(values["rotation"], float), np.array(values["place_m"], float)
    if rotation.shape != (3, 3) or place.shape != (3,):
        raise ValueError("rotation and place of a camera")
    return Camera(lens, rotation, place)


def _point(row: Row, metres: float) -> SolvedPoint:
    place = np.array([row.number(axis) for axis in "xyz"]) * metres
    sigmas = np.array([row.number(f"s{axis}") for axis in "xyz"]) * metres
    correlations = np.eye(3)
    for name, (a, b) in CROSSES.items():
        correlations[a, b] = correlations[b, a] = row.number(name)
    covariance = sigmas[:, None] * correlations * sigmas
    photos = tuple(name for name in row.cells["photos"].split(BETWEEN) if name)
    return SolvedPoint(row.text("point"), row.text("moment"), place, covariance, photos, row.text("kind"))


def _residual(row: Row) -> tuple[Residual, bool]:
    suspect = row.cells["suspect"]
    if suspect not in ("", "yes"):
        raise MienError(f"column 'suspect': want yes or nothing, got {suspect!r}")
    seen = Observation(
        row.text("photo"), row.text("point"), row.number("u"), row.number("v"), row.number("sigma"),
        int(row.number("line", 0.0)),
    )  # fmt: skip
    return Residual(seen, row.number("du"), row.number("dv"), row.number("statistic")), suspect == "yes"
