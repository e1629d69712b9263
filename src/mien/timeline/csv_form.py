"""A table of values as CSV, one row a frame: ``time_s`` or ``frame`` first, then a column for each parameter."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator

from mien.core import LoadError, ParameterTable, RangeError, UnknownNameError

from .layers import Layer
from .rates import Rate, exact_rate, time_of
from .specification import FILM_FPS
from .timeline import Timeline
from .track import LIMIT, Track

CLOCKS = ("time_s", "frame")
"""Names that the first column may have."""


def parse_csv(
    text: str, source: str = "table", *, fps: Rate = FILM_FPS, table: ParameterTable | None = None
) -> Timeline:
    """The timeline of a table: one layer, ``direct``, that replaces, straight lines from row to row.

    An empty cell is no key. The last row lasts as long as the one before it.

    Args:
        text: the CSV text, comma separated, with a heading.
        source: the file's name, for messages.
        fps: what a column ``frame`` counts in.
        table: when given, columns and values are checked against it.

    Raises:
        LoadError: an unknown or doubled column, a cell that is no number or out of range, times that do not rise;
            names the line.
    """
    lines = _rows(text, source)
    columns = [cell.strip() for cell in next(lines, (1, []))[1]]
    _check_heading(columns, source, table)
    clock, names, rate = columns[0], columns[1:], exact_rate(fps)
    times: list[float] = []
    keys: dict[str, tuple[list[float], list[float]]] = {name: ([], []) for name in names}
    for line, cells in lines:
        if not any(cell.strip() for cell in cells):
            continue
        if len(cells) != len(columns):
            raise LoadError(source, f"want {len(columns)} cells, got {len(cells)}", line=line)
        time = _cell(cells[0], clock, source, line)
        if clock == "frame":
            time = time_of(time, rate)
        if time < 0.0:
            raise LoadError(
                source, f"{clock} {cells[0].strip()} is before 0", line=line, hint="times are counted from 0"
            )
        if times and time <= times[-1]:
            raise LoadError(source, f"{clock} {cells[0].strip()} does not come after the row before", line=line)
        times.append(time)
        for name, cell in zip(names, cells[1:], strict=True):
            if cell.strip():
                keys[name][0].append(time)
                keys[name][1].append(_cell(cell, name, source, line, table))
    if not times:
        raise LoadError(source, "there is no row in it", hint="a heading alone moves nothing")
    step = times[-1] - times[-2] if len(times) > 1 else time_of(1.0, rate)
    tracks = {name: Track.from_keys(at, values, name=name) for name, (at, values) in keys.items() if at}
    made_for = float(rate) if clock == "frame" else None
    return Timeline((Layer("direct", "replace", tracks),), max(times[-1] + step, 0.0), fps=made_for)


def format_csv(timeline: Timeline, table: ParameterTable, fps: Rate) -> Iterator[str]:
    """Lines of the table of a timeline's values at a rate, with the rows that some track drives.

    Numbers are written so that they read back as the same numbers.

    Raises:
        UnknownNameError: a track's parameter is not in the table.
    """
    names = timeline.driven(table)
    columns = [table.index[name] for name in names]
    rate = exact_rate(fps)
    yield ",".join(("time_s", *names))
    for first, values, _ in timeline.chunks(table, fps):
        for row, numbers in enumerate(values[:, columns].tolist()):
            yield ",".join(repr(number) for number in (time_of(float(first + row), rate), *numbers))


def _rows(text: str, source: str) -> Iterator[tuple[int, list[str]]]:
    """Line number and cells of each row."""
    reader = csv.reader(text.removeprefix("\ufeff").splitlines(), strict=True)
    try:
        for cells in reader:
            yield reader.line_num, cells
    except csv.Error as error:
        raise LoadError(source, f"is no comma-separated table ({error})", line=reader.line_num) from None


def _check_heading(columns: list[str], source: str, table: ParameterTable | None) -> None:
    if not columns or columns[0] not in CLOCKS:
        got = f"{columns[0]!r}" if columns else "nothing"
        hint = "put commas between the columns" if columns and re.search("[;\t]", columns[0]) else ""
        raise LoadError(source, f"want 'time_s' or 'frame' as the first column, got {got}", line=1, hint=hint)
    for number, name in enumerate(columns):
        if not name:
            raise LoadError(source, f"column {number + 1} has no name", line=1)
        if name in columns[:number]:
            raise LoadError(source, f"column {name!r} is there twice", line=1, hint="leave one of them out")
    if table is None:
        return
    for name in columns[1:]:
        try:
            table.resolve(name)
        except UnknownNameError as error:
            raise LoadError(source, str(error), line=1) from None


def _cell(cell: str, name: str, source: str, line: int, table: ParameterTable | None = None) -> float:
    try:
        number = float(cell)
    except ValueError:
        raise LoadError(source, f"{name}: {cell.strip()!r} is not a number", line=line) from None
    if not math.isfinite(number) or abs(number) > LIMIT:
        raise LoadError(source, f"{name}: {cell.strip()} is not a finite number within ±{LIMIT:g}", line=line)
    if table is None:
        return number
    try:
        return min(table[row].check(number) for row in table.resolve(name))
    except RangeError as error:
        raise LoadError(source, str(error), line=line) from None
