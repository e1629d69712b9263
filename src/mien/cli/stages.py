"""What a person sees on standard error while work goes on: stages with their times, and how long it still takes."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from .streams import tell

LINE_EVERY_S = 10.0
"""Where there is no terminal to draw a bar on, a line as often as this."""


class Stages:
    """Tells of stages on standard error; says nothing when quiet."""

    def __init__(self, quiet: bool = False) -> None:
        self.quiet = quiet
        self.start_s = time.perf_counter()

    def say(self, text: str) -> None:
        """One line."""
        if not self.quiet:
            tell(text)

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """A stage without measurable progress; its line tells what it took."""
        start = time.perf_counter()
        yield
        self.say(f"{name}: {format_time(time.perf_counter() - start)}")

    @contextmanager
    def progress(self, name: str) -> Iterator[Callable[[int, int], None]]:
        """A stage that reports (done, total): a bar with the time left on a terminal, now and then a line elsewhere."""
        start = time.perf_counter()
        if self.quiet:
            yield _ignore
        elif sys.stderr.isatty():
            with _bar(name) as report:
                yield report
        else:
            yield _lines(name, self.say)
        self.say(f"{name}: {format_time(time.perf_counter() - start)}")

    @property
    def elapsed_s(self) -> float:
        """Since the beginning, seconds."""
        return time.perf_counter() - self.start_s


def _ignore(done: int, total: int) -> None:
    """Nothing."""


def _lines(name: str, say: Callable[[str], None]) -> Callable[[int, int], None]:
    start = last = time.perf_counter()

    def report(done: int, total: int) -> None:
        nonlocal last
        now = time.perf_counter()
        if now - last >= LINE_EVERY_S and done < total:
            last = now
            left = (now - start) * (total - done) / max(done, 1)
            say(f"{name}: {done} of {total}, {format_time(left)} left")

    return report


@contextmanager
def _bar(name: str) -> Iterator[Callable[[int, int], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(name, total=None)
        yield lambda done, total: progress.update(task, completed=done, total=total)


def format_time(length_s: float) -> str:
    """A length of time as people say it: 0.8 s, 8 s, 3 min 20 s, 1 h 5 min."""
    whole = round(length_s)
    if whole < 5:
        return f"{length_s:.1f} s"
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"
