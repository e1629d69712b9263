"""Pictures as PNG and JPEG."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien.core import MienError, UnknownNameError
from mien.formats.notes import notes
from mien.formats.picture import Picture, over_white


def gradient(alpha: int = 255) -> np.ndarray:
    pixels = np.zeros((5, 7, 4), dtype=np.uint8)
    pixels[:, :, 0] = np.arange(7) * 30
    pixels[:, :, 1] = np.arange(5)[:, None] * 40
    pixels[:, :, 3] = alpha
    return pixels


@pytest.mark.parametrize("alpha", [255, 128, 0])
def test_png_gives_back_every_pixel(tmp_path: Path, alpha: int) -> None:
    Picture(gradient(alpha)).write(tmp_path / "a.png")
    with Image.open(tmp_path / "a.png") as image:
        assert image.mode == ("RGB" if alpha == 255 else "RGBA")
        np.testing.assert_array_equal(np.asarray(image.convert("RGBA")), gradient(alpha))


def test_png_says_what_made_it() -> None:
    with Image.open(io.BytesIO(Picture(gradient(), notes("head")).to_png())) as image:
        image.load()
        assert image.text["Face"] == "head"
        assert image.text["Software"].startswith("mien ")
        assert "Synthetic" in image.text["Description"]
        assert "srgb" in image.info


def test_the_same_picture_has_the_same_bytes() -> None:
    first, second = (Picture(gradient(), notes("head")) for _ in range(2))
    assert first.to_png() == second.to_png()
    assert first.to_jpeg() == second.to_jpeg()


def test_jpeg_is_close_and_says_what_made_it(tmp_path: Path) -> None:
    pixels = np.full((16, 16, 4), (200, 100, 50, 255), dtype=np.uint8)
    Picture(pixels, notes("head")).write(tmp_path / "a.JPG")
    with Image.open(tmp_path / "a.JPG") as image:
        assert np.abs(np.asarray(image).astype(int) - (200, 100, 50)).max() <= 3
        assert b"Face: head" in image.info["comment"]


def test_half_transparent_black_is_grey_on_white_paper() -> None:
    pixels = np.array([[[0, 0, 0, 0], [0, 0, 0, 128], [10, 20, 30, 255]]], dtype=np.uint8)
    assert over_white(pixels).tolist() == [[[255] * 3, [127] * 3, [10, 20, 30]]]


def test_a_notebook_is_shown_a_png() -> None:
    assert Picture(gradient())._repr_png_().startswith(b"\x89PNG")


def test_an_unknown_suffix_is_refused_and_nothing_written(tmp_path: Path) -> None:
    with pytest.raises(UnknownNameError, match=r"did you mean '.png'"):
        Picture(gradient()).write(tmp_path / "a.pngg")
    assert list(tmp_path.iterdir()) == []


def test_an_array_of_another_shape_is_no_picture() -> None:
    with pytest.raises(MienError, match=r"\(4, 4\)"):
        Picture(np.zeros((4, 4), dtype=np.uint8))
