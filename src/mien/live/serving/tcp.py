"""Lines over TCP, for netcat and robots: each is answered by one of JSON; events come to those who ask for them."""

from __future__ import annotations

import asyncio
import re
from collections.abc import AsyncIterator
from typing import TYPE_CHECKING, Any

from mien.core import MienError
from mien.live.lines import LONGEST_LINE, format_reply, parse_line
from mien.live.messages import refusal

from .outbox import Outbox

if TYPE_CHECKING:
    from .animator import Animator

MOST_CONNECTIONS = 64
"""At one time, on this port."""

STALLED_S = 10.0
"""A client that reads nothing for so long, while something waits for it, is dropped."""

BURST = 8
"""Lines of one client that are handled before others have their turn."""

HTTP = re.compile(rb"\S+ \S+ HTTP/\d|(host|origin|user-agent|content-type|content-length) *:", re.IGNORECASE)
"""How a line of HTTP begins. Pages of any site can make a browser send such lines, with commands behind them."""

WEBSOCKET_ONLY = ("frames", "sound")
"""What cannot be subscribed to in lines: it is binary."""


async def serve_tcp(animator: Animator, host: str, port: int) -> asyncio.Server:
    """A server, which listens already, of lines (``mien.live.lines``).

    Any bytes are answered; a line of HTTP ends the connection. Lines wait for their turn (``Animator.turn``), and are
    not read faster than their answers are.

    Raises:
        OSError: the port is taken, or there is no such host.
    """
    open_ones: set[asyncio.Task[None]] = set()

    def connect(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.create_task(_serve(animator, reader, writer, full=len(open_ones) == MOST_CONNECTIONS))
        open_ones.add(task)
        task.add_done_callback(open_ones.discard)

    return await asyncio.start_server(connect, host, port, limit=LONGEST_LINE)


async def _serve(animator: Animator, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, *, full: bool) -> None:
    outbox = Outbox()
    try:
        if full:
            raise MienError(f"{MOST_CONNECTIONS} connections are open on this port — no more are let in")
        animator.join(outbox)
        await _attend(animator, reader, writer, outbox)
    except MienError as error:
        writer.write(format_reply(refusal(error)))
    except OSError:  # TimeoutError is one
        # It has gone, or reads nothing: what still waits for it is thrown away.
        writer.transport.abort()
    finally:
        writer.close()


async def _attend(
    animator: Animator, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, outbox: Outbox
) -> None:
    """Answer a client and tell it events, until one of the two is over."""
    answering = asyncio.create_task(_answer_lines(animator, reader, writer, outbox))
    telling = asyncio.create_task(_tell(writer, outbox))
    try:
        done, _ = await asyncio.wait((answering, telling), return_when=asyncio.FIRST_COMPLETED)
        for task in done:
            task.result()
    finally:
        animator.leave(outbox)
        outbox.close("the connection is over")
        for task in (answering, telling):
            task.cancel()
        await asyncio.gather(answering, telling, return_exceptions=True)


async def _answer_lines(
    animator: Animator, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, outbox: Outbox
) -> None:
    number = 0
    async for line in read_lines(reader):
        if number % BURST == 0:
            await animator.turn()
        number += 1
        if line is not None and HTTP.match(line):
            error = MienError("this port takes lines such as PLAY smile, not HTTP")
            await _write(writer, format_reply(refusal(error)))
            return
        answer = _answer(animator, line, outbox)
        if answer is not None:
            await _write(writer, format_reply(answer))


async def _tell(writer: asyncio.StreamWriter, outbox: Outbox) -> None:
    """Send events; over once so many wait that the outbox has been closed."""
    while (item := await outbox.next()) is not None:
        await _write(writer, (item.encode() if isinstance(item, str) else item) + b"\n")


def _answer(animator: Animator, line: bytes | None, outbox: Outbox) -> dict[str, Any] | None:
    """The answer to a line, None to an empty one; a line that was too long is None."""
    try:
        if line is None:
            raise MienError(f"the line has more than {LONGEST_LINE} bytes")
        value = parse_line(line)
        if value is None:
            return None
        if value.get("kind") == "subscribe" and any(value.get(name) for name in WEBSOCKET_ONLY):
            raise MienError("subscribe: pictures and sound come on a WebSocket — here are events only")
    except MienError as error:
        return refusal(error)
    return animator.handle(value, outbox)


async def read_lines(reader: asyncio.StreamReader) -> AsyncIterator[bytes | None]:
    """Lines in order, None in the place of each that is longer than the reader's limit; the last needs no end."""
    too_long = False
    while True:
        try:
            line = await reader.readuntil(b"\n")
        except asyncio.LimitOverrunError as error:
            await reader.readexactly(error.consumed)
            too_long = True
            continue
        except asyncio.IncompleteReadError as error:
            line = error.partial
        if line or too_long:
            yield None if too_long else line
        if not line.endswith(b"\n"):
            return
        too_long = False


async def _write(writer: asyncio.StreamWriter, line: bytes) -> None:
    writer.write(line)
    if writer.transport.get_write_buffer_size() or writer.is_closing():
        async with asyncio.timeout(STALLED_S):
            await writer.drain()
