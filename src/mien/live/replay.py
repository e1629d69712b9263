"""A logged session again: the identical frames, and a performance that can be written as a film."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

import numpy as np

from mien.core import Face, MienError
from mien.perform import Performance
from mien.timeline import Layer, Timeline, Track, exact_rate
from mien.timeline.rates import time_of

from .logs import Log
from .session import Frame, Session


def replay(log: Log, face: Face) -> Iterator[Frame]:
    """The frames of a log, bit by bit as they were.

    Args:
        log: of the session.
        face: the one that it names, or another of the same table.

    Raises:
        MienError: the face has another table, or refuses what was accepted then.
    """
    head = log.header
    if head.table != face.parameters.fingerprint:
        raise MienError(
            f"the log was made with {head.face!r} of the table {head.table}, and {face.name!r} has "
            f"{face.parameters.fingerprint} — another version of mien, or of the face"
        )
    pose = face.neutral.replace(head.pose)
    session = Session(face, head.loop_s, head.seed, pose=pose, idle=head.idle, motions=head.motions)
    commands = {loop: list(group) for loop, group in groupby(log.commands, key=lambda command: command[0])}
    for loop in range(log.loops):
        for _, message in commands.get(loop, ()):
            reply = session.handle(message)
            if reply["kind"] == "error":
                raise MienError(f"loop {loop}: {reply['message']}")
        yield session.step()


def perform_log(log: Log, face: Face) -> Performance:
    """The log as a performance: every row that moves, with a key at every loop.

    Raises:
        MienError: as ``replay``, or it has no loop.
    """
    values = np.array([frame.pose.values for frame in replay(log, face)])
    if not len(values):
        raise MienError("the log has no loop — there is nothing to show")
    rate, table = exact_rate(1.0 / log.header.loop_s), face.parameters
    times = time_of(np.arange(len(values), dtype=np.float64), rate)
    times.flags.writeable = False
    tracks = {
        row.name: Track.from_keys(times, values[:, number], name=row.name)
        for number, row in enumerate(table)
        if row.role != "scene" and np.any(values[:, number] != row.default)
    }
    length_s = time_of(float(len(values)), rate)
    return Performance(Timeline((Layer("direct", "replace", tracks),), length_s, fps=float(rate)), face)
