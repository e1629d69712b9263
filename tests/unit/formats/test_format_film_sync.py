"""Sound and picture begin together and stay together: a click that is heard while a white flash is seen."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest
from film_cases import PLAYED

from mien.core import Sound
from mien.formats.film import write_film
from mien.formats.rates import check_rate

SIDE = 16
CLICK_SAMPLES = 8

HEARD_S = {".mp4": 0.0003, ".webm": 0.0013, ".mov": 0.0001}
"""How far off a click may be: an encoder smears it, and WebM counts in milliseconds, in pictures and in sound."""

SEEN_S = {".mp4": 0.00005, ".webm": 0.0006, ".mov": 0.00005}


def flash(count: int, flashes: set[int]) -> Iterator[np.ndarray]:
    black, white = (np.full((SIDE, SIDE, 4), level, dtype=np.uint8) for level in (0, 255))
    black[..., 3] = 255
    return (white if number in flashes else black for number in range(count))


def clicks(count: int, flashes: set[int], rate: Fraction, rate_hz: int) -> Sound:
    samples = np.zeros(int(count / rate * rate_hz), dtype=np.int16)
    for number in flashes:
        place = round(number / rate * rate_hz)
        samples[place : place + CLICK_SAMPLES] = 20000
    return Sound(samples, rate_hz)


def seen_s(path: Path, from_s: float = 0.0) -> list[float]:
    """When the picture is white."""
    with av.open(str(path)) as film:
        film.seek(int(from_s * av.time_base))
        return [
            float(frame.pts * frame.time_base)
            for frame in film.decode(video=0)
            if frame.to_ndarray(format="gray").mean() > 128
        ]


def heard_s(path: Path, from_s: float = 0.0, part_s: float = 0.5) -> list[float]:
    """When the sound is loudest in every part of a length, if it is loud."""
    blocks, begin, rate_hz = [], None, 1
    with av.open(str(path)) as film:
        film.seek(int(from_s * av.time_base))
        for frame in film.decode(audio=0):
            if begin is None:
                begin, rate_hz = float(frame.pts * frame.time_base), frame.sample_rate
            block = np.abs(frame.to_ndarray()[0].astype(float))
            blocks.append(block / 32768 if frame.format.name == "s16" else block)
    samples, part = np.concatenate(blocks), round(part_s * rate_hz)
    starts = range(0, len(samples), part)
    peaks = [start + int(samples[start : start + part].argmax()) for start in starts]
    return [(begin or 0.0) + peak / rate_hz for peak in peaks if samples[peak] > 0.1]


@pytest.mark.parametrize(("fps", "rate_hz"), [(24, 24000), (29.97, 22050), (23.976, 44100), (25, 16000), (30, 12345)])
@pytest.mark.parametrize("suffix", PLAYED)
def test_a_click_is_heard_when_the_flash_is_seen(tmp_path: Path, suffix: str, fps: float, rate_hz: int) -> None:
    path, rate, flashes = tmp_path / f"a{suffix}", check_rate(fps), {5, 20, 40}
    sound = clicks(48, flashes, rate, rate_hz)
    write_film(flash(48, flashes), path, fps=fps, size_px=(SIDE, SIDE), sound=sound)
    wanted = [float(number / rate) for number in sorted(flashes)]
    assert seen_s(path) == pytest.approx(wanted, abs=SEEN_S[suffix])
    assert heard_s(path) == pytest.approx(wanted, abs=HEARD_S[suffix] + CLICK_SAMPLES / rate_hz)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", PLAYED)
def test_they_are_still_together_after_ten_minutes(tmp_path: Path, suffix: str) -> None:
    path, rate = tmp_path / f"a{suffix}", check_rate(29.97)
    count = int(600 * rate)
    flashes = {count - 40}
    sound = clicks(count, flashes, rate, 24000)
    write_film(flash(count, flashes), path, fps=29.97, size_px=(SIDE, SIDE), sound=sound)
    wanted = float((count - 40) / rate)
    assert seen_s(path, 590.0) == pytest.approx([wanted], abs=SEEN_S[suffix])
    assert heard_s(path, 590.0) == pytest.approx([wanted], abs=HEARD_S[suffix] + CLICK_SAMPLES / 24000)
    times = {"video": [], "audio": []}
    with av.open(str(path)) as film:
        for packet in film.demux():
            if packet.pts is not None:
                times[packet.stream.type].append(float(packet.pts * packet.time_base))
    pictures = np.sort(times["video"])
    assert len(pictures) == count
    assert np.abs(pictures - np.arange(count) / float(rate)).max() <= SEEN_S[suffix]
    # No gap and no overlap: packets of equal length follow one another, but for the last ones.
    gaps = np.diff(np.sort(times["audio"]))[:-2]
    assert np.abs(gaps - np.median(gaps)).max() <= 2 * SEEN_S[suffix]
    assert abs(times["audio"][-1] - pictures[-1]) < 0.1
