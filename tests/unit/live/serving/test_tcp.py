"""Lines over TCP: answers, events, and what happens to clients that do harm."""

from __future__ import annotations

import asyncio
import json
import random
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from live_server import STILL, Plain, live_server

from mien.core import MienError
from mien.live import Session
from mien.live.lines import LONGEST_LINE
from mien.live.serving import tcp
from mien.live.serving.animator import Animator
from mien.live.serving.server import Doors
from mien.live.serving.tcp import MOST_CONNECTIONS, read_lines, serve_tcp
from support import face


class Client:
    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader, self.writer = reader, writer

    def send(self, *lines: bytes) -> None:
        self.writer.write(b"".join(line + b"\n" for line in lines))

    async def answer(self) -> dict[str, object]:
        return json.loads(await asyncio.wait_for(self.reader.readline(), 20))

    async def ask(self, line: bytes) -> dict[str, object]:
        self.send(line)
        return await self.answer()

    async def rest(self) -> bytes:
        """All that comes until the other side closes."""
        return await asyncio.wait_for(self.reader.read(), 20)


def run(test):
    """A test with an animator whose clock stands still, and a way to connect to it by TCP."""

    @asynccontextmanager
    async def served() -> AsyncIterator[SimpleNamespace]:
        animator = Animator(Session(face("toon:pip"), idle=STILL), Plain(), clock=lambda: 0.0)
        server = await serve_tcp(animator, "127.0.0.1", 0)
        port = server.sockets[0].getsockname()[1]
        clients: list[Client] = []

        async def connect() -> Client:
            clients.append(Client(*await asyncio.open_connection("127.0.0.1", port)))
            return clients[-1]

        try:
            yield SimpleNamespace(animator=animator, connect=connect, clients=clients)
        finally:
            server.close()
            for client in clients:
                client.writer.transport.abort()
            while animator.outboxes:
                await asyncio.sleep(0)

    async def whole() -> None:
        async with served() as place:
            await asyncio.wait_for(test(place), 60)

    asyncio.run(whole())


def test_every_line_is_answered_in_order():
    async def test(place):
        client = await place.connect()
        client.send(b"ELU 0.2 500", b"", b'{"kind": "play", "motion": "smile", "id": "7"}', b"STAET", b"\xff\xfe")
        assert await client.answer() == {"kind": "ok"}
        assert (await client.answer())["id"] == "7"
        assert "did you mean 'STATE'" in (await client.answer())["message"]
        assert "no UTF-8" in (await client.answer())["message"]
        client.writer.write(b"STATE ELU")  # as printf without a line end writes it
        client.writer.write_eof()
        assert (await client.answer())["kind"] == "state"
        assert await client.rest() == b""

    run(test)


def test_a_line_acts_on_the_face():
    async def test(place):
        client = await place.connect()
        assert await client.ask(b"MOVE ELU 0.25") == {"kind": "ok"}
        place.animator.session.step()
        assert (await client.ask(b"STATE ELU"))["values"] == {"ELU": 0.25}

    run(test)


def test_a_line_that_is_too_long_is_refused_and_the_next_one_counts():
    async def test(place):
        client = await place.connect()
        client.send(b"SAY " + b"a" * LONGEST_LINE, b"RESET", b"x" * 5_000_000, b"RESET")
        answers = [await client.answer() for _ in range(4)]
        assert [answer["kind"] for answer in answers] == ["error", "ok", "error", "ok"]
        assert str(LONGEST_LINE) in answers[0]["message"]

    run(test)


@pytest.mark.parametrize(
    "data", [b"", b"a", b"a\n", b"\n\nb\n", b"12345678\nx", b"123456789" * 9 + b"\nnext", b"1" * 40]
)
def test_lines_are_the_same_however_they_come(data):
    async def read(pieces):
        reader = asyncio.StreamReader(limit=8)
        for piece in pieces:
            reader.feed_data(piece)
        reader.feed_eof()
        return [line async for line in read_lines(reader)]

    whole = asyncio.run(read([data]))
    assert whole == asyncio.run(read([data[i : i + 1] for i in range(len(data))]))
    wanted = [line if len(line.rstrip(b"\n")) <= 8 else None for line in data.splitlines(keepends=True)]
    assert whole == wanted


@given(st.lists(st.binary(max_size=30), max_size=9))
def test_any_bytes_are_lines(pieces):
    async def read():
        reader = asyncio.StreamReader(limit=8)
        for piece in pieces:
            reader.feed_data(piece)
        reader.feed_eof()
        return [line async for line in read_lines(reader)]

    data = b"".join(pieces)
    lines = asyncio.run(read())
    assert len(lines) == data.count(b"\n") + (data[-1:] not in (b"", b"\n"))
    if None not in lines:
        assert b"".join(lines) == data


@pytest.mark.parametrize(
    "line",
    [
        b"GET / HTTP/1.1\r",
        b"POST /ELU HTTP/1.1\r",
        b"smile /x HTTP/1.0\r",
        b"Host: localhost:8766\r",
        b"PRI * HTTP/2.0\r",
        b"content-type: text/plain",
    ],
)
def test_http_ends_the_connection_and_nothing_behind_it_counts(line):
    async def test(place):
        client = await place.connect()
        client.send(line, b"", b"MOVE ELU 0", b"PLAY smile")
        assert b"not HTTP" in (await client.rest()).splitlines()[0]
        assert place.animator.messages == 0

    run(test)


def test_a_request_line_that_is_too_long_ends_at_the_next_header():
    async def test(place):
        client = await place.connect()
        client.send(b"GET /" + b"a" * LONGEST_LINE + b" HTTP/1.1\r", b"Host: localhost\r", b"\r", b"PLAY smile")
        assert len((await client.rest()).splitlines()) == 2
        assert place.animator.messages == 0

    run(test)


def test_what_is_said_about_http_is_no_http():
    async def test(place):
        client = await place.connect()
        assert (await client.ask(b"SAY GET / HTTP/1.1 is a request"))["kind"] == "error"  # no voice
        assert (await client.ask(b"RESET"))["kind"] == "ok"

    run(test)


SAY = b'{"kind": "say", "text": "a", "id": "s", "phones": [[0, 0.1, "AA"]]}'


def test_events_come_to_those_who_subscribe():
    async def test(place):
        listening, other = await place.connect(), await place.connect()
        assert await listening.ask(b"SUBSCRIBE events") == {"kind": "ok"}
        assert (await other.ask(SAY))["kind"] == "ok"
        for _ in range(60):
            place.animator._step()
        events = [await listening.answer() for _ in range(2)]
        assert [event["event"] for event in events] == ["speech.started", "speech.ended"]
        assert [event["id"] for event in events] == ["s", "s"]
        assert (await other.ask(b"RESET"))["kind"] == "ok"

    run(test)


def test_pictures_and_sound_are_not_for_lines():
    async def test(place):
        client = await place.connect()
        for line in (b"SUBSCRIBE frames", b'{"kind": "subscribe", "events": true, "sound": true}'):
            assert "WebSocket" in (await client.ask(line))["message"]
        assert not any(outbox.frames or outbox.events for outbox in place.animator.outboxes)

    run(test)


def test_a_client_that_never_reads_is_dropped_and_nobody_else_waits(monkeypatch):
    monkeypatch.setattr(tcp, "STALLED_S", 0.2)

    async def test(place):
        good, deaf = await place.connect(), await place.connect()
        assert (await deaf.ask(b"SUBSCRIBE events"))["kind"] == "ok"
        deaf.reader._transport.pause_reading()
        while len(place.animator.outboxes) == 2:
            for outbox in place.animator.outboxes:
                if outbox.events:
                    outbox.put("x" * 100_000)
            assert (await good.ask(b"ELU 0.5"))["kind"] == "ok"
        assert (await good.ask(b"RESET"))["kind"] == "ok"

    run(test)


def test_a_client_that_sends_and_never_reads_is_not_read_any_further(monkeypatch):
    monkeypatch.setattr(tcp, "STALLED_S", 0.2)

    async def test(place):
        good, deaf = await place.connect(), await place.connect()
        await deaf.ask(b"RESET")
        deaf.reader._transport.pause_reading()
        while len(place.animator.outboxes) == 2:
            deaf.writer.write(b"STATE\n" * 1000)
            assert (await good.ask(b"ELU 0.5"))["kind"] == "ok"
        assert (await good.ask(b"RESET"))["kind"] == "ok"

    run(test)


def test_connections_are_bounded():
    async def test(place):
        clients = [await place.connect() for _ in range(MOST_CONNECTIONS)]
        assert [(await client.ask(b"RESET"))["kind"] for client in clients] == ["ok"] * MOST_CONNECTIONS
        late = await place.connect()
        assert b"no more are let in" in await late.rest()
        clients[0].writer.close()
        await clients[0].rest()
        while len(place.animator.outboxes) == MOST_CONNECTIONS:
            await asyncio.sleep(0)
        assert (await (await place.connect()).ask(b"RESET"))["kind"] == "ok"

    run(test)


def test_a_hundred_that_connect_and_vanish_leave_nothing_behind():
    async def test(place):
        good = await place.connect()
        for number in range(100):
            gone = await place.connect()
            gone.send(b"SUBSCRIBE events", b"ELU 0.1", b"half a li"[: number % 9])
            gone.writer.transport.abort()
        assert (await good.ask(b"RESET"))["kind"] == "ok"
        while len(place.animator.outboxes) > 1:
            await asyncio.sleep(0)
        assert (await good.ask(b"RESET"))["kind"] == "ok"

    run(test)


def test_nothing_is_answered_to_who_has_gone(caplog):
    async def test(place):
        good = await place.connect()
        for _ in range(5):
            gone = await place.connect()
            gone.send(*[b"STATE"] * 1000)
            await gone.answer()
            gone.writer.transport.abort()
        while len(place.animator.outboxes) > 1:
            await good.ask(b"RESET")
        assert place.animator.messages < 5_000

    run(test)
    assert caplog.records == []


def test_ten_thousand_malformed_lines_are_answered_one_by_one():
    chance = random.Random(20)
    pieces = [b"MOVE", b"ELU", b"1e999", b"nan", b"{", b'{"kind":', b"\xff", b"\0", b"LOOK", b"[[[[", b"-1", b" ", b'"']
    lines = [b" ".join(chance.choices(pieces, k=chance.randint(1, 6))) for _ in range(9_000)]
    lines += [chance.randbytes(chance.randint(1, 60)).replace(b"\n", b"") + b"!" for _ in range(999)] + [b"[" * 9_999]

    async def test(place):
        good, bad = await place.connect(), await place.connect()

        async def send() -> None:
            for start in range(0, len(lines), 500):
                bad.send(*lines[start : start + 500])
                await bad.writer.drain()

        sending = asyncio.create_task(send())
        wanted = sum(bool(line.decode("utf-8", "replace").strip()) for line in lines)
        kinds = {(await bad.answer())["kind"] for _ in range(wanted)}
        await sending
        assert "error" in kinds
        assert (await good.ask(b"RESET"))["kind"] == "ok"
        assert (await bad.ask(b"RESET"))["kind"] == "ok"

    run(test)


def test_many_lines_in_one_packet_let_others_go_on():
    """A client that answers in between is answered before those thousand lines are through."""

    async def test(place):
        many, other = await place.connect(), await place.connect()
        many.send(*[b"ELU 0.5"] * 1000)
        await other.ask(b"STATE")
        assert place.animator.messages < 1001
        assert [(await many.answer())["kind"] for _ in range(1000)] == ["ok"] * 1000

    run(test)


def test_a_server_opens_its_other_doors_and_shuts_them():
    async def whole() -> None:
        doors = Doors(port=0, tcp_port=0, udp_port=0)
        async with live_server(face("toon:pip"), doors) as live:
            assert set(live.opened.ports) == {"page", "tcp", "osc"}
            client = Client(*await asyncio.open_connection("127.0.0.1", live.opened.ports["tcp"]))
            assert await client.ask(b"ELU 0.25") == {"kind": "ok"}
            with pytest.raises(MienError, match="--tcp-port: cannot listen"):
                async with live_server(face("toon:pip"), Doors(port=0, tcp_port=live.opened.ports["tcp"])):
                    pass
        assert await client.rest() == b""
        client.writer.close()
        with pytest.raises(OSError, match=r"."):
            await asyncio.open_connection("127.0.0.1", live.opened.ports["tcp"])

    asyncio.run(whole())


def test_connections_that_are_open_when_all_ends_end_without_a_word(caplog):
    async def whole() -> None:
        animator = Animator(Session(face("toon:pip"), idle=STILL), Plain(), clock=lambda: 0.0)
        server = await serve_tcp(animator, "127.0.0.1", 0)
        _, writer = await asyncio.open_connection("127.0.0.1", server.sockets[0].getsockname()[1])
        while not animator.outboxes:
            await asyncio.sleep(0)
        server.close()
        writer.close()

    asyncio.run(whole())
    assert caplog.records == []
