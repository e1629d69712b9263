"""Transparent films: alpha comes back, and no edge is darker than the face."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from film_cases import CLEAR, pictures

from mien.core import RangeError
from mien.formats.film import write_film

SIDE = 96
COLOR = np.array([240, 160, 120])


def disc(number: int) -> np.ndarray:
    """A disc with a soft edge that moves to the right; black where nothing is, as the renderer gives it."""
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    distance = np.hypot(x - 36 - 2 * number, y - 48)
    alpha = np.clip(30.5 - distance, 0, 1)
    pixels = np.zeros((SIDE, SIDE, 4), dtype=np.uint8)
    pixels[alpha > 0, :3] = COLOR
    pixels[..., 3] = np.rint(255 * alpha)
    return pixels


@pytest.fixture(params=CLEAR)
def film(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[str, list[np.ndarray]]:
    path = tmp_path / f"a{request.param}"
    write_film(map(disc, range(8)), path, fps=24, size_px=(SIDE, SIDE), transparent=True)
    return request.param, pictures(path)


def test_alpha_comes_back_and_nothing_shines_through_from_the_frame_before(
    film: tuple[str, list[np.ndarray]],
) -> None:
    suffix, found = film
    assert len(found) == 8
    for number, picture in enumerate(found):
        wanted = disc(number)[..., 3].astype(int)
        if suffix == ".gif":
            wanted = np.where(wanted >= 128, 255, 0)
        difference = np.abs(picture[..., 3] - wanted)
        # VP9 codes alpha as it does light; all others keep it.
        assert difference.max() <= {".webm": 24, ".gif": 0}.get(suffix, 1)
        assert difference.mean() < 0.5


def test_edges_have_the_colour_of_what_they_are_edges_of(film: tuple[str, list[np.ndarray]]) -> None:
    suffix, found = film
    for number, picture in enumerate(found):
        alpha = disc(number)[..., 3]
        edge = (alpha > (128 if suffix == ".gif" else 24)) & (alpha < 255)
        assert np.abs(picture[edge][:, :3].mean(axis=0) - COLOR).max() < 5


@pytest.mark.parametrize("suffix", [".webm", ".mov"])
def test_what_lies_just_outside_an_edge_has_its_colour_so_that_scaling_darkens_nothing(
    tmp_path: Path, suffix: str
) -> None:
    path = tmp_path / f"a{suffix}"
    write_film([disc(0)], path, fps=24, size_px=(SIDE, SIDE), transparent=True)
    (picture,) = pictures(path)
    assert np.abs(picture[..., :3].mean(axis=(0, 1)) - COLOR).max() < 3


def test_mp4_has_no_transparency(tmp_path: Path) -> None:
    with pytest.raises(RangeError, match=r"\.webm"):
        write_film([disc(0)], tmp_path / "a.mp4", fps=24, size_px=(SIDE, SIDE), transparent=True)
    assert list(tmp_path.iterdir()) == []
