"""How lively a face speaks: five amounts."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from mien.core import MienError, RangeError, UnknownNameError

SWITCHES = {"on": 1.0, "yes": 1.0, "true": 1.0, "off": 0.0, "no": 0.0, "false": 0.0}
MOST = 2.0


@dataclass(frozen=True)
class Style:
    """Amounts from 0 (off) over 1 (usual) to 2.

    Attributes:
        blinks: how often the eyes blink.
        head: how far the head sways and nods.
        brows: how far the brows rise with accents.
        gaze: how far the eyes stray from the viewer.
        strength: how far the mouth moves; lips close fully at any strength.
    """

    blinks: float = 1.0
    head: float = 1.0
    brows: float = 1.0
    gaze: float = 1.0
    strength: float = 1.0

    def __post_init__(self) -> None:
        for field in fields(self):
            amount = float(getattr(self, field.name))
            if not (math.isfinite(amount) and 0.0 <= amount <= MOST):
                raise RangeError(f"style {field.name}={amount:g} is out of range — it goes from 0 (off) to {MOST:g}")
            object.__setattr__(self, field.name, amount)


def parse_style(text: str) -> Style:
    """The style in a text such as ``blinks=off,head=0.5``; what it does not name is as usual.

    Raises:
        MienError: a part is not ``name=value``, a name comes twice, or a value is neither a number, ``on`` nor ``off``.
        UnknownNameError: there is no such amount.
        RangeError: an amount is out of range.
    """
    known = [field.name for field in fields(Style)]
    amounts: dict[str, float] = {}
    for part in filter(None, (piece.strip() for piece in text.split(","))):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals:
            raise MienError(f"style {part!r}: want name=value, for example blinks=off,head=0.5")
        if name not in known:
            raise UnknownNameError("style", name, known)
        if name in amounts:
            raise MienError(f"style {text!r}: {name} is given twice")
        amounts[name] = _parse_amount(name, value)
    return Style(**amounts)


def _parse_amount(name: str, value: str) -> float:
    if value.lower() in SWITCHES:
        return SWITCHES[value.lower()]
    try:
        return float(value)
    except ValueError:
        raise MienError(f"style {name}={value}: want a number from 0 to {MOST:g}, on or off") from None
