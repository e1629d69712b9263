"""VMC over UDP from a live face to whoever listens."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Iterator

import pytest
from live_server import STILL, Plain

from mien.core import UnknownNameError
from mien.live import Session
from mien.live.osc import decode_packet
from mien.live.serving.about import describe
from mien.live.serving.animator import Animator
from mien.live.serving.udp import serve_udp
from mien.live.serving.vmc_sender import VmcSender
from mien.live.vmc import VALUE
from support import face


@pytest.fixture
def listener() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listening:
        listening.bind(("127.0.0.1", 0))
        listening.settimeout(10)
        yield listening


def make(loop_s=1 / 60):
    return Animator(Session(face("toon:pip"), loop_s, idle=STILL), Plain(), clock=lambda: 0.0)


def test_each_loop_is_sent_until_it_is_closed(listener):
    animator = make()
    sender = VmcSender(animator, *listener.getsockname())
    animator.handle({"kind": "move", "values": {"ELU": 0}})
    animator._step()
    told = {arguments[0]: arguments[1] for address, arguments in decode_packet(listener.recv(2000)) if address == VALUE}
    assert told["Blink_L"] > 0.95
    assert told["Blink_R"] < 0.05
    animator._step()
    assert (sender.sent, sender.lost) == (2, 0)
    assert describe(animator)["vmc"] == {"sent": 2, "lost": 0}
    sender.close()
    animator._step()
    assert (sender.sent, sender.lost) == (2, 0)


def test_of_fast_loops_some_are_left_out(listener):
    animator = make(1 / 240)
    sender = VmcSender(animator, *listener.getsockname(), "arkit")
    for _ in range(8):
        animator._step()
    sender.close()
    packets = [listener.recv(2000) for _ in range(sender.sent)]
    times = [
        arguments[0] for packet in packets for address, arguments in decode_packet(packet) if address.endswith("/T")
    ]
    assert times == pytest.approx([0, 4 / 240])


def test_where_nobody_listens_the_face_goes_on(listener):
    host, port = listener.getsockname()
    listener.close()
    animator = make()
    sender = VmcSender(animator, host, port)
    for _ in range(5):
        animator._step()
    sender.close()
    assert sender.sent + sender.lost == 5
    assert animator.session.loop == 5


def test_unknown_names_and_hosts_are_refused_and_leave_nothing_open():
    with pytest.raises(UnknownNameError):
        VmcSender(make(), "127.0.0.1", 39539, "vrm2")
    with pytest.raises(OSError, match=r"."):
        VmcSender(make(), "no such host", 39539)


def test_one_live_face_moves_another():
    """A wink goes from one animator to the other through real sockets."""

    async def whole() -> None:
        first, second = make(), make()
        transport = await serve_udp(second, "127.0.0.1", 0)
        sender = VmcSender(first, *transport.get_extra_info("sockname"), "perfect-sync")
        try:
            first.handle({"kind": "move", "values": {"ELU": 0, "MB": 0.6, "HH": -20}})
            first._step()
            while not second.messages:
                await asyncio.sleep(0.001)
            second._step()
            state = {"kind": "state", "names": ["ELU", "ERU", "MB", "HH"]}
            wanted, found = (animator.handle(state)["values"] for animator in (first, second))
            assert found == pytest.approx(wanted, abs=0.02)
        finally:
            sender.close()
            transport.close()
            await asyncio.sleep(0)

    asyncio.run(whole())
