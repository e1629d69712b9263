"""Films that cannot be: one clear word, nothing half-written, no thread left; and sizes at the ends of the range."""

from __future__ import annotations

import errno
import os
import resource
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import av
import numpy as np
import pytest
from film_cases import KINDS, SIZE, frames, pictures, tone

from mien.core import MienError, RangeError, UnknownNameError
from mien.formats import film, film_frames, film_stills
from mien.formats.codecs import CODECS, Codec, find_codec
from mien.formats.film import write_film


@pytest.mark.parametrize("codec", CODECS, ids=[row.suffix for row in CODECS])
@pytest.mark.parametrize("size", [(1, 1), (2, 3), (17, 5), (101, 64)])
def test_odd_and_tiny_sizes(tmp_path: Path, codec: Codec, size: tuple[int, int]) -> None:
    path = tmp_path / f"a{codec.suffix}"
    write_film(frames(3, size), path, fps=24, size_px=size)
    width, height = (side + side % 2 if codec.even else side for side in size)
    found = pictures(path)
    assert [picture.shape for picture in found] == [(height, width, 4)] * 3
    assert np.abs(found[2].astype(int) - (255, 40, 255, 255)).max() <= 6


@pytest.mark.parametrize("size", [(16383, 2), (2, 16383)])
@pytest.mark.parametrize("suffix", KINDS)
def test_the_longest_side(tmp_path: Path, suffix: str, size: tuple[int, int]) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(1, size), path, fps=24, size_px=size)
    (picture,) = pictures(path)
    assert abs(int(picture[-1, -1, 1])) <= 4


@pytest.mark.parametrize("suffix", [".mp4", ".webm", ".mov", ".webp"])
def test_too_many_pixels_are_refused_before_the_first_frame(tmp_path: Path, suffix: str) -> None:
    def never() -> Iterator[np.ndarray]:
        raise AssertionError
        yield

    with pytest.raises(RangeError):
        write_film(never(), tmp_path / f"a{suffix}", fps=24, size_px=(16384, 16384))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", KINDS)
@pytest.mark.parametrize(
    "failure", [KeyboardInterrupt, OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)), MienError("no such pose")]
)
def test_an_existing_film_survives_a_failure_in_the_middle(tmp_path: Path, failure: BaseException, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    path.write_text("old")
    before = threading.active_count()

    def failing() -> Iterator[np.ndarray]:
        yield from frames(5)
        raise failure

    with pytest.raises((KeyboardInterrupt, MienError)):
        write_film(failing(), path, fps=24, size_px=SIZE, sound=tone(1))
    assert path.read_text() == "old"
    assert [item.name for item in tmp_path.iterdir()] == [path.name]
    assert threading.active_count() == before


@pytest.mark.parametrize("suffix", KINDS)
def test_an_encoder_that_fails_midway_is_one_clear_word(
    tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[int] = []

    def failing(make: Callable[..., av.VideoFrame]) -> Callable[..., av.VideoFrame]:
        def make_or_fail(*arguments: object) -> av.VideoFrame:
            made.append(1)
            if len(made) == 4:
                raise av.error.ExternalError(542398533, "Generic error in an external library")
            return make(*arguments)

        return make_or_fail

    for module in (film, film_stills):
        monkeypatch.setattr(module, "make_frame", failing(film_frames.make_frame))
    monkeypatch.setattr(film, "make_frame_in_colors", failing(film_frames.make_frame_in_colors))
    with pytest.raises(MienError, match=r"a\.\w+: the encoder \S+ gave up \(Generic error"):
        write_film(frames(8), tmp_path / f"a{suffix}", fps=24, size_px=SIZE, sound=tone(1))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", KINDS)
def test_a_full_disk_is_one_clear_word(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    path.write_text("old")
    generator = np.random.default_rng(1)
    noise = generator.integers(0, 256, (200, 200, 4), dtype=np.uint8)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, before[1]))
    try:
        with pytest.raises(MienError, match="the disk is full"):
            write_film((np.roll(noise, 7 * k, 1) for k in range(40)), path, fps=24, size_px=(200, 200), sound=tone(2))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert path.read_text() == "old"
    assert [item.name for item in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("suffix", KINDS)
def test_no_frames_and_frames_of_another_shape_are_refused(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    with pytest.raises(MienError, match="needs one frame"):
        write_film(iter(()), path, fps=24, size_px=SIZE, sound=tone(1))
    with pytest.raises(MienError, match="frame 0: want 64x48"):
        write_film(frames(1, (32, 32)), path, fps=24, size_px=SIZE)
    with pytest.raises(MienError, match="float64"):
        write_film(iter([np.ones((48, 64, 4))]), path, fps=24, size_px=SIZE)
    assert list(tmp_path.iterdir()) == []


def test_a_suffix_that_is_no_film_is_refused(tmp_path: Path) -> None:
    assert find_codec("A.WebM").container == "webm"
    with pytest.raises(UnknownNameError, match=r"'\.webm'"):
        find_codec("a.wbm")


def test_a_gif_has_no_more_than_fifty_frames_a_second(tmp_path: Path) -> None:
    with pytest.raises(RangeError, match="50"):
        write_film(frames(2), tmp_path / "a.gif", fps=60, size_px=SIZE)
