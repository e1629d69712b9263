"""Values by motor code, as files give them."""

from __future__ import annotations

from collections.abc import Mapping

from mien.core import UnknownNameError

from .fields import Fields
from .motors import motors
from .records import Limits


def motor_values(fields: Fields, limits: Mapping[str, Limits]) -> dict[str, float]:
    """P_ctrl or degrees by code.

    Raises:
        UnknownNameError: the character has no such motor.
        MienError: a value is no number, or out of range.
    """
    values = {}
    for code in fields.keys:
        if code not in limits:
            raise UnknownNameError(f"{fields.place}: motor", code, limits)
        low, high = (limits[code].low_deg, limits[code].high_deg) if motors()[code].unit == "deg" else (0.0, 1.0)
        low = -1.0 if motors()[code].unit == "signed" else low
        value = fields.number(code)
        if not low <= value <= high:
            raise fields.error(code, f"{value:g} is out of range — it goes from {low:g} to {high:g}")
        values[code] = value
    return values
