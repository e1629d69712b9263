"""Voices made equally loud."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

SPEECH_LEVEL = 3276.8
"""Root mean square of speech, of 32767 (-20 dB)."""

PEAK_LEVEL = 29000.0
"""Highest sample, of 32767 (just under -1 dB)."""


def set_level(samples: NDArray[np.int16], spoken: Sequence[tuple[int, int]]) -> NDArray[np.int16]:
    """Samples whose speech has the level all voices have, unless a peak would be cut."""
    squares = sum(float((samples[first:last].astype(np.float64) ** 2).sum()) for first, last in spoken)
    count = sum(last - first for first, last in spoken)
    peak = int(np.abs(samples.astype(np.int32)).max(initial=0))
    if not squares or not peak:
        return samples
    gain = min(SPEECH_LEVEL / (squares / count) ** 0.5, PEAK_LEVEL / peak)
    return np.rint(samples * gain).astype(np.int16)
