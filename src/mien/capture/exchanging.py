"""Clicks, points and cameras of a project, to and from files of other programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mien.core import LoadError, MienError, UnknownNameError
from mien.formats.atomic import writing

from .dltdv import (
    ORIGINS,
    format_clicks,
    format_coefficients,
    format_names,
    format_places,
    names_file,
    point_names,
    read_clicks,
)
from .project import read_project, read_solution, survey_of
from .project_points import format_points, read_points
from .project_records import POINTS, Project
from .projecting import lens_array

CLICKS, PLACES, CAMERAS = "xypts.csv", "xyzpts.csv", "dltcoefs.csv"
"""Ends of the names of files, in small letters, that tell what is in them."""


def add_points(
    project: Project,
    file: Path,
    *,
    origin: str = ORIGINS[0],
    frames: Sequence[int] = (),
    names: Sequence[str] = (),
    replace_points: bool = False,
) -> tuple[int, list[str]]:
    """Adds clicks of DLTdv or Argus to ``points.csv``; how many, and names of their points.

    Args:
        project: to add them to.
        file: that has them.
        origin: as of ``read_clicks``.
        frames: as of ``read_clicks``.
        names: as of ``read_clicks``.
        replace_points: points that are there already and lie elsewhere are replaced.

    Raises:
        MienError: something is wrong with the file, or points of it are there and lie elsewhere.
    """
    _check_origin(origin)
    if frames and len(frames) != len({each.moment for each in project.photographs}):
        raise MienError(f"want as many rows as the project has moments, got {len(frames)}")
    new = {
        (each.photo, each.point): each
        for each in read_clicks(file, project.photographs, origin=origin, frames=frames, names=names)
    }
    if not new:
        raise LoadError(file, "has no clicks in it")
    path = project.folder / POINTS
    old = {(each.photo, each.point): each for each in read_points(path, project.photographs)} if path.is_file() else {}
    for key, each in new.items():
        there = old.get(key)
        if there is not None and (there.u, there.v) != (each.u, each.v) and not replace_points:
            raise LoadError(
                path,
                f"point {each.point!r} of {each.photo} is there already, at {there.u:g}, {there.v:g}, "
                f"and in {file.name} at {each.u:g}, {each.v:g}",
                line=there.line,
                hint="--force replaces such points",
            )
    with writing(path) as place:
        place.write_text(format_points({**old, **new}.values()), encoding="utf-8", newline="\n")
    return len(new), point_names(list(new.values()))


def export(folder: Path, out: Path, *, origin: str = ORIGINS[0]) -> list[str]:
    """Writes what the name of a file asks for; a sentence each of what was written, and what was left out.

    Raises:
        MienError: the name asks for nothing, or there is nothing to write.
    """
    _check_origin(origin)
    wanted = next((end for end in (CLICKS, PLACES, CAMERAS) if out.name.lower().endswith(end)), None)
    if wanted is None:
        raise MienError(
            f"{out}: want a name that ends in xypts.csv (clicks), xyzpts.csv (points) or dltCoefs.csv (cameras)"
        )
    project = read_project(folder)
    survey = survey_of(project)
    names = point_names(survey.observations)
    if wanted == CLICKS:
        if not names:
            raise MienError(f"{project.folder / POINTS}: there are no clicks to export")
        _write(out, format_clicks(survey.observations, project.photographs, origin=origin))
        told = [f"{out}: clicks {len(survey.observations)}, points {len(names)}"]
    else:
        solution = read_solution(folder)
        told = []
        if wanted == CAMERAS:
            _write(out, format_coefficients(solution, project.metres, origin))
            bent = any(lens_array(camera.lens)[3:7].any() for camera in solution.cameras.values())
            note = "; their lenses are taken for straight: the coefficients have no terms of distortion"
            return [f"{out}: the cameras of the first moment, for lengths in {project.unit}{note * bent}"]
        # Points have the numbers that they have among the clicks: one file names both.
        names = list(dict.fromkeys([*names, *(name for _, name in solution.points)]))
        _write(out, format_places(solution, names, project.metres))
        told = [f"{out}: {len(names)} points in {project.unit}"]
    _write(names_file(out), format_names(names))
    return [*told, f"{names_file(out)}: their names"]


def _write(out: Path, text: str) -> None:
    with writing(out) as place:
        place.write_text(text, encoding="utf-8", newline="\n")


def _check_origin(origin: str) -> None:
    if origin not in ORIGINS:
        raise UnknownNameError("origin", origin, ORIGINS)
