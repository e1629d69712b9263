"""Conversion to luma and chroma: equal to plain NumPy, near to FFmpeg's, exact where it can be told by hand."""

from __future__ import annotations

from fractions import Fraction

import av
import numpy as np
import pytest
from av.video.reformatter import ColorRange, Colorspace
from hypothesis import given
from hypothesis import strategies as st

from mien.formats import yuv
from mien.formats.film_frames import make_frame

RED, GREEN, BLUE = Fraction(2126, 10000), Fraction(7152, 10000), Fraction(722, 10000)


def picture(seed: int, width: int, height: int) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, (height, width, 4), dtype=np.uint8)


def plane(frame: av.VideoFrame, number: int) -> np.ndarray:
    part = frame.planes[number]
    kind = np.uint16 if "10le" in frame.format.name else np.uint8
    return np.frombuffer(memoryview(part), kind).reshape(part.height, -1)[:, : part.width].astype(np.int64)


def plain(color: np.ndarray, bits: int, shift: int) -> list[np.ndarray]:
    """Luma and chroma of sums of ``2 ** shift`` pixels, (H, W, 3), by the same whole numbers."""
    red, green, blue = np.moveaxis(color.astype(np.int64), 2, 0)
    down = 24 - bits + shift
    half, middle = 1 << (down - 1), 128 << (bits - 8 + down)
    luma = (yuv.YR * red + yuv.YG * green + yuv.YB * blue + (16 << (bits - 8 + down)) + half) >> down
    blues = (yuv.UB * blue - yuv.UR * red - yuv.UG * green + middle + half) >> down
    reds = (yuv.VR * red - yuv.VG * green - yuv.VB * blue + middle + half) >> down
    return [luma, blues, reds]


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(1, 20))
def test_equal_to_plain_numpy(seed: int, half_width: int, half_height: int) -> None:
    pixels = picture(seed, 2 * half_width, 2 * half_height)
    color = pixels[..., :3].astype(np.int64)
    four = color[0::2, 0::2] + color[0::2, 1::2] + color[1::2, 0::2] + color[1::2, 1::2]
    frame = make_frame(pixels, "yuv420p")
    np.testing.assert_array_equal(plane(frame, 0), plain(color, 8, 0)[0])
    np.testing.assert_array_equal(plane(frame, 1), plain(four, 8, 2)[1])
    np.testing.assert_array_equal(plane(frame, 2), plain(four, 8, 2)[2])
    frame = make_frame(pixels, "yuv444p10le")
    for number, codes in enumerate(plain(color, 10, 0)):
        np.testing.assert_array_equal(plane(frame, number), codes)


@pytest.mark.parametrize("bits", [8, 10])
def test_every_colour_of_a_grid_is_the_nearest_code(bits: int) -> None:
    levels = np.arange(0, 256, 15, dtype=np.uint8)
    grid = np.stack(np.meshgrid(levels, levels, levels, [255]), axis=-1).reshape(18, -1, 4).astype(np.uint8)
    pixels = grid.repeat(2, axis=0).repeat(2, axis=1)
    frame = make_frame(pixels, "yuv420p" if bits == 8 else "yuv444p10le")
    scale = 1 << (bits - 8)
    red, green, blue = np.moveaxis(pixels[..., :3] / 255, 2, 0)
    luma = float(RED) * red + float(GREEN) * green + float(BLUE) * blue
    wanted = [
        scale * (16 + 219 * luma),
        scale * (128 + 224 * (blue - luma) / 1.8556),
        scale * (128 + 224 * (red - luma) / 1.5748),
    ]
    for number, exact in enumerate(wanted):
        if number and bits == 8:
            exact = exact[::2, ::2]
        assert np.abs(plane(frame, number) - exact).max() < 0.52


@pytest.mark.parametrize(
    ("color", "codes"),
    [
        ((0, 0, 0), (16, 128, 128)),
        ((255, 255, 255), (235, 128, 128)),
        ((128, 128, 128), (126, 128, 128)),
        ((255, 0, 0), (63, 102, 240)),
        ((0, 255, 0), (173, 42, 26)),
        ((0, 0, 255), (32, 240, 118)),
    ],
)
def test_known_colours(color: tuple[int, ...], codes: tuple[int, ...]) -> None:
    """Source: the codes of full colour bars in BT.709."""
    frame = make_frame(np.full((2, 2, 4), (*color, 255), dtype=np.uint8), "yuv420p")
    assert tuple(int(plane(frame, number)[0, 0]) for number in range(3)) == codes


def test_near_to_ffmpegs_own() -> None:
    x, y = np.meshgrid(np.linspace(0, 1, 320), np.linspace(0, 1, 240))
    smooth = np.stack([255 * x, 255 * y, 127 + 127 * np.sin(5 * (x + y)), np.full_like(x, 255)], axis=2)
    pixels = np.rint(smooth).astype(np.uint8)
    theirs = av.VideoFrame.from_ndarray(pixels, format="rgba").reformat(
        format="yuv420p",
        dst_colorspace=Colorspace.ITU709,
        src_color_range=ColorRange.JPEG,
        dst_color_range=ColorRange.MPEG,
    )
    ours = make_frame(pixels, "yuv420p")
    for number in range(3):
        assert np.abs(plane(ours, number) - plane(theirs, number)).max() <= 2


@given(st.integers(0, 2**32 - 1), st.integers(1, 30), st.integers(1, 20))
def test_alpha_is_kept_and_colour_spreads_into_what_is_clear(seed: int, width: int, height: int) -> None:
    pixels = picture(seed, width, height)
    pixels[..., 3] *= np.random.default_rng(seed).random((height, width)) < 0.1
    spread = np.zeros((height, width), dtype=np.uint32)
    yuv.spread_color(yuv.to_words(pixels), spread)
    result = spread.view(np.uint8).reshape(height, width, 4)
    np.testing.assert_array_equal(result, _spread_plainly(pixels))
    frame = make_frame(pixels, "yuva444p10le")
    assert np.abs(plane(frame, 3) - pixels[..., 3] * (1023 / 255)).max() < 1
    assert not plane(frame, 3)[pixels[..., 3] == 0].any()
    assert (plane(frame, 3)[pixels[..., 3] == 255] == 1023).all()


def _spread_plainly(pixels: np.ndarray) -> np.ndarray:
    result = pixels.copy()
    visible = pixels[..., 3] > 0
    rows = np.flatnonzero(visible.any(axis=1))
    for row in rows:
        ends = np.flatnonzero(visible[row])
        for x in np.flatnonzero(~visible[row]):
            nearest = min(ends, key=lambda end: (abs(end - x), -end))
            result[row, x, :3] = pixels[row, nearest, :3]
    for row in np.flatnonzero(~visible.any(axis=1)) if len(rows) else ():
        above = rows[rows < row]
        result[row, :, :3] = result[above[-1] if len(above) else rows[0], :, :3]
    return result


def test_odd_sides_show_the_last_row_and_column_twice() -> None:
    pixels = picture(1, 5, 3)
    frame = make_frame(pixels, "yuva420p")
    assert (frame.width, frame.height) == (6, 4)
    for number in (0, 3):
        codes = plane(frame, number)
        np.testing.assert_array_equal(codes[:, 5], codes[:, 4])
        np.testing.assert_array_equal(codes[3], codes[2])
