"""A session that runs: its loops at their deadlines, its clients, its voice and its ears. All in one asyncio thread.

Source: Thórisson 1996, A1.2.4 (a constant loop, commands from a socket).
"""

from __future__ import annotations

import asyncio
import base64
import binascii
import json
from collections import deque
from collections.abc import Awaitable, Callable, Iterable, Mapping
from time import perf_counter
from typing import Any, Protocol

import numpy as np

from mien.core import MienError, Sound
from mien.live.fields import show
from mien.live.loop import Deadlines, Report
from mien.live.messages import Message, check_message, parse_batch, refusal
from mien.live.session import Frame, Session
from mien.live.wire import Pcm, check_rate, sound_message

from .microphone import Microphone
from .outbox import Outbox
from .speaker import Failure, Part

MOST_CLIENTS = 200
"""Connections at one time."""

MOST_DELAYS = 3600
"""A minute at 60 Hz."""

SHARE = 0.75
"""How much of a loop messages may take, together; what comes beyond waits for the next one."""


class Encoder(Protocol):
    """What makes pictures for pages: ``mien.live.frames.FrameEncoder``."""

    @property
    def number(self) -> int: ...  # noqa: D102
    @property
    def setup(self) -> bytes: ...  # noqa: D102
    def encode(self, frame: Frame) -> bytes: ...  # noqa: D102


class Speaks(Protocol):
    """What makes texts into sound and movement: ``speaker.Speaker``."""

    def say(self, message: Message) -> None: ...  # noqa: D102
    def cancel(self) -> Iterable[str | None]: ...  # noqa: D102
    def tick(self, unsaid_s: float) -> None: ...  # noqa: D102


class Animator:
    """A face that is live on sockets.

    Transports call ``join``, ``turn``, ``handle`` and ``leave``; ``run`` is the loop. Messages are handled between
    loops, in the order in which they come; however many come, loops keep their deadlines, since messages get a share
    of each loop and no more.

    Args:
        session: the face.
        encoder: makes its pictures.
        clock: seconds, never goes back.
        sleep: waits so many seconds.
    """

    def __init__(
        self,
        session: Session,
        encoder: Encoder,
        *,
        clock: Callable[[], float] = perf_counter,
        sleep: Callable[[float], Awaitable[object]] = asyncio.sleep,
    ) -> None:
        self.session, self.encoder = session, encoder
        self.report = Report()
        self.speaker: Speaks | None = None
        """Says texts; without one only those with phones are said."""
        self.microphone = Microphone(session.loop_s)
        """Hears live voices."""
        self.outboxes: list[Outbox] = []
        self.messages = 0
        self.delays_s: deque[float] = deque(maxlen=MOST_DELAYS)
        """How late the newest loops began, seconds."""
        self.about: dict[str, Callable[[], object]] = {}
        """What is told besides of what runs with it, by name: JSON."""
        self._clock, self._sleep = clock, sleep
        self._setup = encoder.number
        self._hooks: list[Callable[[Frame], object]] = []
        self._spent = 0.0
        self._stepped = asyncio.Event()
        self._acts: Mapping[str, Callable[[Message, Outbox | None], dict[str, Any]]] = {
            "say": self._say,
            "subscribe": self._subscribe,
            "speech.pcm": self._hear_text,
            "report": self._keep_report,
        }

    def on_frame(self, hook: Callable[[Frame], object]) -> None:
        """Call a function after every loop."""
        self._hooks.append(hook)

    def join(self, outbox: Outbox) -> None:
        """Take a client in.

        Raises:
            MienError: there are too many.
        """
        if len(self.outboxes) >= MOST_CLIENTS:
            raise MienError(f"{MOST_CLIENTS} clients are connected — no more are let in")
        self.outboxes.append(outbox)

    def leave(self, outbox: Outbox) -> None:
        """Let a client go."""
        self.outboxes.remove(outbox)

    async def turn(self) -> None:
        """Wait until a message may be handled: soon, where messages have not had their share of this loop."""
        await asyncio.sleep(0)
        while self._spent > SHARE * self.session.loop_s:
            await self._stepped.wait()

    def handle(self, value: object, outbox: Outbox | None = None) -> dict[str, Any]:
        """The answer to a message, any JSON value; a bad one changes nothing."""
        began = self._clock()
        self.messages += 1
        try:
            message = value if isinstance(value, Message) else check_message(value)
            act = self._acts.get(message.kind)
            if act is None:
                if message.ends_speech and self.speaker is not None:
                    self._break_off(self.speaker.cancel())
                return self.session.handle(message)
            identity = {} if message.id is None else {"id": message.id}
            return {"kind": "ok", **identity, **act(message, outbox)}
        except MienError as error:
            return refusal(error, value)
        finally:
            self._spent += self._clock() - began

    def handle_text(self, data: bytes | str, outbox: Outbox | None = None) -> str:
        """The answer, JSON, to messages in JSON: one, or a list of them."""
        began = self._clock()
        try:
            batch = parse_batch(data)
        except MienError as error:
            return json.dumps(refusal(error))
        finally:
            self._spent += self._clock() - began
        answers = [self.handle(value, outbox) for value in batch]
        return json.dumps(answers if data.lstrip()[:1] in (b"[", "[") else answers[0])

    def deliver(self, made: Part | Failure) -> None:
        """Say what the speaker has made of a text, or tell everybody that it could not."""
        if isinstance(made, Part):
            answer = self.session.handle(made.message, made.utterance)
            if answer["kind"] == "ok":
                if made.samples is not None:
                    self._send_sound(sound_message(answer["speech"], made.samples, made.rate_hz))
                    self.session.keep_sound(answer["speech"], Sound(made.samples, made.rate_hz))
                return
            made = Failure(answer["message"], made.message.id, made.message["more"])
        known = {} if made.id is None else {"id": made.id}
        failed = {"kind": "event", "event": "speech.failed", "message": made.message, "more": made.more, **known}
        self._tell({**failed, "loop": self.session.loop})

    def _break_off(self, dropped: Iterable[str | None]) -> None:
        """Tell of texts that end without having been said; the session tells of those that it was given."""
        for identity in dropped:
            known = {} if identity is None else {"id": identity}
            ended = {"kind": "event", "event": "speech.ended", "broken_off": True, "more": False, **known}
            self._tell({**ended, "loop": self.session.loop})

    def hear(self, sound: Pcm) -> dict[str, Any]:
        """Move the mouth with a live voice."""
        self._obey(self.microphone.hear(sound.samples, sound.rate_hz))
        return {}

    def _obey(self, move: Message | None) -> None:
        if move is not None:
            self.session.handle(move)

    async def run(self) -> None:
        """Run loops at their deadlines, until cancelled."""
        deadlines = Deadlines(self.session.rate, self._clock())
        while True:
            due_s, now_s = deadlines.due_s, self._clock()
            due = deadlines.take(now_s)
            if not due:
                await self._sleep(max(0.0, due_s - now_s))
                continue
            self.delays_s.append(now_s - due_s)
            for _ in range(due):
                frame = self._step()
            self._show(frame)
            self.report = deadlines.report
            # However late the loops are, sockets get their turn.
            await asyncio.sleep(0)

    def _step(self) -> Frame:
        if self.speaker is not None:
            self.speaker.tick(self.session.unsaid_s)
        self._obey(self.microphone.tick(self.session.loop))
        frame = self.session.step()
        for event in frame.events:
            self._tell({**event, "loop": frame.loop})
        for hook in self._hooks:
            hook(frame)
        self._spent = 0.0
        self._stepped.set()
        self._stepped.clear()
        return frame

    def _tell(self, event: Mapping[str, Any]) -> None:
        text = json.dumps(event)
        for outbox in self.outboxes:
            if outbox.events:
                outbox.put(text)

    def _send_sound(self, sound: bytes) -> None:
        for outbox in self.outboxes:
            if outbox.sound:
                outbox.put(sound)

    def _show(self, frame: Frame) -> None:
        """Hand the newest picture to all who want one; nobody draws one that nobody sees."""
        if not any(outbox.open_for_pictures for outbox in self.outboxes):
            return
        picture = self.encoder.encode(frame)
        if self.encoder.number != self._setup:
            self._setup = self.encoder.number
            for outbox in self._watching():
                outbox.start_over()
                outbox.put(self.encoder.setup)
        for outbox in self._watching():
            outbox.show(frame.loop, picture)

    def _watching(self) -> Iterable[Outbox]:
        return (outbox for outbox in self.outboxes if outbox.frames)

    def _say(self, message: Message, outbox: Outbox | None) -> dict[str, Any]:
        if self.speaker is None:
            answer = self.session.handle(message)
            if answer["kind"] == "error":
                raise MienError(answer["message"])
            return answer
        self.speaker.say(message)
        return {}

    def _subscribe(self, message: Message, outbox: Outbox | None) -> dict[str, Any]:
        if outbox is None:
            raise MienError("subscribe: nothing can be sent here — use a WebSocket or a TCP connection")
        wanted = {name: value for name, value in message.fields.items() if value is not None}
        if wanted.get("frames") and not outbox.frames:
            outbox.start_over()
            outbox.put(self.encoder.setup)
        for name, value in wanted.items():
            setattr(outbox, name, value)
        return {}

    def _hear_text(self, message: Message, outbox: Outbox | None) -> dict[str, Any]:
        rate_hz, data = check_rate(message["rate_hz"]), message["data"]
        try:
            found = base64.b64decode(data, validate=True)
        except (binascii.Error, ValueError):
            raise MienError(f"speech.pcm: data {show(data)} is no base64") from None
        if len(found) % 2:
            raise MienError(f"speech.pcm: {len(found)} bytes are no 16-bit samples")
        return self.hear(Pcm(rate_hz, np.frombuffer(found, "<i2").astype(np.int16)))

    def _keep_report(self, message: Message, outbox: Outbox | None) -> dict[str, Any]:
        if outbox is None:
            raise MienError("report: comes from a page, on its WebSocket")
        outbox.report = {name: value for name, value in message.fields.items() if value is not None}
        return {}
