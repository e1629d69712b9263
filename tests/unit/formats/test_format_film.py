"""Films: two streams, the right length, the right colours, and nothing left after a failure."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest

from mien.core import MienError, RangeError, Sound
from mien.formats.film import write_film
from mien.formats.notes import notes
from mien.formats.rates import check_film, check_rate

SIZE = (64, 48)


def frames(count: int, size: tuple[int, int] = SIZE) -> Iterator[np.ndarray]:
    for number in range(count):
        pixels = np.full((size[1], size[0], 4), 255, dtype=np.uint8)
        pixels[:, :, 1] = 20 * (number % 12)
        yield pixels


def tone(length_s: float, rate_hz: int = 24000) -> Sound:
    t = np.arange(round(length_s * rate_hz)) / rate_hz
    return Sound(np.rint(8000 * np.sin(2 * np.pi * 440 * t)).astype(np.int16), rate_hz)


def decode(path: Path) -> tuple[list[np.ndarray], np.ndarray]:
    with av.open(str(path)) as film:
        pictures = [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]
    with av.open(str(path)) as film:
        blocks = [frame.to_ndarray()[0] for frame in film.decode(audio=0)] if film.streams.audio else []
    return pictures, np.concatenate(blocks) if blocks else np.zeros(0)


def lengths_s(path: Path) -> list[float]:
    with av.open(str(path)) as film:
        return [float(stream.duration * stream.time_base) for stream in film.streams]


def test_picture_and_sound_come_back(tmp_path: Path) -> None:
    path = tmp_path / "a.mp4"
    write_film(frames(12), path, fps=24, size_px=SIZE, sound=tone(0.5), notes=notes("head", "Hello"))
    pictures, samples = decode(path)
    assert len(pictures) == 12
    for number, picture in enumerate(pictures):
        assert np.abs(picture.mean(axis=(0, 1)) - (255, 20 * number, 255)).max() < 4
    assert lengths_s(path) == [0.5, 0.5]
    loud = float(np.sqrt(np.mean(samples[2000:10000] ** 2)))
    assert loud == pytest.approx(8000 / 32768 / np.sqrt(2), rel=0.05)


def test_it_says_what_it_is_and_how_its_colours_are_meant(tmp_path: Path) -> None:
    write_film(frames(2), tmp_path / "a.mp4", fps=24, size_px=SIZE, notes=notes("head", "Hello"))
    with av.open(str(tmp_path / "a.mp4")) as film:
        assert film.metadata["face"] == "head"
        assert film.metadata["title"] == "Hello"
        assert "Synthetic" in film.metadata["description"]
        context = film.streams.video[0].codec_context
        assert (context.colorspace, context.color_primaries, context.color_trc, context.pix_fmt) == (1, 1, 1, "yuv420p")


def test_the_index_comes_first_so_that_it_plays_while_it_loads(tmp_path: Path) -> None:
    write_film(frames(2), tmp_path / "a.mp4", fps=24, size_px=SIZE)
    data = (tmp_path / "a.mp4").read_bytes()
    assert 0 < data.index(b"moov") < data.index(b"mdat")


@pytest.mark.parametrize("fps", [1, 12.5, 24, 30000 / 1001, 240])
def test_any_rate(tmp_path: Path, fps: float) -> None:
    write_film(frames(4), tmp_path / "a.mp4", fps=fps, size_px=SIZE, sound=tone(4 / fps))
    with av.open(str(tmp_path / "a.mp4")) as film:
        assert film.streams.video[0].average_rate == check_rate(fps)
    assert lengths_s(tmp_path / "a.mp4") == pytest.approx([4 / fps, 4 / fps], abs=0.001)


def test_a_named_broadcast_rate_is_exact() -> None:
    assert check_rate(29.97002997) == Fraction(30000, 1001)


def test_a_longer_sound_holds_the_last_picture(tmp_path: Path) -> None:
    write_film(frames(3), tmp_path / "a.mp4", fps=24, size_px=SIZE, sound=tone(0.5))
    pictures, _ = decode(tmp_path / "a.mp4")
    assert len(pictures) == 12
    assert abs(pictures[-1].mean() - pictures[2].mean()) < 2
    assert lengths_s(tmp_path / "a.mp4") == [0.5, 0.5]


def test_a_shorter_sound_is_followed_by_silence(tmp_path: Path) -> None:
    write_film(frames(24), tmp_path / "a.mp4", fps=24, size_px=SIZE, sound=tone(0.25))
    _, samples = decode(tmp_path / "a.mp4")
    assert lengths_s(tmp_path / "a.mp4") == [1.0, 1.0]
    assert np.abs(samples[1000:5000]).max() > 0.2
    assert np.abs(samples[9000:]).max() < 0.01


def test_without_sound_there_is_one_stream(tmp_path: Path) -> None:
    write_film(frames(2), tmp_path / "a.mp4", fps=24, size_px=SIZE)
    with av.open(str(tmp_path / "a.mp4")) as film:
        assert [stream.type for stream in film.streams] == ["video"]


def test_the_same_film_has_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a.mp4", "b.mp4"):
        write_film(frames(30), tmp_path / name, fps=24, size_px=SIZE, sound=tone(1.0))
    assert (tmp_path / "a.mp4").read_bytes() == (tmp_path / "b.mp4").read_bytes()


@pytest.mark.parametrize("fps", [0, 0.5, 241, float("nan"), float("inf"), -24])
def test_a_rate_that_no_film_has_is_refused(fps: float) -> None:
    with pytest.raises(RangeError, match="from 1 to 240"):
        check_rate(fps)


def test_odd_sides_are_refused_with_a_size_that_does() -> None:
    with pytest.raises(RangeError, match="try 102x64"):
        check_film("a.mp4", 24, (101, 64))
    with pytest.raises(RangeError, match="transparen"):
        check_film("a.mp4", 24, (100, 64), transparent=True)


@pytest.mark.parametrize("failure", [KeyboardInterrupt, OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))])
def test_an_existing_film_survives_a_failure_in_the_middle(tmp_path: Path, failure: BaseException) -> None:
    path = tmp_path / "a.mp4"
    path.write_text("old")

    def failing() -> Iterator[np.ndarray]:
        yield from frames(5)
        raise failure

    with pytest.raises((KeyboardInterrupt, MienError)):
        write_film(failing(), path, fps=24, size_px=SIZE, sound=tone(1))
    assert path.read_text() == "old"
    assert [item.name for item in tmp_path.iterdir()] == ["a.mp4"]


def test_no_frames_and_frames_of_another_size_are_refused(tmp_path: Path) -> None:
    with pytest.raises(MienError, match="needs one frame"):
        write_film(iter(()), tmp_path / "a.mp4", fps=24, size_px=SIZE)
    with pytest.raises(MienError, match="frame 0: want 64x48"):
        write_film(frames(1, (32, 32)), tmp_path / "a.mp4", fps=24, size_px=SIZE)
    assert list(tmp_path.iterdir()) == []
