"""Photographs -> cameras -> points -> faces.

Names are imported when they are first used: least squares and pictures load when they are needed.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .project import find_boards, read_project, read_solution, read_survey, solve_project, write_solution
    from .project_records import Board, Pair, Project
    from .records import (
        Camera,
        Lens,
        Observation,
        Photograph,
        Reference,
        Residual,
        Solution,
        SolvedPoint,
        Survey,
    )
    from .report import write_report

__all__ = [
    "Board",
    "Camera",
    "Lens",
    "Observation",
    "Pair",
    "Photograph",
    "Project",
    "Reference",
    "Residual",
    "Solution",
    "SolvedPoint",
    "Survey",
    "find_boards",
    "read_project",
    "read_solution",
    "read_survey",
    "solve_project",
    "write_report",
    "write_solution",
]

_HOMES = {
    "project": ("find_boards", "read_project", "read_solution", "read_survey", "solve_project", "write_solution"),
    "project_records": ("Board", "Pair", "Project"),
    "report": ("write_report",),
}
"""Module -> names that are imported from it; all others come from ``records``."""

_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'mien.capture' has no attribute {name!r}")
    globals()[name] = value = getattr(import_module(f"mien.capture.{_HOME_OF.get(name, 'records')}"), name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
