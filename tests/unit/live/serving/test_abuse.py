"""What clients may do wrong, and a good client beside them that notices none of it."""

import asyncio
import json
import random
import struct
from contextlib import asynccontextmanager, suppress

import pytest
from live_server import answer, live_server, request
from websockets.exceptions import ConnectionClosed, InvalidStatus

from mien.live.serving.outbox import MOST_WAITING
from mien.live.wire import FRAME, HEADER

MANY = 10_000


class Good:
    """A client that draws whatever it is sent, at once."""

    def __init__(self):
        self.loops = []

    async def watch(self, socket):
        await socket.send(json.dumps({"kind": "subscribe", "frames": True}))
        async for message in socket:
            if isinstance(message, bytes):
                kind, _, setup, loop, _ = HEADER.unpack_from(message)
                if kind == FRAME:
                    self.loops.append(loop)
                    await socket.send(struct.pack("<BBHI", 1, 0, setup, loop))

    async def seen_since(self, live):
        """Wait for a picture of a loop that is still to come."""
        wanted = live.animator.session.loop + 2
        async with asyncio.timeout(30):
            while not self.loops or self.loops[-1] < wanted:
                await asyncio.sleep(0.005)


@asynccontextmanager
async def beside_a_good_client():
    async with live_server() as live, live.socket() as socket:
        good = Good()
        watching = asyncio.create_task(good.watch(socket))
        await good.seen_since(live)
        tasks = len(asyncio.all_tasks())
        try:
            yield live, good
            await good.seen_since(live)
            assert good.loops == sorted(set(good.loops))
            async with asyncio.timeout(30):
                while len(live.animator.outboxes) > 1 or len(asyncio.all_tasks()) > tasks:
                    await asyncio.sleep(0.01)
            assert not watching.done()
        finally:
            watching.cancel()
            await asyncio.gather(watching, return_exceptions=True)


def run(work):
    asyncio.run(work())


def garbage(chance):
    """Texts and bytes of every wrong kind."""
    deep = "[" * chance.randint(1, 2000)
    return chance.choice(
        [
            lambda: "{" * chance.randint(1, 50),
            lambda: deep + "]" * len(deep),
            lambda: '{"kind": "move", "values": {"jaw.rotation": NaN}}',
            lambda: json.dumps({"kind": chance.choice(["move", "play", "say", "look", 3, None, []]), "at": [1] * 9}),
            lambda: json.dumps({"kind": "move", "values": {"jaw.rotation": "wide"}}),
            lambda: json.dumps({"kind": "move", "values": {"jaw.rotation": 1e308}, "over_ms": -1}),
            lambda: json.dumps({"kind": "say", "text": "x", "phones": [[5, 1, "AA"]]}),
            lambda: json.dumps({"kind": "subscribe", "frames": "yes"}),
            lambda: json.dumps(chance.random()),
            lambda: chance.randbytes(chance.randint(1, 60)).replace(b"\x01", b"\x07", 1),
            lambda: '{"id": "' + "x" * 500 + '"}',
        ]
    )()


def test_ten_thousand_malformed_messages_on_a_websocket_are_answered_one_by_one():
    async def work():
        async with beside_a_good_client() as (live, good):
            chance = random.Random(7)
            async with live.socket() as bad:
                answers = 0

                async def read():
                    nonlocal answers
                    while answers < MANY:
                        reply = json.loads(await answer(bad))
                        assert (reply[0] if isinstance(reply, list) else reply)["kind"] == "error"
                        answers += 1

                reading = asyncio.create_task(read())
                before = len(good.loops)
                for _ in range(MANY):
                    await bad.send(garbage(chance))
                await reading
                assert len(good.loops) > before

    run(work)


def test_ten_thousand_malformed_requests_are_refused_one_by_one():
    async def work():
        async with beside_a_good_client() as (live, good):
            chance = random.Random(8)
            reader, writer = await asyncio.open_connection("127.0.0.1", live.port)
            head = f"POST /messages HTTP/1.1\r\nHost: 127.0.0.1:{live.port}\r\nAuthorization: Bearer {live.doors.token}"
            before = len(good.loops)
            for _ in range(MANY // 100):
                for _ in range(100):
                    body = garbage(chance)
                    body = body.encode() if isinstance(body, str) else body
                    writer.write(f"{head}\r\nContent-Length: {len(body)}\r\n\r\n".encode() + body)
                for _ in range(100):
                    status, reply = await read_response(reader)
                    assert status in (b"200", b"400")
                    assert (reply[0] if isinstance(reply, list) else reply)["kind"] == "error"
            assert len(good.loops) > before
            writer.close()
            await writer.wait_closed()

    run(work)


async def read_response(reader):
    """Status and JSON of the next response on a connection that stays open."""
    lines = (await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), 30)).split(b"\r\n")
    length = next(int(line[15:]) for line in lines if line.lower().startswith(b"content-length:"))
    return lines[0].split()[1], json.loads(await reader.readexactly(length))


@pytest.mark.parametrize(
    "data",
    [
        b"\x00" * 100,
        b"GET",
        b"GET / HTTP/1.1\r\n",
        b"GET / HTTP/9.9\r\nHost: x\r\n\r\n",
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
        b"GET /live HTTP/1.1\r\n" + b"X: " + b"y" * 100_000 + b"\r\n\r\n",
        b"POST /messages HTTP/1.1\r\nContent-Length: -5\r\n\r\n",
        b"POST /messages HTTP/1.1\r\nContent-Length: 5\r\nContent-Length: 6\r\n\r\nhello!",
    ],
)
def test_bytes_that_are_no_request_disturb_nobody(data):
    async def work():
        async with beside_a_good_client() as (live, _):
            reader, writer = await asyncio.open_connection("127.0.0.1", live.port)
            with suppress(ConnectionError):
                writer.write(data)
                await writer.drain()
                writer.write_eof()
                await asyncio.wait_for(reader.read(), 10)
            writer.close()
            with suppress(ConnectionError):
                await writer.wait_closed()

    run(work)


def test_a_hundred_that_connect_and_vanish():
    async def work():
        async with beside_a_good_client() as (live, _):

            async def vanish(number):
                socket = await live.socket()
                await socket.send(json.dumps({"kind": "subscribe", "frames": True, "events": True, "sound": True}))
                if number % 2:
                    await socket.recv()
                socket.transport.abort()

            for start in range(0, 100, 20):
                await asyncio.gather(*(vanish(number) for number in range(start, start + 20)))

    run(work)


def test_a_storm_of_reconnecting_clients():
    async def work():
        async with beside_a_good_client() as (live, _):

            async def storm():
                for _ in range(10):
                    async with live.socket() as socket:
                        await socket.send(json.dumps({"kind": "subscribe", "frames": True}))

            await asyncio.gather(*(storm() for _ in range(20)))

    run(work)


def test_more_clients_than_fit_are_told_to_come_again():
    async def work():
        async with beside_a_good_client() as (live, _):
            live.animator.outboxes += live.animator.outboxes * 199
            async with live.socket() as late:
                with pytest.raises(ConnectionClosed):
                    await late.recv()
                assert late.close_code == 1013
            del live.animator.outboxes[1:]

    run(work)


def test_a_client_that_never_reads_is_let_go_and_holds_little():
    async def work():
        async with beside_a_good_client() as (live, _):
            bad = await live.socket(max_queue=1)
            bad.transport.pause_reading()
            await bad.send(json.dumps({"kind": "subscribe", "events": True}))
            async with asyncio.timeout(10):
                while len(live.animator.outboxes) < 2 or not live.animator.outboxes[1].events:
                    await asyncio.sleep(0.005)
            outbox, most = live.animator.outboxes[1], 0
            async with asyncio.timeout(60):
                while not outbox.closed:
                    live.animator._tell({"kind": "event", "event": "x" * 20_000})
                    most = max(most, len(outbox._waiting))
                    await asyncio.sleep(0)
            assert most <= MOST_WAITING
            bad.transport.abort()

    run(work)


def test_those_without_a_token_can_knock_as_often_as_they_like():
    async def work():
        async with beside_a_good_client() as (live, _):
            for _ in range(50):
                with pytest.raises(InvalidStatus):
                    await live.socket(additional_headers={"Authorization": "Bearer guess"})
            assert (await request(live.port, "/?token=guess")).status == 401

    run(work)
