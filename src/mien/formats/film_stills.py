"""Still pictures for films that are a row of them: each is encoded alone, so that none waits in memory."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import av
import numpy as np
from numpy.typing import NDArray

from .codecs import Codec
from .film_frames import make_frame

Pixels = NDArray[np.uint8]


class StillEncoder:
    """Makes files, in memory, of single pictures."""

    def __init__(self, codec: Codec, rate: Fraction, size_px: tuple[int, int], transparent: bool) -> None:
        self._layout = codec.clear_pixels if transparent else codec.pixels
        encoder: Any = av.CodecContext.create(codec.picture, "w")
        encoder.width, encoder.height = size_px
        encoder.pix_fmt, encoder.time_base, encoder.options = self._layout, 1 / rate, dict(codec.options)
        # With more threads a picture comes out only when some of those after it went in.
        encoder.thread_count = 1
        self._encoder = encoder

    def encode(self, pixels: Pixels) -> bytes:
        """The file of one picture."""
        return b"".join(bytes(packet) for packet in self._encoder.encode(make_frame(pixels, self._layout)))
