"""Pictures as the frames that encoders take."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from av.video.frame import VideoFrame
from av.video.plane import VideoPlane
from numpy.typing import NDArray

from . import yuv
from .palette import Quantiser

Pixels = NDArray[np.uint8]


def make_frame(pixels: Pixels, layout: str) -> VideoFrame:
    """A frame of (H, W, 4) pixels in one of FFmpeg's layouts.

    Layouts of 4:2:0 get even sides: the last row or column is shown twice.
    """
    return _MAKERS[layout](pixels)


def make_frame_in_colors(pixels: Pixels, quantiser: Quantiser) -> VideoFrame:
    """A frame of (H, W, 4) pixels in 256 colours of its own."""
    numbers, colors = quantiser.reduce(yuv.to_words(pixels))
    frame = _blank(numbers, "pal8")
    _codes(frame.planes[0], np.uint8)[:, : numbers.shape[1]] = numbers
    # A colour is one number, blue in the lowest eight bits.
    np.frombuffer(memoryview(frame.planes[1]), np.uint8).reshape(-1, 4)[:] = colors[:, [2, 1, 0, 3]]
    return frame


def _make_420(pixels: Pixels) -> VideoFrame:
    words = yuv.to_words(_even(pixels))
    frame = _blank(words, "yuv420p")
    yuv.fill_420(words, *(_codes(plane, np.uint8) for plane in frame.planes))
    return frame


def _make_clear_420(pixels: Pixels) -> VideoFrame:
    words = yuv.to_words(_even(pixels))
    frame = _blank(words, "yuva420p")
    *colors, alpha = (_codes(plane, np.uint8) for plane in frame.planes)
    yuv.fill_420(_spread(words), *colors)
    yuv.fill_alpha_8(words, alpha)
    return frame


def _make_444(pixels: Pixels) -> VideoFrame:
    words = yuv.to_words(pixels)
    frame = _blank(words, "yuv444p10le")
    yuv.fill_444(words, *(_codes(plane, np.uint16) for plane in frame.planes))
    return frame


def _make_clear_444(pixels: Pixels) -> VideoFrame:
    words = yuv.to_words(pixels)
    frame = _blank(words, "yuva444p10le")
    *colors, alpha = (_codes(plane, np.uint16) for plane in frame.planes)
    yuv.fill_444(_spread(words), *colors)
    yuv.fill_alpha_10(words, alpha)
    return frame


def _make_blue_first(pixels: Pixels) -> VideoFrame:
    """For libwebp, which makes chroma of it: its own mean of an edge is off by up to a dozen codes."""
    spread = _spread(yuv.to_words(pixels)).view(np.uint8).reshape(pixels.shape)
    return VideoFrame.from_ndarray(np.ascontiguousarray(spread[..., [2, 1, 0, 3]]), format="bgra")


def _make_bytes(layout: str, channels: list[int]) -> Callable[[Pixels], VideoFrame]:
    return lambda pixels: VideoFrame.from_ndarray(np.ascontiguousarray(pixels[..., channels]), format=layout)


_MAKERS: dict[str, Callable[[Pixels], VideoFrame]] = {
    "yuv420p": _make_420,
    "yuva420p": _make_clear_420,
    "yuv444p10le": _make_444,
    "yuva444p10le": _make_clear_444,
    "rgb24": _make_bytes("rgb24", [0, 1, 2]),
    "rgba": _make_bytes("rgba", [0, 1, 2, 3]),
    "bgra": _make_blue_first,
}


def _even(pixels: Pixels) -> Pixels:
    height, width = pixels.shape[:2]
    if height % 2 or width % 2:
        pixels = np.pad(pixels, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
    return pixels


def _blank(words: NDArray[Any], layout: str) -> VideoFrame:
    height, width = words.shape
    return VideoFrame(width, height, layout)


def _codes(plane: VideoPlane, kind: type[np.uint8] | type[np.uint16]) -> yuv.Plane:
    """(H, at least W) codes of a plane, to be written to."""
    codes: yuv.Plane = np.frombuffer(memoryview(plane), dtype=kind)
    return codes.reshape(plane.height, -1)


def _spread(words: yuv.Words) -> yuv.Words:
    spread = np.empty_like(words)
    yuv.spread_color(words, spread)
    return spread
