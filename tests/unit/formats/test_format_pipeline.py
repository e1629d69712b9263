"""Frames drawn ahead: same order, bounded, and no thread left behind whatever happens."""

from __future__ import annotations

import resource
import threading
import time
import tracemalloc
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from small_face import SmallRenderer, opening_jaw

from mien.core import MienError, Pose
from mien.formats import film, write_performance
from mien.formats.film_stills import StillEncoder
from mien.formats.picture import Picture
from mien.formats.pipeline import DEPTH, at_once, run_ahead, runs


def workers():
    return [thread for thread in threading.enumerate() if thread.name == "mien-frames"]


def test_items_come_in_order_and_all_of_them():
    assert list(run_ahead(iter(range(100)))) == list(range(100))
    assert workers() == []


def test_items_are_made_on_another_thread():
    (name,) = run_ahead(threading.current_thread().name for _ in range(1))
    assert name == "mien-frames"


def test_no_more_run_ahead_than_told():
    made = []

    def items():
        for number in range(50):
            made.append(number)
            yield number

    with closing(run_ahead(items())) as ahead:
        next(ahead)
        time.sleep(0.2)
        # One is taken, DEPTH wait, one is in the worker's hands.
        assert len(made) <= DEPTH + 2


def test_an_error_comes_in_its_place():
    def items():
        yield 1
        raise OSError("no more")

    ahead = run_ahead(items())
    assert next(ahead) == 1
    with pytest.raises(OSError, match="no more"):
        next(ahead)
    assert workers() == []


def test_closing_early_stops_the_thread_and_the_source():
    closed = []

    def items():
        try:
            yield from range(1000)
        finally:
            closed.append(True)

    def take_one_and_stop():
        with closing(run_ahead(items())) as ahead:
            next(ahead)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        take_one_and_stop()
    assert closed == [True]
    assert workers() == []


@settings(deadline=None, max_examples=50)
@given(st.lists(st.integers(0, 2), max_size=20))
def test_runs_hold_every_frame_for_as_long_as_it_is_seen(numbers: list[int]) -> None:
    frames = [np.full((2, 2, 4), number, dtype=np.uint8) for number in numbers]
    found = [(int(pixels[0, 0, 0]), count) for pixels, count in runs(iter(frames))]
    assert [number for number, count in found for _ in range(count)] == numbers
    assert all(one[0] != two[0] for one, two in pairwise(found))


def test_fewer_huge_pictures_wait() -> None:
    assert [at_once(size) for size in ((1, 1), (1024, 1024), (8192, 4096), (16384, 16384))] == [DEPTH, DEPTH, 2, 1]


FILMS = ["a.mp4", "a.webm", "a.mov", "a.gif", "a.apng", "a.webp", "frames", "f_%04d.png"]


@pytest.fixture
def _painted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mien.render.Renderer", SmallRenderer)


@contextmanager
def nothing_left(folder: Path) -> Iterator[None]:
    """Whatever happens inside: no thread more than before, and nothing in the folder but what was there."""
    threads, names = threading.active_count(), sorted(folder.iterdir())
    yield
    assert workers() == []
    assert threading.active_count() <= threads
    assert sorted(folder.iterdir()) == names


def fail_at(number: int, error: BaseException, then: Callable[..., object]) -> Callable[..., object]:
    """What calls ``then``, but raises at a certain call."""
    calls = iter(range(1_000_000))

    def call(*arguments: object) -> object:
        if next(calls) == number:
            raise error
        return then(*arguments)

    return call


@pytest.mark.usefixtures("_painted")
@pytest.mark.parametrize("name", FILMS)
@pytest.mark.parametrize("where", ["pose", "draw", "convert", "interrupt"])
def test_an_error_anywhere_ends_everything(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, where: str
) -> None:
    error: BaseException = KeyboardInterrupt() if where == "interrupt" else ZeroDivisionError(where)
    report = fail_at(20, error, lambda *numbers: None) if where == "interrupt" else None
    if where == "pose":
        monkeypatch.setattr("mien.timeline.timeline.Pose", fail_at(20, error, Pose))
    if where == "draw":
        monkeypatch.setattr(SmallRenderer, "draw", fail_at(20, error, SmallRenderer.draw))
    if where == "convert":
        for function in ("make_frame", "make_frame_in_colors"):
            monkeypatch.setattr(film, function, fail_at(20, error, getattr(film, function)))
        monkeypatch.setattr(StillEncoder, "encode", fail_at(20, error, StillEncoder.encode))
        monkeypatch.setattr("mien.formats.series.Picture", fail_at(20, error, Picture))
    with nothing_left(tmp_path), pytest.raises(type(error)):
        write_performance(opening_jaw(2.0), tmp_path / name, report=report)


@contextmanager
def files_of(most_bytes: int) -> Iterator[None]:
    """Inside, a file that grows beyond so many bytes fails as on a full disk."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most_bytes, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.usefixtures("_painted")
@pytest.mark.parametrize("name", FILMS)
def test_a_disk_that_fills_midway_ends_everything(tmp_path: Path, name: str) -> None:
    most = 200 if "f" in name[:2] else 2000
    with nothing_left(tmp_path), pytest.raises(MienError, match="the disk is full"), files_of(most):
        write_performance(opening_jaw(20.0, size_px=(96, 64)), tmp_path / name)


@pytest.mark.usefixtures("_painted")
@pytest.mark.parametrize("name", ["a.mp4", "a.webp", "frames"])
def test_a_longer_film_needs_no_more_memory(tmp_path: Path, name: str) -> None:
    peaks = []
    for length_s in (5.0, 30.0):
        performance = opening_jaw(length_s, sound=False, size_px=(64, 64))
        tracemalloc.start()
        write_performance(performance, tmp_path / name, fps=10)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    # 250 pictures more would be 4 MB more.
    assert peaks[1] < peaks[0] + 1_000_000
