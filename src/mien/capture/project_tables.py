"""Tables in CSV files that people edit: every fault of a file is told at once, each with its line."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from mien.core import LoadError, MienError, UnknownNameError
from mien.formats.cue_text import read_text

SHOWN = 8
"""Faults of a file that are told; the others are counted."""

SEPARATORS = {",": "commas", ";": "semicolons", "\t": "tabs"}
"""What stands between cells, by how often it stands in the first row; Excel writes what the country is used to."""

T = TypeVar("T")


@dataclass(frozen=True)
class Row:
    """A line of a table.

    Attributes:
        line: where it begins, from 1.
        cells: texts by column, without blanks around them; empty where a column is left out.
        comma: whether numbers may be written with a decimal comma, because the cells are not separated by it.
    """

    line: int
    cells: dict[str, str]
    comma: bool = False

    def text(self, column: str) -> str:
        """The text in a column.

        Raises:
            MienError: there is none.
        """
        if not self.cells[column]:
            raise MienError(f"column {column!r} is empty")
        return self.cells[column]

    def number(self, column: str, default: float | None = None) -> float:
        """The number in a column, or the default where nothing stands.

        Raises:
            MienError: it is no finite number, or there is none and no default.
        """
        text = self.cells[column]
        if not text and default is not None:
            return default
        text = self.text(column)
        try:
            value = float(text.replace(",", ".") if self.comma and text.count(",") == 1 else text)
        except ValueError:
            advice = " — a decimal comma? Write a point, 12.5" if "," in text else ""
            raise MienError(f"column {column!r}: want a number, got {text!r}{advice}") from None
        if not math.isfinite(value) or "_" in text:
            raise MienError(f"column {column!r}: want a finite number, got {text!r} — leave out lines without a place")
        return value


@dataclass
class Faults:
    """What is wrong with a file, gathered so that all of it is told at once."""

    path: Path
    found: list[tuple[int, str]] = field(default_factory=list)

    def add(self, line: int, message: str) -> None:
        """One more."""
        self.found.append((line, message))

    def check(self) -> None:
        """Nothing, where nothing is wrong.

        Raises:
            LoadError: something is; the first fault, and under it the others.
        """
        if not self.found:
            return
        (line, first), *others = sorted(self.found, key=lambda fault: fault[0])
        lines = [first, *(f"{self.path}:{number}: {text}" for number, text in others[: SHOWN - 1])]
        if len(others) >= SHOWN:
            lines.append(f"{self.path}: … and {len(others) - SHOWN + 1} more")
        raise LoadError(self.path, "\n".join(lines), line=line)


def read_table(
    path: Path, required: Sequence[str], optional: Sequence[str], read: Callable[[Row], T]
) -> list[tuple[int, T]]:
    """Lines of a table, each as ``read`` has it, with their numbers.

    The first row names the columns, in any order. Cells are separated by commas, or by semicolons or tabs if the first
    row is; then numbers may have a decimal comma. Rows without anything in them are left out.

    Raises:
        LoadError: the file cannot be read, or all that is wrong with it; ``read`` may raise for its line.
    """
    text = read_text(path)
    separator = _separator(text)
    rows = split_table(path, text)
    columns = _check_columns(path, *next(rows, (1, [])), required, optional)
    faults, found = Faults(path), []
    for line, cells in rows:
        try:
            found.append((line, read(_row(line, cells, columns, (*required, *optional), separator))))
        except MienError as error:
            faults.add(line, str(error))
    faults.check()
    return found


def _separator(text: str) -> str:
    return max(SEPARATORS, key=text.partition("\n")[0].count)


def split_table(path: Path, text: str) -> Iterator[tuple[int, list[str]]]:
    """Line where each row begins, and its cells, separated as in the first row; empty rows are left out.

    Raises:
        LoadError: the text is no CSV.
    """
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=_separator(text), strict=True, skipinitialspace=True)
    line = 1
    while True:
        try:
            cells = [cell.strip() for cell in next(reader)]
        except StopIteration:
            return
        except csv.Error as error:
            raise LoadError(path, f"is not CSV: {error}", line=line, hint='want "" for a quote within quotes') from None
        if any(cells):
            yield line, cells
        line = reader.line_num + 1


def _check_columns(
    path: Path, line: int, names: Sequence[str], required: Sequence[str], optional: Sequence[str]
) -> Sequence[str]:
    wanted = f"the first row names the columns: {','.join((*required, *optional))}"
    lowered = [name.lower() for name in names]
    missing = [name for name in required if name not in lowered]
    if len(missing) == len(required):
        raise LoadError(
            path, f"want a first row {','.join((*required, *optional))}, got {','.join(names)!r}", line=line
        )
    for name in lowered:
        if name and name not in (*required, *optional):
            raise LoadError(path, str(UnknownNameError("column", name, (*required, *optional))), line=line, hint=wanted)
        if name and lowered.count(name) > 1:
            raise LoadError(path, f"there are {lowered.count(name)} columns {name!r}", line=line)
    if missing:
        raise LoadError(path, f"there is no column {missing[0]!r}", line=line, hint=wanted)
    return lowered


def _row(line: int, cells: list[str], columns: Sequence[str], known: Sequence[str], separator: str) -> Row:
    while len(cells) > len(columns) and not cells[-1]:  # spreadsheets fill up
        cells = cells[:-1]
    if len(cells) > len(columns):
        advice = "decimal commas? Write points, 12.5, or separate cells by semicolons"
        hint = advice if separator == "," else "a text with separators in it is written in double quotes"
        raise MienError(f"want {len(columns)} cells separated by {SEPARATORS[separator]}, got {len(cells)} — {hint}")
    cells = cells + [""] * (len(columns) - len(cells))
    if any(cell and not column for column, cell in zip(columns, cells, strict=True)):
        raise MienError("there is something in a column without a name")
    values = dict.fromkeys(known, "") | {column: cell for column, cell in zip(columns, cells, strict=True) if column}
    return Row(line, values, comma=separator != ",")


def format_table(columns: Sequence[str], rows: Iterable[Sequence[str | float]]) -> str:
    """A table as CSV; numbers as short as they can be told."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([cell if isinstance(cell, str) else format_float(cell) for cell in row] for row in rows)
    return text.getvalue()


def format_float(value: float) -> str:
    """The shortest text that is read as the same number."""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))


def round_float(value: float, digits: int = 9) -> float:
    """The number with so many digits that count, so that files of one result do not differ in the last bits."""
    return float(f"{value:.{digits}g}") + 0.0
