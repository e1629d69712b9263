"""Still pictures for films that are a row of them: each is encoded alone, so that none waits in memory."""

from __future__ import annotations

from typing import Any

import av
import numpy as np
from numpy.typing import NDArray

from .codecs import FilmPlan
from .film_frames import make_frame

Pixels = NDArray[np.uint8]


class StillEncoder:
    """Makes files, in memory, of single pictures."""

    def __init__(self, plan: FilmPlan) -> None:
        self._layout = plan.layout
        encoder: Any = av.CodecContext.create(plan.codec.picture, "w")
        encoder.width, encoder.height = plan.size_px
        encoder.pix_fmt, encoder.time_base, encoder.options = plan.layout, 1 / plan.rate, plan.options
        # With more threads a picture comes out only when some of those after it went in.
        encoder.thread_count = 1
        self._encoder = encoder

    def encode(self, pixels: Pixels) -> bytes:
        """The file of one picture."""
        return b"".join(bytes(packet) for packet in self._encoder.encode(make_frame(pixels, self._layout)))
