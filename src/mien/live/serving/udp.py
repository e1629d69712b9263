"""OSC over UDP: ``/mien/...`` are messages, ``/VMC/...`` is a tracker. Nothing is ever answered."""

from __future__ import annotations

import asyncio
from collections import deque
from typing import TYPE_CHECKING, Any

from mien.core import MienError
from mien.live.fields import show
from mien.live.osc import Argument, decode_packet, message_from
from mien.live.vmc import PREFIX, VmcReceiver

if TYPE_CHECKING:
    from mien.live.session import Frame

    from .animator import Animator

MOST_WAITING = 256
"""Packets; those that come while so many wait are lost, as packets may be."""


class OscPort(asyncio.DatagramProtocol):
    """What becomes of packets.

    They wait in a bounded queue for their turn (``Animator.turn``). What trackers say is handed on at most twice a
    loop, the newest only; what is wrong is counted.

    Attributes:
        received: packets that have come.
        ignored: packets that were lost, and calls that were refused.
        reason: why, of the last one.
    """

    def __init__(self, animator: Animator) -> None:
        self.received = self.ignored = 0
        self.reason = ""
        self._animator = animator
        self._tracker = VmcReceiver(animator.session.face, animator.session.loop_s, animator.session.rest)
        self._waiting: deque[bytes] = deque()
        self._news = asyncio.Event()
        self._told = -1
        self._task = asyncio.create_task(self._run())
        animator.on_frame(self._follow)
        animator.about["osc"] = self.report

    def report(self) -> dict[str, Any]:
        """The counts, for people."""
        return {"received": self.received, "ignored": self.ignored, "last_ignored": self.reason}

    def datagram_received(self, data: bytes, addr: object) -> None:
        """Keep a packet for later."""
        self.received += 1
        if len(self._waiting) >= MOST_WAITING:
            self._ignore("packets come faster than they can be read")
            return
        self._waiting.append(data)
        self._news.set()

    def connection_lost(self, exc: Exception | None) -> None:
        """The port has been closed."""
        self._task.cancel()

    async def _run(self) -> None:
        while True:
            while self._waiting:
                try:
                    calls = decode_packet(self._waiting.popleft())
                except MienError as error:
                    self._ignore(str(error))
                    calls = []
                await self._animator.turn()
                for call in calls:
                    if not call[0].startswith(PREFIX):
                        await self._animator.turn()
                    self._take(*call)
            loop = self._animator.session.loop
            if self._told != loop and self._track():
                self._told = loop
            self._news.clear()
            await self._news.wait()

    def _take(self, address: str, arguments: tuple[Argument, ...]) -> None:
        try:
            if address.startswith(PREFIX):
                self._tracker.take(address, arguments)
                return
            message = message_from(address, arguments)
            if message is None:
                raise MienError(f"{show(address)}: want an address that begins with /mien/ or {PREFIX}")
        except MienError as error:
            self._ignore(str(error))
            return
        self._handle(message)

    def _follow(self, frame: Frame) -> None:
        """Hand on what has come from a tracker since, or that it has fallen silent."""
        if not self._task.done():
            self._track()

    def _track(self) -> bool:
        """Whether there was something to hand on."""
        messages = self._tracker.messages(self._animator.session.loop)
        for message in messages:
            self._handle(message)
        return bool(messages)

    def _handle(self, message: dict[str, Any]) -> None:
        answer = self._animator.handle(message)
        if answer["kind"] == "error":
            self._ignore(answer["message"])

    def _ignore(self, reason: str) -> None:
        self.ignored += 1
        self.reason = reason


async def serve_udp(animator: Animator, host: str, port: int) -> asyncio.DatagramTransport:
    """A port that listens already; its protocol is an ``OscPort``.

    Raises:
        OSError: the port is taken, or there is no such host.
    """
    transport, _ = await asyncio.get_running_loop().create_datagram_endpoint(
        lambda: OscPort(animator), local_addr=(host, port)
    )
    return transport
