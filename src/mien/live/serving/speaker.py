"""Who speaks for a live face: texts become sound and movement in another process, sentence by sentence."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Collection
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from time import monotonic
from types import MappingProxyType
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError
from mien.live.messages import Message, check_message
from mien.live.motions import standard_motions
from mien.live.saying import Utterance
from mien.live.sentences import Sentence, cut_sentence, read_marks, split_sentences
from mien.live.streams import Identity, Streams
from mien.perform.marks import MarkedText

from .speaking_process import StoppedError, start_process
from .speaking_worker import Cued, Made, Setup, Task

AHEAD_S = 25.0
"""No more is made while so much waits for being said, seconds: too little to be more texts than a session takes."""

SOON_S = 1.0
"""Where less than this waits for being said, a long sentence begins with its first clause."""

MOST_WAITING = 1_000
MOST_CHARACTERS = 50_000
"""Texts that wait for being made, and their characters together, phones and words among them."""


@dataclass(frozen=True, eq=False)
class Part:
    """Something to be said now, or after what is being said.

    Attributes:
        message: a ``say`` of one sentence, with its phones and words.
        utterance: what the face does.
        samples: (N,) int16, which begin with the utterance; None where somebody else has the sound.
        rate_hz: samples a second.
    """

    message: Message
    utterance: Utterance
    samples: NDArray[np.int16] | None
    rate_hz: int


@dataclass(frozen=True)
class Failure:
    """Something that cannot be said: why, and whether the text goes on all the same."""

    message: str
    id: Identity
    more: bool = False


class Worker(Protocol):
    """What makes texts; once it stops it is replaced."""

    @property
    def language(self) -> str: ...  # noqa: D102
    async def make(self, task: Task) -> Made: ...  # noqa: D102
    async def close(self) -> None: ...  # noqa: D102


@dataclass(eq=False)
class _Waiting:
    """A text that waits.

    Attributes:
        message: that asks for it.
        marked: the text.
        said: whether anything of the text has been said already.
        sentences: what is left of it, once it was begun.
    """

    message: Message
    marked: MarkedText
    said: bool = False
    sentences: deque[Sentence] | None = None


def _count(message: Message) -> int:
    """Characters of a message, with phones and words."""
    return len(message["text"]) + len(message["phones"] or ()) + len(message["words"] or ())


class Speaker:
    """Texts of a live face, made one after the other in a process of their own.

    Args:
        voice: a voice's name, or the usual one.
        rate: loops a second.
        seed: of the session.
        deliver: takes what has been made, on the event loop, in the order of the messages.
        motions: those that marks may ask for.
        now: a clock, seconds, that never goes back.
        open_worker: starts what makes texts.
    """

    def __init__(
        self,
        voice: str | None,
        rate: Fraction,
        seed: int,
        deliver: Callable[[Part | Failure], object],
        *,
        motions: Collection[str] = tuple(standard_motions()),
        now: Callable[[], float] = monotonic,
        open_worker: Callable[[Setup], Awaitable[Worker]] = start_process,
    ) -> None:
        self._setup, self._deliver, self._motions, self._now = Setup(voice, rate, seed), deliver, motions, now
        self._open_worker = open_worker
        self._worker: Worker | None = None
        self._task: asyncio.Task[None] | None = None
        self._news = asyncio.Event()
        self._streams = Streams()
        self._waiting: deque[_Waiting] = deque()
        self._making: Message | None = None
        self._cancelled = 0
        self._unsaid_s = 0.0
        self._language = "en"

    async def start(self) -> None:
        """Start the process and wait until it is warm.

        Raises:
            MienError: the voice is not there.
        """
        await self._ready()
        self._task = asyncio.create_task(self._make_all())

    async def close(self) -> None:
        """End the process; what waits is dropped."""
        self.cancel()
        if self._task is not None:
            self._task.cancel()
            with suppress(asyncio.CancelledError):
                await self._task
        await self._dismiss()

    def say(self, message: Message) -> None:
        """Have a ``say`` made, after those before it; what comes of it is delivered.

        Raises:
            MienError: too much waits, the text is empty, or its marks cannot be understood.
        """
        identity, text = message.id, message["text"]
        streamed = identity in self._streams
        waiting = self._streams.characters + sum(_count(waiting.message) for waiting in self._waiting)
        if waiting + _count(message) > MOST_CHARACTERS or len(self._waiting) >= MOST_WAITING:
            raise MienError(
                f"say: {waiting} characters in {len(self._waiting)} texts wait for being said, at most "
                f"{MOST_CHARACTERS} in {MOST_WAITING} — wait for speech.ended, or interrupt"
            )
        if message["phones"] is not None:
            self._wait(_Waiting(message, MarkedText(text)))
        elif message["more"]:
            self._wait_for(message, self._streams.add(identity, text, self._language, self._now()))
        else:
            whole = self._streams.end(identity) + text if streamed else text
            if not streamed and not whole.strip():
                raise MienError("say: the text is empty — write what is to be said")
            self._wait_for(message, whole, said=streamed)

    def cancel(self) -> tuple[Identity, ...]:
        """Deliver nothing any more of what was asked for before; the texts that this leaves without an end."""
        messages = ([self._making] if self._making else []) + [waiting.message for waiting in self._waiting]
        dropped = dict.fromkeys([message.id for message in messages] + self._streams.open)
        self._cancelled += 1
        self._making = None
        self._waiting.clear()
        self._streams.clear()
        return tuple(dropped)

    def tick(self, unsaid_s: float) -> None:
        """Go on where there is something to do; called at every loop.

        Args:
            unsaid_s: how long the session will take to say all that was delivered.
        """
        self._unsaid_s = unsaid_s
        for identity, text in self._streams.take_silent(self._now()):
            message = check_message({"kind": "say", "text": text, "id": identity, "more": True})
            try:
                self._wait_for(message, text)
            except MienError as error:
                self._deliver(Failure(str(error), identity, more=True))
        self._news.set()

    def _wait_for(self, message: Message, text: str, *, said: bool = False) -> None:
        """Let a text wait; of one that ends the end waits, even if there are no words in it."""
        marked = read_marks(text, self._motions)
        if marked.text.strip() or marked.marks or not message["more"]:
            self._wait(_Waiting(_with(message, text=text), marked, said))

    def _wait(self, waiting: _Waiting) -> None:
        self._waiting.append(waiting)
        self._news.set()

    async def _make_all(self) -> None:
        while True:
            while not self._waiting or self._unsaid_s >= AHEAD_S:
                self._news.clear()
                await self._news.wait()
            cancelled, waiting = self._cancelled, self._waiting[0]
            message, task = self._take(waiting)
            self._making = message
            delivery = await self._make(waiting, message, task)
            self._making = None
            if cancelled == self._cancelled:
                if isinstance(delivery, Part):
                    waiting.said = True
                    self._unsaid_s += float(delivery.utterance.loops / self._setup.rate)
                elif delivery.more and not message["more"]:
                    self._waiting.appendleft(_Waiting(_with(message, text=""), MarkedText("")))
                self._deliver(delivery)
            with suppress(MienError):  # the next text tells
                await self._ready()

    async def _make(self, waiting: _Waiting, message: Message, task: Task) -> Part | Failure:
        """What becomes of a sentence. One that the voice cannot say is no end of a text that has others."""
        try:
            return _part(message, await (await self._ready()).make(task))
        except StoppedError as error:
            if waiting in self._waiting:
                self._waiting.remove(waiting)
            await self._dismiss()
            return Failure(str(error), message.id, waiting.message["more"])
        except MienError as error:
            return Failure(str(error), message.id, message["more"] or waiting.said)

    def _take(self, waiting: _Waiting) -> tuple[Message, Task]:
        """The next sentence of the first text that waits, and the message that asks for it alone."""
        message = waiting.message
        if message["phones"] is not None:
            self._waiting.popleft()
            return message, Cued(message["text"], message["phones"], message["words"] or ())
        if waiting.sentences is None:
            waiting.sentences = deque(split_sentences(waiting.marked, self._language))
        # Of a text that ends without words, the end.
        sentence = waiting.sentences.popleft() if waiting.sentences else Sentence(MarkedText(""))
        if self._unsaid_s < SOON_S:
            sentence, *rest = cut_sentence(sentence)
            waiting.sentences.extendleft(rest)
        if not waiting.sentences:
            self._waiting.popleft()
        more = message["more"] or bool(waiting.sentences)
        return _with(message, text=sentence.text, more=more), sentence

    async def _ready(self) -> Worker:
        """The worker, warm."""
        if self._worker is None:
            self._worker = await self._open_worker(self._setup)
            self._language = self._worker.language
        return self._worker

    async def _dismiss(self) -> None:
        worker, self._worker = self._worker, None
        if worker is not None:
            await worker.close()


def _part(message: Message, made: Made) -> Part:
    """What was made of a message."""
    acts: dict[int, tuple[Message, ...]] = {}
    for loop, act in made.acts:
        acts[loop] = (*acts.get(loop, ()), check_message(act))
    said = _with(message, phones=made.phones, words=made.words) if made.phones else message
    return Part(said, replace(made.utterance, acts=acts), made.samples, made.rate_hz)


def _with(message: Message, **fields: Any) -> Message:
    """The message with other fields."""
    return replace(message, fields=MappingProxyType({**message.fields, **fields}))
