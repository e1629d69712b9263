"""A server of the tests that answers as it is told, and both kinds of client behind one face."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import contextmanager
from threading import Thread
from typing import Any

from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response
from websockets.sync.server import ServerConnection, serve

import mien

TOKEN = "secret-token"
OK = {"kind": "ok"}

Reply = Callable[[Any], Iterable[Any]]


class FakeServer:
    """What came in, and a way to send something without being asked."""

    def __init__(self, reply: Reply) -> None:
        self.reply = reply
        self.about: Any = {"face": "nobody"}
        self.received: list[Any] = []
        self.connections: list[ServerConnection] = []
        self.link = ""

    @property
    def said(self) -> list[tuple[str, bool]]:
        return [(each["text"], each.get("more", False)) for each in self.received if each["kind"] == "say"]

    def tell(self, value: Any) -> None:
        for connection in self.connections:
            connection.send(value if isinstance(value, str | bytes) else json.dumps(value))

    def handle(self, connection: ServerConnection) -> None:
        self.connections.append(connection)
        try:
            for data in connection:
                message = json.loads(data)
                self.received.append(message)
                for value in [OK] if message == {"kind": "subscribe", "events": True} else self.reply(message):
                    connection.send(value if isinstance(value, str | bytes) else json.dumps(value))
        except ConnectionClosed:
            pass

    def guard(self, connection: ServerConnection, request: Request) -> Response | None:
        if request.headers.get("Authorization") != f"Bearer {TOKEN}":
            return Response(403, "Forbidden", Headers(), b"")
        if request.path == "/about":
            return Response(200, "OK", Headers(), json.dumps(self.about).encode())
        return None if request.path == "/live" else Response(404, "Not Found", Headers(), b"")


@contextmanager
def fake_server(reply: Reply = lambda message: [OK]) -> Iterator[FakeServer]:
    fake = FakeServer(reply)
    with serve(fake.handle, "127.0.0.1", 0, process_request=fake.guard, compression=None) as server:
        fake.link = f"http://127.0.0.1:{server.socket.getsockname()[1]}/?token={TOKEN}"
        thread = Thread(target=server.serve_forever)
        thread.start()
        try:
            yield fake
        finally:
            server.shutdown()
            for connection in fake.connections:
                connection.close()
            thread.join()


class Waited:
    """An ``AsyncClient`` whose calls are waited for, so that one test does for both kinds."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self._events: list[Generator[Any, None, None]] = []
        self._loop = asyncio.new_event_loop()
        self._thread = Thread(target=self._loop.run_forever)
        self._thread.start()
        try:
            self._client = self._wait(self._make(arguments, options))
        except BaseException:
            self._stop()
            raise

    async def _make(self, arguments: Any, options: Any) -> mien.AsyncClient:
        return await mien.AsyncClient(*arguments, **options).open()

    def _wait(self, coroutine: Any) -> Any:
        return asyncio.run_coroutine_threadsafe(coroutine, self._loop).result(20)

    def _stop(self) -> None:
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    def __getattr__(self, name: str) -> Any:
        return lambda *arguments, **options: self._wait(getattr(self._client, name)(*arguments, **options))

    def events(self) -> Iterator[Any]:
        events = self._client.events()
        first = asyncio.run_coroutine_threadsafe(anext(events), self._loop)

        def rest() -> Generator[Any, None, None]:
            try:
                yield first.result(20)
                while True:
                    yield self._wait(anext(events))
            except StopAsyncIteration:
                return
            finally:
                self._wait(events.aclose())

        self._events.append(rest())
        return self._events[-1]

    def __enter__(self) -> Waited:
        return self

    def __exit__(self, *exception: object) -> None:
        for events in self._events:
            events.close()
        self._wait(self._client.close())
        self._stop()


KINDS = {"sync": mien.Client, "async": Waited}
