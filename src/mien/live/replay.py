"""A logged session again: the identical frames, and a performance that can be written as a film."""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from itertools import groupby

import numpy as np

from mien.core import Cue, Face, MienError
from mien.perform import Performance
from mien.timeline import Layer, Timeline, Track, exact_rate
from mien.timeline.rates import time_of

from .logs import Log
from .session import Frame, Session
from .slices import Floats
from .sounds import join_sounds


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
    """The log as a performance: every row that moves, with a key at every loop, and what was said, with its sound.

    Raises:
        MienError: as ``replay``, or it has no loop.
    """
    table = face.parameters
    columns: dict[int, array[float]] = {}
    said = _Said(log)
    for frame in replay(log, face):
        values = frame.pose.values
        for row in np.flatnonzero(values != table.defaults).tolist():
            if row not in columns:  # most rows never move, and a session may last for hours
                columns[row] = array("d", [table.defaults[row]]) * frame.loop
        for row, column in columns.items():
            column.append(values[row])
        said.hear(frame)
    if not log.loops:
        raise MienError("the log has no loop — there is nothing to show")
    rate = exact_rate(1.0 / log.header.loop_s)
    times = time_of(np.arange(log.loops, dtype=np.float64), rate)
    times.flags.writeable = False
    tracks = {
        table.rows[row].name: Track.from_keys(times, _read_only(columns[row]), name=table.rows[row].name)
        for row in sorted(columns)
        if table.rows[row].role != "scene"
    }
    length_s = time_of(float(log.loops), rate)
    words, phones = said.cues("words"), said.cues("phones")
    layer = Layer("direct", "replace", tracks)
    timeline = Timeline((layer,), length_s, fps=float(rate), words=words, phones=phones, text=said.text)
    return Performance(timeline, face, join_sounds(log.sounds, said.spans_s, length_s))


class _Said:
    """What is heard of the texts of a log: when each began, and when it broke off."""

    def __init__(self, log: Log) -> None:
        self._messages = [message for _, message in log.commands if message.kind == "say"]
        self._rate = exact_rate(1.0 / log.header.loop_s)
        self._began: dict[int, float] = {}
        self._broke_off: dict[int, float] = {}
        self._length_s = time_of(float(log.loops), self._rate)

    def hear(self, frame: Frame) -> None:
        """Take note of the events of a frame."""
        now_s = time_of(float(frame.loop), self._rate)
        for event in frame.events:
            if event["event"] == "speech.started":
                self._began[event["speech"]] = now_s
            elif event["event"] == "speech.ended" and event["broken_off"]:
                self._broke_off[event["speech"]] = now_s

    @property
    def spans_s(self) -> dict[int, tuple[float, float]]:
        """From when to when each text that was begun could be heard."""
        ends_s = [*self._began.values(), self._length_s][1:]
        return {
            number: (began_s, min(self._broke_off.get(number, end_s), end_s))
            for (number, began_s), end_s in zip(self._began.items(), ends_s, strict=True)
        }

    @property
    def text(self) -> str:
        """All that was begun."""
        return " ".join(self._messages[number]["text"].strip() for number in self._began)

    def cues(self, field: str) -> tuple[Cue, ...]:
        """The words or the phones that were heard, on the clock of the session."""
        found: list[Cue] = []
        for number, (began_s, until_s) in self.spans_s.items():
            for start_s, end_s, symbol in self._messages[number][field] or ():
                if began_s + start_s < until_s:
                    found.append(Cue(began_s + start_s, min(began_s + end_s, until_s), symbol))
        return tuple(found)


def _read_only(values: array[float]) -> Floats:
    """The same numbers, not copied."""
    found: Floats = np.frombuffer(values)
    found.flags.writeable = False
    return found
