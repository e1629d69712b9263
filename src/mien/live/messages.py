"""What a live face understands: one table of kinds of messages; checks, JSON Schema and docs are made from it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NoReturn

from mien.core import MienError, UnknownNameError
from mien.gaze import look_directions
from mien.timeline import CHANGES
from mien.timeline.track import LIMIT

from .fields import LONGEST_NAME, Field, describe, read_list, read_text, show

LAYERS = ("idle", "gaze", "expression", "speech", "direct")
"""Layers of a live face, lowest first: those of a performance."""

IDLE_PARTS = ("blinks", "saccades", "breathing", "sway")
"""What a face does by itself; each can be switched."""

MOST_MESSAGES = 100
"""In one batch."""

LONGEST_MS = 600_000.0
LONGEST_TEXT = 10_000
MOST_PHONES = 10_000
REACH_M = (-1000.0, 1000.0)
"""How far something can be that is looked at, along each axis."""
LONGEST_PCM = 400_000
"""Characters: more than a second at the highest rate."""

PCM_HZ = (8_000, 96_000)
MOST_REPORTED = 1e9


@dataclass(frozen=True)
class Kind:
    """A kind of message.

    Attributes:
        name: its ``kind`` in JSON.
        doc: what it does.
        fields: besides ``kind`` and ``id``.
        connection: whether it is about the connection that it comes on; a session alone does not know it.
    """

    name: str
    doc: str
    fields: tuple[Field, ...] = ()
    connection: bool = False


@dataclass(frozen=True)
class Message:
    """A message that has been checked: every field is there, with its default where none was given."""

    kind: str
    fields: Mapping[str, Any]
    id: str | None = None

    def __getitem__(self, name: str) -> Any:
        return self.fields[name]

    @property
    def ends_speech(self) -> bool:
        """Whether nothing that was to be said before is said after it."""
        return ends_speech(self.kind, self.fields)

    def to_json(self) -> dict[str, Any]:
        """The message as JSON has it, with all of its fields that hold something."""
        found: dict[str, Any] = {"kind": self.kind} | ({} if self.id is None else {"id": self.id})
        return found | {name: _plain(value) for name, value in self.fields.items() if value is not None}


def ends_speech(kind: object, fields: Mapping[str, Any]) -> bool:
    """Whether nothing that was to be said before is said after a message, checked or not."""
    return kind in ("interrupt", "reset") or (kind == "stop" and fields.get("layer") in (None, "speech"))


def _over(default_ms: float, doc: str) -> Field:
    return Field("over_ms", "number", doc, 0, LONGEST_MS, "ms", default_ms)


_CHANGE = Field("change", "choice", "How it gets there.", default="linear", choices=tuple(CHANGES))

KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        kind.name: kind
        for kind in (
            Kind(
                "move",
                "Moves motors to values, each independently of all others. A new command for a motor takes the place "
                "of what was still to come of the one before.",
                (
                    Field(
                        "values",
                        "values",
                        "Value by name: a parameter or motor code of the face; in the layers `speech` and `gaze` a "
                        "channel. Codes go from 0 to 1 between the limits of their motor, pupils and head in degrees.",
                        -LIMIT,
                        LIMIT,
                        required=True,
                    ),
                    _over(0, "How long it takes."),
                    _CHANGE,
                    Field("layer", "choice", "Which layer moves.", default="direct", choices=LAYERS[1:]),
                ),
            ),
            Kind(
                "play",
                "Plays a motion.",
                (
                    Field("motion", "text", "Its name.", 1, LONGEST_NAME, required=True),
                    Field("strength", "number", "How much of it.", 0, 1, default=1),
                    Field("speed", "number", "How many times as fast.", 0.1, 10, default=1),
                    Field("hold", "flag", "Stay where it is before it would go back to rest.", default=False),
                ),
            ),
            Kind(
                "say",
                "Says a text, after all that is being said.",
                (
                    Field("text", "text", "What to say.", 0, LONGEST_TEXT, required=True),
                    Field(
                        "phones",
                        "cues",
                        "When which ARPABET phone is said. Given with a sound of one's own; without them the voice of "
                        "the session speaks.",
                        1,
                        MOST_PHONES,
                    ),
                    Field("words", "cues", "When which word is said.", 0, MOST_PHONES),
                    Field(
                        "more",
                        "flag",
                        "More of this text follows under the same `id`: sentences are said as they complete.",
                        default=False,
                    ),
                ),
            ),
            Kind(
                "look",
                "Looks at a point, x to the face's own left, y up, z forward from the middle of the head, in a "
                "direction, or at a target: eyes first, the head follows. `left` and `right` are those of who "
                "sees the picture; `viewer` is where a face looks by itself.",
                (
                    Field(
                        "at",
                        "place",
                        f"Where: a point, one of {', '.join(f'`{name}`' for name in look_directions())}, or the name "
                        "of a target.",
                        *REACH_M,
                        "m",
                        required=True,
                    ),
                    Field("head", "number", "How much of what is usual the head does.", 0, 1, default=1),
                ),
            ),
            Kind(
                "target",
                "Tells where something is that can be looked at by its name. Eyes that look at it follow it at once, "
                "the head more slowly. A session knows its targets until it ends.",
                (
                    Field("name", "text", "What it is called; not as a direction is.", 1, LONGEST_NAME, required=True),
                    Field("at", "point", "Where it is now, from the middle of the head.", *REACH_M, "m", required=True),
                ),
            ),
            Kind(
                "stop",
                "Stops a layer, or all but `idle`, and lets it go back to rest.",
                (
                    Field("layer", "choice", "Which layer.", choices=LAYERS),
                    _over(300, "How long it takes to go back."),
                    Field("names", "names", "Of the layer `direct` these parameters or motor codes only."),
                ),
            ),
            Kind(
                "interrupt",
                "Falls silent: the mouth is at rest within 100 ms, whatever moved or held it, and what was still to be "
                "said is dropped. Who goes on moving it, as a live voice does, opens it again.",
            ),
            Kind("reset", "Lets go of everything, in all layers.", (_over(300, "How long it takes."),)),
            Kind(
                "state",
                "Tells the values of the face as they are now.",
                (Field("names", "names", "Parameters or motor codes; all that move, if none are named."),),
            ),
            Kind(
                "idle",
                "Switches what the face does by itself: 0 is off and 1 as usual.",
                tuple(Field(part, "number", f"How much of the {part}.", 0, 1) for part in IDLE_PARTS),
            ),
            Kind(
                "subscribe",
                "Asks for what comes without a question: of what is not named, things stay as they are.",
                (
                    Field("events", "flag", "Speech that starts, words, speech that ends or fails."),
                    Field("frames", "flag", "Pictures, binary; on a WebSocket."),
                    Field("sound", "flag", "What is said, binary; on a WebSocket."),
                ),
                connection=True,
            ),
            Kind(
                "speech.pcm",
                "A live voice: the mouth moves with it. On a WebSocket also as binary messages.",
                (
                    Field("rate_hz", "number", "Samples a second.", *PCM_HZ, unit="Hz", required=True),
                    Field(
                        "data", "text", "Base64 of 16-bit samples, low byte first, mono.", 0, LONGEST_PCM, required=True
                    ),
                ),
                connection=True,
            ),
            Kind(
                "report",
                "What a page has measured; `GET /about` tells it.",
                (
                    Field("drawn_fps", "number", "Pictures drawn a second.", 0, MOST_REPORTED, default=0),
                    Field(
                        "offset_p50_ms",
                        "number",
                        "Audio clock at a drawn picture minus the picture's time, half of them.",
                        -MOST_REPORTED,
                        MOST_REPORTED,
                        "ms",
                    ),
                    Field(
                        "offset_p95_ms",
                        "number",
                        "Its size, which 95 % of the pictures stay under.",
                        0,
                        MOST_REPORTED,
                        "ms",
                    ),
                    Field("sound", "choice", "Whether it can be heard.", choices=("off", "blocked", "on")),
                ),
                connection=True,
            ),
        )
    }
)
"""Kinds of messages by name."""

ID = Field("id", "text", "Comes back in the answer and in events about it.", 0, LONGEST_NAME)


def check_message(value: object) -> Message:
    """The message in any JSON value.

    Raises:
        MienError: it is no message; names the field, what was wanted and what came.
    """
    if not isinstance(value, dict):
        raise MienError(f"want an object with a 'kind', got {show(value)}")
    if "kind" not in value:
        raise MienError(f"a message has no 'kind' — there is {', '.join(KINDS)}")
    name = read_text("kind", value["kind"], 1, LONGEST_NAME)
    if name not in KINDS:
        raise UnknownNameError("kind of message", name, KINDS)
    kind = KINDS[name]
    known = {field.name for field in kind.fields} | {"kind", ID.name}
    for key in value:
        if key not in known:
            raise UnknownNameError(f"field of {name!r}:", str(key)[:LONGEST_NAME], sorted(known))
    identity = None if value.get("id") is None else ID.check(value["id"])
    return Message(name, MappingProxyType({field.name: _read(field, value, name) for field in kind.fields}), identity)


def _read(field: Field, value: Mapping[str, object], kind: str) -> Any:
    given = value.get(field.name)
    if given is None:
        if field.required:
            raise MienError(f"{kind}: {field.name!r} is missing — {field.doc}")
        return field.default
    try:
        return field.check(given)
    except MienError as error:
        raise type(error)(f"{kind}: {error}") if type(error) is not UnknownNameError else error from None


def parse_json(data: bytes | str) -> object:
    """Any JSON value; NaN and infinities are none.

    Raises:
        MienError: it is no JSON, no UTF-8 or nested too deeply.
    """
    try:
        return json.loads(data, parse_constant=_refuse)
    except RecursionError:
        raise MienError("is nested too deeply to be a message") from None
    except ValueError as error:
        raise MienError(f"is no JSON ({str(error)[:100]})") from None


def parse_batch(data: bytes | str) -> list[object]:
    """The messages, not yet checked, in a JSON value: itself, or those of a list.

    Raises:
        MienError: it is no JSON, or too many.
    """
    value = parse_json(data)
    return read_list("batch", value, MOST_MESSAGES) if isinstance(value, list) else [value]


def refusal(error: MienError, value: object = None) -> dict[str, Any]:
    """The answer to a message that was refused."""
    identity = value.get("id") if isinstance(value, dict) else None
    known = {"id": identity} if isinstance(identity, str) and len(identity) <= LONGEST_NAME else {}
    return {"kind": "error", **known, "message": str(error)}


def json_schema() -> dict[str, Any]:
    """JSON Schema of all messages, draft 2020-12."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Messages to a live face of mien",
        "oneOf": [
            {
                "type": "object",
                "description": kind.doc,
                "properties": {"kind": {"const": kind.name}, ID.name: ID.schema()}
                | {field.name: field.schema() for field in kind.fields},
                "required": ["kind", *(field.name for field in kind.fields if field.required)],
                "additionalProperties": False,
            }
            for kind in KINDS.values()
        ],
    }


def markdown() -> str:
    """The table of messages as people read it."""
    lines = [f"Every message may have an `id` ({ID.doc[0].lower()}{ID.doc[1:]})"]
    for kind in KINDS.values():
        lines += ["", f"### {kind.name}", kind.doc, *(["", *describe(kind.fields)] if kind.fields else [])]
    return "\n".join(lines) + "\n"


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no number")


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, tuple):
        return [_plain(each) for each in value]
    return value
