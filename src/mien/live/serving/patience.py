"""What a connection may cost before anything is known of it: how many there are, how slow, how much lies unread."""

from __future__ import annotations

import asyncio
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

MOST_CONNECTIONS = 400
"""At one time, of all kinds, with a token or without: fewer than the files that systems let a program open."""

SLOWEST_S = 10.0
"""A connection on which no request is made and answered for so long is cut."""

MOST_UNREAD = 8_000_000
"""Bytes that the system has not taken yet: some setups and sentences, and no flood of answers to pings."""


class HttpConnection(H11Protocol):
    """A connection with HTTP on it, which is cut where too many are open or it is slow."""

    slowest_s = SLOWEST_S
    _slow: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Count it, and begin to wait."""
        super().connection_made(transport)
        if len(self.connections) > MOST_CONNECTIONS:
            transport.abort()
        else:
            self._wait()

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        self._wait()

    def handle_websocket_upgrade(self, event: Any) -> None:
        """Wait no more: it answers pings from now on."""
        self._forget()
        super().handle_websocket_upgrade(event)

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait no more."""
        self._forget()
        super().connection_lost(exc)

    def _wait(self) -> None:
        self._forget()
        self._slow = self.loop.call_later(self.slowest_s, self.transport.abort)

    def _forget(self) -> None:
        if self._slow is not None:
            self._slow.cancel()


class SocketConnection(WebSocketsSansIOProtocol):
    """A connection with a WebSocket on it, which is cut where it does not read what it makes the server send."""

    def data_received(self, data: bytes) -> None:
        """Answer pings, keep messages for later."""
        super().data_received(data)
        if self.transport.get_write_buffer_size() > MOST_UNREAD:
            self.transport.abort()
