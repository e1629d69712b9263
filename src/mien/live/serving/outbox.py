"""What waits for one client: the newest picture, and a few other things in order. Everything is bounded."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Mapping
from typing import Any

WINDOW = 2
"""Pictures that can be on their way without having been drawn."""

MOST_WAITING = 512
MOST_BYTES = 16_000_000
"""Answers, events and sound that can wait for a client, and how long they may be together."""

Item = str | bytes


class Outbox:
    """Mail for one connection.

    Answers, events and sound go in order; of pictures only the newest waits, and it goes when fewer than ``WINDOW``
    of those sent before have not been drawn. Who does not read what is put here is closed, and disturbs nobody else.

    Attributes:
        frames: whether pictures are wanted.
        events: whether events are.
        sound: whether what is said is.
        report: what the client has measured.
        closed: why no more is sent; empty while it is open.
    """

    def __init__(self) -> None:
        self.frames = self.events = self.sound = False
        self.report: Mapping[str, Any] = {}
        self.closed = ""
        self._waiting: deque[Item] = deque()
        self._bytes = 0
        self._picture: tuple[int, bytes] | None = None
        self._flying: deque[int] = deque()
        self._news, self._over = asyncio.Event(), asyncio.Event()

    @property
    def open_for_pictures(self) -> bool:
        """Whether a picture put here now would be sent as soon as the line is free."""
        return self.frames and not self.closed and len(self._flying) < WINDOW

    def put(self, item: Item) -> None:
        """Send an answer, event or sound after those that wait; the client is closed where too much waits."""
        if self.closed:
            return
        self._waiting.append(item)
        self._bytes += len(item)
        if len(self._waiting) > MOST_WAITING or self._bytes > MOST_BYTES:
            self.close("too much waits for being read")
        self._news.set()

    def show(self, loop: int, picture: bytes) -> None:
        """Send a picture in the place of the one that waits."""
        if self.frames and not self.closed:
            self._picture = loop, picture
            self._news.set()

    def drawn(self, loop: int) -> None:
        """Pictures up to that of a loop are through."""
        while self._flying and self._flying[0] <= loop:
            self._flying.popleft()
        self._news.set()

    def start_over(self) -> None:
        """No picture is on its way any more: those of before a new setup are not drawn."""
        self._picture = None
        self._flying.clear()

    def close(self, reason: str) -> None:
        """Send nothing any more, not even what waits."""
        self.closed = self.closed or reason
        self._waiting.clear()
        self._bytes, self._picture = 0, None
        self._news.set()
        self._over.set()

    async def wait_closed(self) -> None:
        """Wait until it is closed."""
        await self._over.wait()

    def take(self) -> Item | None:
        """What is to be sent now; None where nothing is."""
        if self._waiting:
            item = self._waiting.popleft()
            self._bytes -= len(item)
            return item
        if self._picture is not None and len(self._flying) < WINDOW:
            loop, picture = self._picture
            self._picture = None
            self._flying.append(loop)
            return picture
        return None

    async def next(self) -> Item | None:
        """What is to be sent next, as soon as there is something; None once it is closed."""
        while not self.closed:
            item = self.take()
            if item is not None:
                return item
            self._news.clear()
            await self._news.wait()
        return None
