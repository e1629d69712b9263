"""One connection to a live face, seen from a client and without a socket: answers, events, texts that are being said.

``Client`` and ``AsyncClient`` share it; they differ in how they wait.
"""

from __future__ import annotations

import json
import secrets
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from threading import Lock
from typing import Any, Generic, Protocol, TypeVar

from mien.core import MienError

from .messages import ends_speech

Answer = dict[str, Any]
Event = dict[str, Any]
Payload = Mapping[str, Any] | Sequence[Mapping[str, Any]]

MOST_EVENTS = 10_000
"""Events that wait for who asked for them; who does not read them loses the oldest."""

OVER: Answer = {"kind": "ok"}
"""In the place of the answer to what was not sent, because its text is over."""

CLOSED = "this client is closed — make a new one"

P = TypeVar("P", bound="Pending")


@dataclass(frozen=True)
class Said:
    """What became of a text.

    Attributes:
        id: of its events.
        broken_off: whether it is known that somebody let the face fall silent before its end.
    """

    id: str
    broken_off: bool = False


def new_id() -> str:
    """An id that nobody else has."""
    return secrets.token_hex(8)


class Pending(Protocol):
    """Something that will hold a result: a Future of threads, or one of asyncio."""

    def done(self) -> bool: ...  # noqa: D102
    def set_result(self, result: Any, /) -> None: ...  # noqa: D102


class Queue(Protocol):
    """A queue without an end, of threads or of asyncio."""

    def put_nowait(self, item: Any, /) -> None: ...  # noqa: D102
    def get_nowait(self) -> Any: ...  # noqa: D102
    def qsize(self) -> int: ...  # noqa: D102


class Talk(Generic[P]):
    """A text that is being said, as its client sees it.

    Args:
        end: gets a ``Said``, or a MienError, once it is over.
        identity: of the text, made up where none is given.
    """

    def __init__(self, end: P, identity: str | None) -> None:
        self.id = new_id() if identity is None else identity
        self.end = end

    @property
    def over(self) -> bool:
        """Whether it has ended, has been broken off or has failed."""
        return self.end.done()

    def hear(self, event: Event) -> None:
        """Take note of an event, of this text or another one."""
        if event.get("id") != self.id:
            return
        if event["event"] == "speech.failed" and not event.get("more"):
            self.finish(MienError(f"the text could not be said: {event.get('message')}"))
        elif event["event"] == "speech.ended" and event.get("broken_off"):
            self.finish(Said(self.id, broken_off=True))
        elif event["event"] == "speech.ended" and not event.get("more"):
            self.finish(Said(self.id))

    def finish(self, outcome: Said | MienError) -> None:
        """It is over; what comes later changes nothing."""
        if not self.end.done():
            self.end.set_result(outcome)


class Exchange:
    """One connection, seen from a client: answers go to who waits for them, in order; events to who listens."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._pending: deque[Pending] = deque()
        self._talks: list[Talk[Any]] = []
        self._queues: list[Queue] = []
        self._lost: Answer | None = None

    def expect(self, pending: Pending, message: Payload) -> None:
        """Let the next answer go there; called right before its message is sent."""
        with self._lock:
            if self._lost is not None:
                pending.set_result(self._lost)
                return
            self._pending.append(pending)
            if any(_breaks_off(each) for each in (message if isinstance(message, Sequence) else (message,))):
                # Nothing is heard of a text that had not been begun.
                for talk in self._talks:
                    talk.finish(Said(talk.id, broken_off=True))

    def begin(self, talk: Talk[Any]) -> None:
        """Let a text hear what becomes of it."""
        with self._lock:
            self._talks.append(talk)
            if self._lost is not None:
                talk.finish(MienError(self._lost["message"]))

    def end(self, talk: Talk[Any]) -> None:
        """Let it hear nothing any more."""
        with self._lock:
            self._talks.remove(talk)

    def listen(self, queue: Queue) -> None:
        """Put all events from now on there, and an error when the connection is lost."""
        with self._lock:
            self._queues.append(queue)
            if self._lost is not None:
                queue.put_nowait(self._lost)

    def leave(self, queue: Queue) -> None:
        """Put nothing there any more."""
        with self._lock:
            self._queues.remove(queue)

    def take(self, data: str | bytes) -> None:
        """Sort what has come; pictures and sound are passed over."""
        if isinstance(data, bytes):
            return
        try:
            value = json.loads(data)
        except (ValueError, RecursionError):
            value = None
        if isinstance(value, list) or (isinstance(value, dict) and value.get("kind") != "event"):
            with self._lock:
                pending = self._pending.popleft() if self._pending else None
                if pending is not None and not pending.done():
                    pending.set_result(value)
        elif isinstance(value, dict) and isinstance(value.get("event"), str):
            with self._lock:
                for talk in self._talks:
                    talk.hear(value)
                for queue in self._queues:
                    _put(queue, value)
        else:
            self.lose("what answers there is no live face of mien — give the link that 'mien live' printed")

    def lose(self, reason: str) -> None:
        """The connection is gone: whoever waits is told so, and whoever asks later."""
        with self._lock:
            if self._lost is not None:
                return
            self._lost = {"kind": "error", "message": reason}
            for pending in self._pending:
                if not pending.done():
                    pending.set_result(self._lost)
            for talk in self._talks:
                talk.finish(MienError(reason))
            for queue in self._queues:
                _put(queue, self._lost)


def _put(queue: Queue, value: Event) -> None:
    if queue.qsize() >= MOST_EVENTS:
        queue.get_nowait()
    queue.put_nowait(value)


def _breaks_off(message: Any) -> bool:
    return isinstance(message, Mapping) and ends_speech(message.get("kind"), message)


def read_event(event: Event) -> Event | None:
    """An event; None where there are no more, because the client was closed.

    Raises:
        MienError: the connection was lost.
    """
    if event["kind"] != "error":
        return event
    if event["message"] == CLOSED:
        return None
    raise MienError(event["message"])


def read_outcome(outcome: Said | MienError) -> Said:
    """What became of a text.

    Raises:
        MienError: it could not be said.
    """
    if isinstance(outcome, MienError):
        raise outcome
    return outcome
