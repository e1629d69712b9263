"""Films of every kind: the right pictures at the right times, sound as long, the same bytes again."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest
from film_cases import KINDS, PLAYED, REPEATED, SIZE, frames, lengths_s, pictures, samples, shown, tone

from mien.formats.codecs import CODECS
from mien.formats.film import write_film
from mien.formats.notes import notes
from mien.formats.rates import check_rate

TOLERANCE = {".mp4": 4, ".webm": 4, ".mov": 1, ".gif": 0, ".apng": 0, ".webp": 3}
"""How far a colour may be off: losses of the codec and of its reader; plain areas fit into 256 colours."""


def test_every_row_of_the_table_is_tested() -> None:
    assert {row.suffix for row in CODECS} == set(KINDS)


@pytest.mark.parametrize("suffix", KINDS)
def test_pictures_come_back(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(12), path, fps=24, size_px=SIZE)
    found = pictures(path)
    assert len(found) == 12
    for number, picture in enumerate(found):
        assert picture.shape == (48, 64, 4)
        assert np.abs(picture.mean(axis=(0, 1)) - (255, 20 * number, 255, 255)).max() <= TOLERANCE[suffix]


@pytest.mark.parametrize("suffix", PLAYED)
def test_sound_comes_back_and_lasts_as_long(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(12), path, fps=24, size_px=SIZE, sound=tone(0.5))
    assert lengths_s(path) == pytest.approx([0.5, 0.5], abs=0.001)
    middle = samples(path)[2000:10000]
    assert float(np.sqrt(np.mean(middle**2))) == pytest.approx(8000 / 32768 / np.sqrt(2), rel=0.05)


@pytest.mark.parametrize("suffix", REPEATED)
def test_kinds_without_sound_leave_it_out_and_begin_again_at_the_end(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(3), path, fps=24, size_px=SIZE, sound=tone(1.0))
    assert len(pictures(path)) == 3
    with av.open(str(path), options={"ignore_loop": "1"} if suffix != ".webp" else {}) as film:
        assert [stream.type for stream in film.streams] == ["video"]
    from PIL import Image

    with Image.open(path) as image:
        assert image.info["loop"] == 0


@pytest.mark.parametrize("suffix", PLAYED)
def test_colours_are_said_to_be_bt709(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(2), path, fps=24, size_px=SIZE)
    with av.open(str(path)) as film:
        context = film.streams.video[0].codec_context
        assert (context.colorspace, context.color_primaries, context.color_trc) == (1, 1, 1)


@pytest.mark.parametrize("suffix", [".mp4", ".mov"])
def test_the_index_comes_first_so_that_it_plays_while_it_loads(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(2), path, fps=24, size_px=SIZE)
    data = path.read_bytes()
    assert 0 < data.index(b"moov") < data.index(b"mdat")


@pytest.mark.parametrize("suffix", KINDS)
@pytest.mark.parametrize("fps", [1, 12.5, 24, 29.97, Fraction(24000, 1001), 50])
def test_any_rate(tmp_path: Path, fps: float, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(7), path, fps=fps, size_px=SIZE, sound=tone(float(7 / check_rate(fps)) - 0.0001))
    step = {".webm": 0.001, ".gif": 0.01, ".webp": 0.001}.get(suffix, 0.00005)
    for number, (_, start_s, _) in enumerate(shown(path)):
        assert abs(start_s - number / check_rate(fps)) <= step / 2 + 1e-9
    if suffix in PLAYED:
        assert lengths_s(path) == pytest.approx([float(7 / fps)] * 2, abs=0.001)


@pytest.mark.parametrize("suffix", KINDS)
def test_equal_frames_in_a_row_may_be_one_that_stays(tmp_path: Path, suffix: str) -> None:
    first, last = frames(2)
    path = tmp_path / f"a{suffix}"
    write_film([first, first, first.copy(), last, last], path, fps=25, size_px=SIZE, variable=True)
    found = shown(path)
    assert [start_s for _, start_s, _ in found] == pytest.approx([0, 0.12])
    assert found[1][2] == pytest.approx(0.08, abs=0.002)
    assert lengths_s(path) == pytest.approx([0.2]) if suffix in PLAYED else len(found) == 2


@pytest.mark.parametrize("suffix", KINDS)
def test_a_picture_that_stays_for_minutes(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    first, last = frames(2)
    write_film([*[first] * 3001, last], path, fps=29.97, size_px=SIZE, variable=True)
    found = shown(path)
    assert len(found) == 2
    assert found[1][1] == pytest.approx(3001 * 1001 / 30000, abs=0.006)


@pytest.mark.parametrize("suffix", PLAYED)
def test_a_longer_sound_holds_the_last_picture(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(3), path, fps=24, size_px=SIZE, sound=tone(0.5))
    found = pictures(path)
    assert len(found) == 12
    assert abs(found[-1].mean() - found[2].mean()) < 2
    assert lengths_s(path) == pytest.approx([0.5, 0.5], abs=0.001)


@pytest.mark.parametrize("suffix", PLAYED)
def test_a_shorter_sound_is_followed_by_silence(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(24), path, fps=24, size_px=SIZE, sound=tone(0.25))
    heard = samples(path)
    rate_hz = 48000 if suffix == ".webm" else 24000
    assert lengths_s(path) == pytest.approx([1.0, 1.0], abs=0.001)
    assert np.abs(heard[: rate_hz // 5]).max() > 0.2
    assert np.abs(heard[rate_hz // 2 :]).max() < 0.01


@pytest.mark.parametrize("suffix", PLAYED)
def test_without_sound_there_is_one_stream(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_film(frames(2), path, fps=24, size_px=SIZE)
    with av.open(str(path)) as film:
        assert [stream.type for stream in film.streams] == ["video"]


@pytest.mark.parametrize("transparent", [False, True])
@pytest.mark.parametrize("suffix", KINDS)
def test_the_same_film_has_the_same_bytes(tmp_path: Path, suffix: str, transparent: bool) -> None:
    generator = np.random.default_rng(1)
    noise = [generator.integers(0, 256, (270, 330, 4), dtype=np.uint8) for _ in range(8)]
    if not transparent or suffix == ".mp4":
        transparent = False
        for picture in noise:
            picture[..., 3] = 255
    path, written = tmp_path / f"a{suffix}", set()
    for level in (0, 60, 255):
        write_film(
            noise, path, fps=24, size_px=(330, 270), sound=tone(0.3), notes=notes("head"), transparent=transparent
        )
        written.add(path.read_bytes())
        leave_in_memory(level)
    assert len(written) == 1


def leave_in_memory(level: int) -> None:
    """Bytes in memory that was given back: x264's macroblock tree at its fastest presets reads what it never wrote."""
    sizes = np.random.default_rng(level).integers(1, 5_000_000, 8)
    for block in [np.empty(size, dtype=np.uint8) for size in sizes]:
        block[:] = level
