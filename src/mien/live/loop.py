"""When loops are due: absolute deadlines, so that an hour of them drifts by nothing."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from mien.timeline import Rate, exact_rate
from mien.timeline.rates import time_of

CATCH_UP = 6
"""Loops that may run at once after a delay: at 60 Hz a tenth of a second, in which no face is seen to jump; our choice.
"""


@dataclass(frozen=True)
class Report:
    """What became of the loops so far.

    Attributes:
        run: loops that were run.
        late: those of them that began a whole loop or more after they were due.
        dropped: deadlines that were passed over because more than ``CATCH_UP`` loops were due at once.
        worst_s: greatest delay of a loop, seconds.
    """

    run: int = 0
    late: int = 0
    dropped: int = 0
    worst_s: float = 0.0


class Deadlines:
    """Deadlines of loops at a rate: loop k is due at ``start + k / rate``, whatever the ones before took.

    Loops that are late are run at once, one after the other, so that durations stay as they were asked for. Where more
    than ``catch_up`` are due at once (the machine slept, or is too slow) the oldest deadlines are dropped: the face
    goes on from where it is, later, instead of racing through what it has missed.

    Source: Thórisson 1996, A1.2.4, has a constant loop; the pause of his outline lets it drift (errata).
    """

    def __init__(self, rate: Rate, start_s: float, catch_up: int = CATCH_UP) -> None:
        self.rate: Fraction = exact_rate(rate)
        self.start_s = start_s
        self.catch_up = max(1, catch_up)
        self.report = Report()
        self._next = 0

    @property
    def due_s(self) -> float:
        """When the next loop is due, on the clock of ``start_s``."""
        return self.start_s + time_of(float(self._next), self.rate)

    def take(self, now_s: float) -> int:
        """How many loops are to be run now, 0 to ``catch_up``; they are counted as run."""
        # The estimate may be off by one where a deadline is rounded; the deadline itself decides.
        last = math.floor((now_s - self.start_s) * float(self.rate)) + 1
        while self.start_s + time_of(float(last), self.rate) > now_s:
            last -= 1
        due = last + 1 - self._next
        if due <= 0:
            return 0
        delay = now_s - self.due_s
        run = min(due, self.catch_up)
        old = self.report
        self.report = Report(old.run + run, old.late + run - 1, old.dropped + due - run, max(old.worst_s, delay))
        self._next += due
        return run


def run_loops(
    step: Callable[[], object],
    deadlines: Deadlines,
    *,
    now: Callable[[], float],
    sleep: Callable[[float], object],
    going: Callable[[], bool],
) -> Report:
    """Run a step at each deadline until ``going`` says no; what became of the loops.

    Args:
        step: one loop.
        deadlines: of the loops.
        now: the clock, seconds; never goes back.
        sleep: waits so many seconds, or a little longer or shorter.
        going: asked before each loop.
    """
    while going():
        due = deadlines.take(now())
        if not due:
            sleep(max(0.0, deadlines.due_s - now()))
        for _ in range(due):
            step()
            if not going():
                break
    return deadlines.report
