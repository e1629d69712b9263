"""One WebSocket of a live face: messages and sound come in; answers, events, pictures and sound go out."""

from __future__ import annotations

import asyncio
import json
from contextlib import suppress

from starlette.websockets import WebSocket, WebSocketDisconnect

from mien.core import MienError
from mien.live.messages import refusal
from mien.live.wire import Pcm, read_binary

from .animator import Animator
from .outbox import Outbox

TRY_AGAIN, POLICY = 1013, 1008
"""Codes of closed WebSockets (RFC 6455, 7.4.1, and the registry of IANA)."""

LAST_WORD_S = 1.0
GONE = (WebSocketDisconnect, RuntimeError)
"""What the library raises where the other side has closed."""


async def serve_websocket(animator: Animator, websocket: WebSocket) -> None:
    """Serve one client, from the beginning to the end."""
    await websocket.accept()
    outbox = Outbox()
    try:
        animator.join(outbox)
    except MienError as error:
        await websocket.close(TRY_AGAIN, str(error))
        return
    tasks = [
        asyncio.create_task(work)
        for work in (_receive(animator, websocket, outbox), _send(websocket, outbox), outbox.wait_closed())
    ]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        animator.leave(outbox)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    # A client that reads nothing does not read this either.
    with suppress(*GONE, TimeoutError):
        await asyncio.wait_for(websocket.close(POLICY, outbox.closed), LAST_WORD_S)


async def _receive(animator: Animator, websocket: WebSocket, outbox: Outbox) -> None:
    """Handle what comes, until the other side closes."""
    while (event := await websocket.receive())["type"] != "websocket.disconnect":
        text, data = event.get("text"), event.get("bytes")
        if text is not None:
            await animator.turn()
            outbox.put(animator.handle_text(text, outbox))
        elif data is not None:
            await _receive_binary(animator, data, outbox)


async def _receive_binary(animator: Animator, data: bytes, outbox: Outbox) -> None:
    try:
        found = read_binary(data)
        if isinstance(found, Pcm):
            await animator.turn()
            animator.hear(found)
        elif found.setup == animator.encoder.number:
            outbox.drawn(found.loop)
    except MienError as error:
        outbox.put(json.dumps(refusal(error)))


async def _send(websocket: WebSocket, outbox: Outbox) -> None:
    """Send what the outbox has, until it is closed or the other side is gone."""
    with suppress(*GONE):
        while (item := await outbox.next()) is not None:
            await websocket.send({"type": "websocket.send", "text" if isinstance(item, str) else "bytes": item})
