"""What can be asked of a live face: the messages, and how answers are read."""

from __future__ import annotations

import base64
import json
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, Generic, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike

from mien.core import MienError

from .exchange import Answer, Payload

SUBSCRIBE: Answer = {"kind": "subscribe", "events": True}
T = TypeVar("T")
L = TypeVar("L")


def say_message(text: str, identity: str, *, more: bool = False) -> Answer:
    """The message that says a text, or some of it."""
    return {"kind": "say", "text": text, "id": identity} | ({"more": True} if more else {})


def encode(value: Payload) -> str:
    """Messages as JSON; numbers of NumPy are numbers.

    Raises:
        MienError: something in them has no place in JSON.
    """
    try:
        return json.dumps(value, allow_nan=False, default=_plain)
    except (TypeError, ValueError) as error:
        raise MienError(f"this cannot be sent as a message: {error}") from None


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is nothing that JSON knows")


def read_answer(answer: Any) -> Any:
    """An answer, or a list of them.

    Raises:
        MienError: a message was refused; the server's text, and which message of a list.
    """
    if isinstance(answer, list):
        refused = [(number, each) for number, each in enumerate(answer) if each.get("kind") == "error"]
        if refused:
            number, first = refused[0]
            raise MienError(f"{len(refused)} of {len(answer)} messages were refused; message {number}: {_text(first)}")
    elif answer.get("kind") == "error":
        raise MienError(_text(answer))
    return answer


def _text(answer: Answer) -> str:
    return str(answer.get("message", "the message was refused"))


def pcm_message(samples: ArrayLike, rate_hz: int) -> Answer:
    """The message with some sound.

    Args:
        samples: (N,) mono, int16, or floating from -1 to 1; at most a second of them.
        rate_hz: samples a second.

    Raises:
        MienError: the samples are of another shape or type, or too many.
    """
    values = np.asarray(samples)
    if values.ndim != 1 or not (values.dtype == np.int16 or np.issubdtype(values.dtype, np.floating)):
        raise MienError(
            f"hear: want a row of int16, or of floats from -1 to 1, got {values.dtype} of shape {values.shape} — "
            "of several channels give one, as in samples[:, 0]"
        )
    if len(values) > rate_hz:
        raise MienError(f"hear: {len(values)} samples at {rate_hz} Hz are more than a second — give them bit by bit")
    if values.dtype != np.int16:
        values = np.rint(np.clip(np.nan_to_num(values), -1.0, 1.0) * 32767.0)
    data = base64.b64encode(values.astype("<i2").tobytes()).decode("ascii")
    return {"kind": "speech.pcm", "rate_hz": rate_hz, "data": data}


class Calls(ABC, Generic[T, L]):
    """What can be asked of a live face.

    Every call sends one message and gives its answer; a message that the face refuses raises MienError with the text
    that it answered. With ``AsyncClient`` every call is awaited.
    """

    @abstractmethod
    def _ask(self, message: Payload, part: str | None = None) -> Any:
        """The answer to a message, or a part of it."""

    @abstractmethod
    def _fetch(self, path: str) -> Any:
        """What the server tells at an address, JSON."""

    @overload
    def send(self, message: Mapping[str, Any]) -> T: ...
    @overload
    def send(self, message: Sequence[Mapping[str, Any]]) -> L: ...
    def send(self, message: Payload) -> T | L:
        """The answer to any message of docs/messages.md, or the answers to a list of up to 100.

        Of a list all messages are carried out that are right, even if it raises because of another one.
        """
        return self._ask(message)

    def move(
        self,
        values: Mapping[str, float] | None = None,
        /,
        *,
        over_ms: float = 0,
        change: str = "linear",
        layer: str = "direct",
        **codes: float,
    ) -> T:
        """Move motors to values: ``move({"jaw.rotation": 8}, over_ms=300)`` or ``move(ELU=0.2, over_ms=500)``.

        Args:
            values: by the name of a parameter or motor code; in the layers speech and gaze of a channel.
            over_ms: how long it takes.
            change: how it gets there: linear, cosine, ease-in, ease-out.
            layer: which one moves: direct, expression, gaze, speech.
            codes: values by names that Python can write.
        """
        moved = {**(values or {}), **codes}
        return self._ask({"kind": "move", "values": moved, "over_ms": over_ms, "change": change, "layer": layer})

    def play(self, motion: str, *, strength: float = 1, speed: float = 1, hold: bool = False) -> T:
        """Play a motion, such as smile or nod.

        Args:
            motion: its name; ``about()["motions"]`` has all.
            strength: how much of it, 0 to 1.
            speed: how many times as fast, 0.1 to 10.
            hold: stay where it is before it would go back to rest.
        """
        return self._ask({"kind": "play", "motion": motion, "strength": strength, "speed": speed, "hold": hold})

    def look(self, at: Sequence[float] | str, *, head: float = 1) -> T:
        """Look at a point, in a direction or at a target: eyes first, the head follows.

        Args:
            at: x, y, z in metres from the middle of the head (its own left, up, forward); or left, right (as one sees
                the picture), up, down, viewer, away; or the name of a target.
            head: how much of what is usual the head does, 0 to 1.
        """
        return self._ask({"kind": "look", "at": at if isinstance(at, str) else list(at), "head": head})

    def target(self, name: str, at: Sequence[float]) -> T:
        """Tell where something is that can be looked at by its name; eyes that look at it follow it.

        Args:
            name: what it is called.
            at: x, y, z in metres from the middle of the head.
        """
        return self._ask({"kind": "target", "name": name, "at": list(at)})

    def stop(self, layer: str | None = None, *, over_ms: float = 300) -> T:
        """Stop a layer (direct, expression, gaze, speech, idle), or all but idle; it goes back to rest.

        Args:
            layer: which.
            over_ms: how long that takes.
        """
        which = {} if layer is None else {"layer": layer}
        return self._ask({"kind": "stop", **which, "over_ms": over_ms})

    def interrupt(self) -> T:
        """Fall silent: the mouth is shut within 100 ms, and what was still to be said is dropped."""
        return self._ask({"kind": "interrupt"})

    def reset(self, *, over_ms: float = 300) -> T:
        """Let go of everything, in all layers.

        Args:
            over_ms: how long it takes.
        """
        return self._ask({"kind": "reset", "over_ms": over_ms})

    def state(self, *names: str) -> T:
        """Values of the face as they are now, by name; of all that moves, if no names are given."""
        return self._ask({"kind": "state"} | ({"names": list(names)} if names else {}), "values")

    def idle(self, **parts: float) -> T:
        """Switch what the face does by itself: ``idle(blinks=0, sway=0.5)``; 0 is off and 1 as usual.

        Args:
            parts: of blinks, saccades, breathing, sway.
        """
        return self._ask({"kind": "idle", **parts})

    def hear(self, samples: ArrayLike, rate_hz: int) -> T:
        """Let the mouth move with a live voice: a little more of its sound, a few times a second.

        Args:
            samples: (N,) mono, int16, or floating from -1 to 1; at most a second of them.
            rate_hz: samples a second, 8000 to 96000.
        """
        return self._ask(pcm_message(samples, rate_hz))

    def about(self) -> T:
        """What the server tells of itself: face, rate, how its loops keep time, who is connected, motions."""
        return self._fetch("/about")
