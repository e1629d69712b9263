"""The parameters of a measured face: Parke's phase number, a weight for each phase, the head, the eyes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mien.core import Parameter, ParameterTable, both_sides

from .records import Keypose
from .standard import StandardPhase, standard_phases

PARKE = "Parke 1972, Animation"
OWN = "own: beyond Parke's one number, so that a face can blink while it smiles"
NUMBER = "phase.number"

HEAD: Sequence[tuple[str, float, bool, str]] = (
    ("head.turn", 45.0, True, "Head turned to the own left, as one rigid piece."),
    ("head.nod", 30.0, False, "Head nodded as one rigid piece; positive looks up."),
    ("head.tilt", 30.0, True, "Head tilted towards the own left shoulder, as one rigid piece."),
)
EYES: Sequence[tuple[str, float, bool, str]] = (
    ("eye.turn", 40.0, True, "Turn of the {side} eye to the own left."),
    ("eye.nod", 30.0, False, "Turn of the {side} eye upwards."),
)


def keypose_table(keypose: Keypose) -> ParameterTable:
    """The table of a measured face; ``phase`` is the phase number, and own names of phases are aliases."""
    count = len(keypose.phases)
    rows = [*_number_row(count), *_phase_rows(keypose), *_head_rows(), *(_eye_rows() if keypose.eyes else ())]
    aliases = {"phase": NUMBER} if count > 1 else {}
    for own, name in keypose.stands_for.items():
        if own != keypose.phases[0]:
            sides = ("", ".left", ".right") if standard_phases()[name].sided else ("",)
            aliases |= {f"phase.{own}{side}": f"phase.{name}{side}" for side in sides}
    return ParameterTable(tuple(rows), aliases)


def standard_table() -> ParameterTable:
    """The table of a face that has every standard phase, and eyes that turn."""
    rows = [row for phase in list(standard_phases().values())[1:] for row in _weigh(phase)]
    return ParameterTable((*_number_row(len(standard_phases())), *rows, *_head_rows(), *_eye_rows()))


def phase_of(keypose: Keypose, name: str) -> StandardPhase:
    """What a phase of a face is: the standard one that it is or stands for, or its own."""
    standard = standard_phases().get(keypose.stands_for.get(name, name))
    if standard is not None:
        return standard
    sided = name in keypose.sided
    doc = f"Phase {name!r} as it was measured" + (", the {side} half." if sided else ".")
    return StandardPhase(name, sided, "phase", "motion", None, doc, f"Phase {name!r} as it was measured.", PARKE)


def _number_row(count: int) -> Iterator[Parameter]:
    if count > 1:
        doc = "Number of a phase; 2.5 is half way from the second to the third, on a cosine."
        yield Parameter(NUMBER, 1.0, float(count), 1.0, "phase", "phase", doc=doc, source=PARKE)


def _phase_rows(keypose: Keypose) -> Iterator[Parameter]:
    for name in keypose.phases[1:]:
        yield from _weigh(phase_of(keypose, name))


def _weigh(phase: StandardPhase) -> tuple[Parameter, ...]:
    row = Parameter(
        f"phase.{phase.name}",
        0.0,
        1.0,
        0.0,
        "share",
        phase.group,
        doc=phase.doc,
        source=OWN if phase.source == "own" else phase.source,
        role=phase.role,
        closed=phase.closed,
    )
    return both_sides(row) if phase.sided else (row,)


def _head_rows() -> Iterator[Parameter]:
    for name, most, odd, doc in HEAD:
        yield Parameter(name, -most, most, 0.0, "deg", "head", odd, doc, OWN_HEAD)


def _eye_rows() -> Iterator[Parameter]:
    for name, most, odd, doc in EYES:
        yield from both_sides(Parameter(name, -most, most, 0.0, "deg", "eye", odd, doc, OWN_EYES, role="gaze"))


OWN_HEAD = "own: Parke 1972 moved the viewer instead"
OWN_EYES = "own: his eyes were part of the phases"
