"""Deadlines: nothing drifts, what is late is counted."""

import random
from fractions import Fraction

import pytest

from mien.live import Deadlines, run_loops


class Clock:
    """A clock that only sleeping and working move; sleeping takes a little longer than asked for."""

    def __init__(self, start_s=1000.0, over_s=0.0):
        self.now_s, self.over_s = start_s, over_s

    def now(self):
        return self.now_s

    def sleep(self, length_s):
        self.now_s += length_s + self.over_s


def run(clock, deadlines, work, loops):
    starts = []

    def step():
        starts.append(clock.now_s)
        clock.now_s += work()

    report = run_loops(step, deadlines, now=clock.now, sleep=clock.sleep, going=lambda: len(starts) < loops)
    return starts, report


@pytest.mark.parametrize("rate", [60, 10, Fraction(30000, 1001)])
def test_an_hour_drifts_by_nothing(rate):
    clock, chance = Clock(over_s=0.0004), random.Random(5)
    loops = int(3600 * rate)
    starts, report = run(clock, Deadlines(rate, clock.now_s), lambda: chance.random() * 0.9 / float(rate), loops)
    assert len(starts) == loops
    exact = Fraction(rate)
    due = (1000.0 + number * exact.denominator / exact.numerator for number in range(loops))
    worst = max(start - when for start, when in zip(starts, due, strict=True))
    assert 0.0 <= worst <= 0.0004 + 1e-9
    assert (report.run, report.late, report.dropped) == (loops, 0, 0)
    assert report.worst_s <= 0.0004 + 1e-9


def test_late_loops_run_at_once_and_are_counted():
    clock = Clock(0.0)
    works = iter([0.0, 0.35, *[0.0] * 20])
    starts, report = run(clock, Deadlines(10, 0.0), lambda: next(works), 8)
    # The loop at 0.1 s takes until 0.45 s: those due at 0.2, 0.3 and 0.4 s start then, the next is in time again.
    assert starts == pytest.approx([0.0, 0.1, 0.45, 0.45, 0.45, 0.5, 0.6, 0.7])
    assert (report.run, report.late, report.dropped) == (8, 2, 0)
    assert report.worst_s == pytest.approx(0.25)


def test_what_cannot_be_caught_up_is_dropped_and_counted():
    clock = Clock(0.0)
    works = iter([10.02, *[0.0] * 20])
    starts, report = run(clock, Deadlines(10, 0.0, catch_up=3), lambda: next(works), 6)
    assert starts == pytest.approx([0.0, 10.02, 10.02, 10.02, 10.1, 10.2])
    assert (report.run, report.late, report.dropped) == (6, 2, 97)


def test_a_machine_that_is_too_slow_still_steps():
    clock = Clock(0.0)
    _, report = run(clock, Deadlines(60, 0.0), lambda: 0.1, 100)
    assert report.dropped > 0
    assert report.run + report.dropped == pytest.approx(clock.now_s * 60, abs=37)  # a batch of six takes 0.6 s
