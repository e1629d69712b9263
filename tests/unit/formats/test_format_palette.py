"""256 colours of a picture: exact where there are no more, near where there are, the rare ones kept."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.formats import palette, yuv
from mien.formats.palette import COLORS, DITHER, PATTERN, Quantiser


def reduce(pixels: np.ndarray, clear: bool = False) -> np.ndarray:
    numbers, colors = Quantiser(clear).reduce(yuv.to_words(pixels))
    return colors[numbers]


def opaque(color: np.ndarray) -> np.ndarray:
    return np.concatenate([color, np.full((*color.shape[:2], 1), 255)], axis=2).astype(np.uint8)


def test_the_pattern_holds_every_step_and_adds_up_to_nothing() -> None:
    assert PATTERN.shape == (8, 8)
    assert set(PATTERN.ravel()) == set(range(-DITHER, DITHER + 1))
    assert PATTERN.sum() == 0


@given(st.integers(0, 2**32 - 1), st.integers(1, 16))
def test_few_colours_far_apart_are_exact(seed: int, count: int) -> None:
    generator = np.random.default_rng(seed)
    colors = 40 * generator.integers(0, 7, (count, 3))
    pixels = opaque(colors[generator.integers(0, count, (9, 13))])
    np.testing.assert_array_equal(reduce(pixels), pixels)


def test_a_smooth_picture_is_near_and_no_darker_or_lighter() -> None:
    x, y = np.meshgrid(np.linspace(0, 1, 160), np.linspace(0, 1, 120))
    pixels = opaque(np.rint(np.stack([180 + 60 * x, 120 + 60 * y, 90 + 20 * x * y], axis=2)))
    difference = reduce(pixels).astype(int) - pixels
    assert np.abs(difference).max() <= 12
    assert np.abs(difference[..., :3].mean(axis=(0, 1))).max() < 0.5


def test_a_small_iris_keeps_its_colour_beside_a_large_gradient() -> None:
    x, y = np.meshgrid(np.linspace(0, 1, 400), np.linspace(0, 1, 400))
    pixels = opaque(np.rint(np.stack([120 + 120 * x, 100 + 100 * y, 80 + 80 * x * y], axis=2)))
    pixels[200:206, 200:206, :3] = (40, 110, 60)
    assert np.abs(reduce(pixels)[201:205, 201:205].astype(int) - (40, 110, 60, 255)).max() <= 6


@given(st.integers(0, 2**32 - 1))
def test_what_is_half_transparent_is_one_or_the_other(seed: int) -> None:
    pixels = np.random.default_rng(seed).integers(0, 256, (24, 40, 4), dtype=np.uint8)
    found = reduce(pixels, clear=True)
    np.testing.assert_array_equal(found[..., 3], np.where(pixels[..., 3] >= 128, 255, 0))


def test_nothing_visible_is_all_clear() -> None:
    assert not reduce(np.zeros((4, 5, 4), dtype=np.uint8), clear=True).any()


@pytest.mark.parametrize("clear", [False, True])
def test_every_bin_is_in_one_box_and_each_pixel_gets_the_nearest_colour(
    clear: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    pixels = opaque(np.random.default_rng(3).integers(0, 256, (60, 50, 3)))
    monkeypatch.setattr(palette, "PATTERN", np.zeros_like(PATTERN))
    numbers, colors = Quantiser(clear).reduce(yuv.to_words(pixels))
    limit = COLORS - clear
    middles = (pixels[..., :3] & 0xFC) + 1.5
    distances = ((middles[..., None, :] - colors[:limit, :3].astype(float)) ** 2).sum(axis=-1)
    chosen = np.take_along_axis(distances, numbers[..., None].astype(int), axis=2)[..., 0]
    np.testing.assert_array_equal(chosen, distances.min(axis=2))
    assert len(np.unique(numbers)) == limit


def test_one_picture_leaves_nothing_behind_for_the_next() -> None:
    first, second = (opaque(np.random.default_rng(seed).integers(0, 256, (30, 30, 3))) for seed in (1, 2))
    quantiser = Quantiser(False)
    quantiser.reduce(yuv.to_words(first))
    numbers, colors = quantiser.reduce(yuv.to_words(second))
    np.testing.assert_array_equal(colors[numbers], reduce(second))
