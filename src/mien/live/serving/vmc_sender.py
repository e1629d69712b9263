"""A live face, sent to an avatar program by VMC over UDP."""

from __future__ import annotations

import math
import socket
from typing import TYPE_CHECKING

from mien.live.vmc_sending import VmcEncoder

if TYPE_CHECKING:
    from mien.live.session import Frame

    from .animator import Animator

MOST_HZ = 60.0
"""Poses a second; of faster loops some are left out."""


class VmcSender:
    """Sends what a face does, until it is closed.

    Attributes:
        sent: packets that are on their way.
        lost: packets that the system did not take: nobody listens, or the line is full.

    Args:
        animator: runs the face.
        host: where to.
        port: 39539 is usual for programs that draw, 39540 for those that send on.
        names: one of ``mien.live.vmc_sending.NAMES``.

    Raises:
        OSError: there is no such host.
        UnknownNameError: there is no such set of names.
    """

    def __init__(self, animator: Animator, host: str, port: int, names: str = "vrm0") -> None:
        self.sent = self.lost = 0
        self._encoder = VmcEncoder(animator.session.face, names)
        self._loop_s = animator.session.loop_s
        self._every = math.ceil(float(animator.session.rate) / MOST_HZ)
        family, kind, protocol, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_DGRAM)[0]
        self._socket = socket.socket(family, kind, protocol)
        self._socket.setblocking(False)
        self._address = address
        animator.on_frame(self._send)
        animator.about["vmc"] = self.report

    def report(self) -> dict[str, int]:
        """The counts, for people."""
        return {"sent": self.sent, "lost": self.lost}

    def close(self) -> None:
        """Send nothing any more."""
        self._socket.close()

    def _send(self, frame: Frame) -> None:
        if frame.loop % self._every or self._socket.fileno() < 0:
            return
        for packet in self._encoder.encode(frame.pose, frame.loop * self._loop_s):
            try:
                self._socket.sendto(packet, self._address)
                self.sent += 1
            except OSError:
                self.lost += 1
