"""Logs of live sessions: JSON lines that give the identical frames again."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mien.core import LoadError, MienError, Sound
from mien.timeline.track import LIMIT

from .fields import read_list, read_number, show
from .messages import IDLE_PARTS, Message, check_message, parse_json
from .motions import Motion, read_motion
from .sounds import Sounds, parse_sound

FORMAT = "mien-live"
VERSION = 1

MOST_LOOPS = 100_000_000
LOOP_S = (1e-3, 10.0)
"""How long a loop can be, seconds."""


@dataclass(frozen=True)
class Header:
    """What a session began with: the first line of its log.

    Attributes:
        face: its address.
        table: fingerprint of its parameter table.
        seed: of all that chance decides.
        loop_s: length of a loop, seconds.
        idle: how much of each part of idle life.
        motions: those besides the standard ones.
        pose: values at rest that are not the face's own.
    """

    face: str
    table: str
    seed: int
    loop_s: float
    idle: Mapping[str, float]
    motions: tuple[Motion, ...] = ()
    pose: Mapping[str, float] = field(default_factory=dict)

    def line(self) -> str:
        """The line of the log."""
        return _line(
            {
                "format": FORMAT,
                "version": VERSION,
                "face": self.face,
                "table": self.table,
                "seed": self.seed,
                "loop_s": self.loop_s,
                "idle": dict(self.idle),
            }
            | ({"motions": [motion.to_json() for motion in self.motions]} if self.motions else {})
            | ({"pose": dict(self.pose)} if self.pose else {})
        )


@dataclass(frozen=True)
class Log:
    """A whole log.

    Attributes:
        header: what it began with.
        commands: before which loop each message came, in order.
        loops: how many there were.
        sounds: of utterances, by their numbers, as far as the session knew them.
    """

    header: Header
    commands: tuple[tuple[int, Message], ...]
    loops: int
    sounds: Mapping[int, Sound] = field(default_factory=dict)


def command_line(loop: int, message: Message) -> str:
    """The line of a message that came before a loop."""
    return _line({"loop": loop, "message": message.to_json()})


def end_line(loops: int) -> str:
    """The last line of a log."""
    return _line({"loops": loops})


def load_log(path: Path) -> Log:
    """The log in a file.

    Raises:
        LoadError: it cannot be read, or is no log.
    """
    try:
        with path.open(encoding="utf-8-sig") as file:
            return read_log(file, str(path))
    except OSError as error:
        raise LoadError(path, f"cannot be read ({error.strerror})") from error
    except UnicodeDecodeError:
        raise LoadError(path, "is no text in UTF-8", hint="is this the log of a live session?") from None


def read_log(lines: Iterable[str], place: str = "log") -> Log:
    """The log in lines of text. One without an end, of a session that was killed, ends with its last message.

    Raises:
        LoadError: it is no log; names the line.
    """
    header: Header | None = None
    commands: list[tuple[int, Message]] = []
    loops: int | None = None
    sounds = Sounds()
    for number, line in enumerate(lines, start=1):
        if not line.strip():
            continue
        try:
            value = _object(parse_json(line))
            if header is None:
                header = _header(value)
            elif loops is not None:
                raise MienError("comes after the end")
            elif "loops" in value:
                loops = _whole("loops", value["loops"])
            elif "sound" in value:
                sounds.add(_whole("sound", value["sound"]), parse_sound(value))
            else:
                commands.append((_whole("loop", value.get("loop")), check_message(value.get("message"))))
        except MienError as error:
            raise LoadError(place, str(error), line=number) from None
        if len(commands) > 1 and commands[-1][0] < commands[-2][0]:
            raise LoadError(place, f"loop {commands[-1][0]} comes after loop {commands[-2][0]}", line=number)
    if header is None:
        raise LoadError(place, "is empty", hint="a log begins with face, seed and loop length")
    return Log(header, tuple(commands), loops if loops is not None else _last(commands), sounds.finish())


def _last(commands: list[tuple[int, Message]]) -> int:
    return commands[-1][0] + 1 if commands else 0


def _header(value: dict[str, Any]) -> Header:
    if value.get("format") != FORMAT or value.get("version") != VERSION:
        raise MienError(f"want 'format': '{FORMAT}', 'version': {VERSION} — is this the log of a live session?")
    face, table, idle = value.get("face"), value.get("table"), value.get("idle", {})
    if not isinstance(face, str) or not isinstance(table, str):
        raise MienError("want 'face' and 'table' as texts")
    amounts = {part: read_number(f"idle: {part}", amount, 0.0, 1.0) for part, amount in _object(idle).items()}
    for part in amounts:
        if part not in IDLE_PARTS:
            raise MienError(f"idle: {show(part)} is none of {', '.join(IDLE_PARTS)}")
    seed = value.get("seed")
    if isinstance(seed, bool) or not isinstance(seed, int):
        raise MienError(f"seed: want a whole number, got {show(seed)}")
    motions = tuple(read_motion(motion) for motion in read_list("motions", value.get("motions", []), 1000))
    loop_s = read_number("loop_s", value.get("loop_s"), *LOOP_S, "s")
    pose = {
        name: read_number(f"pose: {name}", given, -LIMIT, LIMIT)
        for name, given in _object(value.get("pose", {})).items()
    }
    return Header(face, table, seed, loop_s, amounts, motions, pose)


def _object(value: object) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise MienError(f"want an object, got {show(value)}")
    return value


def _whole(place: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= MOST_LOOPS:
        raise MienError(f"{place}: want a whole number from 0 to {MOST_LOOPS}, got {show(value)}")
    return value


def _line(value: Mapping[str, Any]) -> str:
    return json.dumps(value, separators=(", ", ": "))
