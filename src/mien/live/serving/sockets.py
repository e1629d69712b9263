"""WebSocket and HTTP: the page, its pictures, and messages as JSON."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cache
from importlib.resources import files
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from mien.core import MienError
from mien.live.messages import refusal
from mien.live.wire import Pcm, read_binary

from .animator import Animator
from .outbox import Outbox

MOST_BYTES = 1_000_000
"""In one message."""

TYPES: Mapping[str, str] = {
    "html": "text/html; charset=utf-8",
    "css": "text/css; charset=utf-8",
    "js": "text/javascript; charset=utf-8",
    "svg": "image/svg+xml",
}
"""What a page is made of, by suffix."""

TRY_AGAIN, POLICY = 1013, 1008
"""Codes of closed WebSockets (RFC 6455, 7.4.1, and the registry of IANA)."""

LAST_WORD_S = 1.0
GONE = (WebSocketDisconnect, RuntimeError)
"""What the library raises where the other side has closed."""

About = Callable[[], Mapping[str, Any]]


def make_app(animator: Animator, about: About) -> Starlette:
    """The application around an animator; ``about`` tells what ``GET /about`` answers."""

    async def index(request: Request) -> Response:
        return _page_file("index.html")

    async def page(request: Request) -> Response:
        return _page_file(request.path_params["name"])

    async def tell(request: Request) -> Response:
        return JSONResponse(dict(about()))

    async def parameters(request: Request) -> Response:
        face = animator.session.face
        return JSONResponse({"face": face.name, "parameters": [row.to_json() for row in face.parameters]})

    async def messages(request: Request) -> Response:
        data = bytearray()
        async for piece in request.stream():
            data += piece
            if len(data) > MOST_BYTES:
                error = MienError(f"a request of more than {MOST_BYTES} bytes — send several")
                return JSONResponse(refusal(error), status_code=413)
        await animator.turn()
        answer = animator.handle_text(bytes(data))
        failed = answer.startswith('{"kind": "error"')
        return Response(answer, status_code=400 if failed else 200, media_type="application/json")

    async def live(websocket: WebSocket) -> None:
        await _serve(animator, websocket)

    return Starlette(
        routes=[
            Route("/", index),
            Route("/page/{name}", page),
            Route("/about", tell),
            Route("/parameters", parameters),
            Route("/messages", messages, methods=["POST"]),
            WebSocketRoute("/live", live),
        ]
    )


@cache
def page_files() -> Mapping[str, bytes]:
    """The files of the page by name: the only ones that are served."""
    folder = files("mien.live").joinpath("page")
    found = {entry.name: entry for entry in folder.iterdir() if entry.is_file()}
    return {name: entry.read_bytes() for name, entry in found.items() if name.rpartition(".")[2] in TYPES}


def _page_file(name: str) -> Response:
    data = page_files().get(name)
    if data is None:
        return Response("there is no such file\n", status_code=404, media_type="text/plain")
    return Response(data, headers={"content-type": TYPES[name.rpartition(".")[2]]})


async def _serve(animator: Animator, websocket: WebSocket) -> None:
    """One WebSocket, from the beginning to the end."""
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
