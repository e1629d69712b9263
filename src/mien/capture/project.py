"""A capture project: a folder with photographs, what was seen in them, and what was found.

``project.toml`` tells of the photographs, ``points.csv`` where points are seen, ``references.csv`` which places are
known; ``boards.csv`` keeps corners of boards that were found, and ``solution/`` cameras and points.
"""

from __future__ import annotations

import filecmp
from collections.abc import Callable, Iterator, Sequence
from itertools import product
from pathlib import Path

from mien.core import LoadError, UnknownNameError
from mien.formats.atomic import writing

from .project_points import format_points, merge_points, read_points, read_references
from .project_records import BOARDS, POINTS, PROJECT, REFERENCES, Board, Pair, Project
from .project_solution import read_solution_files, write_solution
from .project_tables import Faults
from .project_toml import format_project, read_project_toml
from .records import Observation, Photograph, Reference, Solution, Survey

__all__ = [
    "METHODS",
    "Board",
    "Pair",
    "Project",
    "find_boards",
    "format_project",
    "read_project",
    "read_solution",
    "read_survey",
    "solve_project",
    "survey_of",
    "write_solution",
]

METHODS = ("metric", "appendix-c")
"""How cameras are found from references."""

Report = Callable[[str], None]
"""Takes what is being done."""


def read_project(folder: Path | str) -> Project:
    """The project in a folder.

    Raises:
        LoadError: there is none, or what is wrong in its ``project.toml``; a photograph that is there under two names.
    """
    project = read_project_toml(Path(folder))
    _check_different(project)
    return project


def _check_different(project: Project) -> None:
    there = [(each, path) for each in project.photographs if (path := each.path) is not None]
    for number, (one, path) in enumerate(there):
        for other, place in there[number + 1 :]:
            if path.stat().st_size == place.stat().st_size and filecmp.cmp(path, place, shallow=False):
                raise LoadError(
                    project.folder / PROJECT,
                    f"{one.name} and {other.name} are the same picture",
                    hint="take one of them out: seen twice from one place, nothing is learnt about depth",
                )


def read_survey(folder: Path | str) -> Survey:
    """What was measured: clicked points, corners of boards found before, references and corners as the boards are made.

    Raises:
        LoadError: all that is wrong with the first file that has anything wrong with it.
    """
    return survey_of(read_project(folder))


def survey_of(project: Project) -> Survey:
    """What was measured for a project that was read; as ``read_survey``.

    Raises:
        LoadError: as ``read_survey``.
    """
    from .boards import board_references

    folder = project.folder
    references = [*_read_references(project), *(each for board in project.boards for each in board_references(board))]
    parts = {}
    if (folder / POINTS).is_file() or not (project.boards or (folder / BOARDS).is_file()):
        parts[folder / POINTS] = _read_clicked(folder / POINTS, project.photographs)
    if project.boards and (folder / BOARDS).is_file():
        parts[folder / BOARDS] = read_points(folder / BOARDS, project.photographs)
        _check_corners(folder / BOARDS, parts[folder / BOARDS], project.boards)
    return Survey(project.photographs, merge_points(parts), tuple(references))


def _read_clicked(path: Path, photographs: Sequence[Photograph]) -> tuple[Observation, ...]:
    if not path.is_file():
        raise LoadError(path, "there is no such file", hint="want rows photo,point,u,v,sigma of what was clicked")
    return read_points(path, photographs)


def _read_references(project: Project) -> tuple[Reference, ...]:
    path = project.folder / REFERENCES
    if not path.is_file():
        return ()
    references = read_references(path, project.unit)
    for each, board in product(references, project.boards):
        if each.name.startswith(f"{board.target}:"):
            raise LoadError(
                path,
                f"{each.name!r} is a corner of the board {board.target!r}, whose size tells where it is",
                hint="leave it out, or give it another name",
            )
    return references


def _check_corners(path: Path, observations: Sequence[Observation], boards: Sequence[Board]) -> None:
    from .boards import corner_names

    corners = {board.target: frozenset(corner_names(board)) for board in boards}
    faults = Faults(path)
    for each in observations:
        target = each.point.partition(":")[0]
        if target not in corners:
            faults.add(each.line, str(UnknownNameError("board", target, corners)))
        elif each.point not in corners[target]:
            faults.add(
                each.line, f"there is no corner {each.point!r} on the board — find them again: mien capture boards"
            )
    faults.check()


def find_boards(project: Project, report: Callable[[int, int], None] | None = None) -> tuple[Observation, ...]:
    """Corners of all boards in the photographs, kept in ``boards.csv`` so that later runs need no pictures.

    Raises:
        MienError: a board is not found where it should be, a photograph is not there, or the file cannot be written.
    """
    from .boards import find_corners

    found = find_corners(project.boards, project.photographs, report)
    with writing(project.folder / BOARDS) as place:
        place.write_text(format_points(found), encoding="utf-8", newline="\n")
    return found


def read_solution(folder: Path | str) -> Solution:
    """The solution of a project, as it was written last.

    Raises:
        LoadError: there is none, or something is wrong with the files of the project.
    """
    return read_solution_files(Path(folder), read_survey(folder))


def solve_project(folder: Path | str, *, method: str | None = None, report: Report | None = None) -> Solution:
    """Cameras and points of a project; nothing is written but corners of boards that were not looked for yet.

    Args:
        folder: of the project.
        method: ``metric``, which is the rule, or ``appendix-c`` as in Parke's thesis; a pair has a way of its own.
        report: is told what is being done.

    Raises:
        MienError: what is wrong with its files, or why nothing can be found from them.
    """
    if method is not None and method not in METHODS:
        raise UnknownNameError("method", method, METHODS)
    project = read_project(folder)
    if method is not None and project.pair is not None:
        raise LoadError(
            project.folder / PROJECT,
            f"has a [pair], which is solved in its own way, not by {method}",
            hint="leave the method out; orthographic = true under [pair] is as in 1972",
        )
    say = report or _say_nothing
    if project.boards and not (project.folder / BOARDS).is_file():
        say("looking for boards")
        find_boards(project)
    survey = survey_of(project)
    for text in _without_corners(project, survey):
        say(text)
    if project.pair is None:
        from .solving import solve

        return solve(survey, method=method or METHODS[0], report=say)
    return _solve_pair(survey, project.pair)


def _say_nothing(_text: str) -> None:
    pass


def _without_corners(project: Project, survey: Survey) -> Iterator[str]:
    """What to say where a board that may be in a photograph has no corners in it: perhaps it was not looked for yet."""
    for board in project.boards:
        seen = {each.photo for each in survey.observations if each.point.startswith(f"{board.target}:")}
        missing = [each.name for each in project.photographs if board.may_be_in(each.name) and each.name not in seen]
        if missing:
            told = f"{', '.join(missing[:3])}{' …' if len(missing) > 3 else ''}"
            yield f"no corners of {board.target!r} in {told}; to look again: mien capture boards {project.folder}"


def _solve_pair(survey: Survey, pair: Pair) -> Solution:
    from .pair import solve_pair

    return solve_pair(
        survey,
        front=pair.front,
        side=pair.side,
        scale=pair.scale,
        camera_distance_m=pair.camera_distance_m or None,
        orthographic=pair.orthographic,
        midline=pair.midline,
        mirror=pair.mirror,
        twins=pair.twins or None,
        side_from=pair.side_from,
        side_turn_deg=pair.side_turn_deg,
    )
