"""A mono recording."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Sound:
    """Mono samples, 16 bits.

    Attributes:
        samples: (N,) int16; may be a memory map of a file, so read it in pieces.
        rate_hz: samples a second.
    """

    samples: NDArray[np.int16]
    rate_hz: int

    @property
    def length_s(self) -> float:
        """Duration in seconds."""
        return len(self.samples) / self.rate_hz

    @classmethod
    def silence(cls, length_s: float, rate_hz: int = 24000) -> Sound:
        """Nothing to hear, for a while."""
        return cls(np.zeros(round(length_s * rate_hz), dtype=np.int16), rate_hz)
