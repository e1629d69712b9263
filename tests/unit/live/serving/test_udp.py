"""OSC over UDP: messages, trackers, and packets of any bytes."""

from __future__ import annotations

import asyncio
import random
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from types import SimpleNamespace

from live_server import STILL, Plain

from mien.live import Session
from mien.live.osc import encode_call
from mien.live.serving.about import describe
from mien.live.serving.animator import Animator
from mien.live.serving.udp import MOST_WAITING, serve_udp
from support import face


def run(test):
    """A test with an animator whose clock stands still, and a way to send it packets."""

    @asynccontextmanager
    async def served() -> AsyncIterator[SimpleNamespace]:
        animator = Animator(Session(face("toon:pip"), idle=STILL), Plain(), clock=lambda: 0.0)
        transport = await serve_udp(animator, "127.0.0.1", 0)
        sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        sender.connect(transport.get_extra_info("sockname"))
        port = transport.get_protocol()

        async def send(*packets: bytes) -> None:
            """Send packets, and wait until they are through."""
            wanted = port.received + len(packets)
            for packet in packets:
                sender.send(packet)
                await asyncio.sleep(0)
            while port.received < wanted:
                await asyncio.sleep(0.001)
            for _ in range(3 * len(packets)):
                await asyncio.sleep(0)

        try:
            yield SimpleNamespace(animator=animator, session=animator.session, port=port, send=send, sender=sender)
        finally:
            sender.close()
            transport.close()
            await asyncio.sleep(0)

    async def whole() -> None:
        async with served() as place:
            await asyncio.wait_for(test(place), 60)

    asyncio.run(whole())


def values(place, *names):
    return place.session.handle({"kind": "state", "names": list(names)})["values"]


def test_messages_act_and_are_not_answered():
    async def test(place):
        await place.send(encode_call("/mien/move/ELU", 0.25), encode_call("/mien/play", "smile"))
        place.animator._step()
        assert values(place, "ELU") == {"ELU": 0.25}
        assert describe(place.animator)["osc"] == {"received": 2, "ignored": 0, "last_ignored": ""}
        place.sender.setblocking(False)
        try:
            answer = place.sender.recv(1)
        except BlockingIOError:
            answer = b""
        assert answer == b""

    run(test)


def test_what_is_wrong_is_counted_with_its_reason():
    async def test(place):
        for packet, words in (
            (b"abc", "3 bytes"),
            (encode_call("/mien/mvoe/ELU", 1.0), "did you mean '/mien/move'"),
            (encode_call("/mien/move/EULE", 1.0), "EULE"),
            (encode_call("/synth/1", 1.0), "want an address that begins with /mien/"),
            (encode_call("/VMC/Ext/Blend/Val", "Jyo", 1.0), "'Jyo' is no expression"),
            (encode_call("/VMC/Ext/Blend/Val", "Joy"), "want a name and 1 numbers"),
        ):
            before = place.port.ignored
            await place.send(packet)
            assert place.port.ignored == before + 1
            assert words in place.port.reason

    run(test)


def test_a_tracker_moves_the_face_and_lets_go():
    async def test(place):
        await place.send(encode_call("/VMC/Ext/Blend/Val", "Blink_L", 1.0), encode_call("/VMC/Ext/T", 0.5))
        place.animator._step()
        rest = values(place, "ELU")["ELU"]
        assert rest > 0
        await place.send(encode_call("/VMC/Ext/Blend/Apply"))
        place.animator._step()
        assert values(place, "ELU") == {"ELU": 0}
        for _ in range(119):
            place.animator._step()
        assert values(place, "ELU") == {"ELU": 0}
        for _ in range(31):
            place.animator._step()
        assert values(place, "ELU") == {"ELU": rest}
        assert place.port.ignored == 0

    run(test)


def test_a_fast_tracker_is_handed_on_at_most_twice_a_loop():
    async def test(place):
        frame = [encode_call("/VMC/Ext/Blend/Val", "A", 0.4), encode_call("/VMC/Ext/Blend/Apply")]
        for _ in range(20):
            await place.send(*frame)
        assert place.animator.messages == 1
        await place.send(encode_call("/VMC/Ext/Blend/Val", "A", 0.9), frame[1])
        place.animator._step()
        assert place.animator.messages == 2
        place.animator._step()
        assert values(place, "MB")["MB"] > 0.4
        assert place.animator.messages == 2

    run(test)


def test_packets_that_wait_are_bounded():
    async def test(place):
        for _ in range(MOST_WAITING + 10):
            place.port.datagram_received(encode_call("/mien/reset"), ("127.0.0.1", 1))
        assert (place.port.received, place.port.ignored) == (MOST_WAITING + 10, 10)
        while place.animator.messages < MOST_WAITING:
            await asyncio.sleep(0)
        assert "faster" in place.port.reason

    run(test)


def test_ten_thousand_malformed_packets_do_no_harm():
    chance = random.Random(21)
    pieces = [b"/mien/move/ELU\0\0", b"/VMC/Ext/Bone/Pos\0\0\0", b",f\0\0", b",sfffffff\0\0\0", b"#bundle\0", bytes(8)]
    pieces += [
        b"\0\0\0\x10",
        b"Head\0\0\0\0",
        b"\x7f\xc0\0\0",
        b"/VMC/Ext/Blend/Val\0\0",
        b",sf\0",
        b"Joy\0",
        b"\xff" * 4,
    ]
    packets = [b"".join(chance.choices(pieces, k=chance.randint(0, 12))) for _ in range(8_000)]
    packets += [chance.randbytes(chance.randint(0, 200)) for _ in range(2_000)]

    async def test(place):
        for number, packet in enumerate(packets):
            place.port.datagram_received(packet, ("127.0.0.1", 1))
            if number % 100 == 0:
                while place.port._waiting:
                    await asyncio.sleep(0)
                place.animator._step()
        assert place.port.received == len(packets)
        assert place.port.ignored > len(packets) / 2
        await place.send(encode_call("/mien/move/ELU", 0.25))
        for _ in range(20):  # however slow the machine: its turn comes
            place.animator._step()
            await asyncio.sleep(0.001)
        assert values(place, "ELU") == {"ELU": 0.25}

    run(test)


def test_a_closed_port_has_no_part_in_loops():
    async def test(place):
        place.port._task.cancel()
        await asyncio.gather(place.port._task, return_exceptions=True)
        place.port._tracker.take("/VMC/Ext/Blend/Apply", ())
        before = place.animator.messages
        place.animator._step()
        assert place.animator.messages == before

    run(test)
