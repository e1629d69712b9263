"""Words, phones and visemes are all lists of cues."""

from __future__ import annotations

from dataclasses import dataclass

SILENCE = "SIL"
"""The symbol of a pause among phones."""


@dataclass(frozen=True, order=True)
class Cue:
    """A symbol that lasts from ``start_s`` to ``end_s``, seconds."""

    start_s: float
    end_s: float
    symbol: str

    @property
    def length_s(self) -> float:
        """Duration in seconds."""
        return self.end_s - self.start_s

    @property
    def centre_s(self) -> float:
        """Middle, seconds."""
        return 0.5 * (self.start_s + self.end_s)
