"""Action units as coders write them: ``12=0.8,6=0.5``, ``1+2+5B``, ``L14C``."""

from __future__ import annotations

import re

from mien.core import MienError, UnknownNameError

from .vocabulary import vocabulary

VOCABULARY = "facs"

INTENSITIES = {"A": 0.2, "B": 0.4, "C": 0.6, "D": 0.8, "E": 1.0}
"""What a letter is worth, from a trace to the most that there is: fifths, as in programs that count from 0 to 5.

Source: letters of Ekman, Friesen and Hager 2002; fifths as OpenFace 2 and openFACS count.
"""

UNIT = re.compile(r"(?:AU)?(?P<before>[LR])?(?P<number>\d+)(?P<after>[LR])?(?P<letter>[A-E])?(?:=(?P<amount>.*))?")


def parse_units(text: str, place: str = "") -> dict[str, float]:
    """Intensities 0..1 by name, from units with commas or plus signs between them.

    Each is a number with ``AU`` before it or not, a side (``L`` or ``R``) before or after the number or none, and how
    much of it is there: a letter, or ``=`` and a number. A unit with neither is there fully.

    Args:
        text: the units.
        place: where they come from, for messages.

    Raises:
        MienError: a unit cannot be understood.
        UnknownNameError: there is no such unit, or not on one side.
    """
    return dict(_parse_unit(part.strip(), place or text) for part in re.split(r"[,+]", text))


def _parse_unit(unit: str, place: str) -> tuple[str, float]:
    match = UNIT.fullmatch(unit)
    try:
        if match is None or (match["before"] and match["after"]) or (match["letter"] and match["amount"] is not None):
            raise ValueError
        amount = float(match["amount"]) if match["amount"] is not None else INTENSITIES[match["letter"] or "E"]
    except ValueError:
        raise MienError(
            f"{place}: {unit!r} is not an action unit — want a number, then = and 0..1 or a letter A..E, with L or R "
            "for one side, as in 12=0.8,L4=0.5 or 1+2+5B"
        ) from None
    name = f"AU{int(match['number'])}{match['before'] or match['after'] or ''}"
    table = vocabulary(VOCABULARY)
    if name not in table:
        raise UnknownNameError("action unit", name, [*table.names, *table.symmetric])
    return name, amount
