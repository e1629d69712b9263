"""Frames in 256 colours of their own, one at a time, for GIF."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import av
from av.filter import Graph
from av.video.frame import VideoFrame

TICKS_PER_S = 100
"""Time in a GIF goes in hundredths. Source: CompuServe, GIF89a specification, section 23."""

DITHER = "bayer:bayer_scale=5"
"""An ordered pattern stays where it is from frame to frame; error diffusion crawls over what does not move."""


class Palette:
    """Chooses colours for every frame and gives it in them."""

    def __init__(self, size_px: tuple[int, int], clear: bool) -> None:
        width, height = size_px
        self._graph = Graph()
        layout = av.VideoFormat("rgba", width, height)
        source = self._graph.add_buffer(width=width, height=height, format=layout, time_base=Fraction(1, TICKS_PER_S))
        both = self._graph.add("split")
        choose = self._graph.add("palettegen", f"stats_mode=single:reserve_transparent={int(clear)}")
        use = self._graph.add("paletteuse", f"new=1:alpha_threshold=128:dither={DITHER}")
        self._result: Any = self._graph.add("buffersink")
        source.link_to(both)
        both.link_to(choose, 0, 0)
        both.link_to(use, 1, 0)
        choose.link_to(use, 0, 1)
        use.link_to(self._result)
        self._graph.configure()
        self._source = source

    def reduce(self, frame: VideoFrame) -> VideoFrame:
        """The frame in 256 colours, half-transparent pixels made one or the other."""
        self._source.push(frame)
        reduced: VideoFrame = self._result.pull()
        return reduced
