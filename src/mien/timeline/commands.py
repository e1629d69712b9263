"""Parke's command list: for each frame, in order, the parameters that some specification covers, with their values.

Source: Parke 1974, section 4.1: the output of his sequencing program and the input of the model.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from mien.core import ParameterTable

from .rates import Rate
from .specification import Specifications
from .timeline import Timeline

Command = tuple[int, list[tuple[str, float]]]
"""A frame's number, and name and value of each parameter that is set in it, in the table's order."""


def command_list(timeline: Timeline | Specifications, table: ParameterTable, fps: Rate) -> Iterator[Command]:
    """The commands of each frame, in order; a frame that nothing covers has an empty list.

    A held value is no command: the model keeps it.

    Raises:
        LoadError: a specification does not fit the table.
        UnknownNameError: a track's parameter is not in the table.
    """
    if isinstance(timeline, Specifications):
        timeline = timeline.to_timeline(table)
    for first, values, covered in timeline.chunks(table, fps):
        for row in range(len(values)):
            columns = np.flatnonzero(covered[row])
            yield first + row, [(table.names[column], float(values[row, column])) for column in columns]


def format_commands(commands: Iterable[Command]) -> Iterator[str]:
    """Lines of text, ``frame  parameter  value``, one a command; frames without commands have none."""
    for frame, settings in commands:
        for name, value in settings:
            yield f"{frame:6d}  {name:<28}  {value:.6g}"
