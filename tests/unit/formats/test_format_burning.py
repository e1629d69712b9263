"""Burned subtitles: the letters that are there, where they stand, when they are seen, and what else stays as it was."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageFont
from small_face import SmallRenderer, opening_jaw

from mien.core import MienError, RangeError
from mien.formats import write_performance
from mien.formats.burning import CHARACTER_EM, LETTERS, STANDINS, Burner, check_letters, check_size
from mien.formats.performances import draw_frames
from mien.formats.subtitles import Subtitle

SIZE = (640, 360)
GREY = np.full((SIZE[1], SIZE[0], 4), 128, dtype=np.uint8)


def burn(*lines: str, picture: np.ndarray = GREY) -> np.ndarray:
    burner = Burner([Subtitle(0.0, 1.0, lines)], (picture.shape[1], picture.shape[0]))
    assert burner.at(0.5) == 0
    out = picture.copy()
    burner.burn(out)
    return out


def box(pixels: np.ndarray) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of what is no longer grey."""
    rows, columns = np.nonzero((pixels != 128).any(axis=2))
    return columns.min(), rows.min(), columns.max(), rows.max()


def test_letters_are_white_with_a_dark_edge_and_the_rest_is_untouched() -> None:
    out = burn("Hello there")
    left, top, right, bottom = box(out)
    assert out[top : bottom + 1, left : right + 1, :3].max() == 255
    assert out[top : bottom + 1, left : right + 1, :3].min() == 0
    assert out[(top + bottom) // 2, left, :3].max() < 128
    assert (out[:top] == 128).all()


@pytest.mark.parametrize("lines", [("Gypsy",), ("A much longer line of nearly forty-one chars", "and one more")])
@pytest.mark.parametrize("size", [(640, 360), (360, 640), (512, 512), (1280, 320)])
def test_they_stand_in_the_middle_of_the_safe_area(lines: tuple[str, ...], size: tuple[int, int]) -> None:
    picture = np.full((size[1], size[0], 4), 128, dtype=np.uint8)
    left, top, right, bottom = box(burn(*lines, picture=picture))
    assert left >= 0.045 * size[0]
    assert right <= 0.955 * size[0]
    assert abs((left + right) / 2 - size[0] / 2) <= 2
    assert 0.9 * size[1] < bottom <= 0.955 * size[1]
    assert bottom - top < (0.1 if len(lines) == 1 else 0.18) * size[1]


def test_a_line_of_wide_letters_shrinks_to_fit() -> None:
    left, _, right, _ = box(burn("W" * 42))
    assert left >= 0.04 * SIZE[0]
    assert right <= 0.96 * SIZE[0]


def test_over_a_transparent_picture_the_letters_are_opaque() -> None:
    out = burn("Hello", picture=np.zeros((360, 640, 4), dtype=np.uint8))
    assert out[:, :, 3].max() == 255
    assert (out[:300, :, 3] == 0).all()


def test_all_letters_of_the_table_are_there_and_no_other() -> None:
    font = ImageFont.load_default(40)
    nothing = bytes(font.getmask("\uffff"))
    there = {c for c in map(chr, range(32, 0x2600)) if c.isprintable() and bytes(font.getmask(c)) != nothing}
    assert there == LETTERS
    assert set("".join(STANDINS.values())) <= LETTERS
    assert not set(STANDINS) & LETTERS
    text = "the quick brown fox jumps over the lazy dog"
    assert 0.9 * CHARACTER_EM < font.getlength(text) / len(text) / 40 < CHARACTER_EM


def test_a_character_without_letters_becomes_its_like_or_is_left_out_or_refused() -> None:
    np.testing.assert_array_equal(burn("Café — naïve ﬁx 😀 x²"), burn("Cafe - naive fix x2"))
    check_letters(["Straße — 5 € 😀 ½"])
    with pytest.raises(MienError, match=r"no letters for П и р .*--subtitles FILE"):
        check_letters(["Пирр"])


def test_the_same_letters_every_time() -> None:
    out = burn("Hello, there", "again")
    np.testing.assert_array_equal(out, burn("Hello, there", "again"))


@pytest.mark.parametrize("size", [(1, 1), (64, 64), (1000, 40), (186, 500)])
def test_too_small_a_picture_is_refused_with_a_size_that_does(size: tuple[int, int]) -> None:
    with pytest.raises(RangeError, match="at least --size 187x126"):
        check_size(size)
    check_size((187, 126))


def test_frames_show_the_subtitle_of_their_moment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mien.render.Renderer", SmallRenderer)
    still = opening_jaw(size_px=(200, 200), still=True)
    burner = Burner([Subtitle(0.2, 0.4, ("One",)), Subtitle(0.4, 0.7, ("Two",))], (200, 200))
    frames = list(draw_frames(still.timeline, still.face, still.scene, 10, burner=burner))
    looks = [frames[0], frames[2], frames[4]]
    assert not np.array_equal(looks[1], looks[2])
    seen = [[np.array_equal(frame, look) for look in looks].index(True) for frame in frames]
    assert seen == [0, 0, 1, 1, 2, 2, 2, 0, 0, 0]
    assert frames[2] is frames[3]


def test_pictures_of_a_series_carry_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mien.render.Renderer", SmallRenderer)
    performance = opening_jaw(2.0, size_px=(200, 200), words=("Ah",), still=True)
    write_performance(performance, tmp_path / "plain", fps=1)
    write_performance(performance, tmp_path / "burned", fps=1, subtitles="burn")
    for name, equal in (("frame_0000.png", False), ("frame_0001.png", True)):
        with Image.open(tmp_path / "plain" / name) as one, Image.open(tmp_path / "burned" / name) as other:
            assert np.array_equal(np.asarray(one)[:180], np.asarray(other)[:180])
            assert np.array_equal(np.asarray(one), np.asarray(other)) == equal
