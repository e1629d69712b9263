"""Messages as lines of text, for netcat and robots: ``MOVE ELU 0.2 500``, ``SAY Hello there``, ``ELU 0.2 500``."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from mien.core import MienError, UnknownNameError

from .fields import show
from .messages import parse_json

LONGEST_LINE = 12_000
"""Bytes."""

Fields = dict[str, Any]


def parse_line(data: bytes) -> Fields | None:
    """The message, not yet checked, in a line; None in an empty one.

    The first word is a kind, in whatever case; a line that begins with another word is a move. A line that begins with
    ``{`` is JSON.

    Raises:
        MienError: it is no UTF-8, too long, or not of one of the forms.
    """
    if len(data) > LONGEST_LINE:
        raise MienError(f"the line has {len(data)} bytes — at most {LONGEST_LINE} are read")
    try:
        text = data.decode("utf-8").strip()
    except UnicodeDecodeError as error:
        raise MienError(f"the line is no UTF-8 (byte {error.start})") from None
    if not text:
        return None
    if text.startswith("{"):
        return _json(data)
    first, _, rest = text.partition(" ")
    verb = first.lower()
    if verb in FORMS:
        return {"kind": verb} | FORMS[verb](rest.strip())
    words = text.split()
    if len(words) == 1:
        raise UnknownNameError("command", first[:100], [*(kind.upper() for kind in FORMS)])
    return {"kind": "move"} | _move(text)


def _json(data: bytes) -> Fields:
    value = parse_json(data)
    if not isinstance(value, dict):
        raise MienError(f"want an object, got {show(value)}")
    return value


def _move(rest: str) -> Fields:
    words = rest.split()
    if len(words) not in (2, 3):
        raise MienError(f"MOVE {show(rest)}: want NAME VALUE and perhaps MS, as in MOVE ELU 0.2 500")
    over = {"over_ms": _number(words[2])} if len(words) == 3 else {}
    return {"values": {words[0]: _number(words[1])}, **over}


def _play(rest: str) -> Fields:
    words = rest.split()
    if len(words) not in (1, 2):
        raise MienError(f"PLAY {show(rest)}: want MOTION and perhaps how much of it, as in PLAY smile 0.8")
    return {"motion": words[0]} | ({"strength": _number(words[1])} if len(words) == 2 else {})


def _look(rest: str) -> Fields:
    words = rest.split()
    if len(words) == 3:
        return {"at": [_number(word) for word in words]}
    if len(words) != 1:
        raise MienError(f"LOOK {show(rest)}: want X Y Z in metres, a direction or a target, as in LOOK 0.1 0 0.5")
    return {"at": words[0]}


def _target(rest: str) -> Fields:
    words = rest.split()
    if len(words) != 4:
        raise MienError(f"TARGET {show(rest)}: want NAME X Y Z in metres, as in TARGET cup 0.1 0 0.5")
    return {"name": words[0], "at": [_number(word) for word in words[1:]]}


def _stop(rest: str) -> Fields:
    return {"layer": rest} if rest else {}


def _state(rest: str) -> Fields:
    return {"names": rest.split()} if rest else {}


def _idle(rest: str) -> Fields:
    words = rest.split()
    if len(words) != 2:
        raise MienError(f"IDLE {show(rest)}: want PART and how much of it, as in IDLE blinks 0")
    return {words[0]: _number(words[1])}


def _subscribe(rest: str) -> Fields:
    return dict.fromkeys(rest.split(), True)


def _alone(rest: str) -> Fields:
    if rest:
        raise MienError(f"{show(rest)}: nothing is wanted behind this command")
    return {}


FORMS: Mapping[str, Callable[[str], Fields]] = MappingProxyType(
    {
        "move": _move,
        "play": _play,
        "say": lambda rest: {"text": rest},
        "look": _look,
        "target": _target,
        "stop": _stop,
        "interrupt": _alone,
        "reset": _alone,
        "state": _state,
        "idle": _idle,
        "subscribe": _subscribe,
    }
)
"""What stands behind each kind; the others about a connection are JSON only."""


def format_reply(reply: Mapping[str, Any]) -> bytes:
    """An answer as a line: JSON, since programs read it."""
    return json.dumps(reply).encode("ascii") + b"\n"


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        raise MienError(f"want a number, got {show(word)}") from None
