"""Thórisson's motors by code, and those that mien adds: which control point each moves, and which way.

Source: Thórisson 1996, A1.2.1; he calls motor 15 horizontal "PUPIL/RIGHT", it is the left one.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from types import MappingProxyType

DIMENSIONS = ("H", "V")


@dataclass(frozen=True)
class Motor:
    """One dimension of one control point, or a movement of its own.

    Attributes:
        code: ``ELU``.
        number: of its control point in the paper, 0 for what the paper has not.
        dimension: 0 horizontal, 1 vertical, as in the paper.
        feature: ``EL``, whose point it moves; empty for the head and what is no point.
        point: name of the point within the feature.
        parameter: our name.
        unit: ``share`` of the way between its limits (his P_ctrl), ``deg``, or ``signed`` for -1..1 about rest.
        direction: (x, y), y down, into which a positive offset moves the point.
        paper: it is one of the 21.
        odd: it changes its sign in the mirror.
        role: of its parameter, as in ``mien.core.Parameter``; ``closed`` likewise.
        closed: where it shuts an eye or the mouth.
        doc: what it does.
    """

    code: str
    number: int
    dimension: int
    feature: str
    point: str
    parameter: str
    unit: str
    direction: tuple[float, float]
    paper: bool
    odd: bool
    role: str
    closed: float | None
    doc: str

    @property
    def aliases(self) -> tuple[str, ...]:
        """Other names of its parameter: the code, and the point's number with the dimension (``15-0``, ``15-H``)."""
        if not self.number:
            return (self.code,)
        return (self.code, f"{self.number}-{self.dimension}", f"{self.number}-{DIMENSIONS[self.dimension]}")


@cache
def motors() -> Mapping[str, Motor]:
    """All motors by code, the paper's first."""
    text = resources.files(__package__).joinpath("data", "motors.csv").read_text(encoding="utf-8")
    return MappingProxyType({row["code"]: _motor(row) for row in csv.DictReader(text.splitlines())})


def paper_codes() -> tuple[str, ...]:
    """The 21 codes of the paper."""
    return tuple(code for code, motor in motors().items() if motor.paper)


def _motor(row: Mapping[str, str]) -> Motor:
    return Motor(
        row["code"],
        int(row["number"] or 0),
        int(row["dimension"] or 0),
        row["feature"],
        row["point"],
        row["parameter"],
        row["unit"],
        (float(row["dx"]), float(row["dy"])),
        row["paper"] == "1",
        row["odd"] == "1",
        row["role"],
        float(row["closed"]) if row["closed"] else None,
        row["doc"],
    )
