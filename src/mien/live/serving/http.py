"""HTTP: the page, messages as JSON, what the server tells of itself; and the way to the WebSocket."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket

from mien.core import MienError
from mien.live.messages import refusal

from .animator import Animator
from .websocket import serve_websocket

MOST_BYTES = 1_000_000
"""In one message."""

TYPES: Mapping[str, str] = {
    "html": "text/html; charset=utf-8",
    "css": "text/css; charset=utf-8",
    "js": "text/javascript; charset=utf-8",
    "svg": "image/svg+xml",
}
"""What a page is made of, by suffix."""

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
        await serve_websocket(animator, websocket)

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
