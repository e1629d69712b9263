"""Frames drawn ahead: same order, bounded, and no thread left behind whatever happens."""

import threading
import time
from contextlib import closing

import pytest

from mien.formats.pipeline import DEPTH, run_ahead


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
