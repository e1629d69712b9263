"""A server in this process, for tests: everything on loopback, on ports that are free."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass
from types import SimpleNamespace

from websockets.asyncio.client import ClientConnection, connect

from mien.core import Face
from mien.live import Frame, Session
from mien.live.serving.animator import Animator
from mien.live.serving.server import Doors, Opened, open_server
from mien.live.wire import FRAME, HEADER, SETUP, VERSION
from support import face

STILL = {"blinks": 0.0, "saccades": 0.0, "breathing": 0.0, "sway": 0.0}


class Plain:
    """Pictures that tell their loop, and nothing else."""

    number = 1
    setup = HEADER.pack(SETUP, VERSION, 1, 0, 0.0)

    def encode(self, frame: Frame) -> bytes:
        return HEADER.pack(FRAME, VERSION, self.number, frame.loop, 0.0) + bytes(40_000)


@dataclass
class Live:
    animator: Animator
    opened: Opened
    doors: Doors

    @property
    def port(self) -> int:
        return self.opened.ports["page"]

    def socket(self, **more: object) -> connect:
        headers = {"Authorization": f"Bearer {self.doors.token}"}
        return connect(f"ws://127.0.0.1:{self.port}/live", **{"additional_headers": headers, **more})


@asynccontextmanager
async def live_server(
    subject: Face | None = None, doors: Doors | None = None, loop_s: float = 1 / 60, encoder: object = None
) -> AsyncIterator[Live]:
    session = Session(subject or face("head"), loop_s, idle=STILL)
    animator = Animator(session, encoder or Plain())
    doors = doors or Doors(port=0)
    async with open_server(animator, doors) as opened:
        yield Live(animator, opened, doors)


async def request(
    port: int,
    path: str,
    *,
    method: str = "GET",
    headers: dict[str, str] | None = None,
    body: bytes = b"",
) -> SimpleNamespace:
    """A request by hand, so that every header is ours: status, headers, body."""
    sent = {"Host": f"127.0.0.1:{port}", "Connection": "close", "Content-Length": str(len(body)), **(headers or {})}
    lines = [f"{method} {path} HTTP/1.1", *(f"{name}: {value}" for name, value in sent.items()), "", ""]
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    try:
        writer.write("\r\n".join(lines).encode("latin-1") + body)
        answer = await reader.read()
    finally:
        writer.close()
        with suppress(ConnectionResetError):
            await writer.wait_closed()
    head, _, rest = answer.partition(b"\r\n\r\n")
    first, *others = head.decode("latin-1").split("\r\n")
    found = {name.lower(): value for name, _, value in (line.partition(": ") for line in others)}
    return SimpleNamespace(status=int(first.split()[1]), headers=found, body=rest)


async def answer(socket: ClientConnection) -> str:
    """The next text that comes."""
    while isinstance(message := await asyncio.wait_for(socket.recv(), 10), bytes):
        pass
    return message
