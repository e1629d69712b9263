"""Numbers as texts of files: rounded, short, the same on every machine."""

from __future__ import annotations


def format_number(value: float, decimals: int) -> str:
    """The number rounded to so many decimals, without zeros at its end and without a minus before nothing."""
    text = f"{value:.{decimals}f}"
    if decimals:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
