"""Clients of a live face: one that waits, and one for asyncio."""

from __future__ import annotations

import asyncio
import os
from collections.abc import AsyncIterable, AsyncIterator, Awaitable, Iterable, Iterator
from concurrent.futures import Future
from contextlib import AsyncExitStack, ExitStack, asynccontextmanager, contextmanager, suppress
from queue import SimpleQueue
from threading import Lock, Thread
from typing import TYPE_CHECKING, Any, Self

from mien.core import MienError

from .calls import SUBSCRIBE, Calls, encode, read_answer, say_message
from .exchange import CLOSED, OVER, Answer, Event, Exchange, Payload, Said, Talk, new_id, read_event, read_outcome
from .reaching import choose_link, connection_options, fetch, gone, opening

if TYPE_CHECKING:
    from websockets.asyncio.client import ClientConnection

OPEN_S = 10.0

Outcome = Said | MienError


class Client(Calls[Answer, list[Answer]]):
    """A connection to a live face.

    ``with mien.Client() as face: face.say("Hello.")`` finds the one server that runs on this machine. Several threads
    may use it at once: one says something, another one interrupts. A connection that is lost is not made again: every
    call raises MienError from then on.

    Args:
        link: that ``mien live`` printed; else that of the environment's MIEN_LINK, or of the server that runs.
        token: in the place of that of the link.
        timeout_s: how long to wait for the connection.

    Raises:
        MienError: there is no such server, more than one, or it refuses.
    """

    def __init__(self, link: str | None = None, *, token: str | None = None, timeout_s: float = OPEN_S) -> None:
        from websockets.sync.client import connect

        self.link = choose_link(link, token, os.environ)
        self._timeout_s = timeout_s
        self._exchange, self._sending, self._stack = Exchange(), Lock(), ExitStack()
        self._subscribed = False
        with opening(self.link):
            self._connection = self._stack.enter_context(
                connect(self.link.socket, **connection_options(self.link, timeout_s))
            )
        self._reader = Thread(target=self._read, name="mien-client", daemon=True)
        self._reader.start()

    def close(self) -> None:
        """Close the connection; whatever still waits for something raises."""
        self._exchange.lose(CLOSED)
        self._stack.close()
        self._reader.join()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def say(self, text: str, *, wait: bool = False, id: str | None = None) -> Said:
        """Say a text after all that is being said.

        Args:
            text: of one sentence or more.
            wait: until it has been said, or has been broken off.
            id: of its events, made up where none is given.

        Raises:
            MienError: the face refuses, or it could not be said and ``wait`` is given.
        """
        if not wait:
            identity = new_id() if id is None else id
            self._ask(say_message(text, identity))
            return Said(identity)
        with self._talk(id) as talk:
            self._say(talk, text)
            return read_outcome(talk.end.result())

    def say_stream(self, pieces: Iterable[str], *, wait: bool = False, id: str | None = None) -> Said:
        """Say a text that comes bit by bit, as from a language model: each sentence as soon as it is complete.

        No more pieces are taken once somebody, here or elsewhere, lets the face fall silent.

        Args:
            pieces: of text; spaces between words are theirs.
            wait: until it has been said, or has been broken off.
            id: of its events, made up where none is given.

        Raises:
            MienError: as ``say``.
        """
        with self._talk(id) as talk:
            for piece in [pieces] if isinstance(pieces, str) else pieces:
                self._say(talk, piece, more=True)
                if talk.over:
                    break
            self._say(talk, "")
            return read_outcome(talk.end.result()) if wait or talk.over else Said(talk.id)

    def events(self) -> Iterator[Event]:
        """Events of speech from now on: ``{"event": "speech.word", "word": …}``; ends when this client is closed.

        Raises:
            MienError: the server is gone.
        """
        queue: SimpleQueue[Event] = SimpleQueue()
        self._exchange.listen(queue)
        self._subscribe()
        return self._listen(queue)

    def _listen(self, queue: SimpleQueue[Event]) -> Iterator[Event]:
        try:
            while (event := read_event(queue.get())) is not None:
                yield event
        finally:
            self._exchange.leave(queue)

    def _subscribe(self) -> None:
        if not self._subscribed:
            self._ask(SUBSCRIBE)
            self._subscribed = True

    @contextmanager
    def _talk(self, identity: str | None) -> Iterator[Talk[Future[Outcome]]]:
        self._subscribe()
        talk: Talk[Future[Outcome]] = Talk(Future(), identity)
        self._exchange.begin(talk)
        try:
            yield talk
        finally:
            self._exchange.end(talk)

    def _say(self, talk: Talk[Future[Outcome]], text: str, *, more: bool = False) -> None:
        """Say some of a text, unless it is over."""
        read_answer(self._post(say_message(text, talk.id, more=more), talk).result())

    def _ask(self, message: Payload, part: str | None = None) -> Any:
        answer = read_answer(self._post(message).result())
        return answer if part is None else answer[part]

    def _fetch(self, path: str) -> Any:
        return fetch(self.link, path, self._timeout_s)

    def _post(self, message: Payload, talk: Talk[Any] | None = None) -> Future[Any]:
        """What will hold the answer to a message."""
        from websockets.exceptions import ConnectionClosed

        text, pending = encode(message), Future[Any]()
        with self._sending:
            # Whatever breaks speech off is sent from here too: nothing of a talk goes out behind it.
            if talk is not None and talk.over:
                pending.set_result(OVER)
                return pending
            self._exchange.expect(pending, message)
            with suppress(ConnectionClosed):  # the reader tells
                self._connection.send(text)
        return pending

    def _read(self) -> None:
        from websockets.exceptions import ConnectionClosed

        with suppress(ConnectionClosed):
            for data in self._connection:
                self._exchange.take(data)
        self._exchange.lose(gone(self.link, self._connection))


class AsyncClient(Calls[Awaitable[Answer], Awaitable[list[Answer]]]):
    """A connection to a live face under asyncio: ``async with mien.AsyncClient() as face: await face.say("Hello.")``.

    As ``Client``, but all calls are awaited, and the connection is made by ``async with``, or by ``open``.

    Args:
        link: that ``mien live`` printed; else that of the environment's MIEN_LINK, or of the server that runs.
        token: in the place of that of the link.
        timeout_s: how long to wait for the connection.

    Raises:
        MienError: there is no such server, or more than one.
    """

    def __init__(self, link: str | None = None, *, token: str | None = None, timeout_s: float = OPEN_S) -> None:
        self.link = choose_link(link, token, os.environ)
        self._timeout_s = timeout_s
        self._exchange, self._stack = Exchange(), AsyncExitStack()
        self._connection: ClientConnection | None = None
        self._subscribed = False

    async def open(self) -> Self:
        """Connect; the client itself.

        Raises:
            MienError: the server does not answer, or refuses.
        """
        from websockets.asyncio.client import connect

        with opening(self.link):
            opened = connect(self.link.socket, **connection_options(self.link, self._timeout_s))
            self._connection = await self._stack.enter_async_context(opened)
        self._reader = asyncio.create_task(self._read(self._connection))
        return self

    async def close(self) -> None:
        """Close the connection; whatever still waits for something raises."""
        self._exchange.lose(CLOSED)
        await self._stack.aclose()
        if self._connection is not None:
            await self._reader

    async def __aenter__(self) -> Self:
        return await self.open()

    async def __aexit__(self, *exception: object) -> None:
        await self.close()

    async def say(self, text: str, *, wait: bool = False, id: str | None = None) -> Said:
        """Say a text after all that is being said; as ``Client.say``."""
        if not wait:
            identity = new_id() if id is None else id
            await self._ask(say_message(text, identity))
            return Said(identity)
        async with self._talk(id) as talk:
            await self._say(talk, text)
            return read_outcome(await talk.end)

    async def say_stream(
        self, pieces: Iterable[str] | AsyncIterable[str], *, wait: bool = False, id: str | None = None
    ) -> Said:
        """Say a text that comes bit by bit, each sentence as soon as it is complete; as ``Client.say_stream``."""
        async with self._talk(id) as talk:
            async for piece in _each(pieces):
                await self._say(talk, piece, more=True)
                if talk.over:
                    break
            await self._say(talk, "")
            return read_outcome(await talk.end) if wait or talk.over else Said(talk.id)

    async def events(self) -> AsyncIterator[Event]:
        """Events of speech from the first time on that one is awaited; as ``Client.events``."""
        queue: asyncio.Queue[Event] = asyncio.Queue()
        self._exchange.listen(queue)
        try:
            await self._subscribe()
            while (event := read_event(await queue.get())) is not None:
                yield event
        finally:
            self._exchange.leave(queue)

    async def _subscribe(self) -> None:
        if not self._subscribed:
            await self._ask(SUBSCRIBE)
            self._subscribed = True

    @asynccontextmanager
    async def _talk(self, identity: str | None) -> AsyncIterator[Talk[asyncio.Future[Outcome]]]:
        await self._subscribe()
        talk: Talk[asyncio.Future[Outcome]] = Talk(asyncio.get_running_loop().create_future(), identity)
        self._exchange.begin(talk)
        try:
            yield talk
        finally:
            self._exchange.end(talk)

    async def _say(self, talk: Talk[asyncio.Future[Outcome]], text: str, *, more: bool = False) -> None:
        """Say some of a text, unless it is over."""
        if not talk.over:
            await self._ask(say_message(text, talk.id, more=more))

    async def _ask(self, message: Payload, part: str | None = None) -> Any:
        from websockets.exceptions import ConnectionClosed

        if self._connection is None:
            raise MienError("this client is not connected — use it as 'async with mien.AsyncClient() as face:'")
        text, pending = encode(message), asyncio.get_running_loop().create_future()
        # The library writes before it waits, so answers come in the order in which they are expected here.
        self._exchange.expect(pending, message)
        with suppress(ConnectionClosed):  # the reader tells
            await self._connection.send(text)
        answer = read_answer(await pending)
        return answer if part is None else answer[part]

    async def _fetch(self, path: str) -> Any:
        return await asyncio.to_thread(fetch, self.link, path, self._timeout_s)

    async def _read(self, connection: ClientConnection) -> None:
        from websockets.exceptions import ConnectionClosed

        with suppress(ConnectionClosed):
            async for data in connection:
                self._exchange.take(data)
        self._exchange.lose(gone(self.link, connection))


async def _each(pieces: Iterable[str] | AsyncIterable[str]) -> AsyncIterator[str]:
    if isinstance(pieces, AsyncIterable):
        async for piece in pieces:
            yield piece
    else:
        for piece in [pieces] if isinstance(pieces, str) else pieces:
            yield piece
