"""Connections that never ask for anything, or never read."""

import asyncio
import json
from contextlib import suppress

import pytest
from live_server import answer, live_server, request

from mien.live.serving import patience


@pytest.mark.parametrize(
    "begun",
    [b"", b"GET / HT", b"GET /about HTTP/1.1\r\nHost: a\r\n", b"POST /messages HTTP/1.1\r\nContent-Length: 9\r\n"],
)
def test_who_does_not_ask_is_cut_and_who_does_is_not(monkeypatch, begun):
    monkeypatch.setattr(patience.HttpConnection, "slowest_s", 0.3)

    async def work():
        async with live_server() as live, live.socket() as good:
            reader, writer = await asyncio.open_connection("127.0.0.1", live.port)
            writer.write(begun)
            with suppress(ConnectionResetError):
                assert await asyncio.wait_for(reader.read(), 20) == b""
            writer.close()
            with suppress(ConnectionResetError):
                await writer.wait_closed()
            await good.send(json.dumps({"kind": "state"}))
            assert json.loads(await answer(good))["kind"] == "state"

    asyncio.run(work())


def test_a_body_that_never_ends_is_cut(monkeypatch):
    monkeypatch.setattr(patience.HttpConnection, "slowest_s", 0.3)

    async def work():
        async with live_server() as live:
            reader, writer = await asyncio.open_connection("127.0.0.1", live.port)
            head = f"Host: 127.0.0.1:{live.port}\r\nAuthorization: Bearer {live.doors.token}\r\nContent-Length: 90"
            writer.write(f"POST /messages HTTP/1.1\r\n{head}\r\n\r\n[".encode())
            with suppress(ConnectionResetError):
                assert await asyncio.wait_for(reader.read(), 20) == b""
            writer.close()
            with suppress(ConnectionResetError):
                await writer.wait_closed()

    asyncio.run(work())


def test_there_is_an_end_to_connections_and_they_make_room_again(monkeypatch):
    monkeypatch.setattr(patience, "MOST_CONNECTIONS", 5)

    async def work():
        async with live_server() as live:
            idle = [await asyncio.open_connection("127.0.0.1", live.port) for _ in range(9)]
            cut = 0
            for reader, _ in idle:
                with suppress(TimeoutError, ConnectionResetError):
                    await asyncio.wait_for(reader.read(), 0.2)
                cut += reader.at_eof() or reader.exception() is not None
            assert cut == 4
            for _, writer in idle:
                writer.close()
                with suppress(ConnectionResetError):
                    await writer.wait_closed()
            async with asyncio.timeout(20):
                while True:
                    with suppress(ConnectionResetError, IndexError):
                        assert (await request(live.port, "/about")).status == 401
                        return
                    await asyncio.sleep(0.01)

    asyncio.run(work())


def test_a_flood_of_pings_that_nobody_reads_the_answers_to_is_cut(monkeypatch):
    monkeypatch.setattr(patience, "MOST_UNREAD", 100_000)

    async def work():
        async with live_server() as live:
            bad = await live.socket(max_queue=1)
            bad.transport.pause_reading()
            frame = bytes([0x89, 0x80 | 125, 0, 0, 0, 0]) + bytes(125)
            async with asyncio.timeout(30):
                while not bad.transport.is_closing() and live.animator.outboxes:
                    bad.transport.write(frame * 500)
                    await asyncio.sleep(0)
            bad.transport.abort()

    asyncio.run(work())
