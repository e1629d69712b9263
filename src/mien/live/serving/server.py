"""The server of a live face: its doors, from the first to the last moment."""

from __future__ import annotations

import asyncio
import gc
import logging
import secrets
import socket
import sys
from collections.abc import AsyncIterator, Iterator, Mapping
from contextlib import AsyncExitStack, asynccontextmanager, contextmanager, nullcontext, suppress
from dataclasses import dataclass, field
from ipaddress import ip_address
from types import MappingProxyType
from urllib.parse import urlencode

import uvicorn

from mien.core import MienError
from mien.live.link import DEFAULT_PORT

from .about import describe
from .animator import Animator
from .guard import Guard
from .http import MOST_BYTES, make_app
from .patience import HttpConnection, SocketConnection
from .tcp import serve_tcp
from .udp import serve_udp

LONGEST_GOODBYE_S = 2.0
SWITCH_S = 0.001
"""A thread that computes lets the loop go on after this time, seconds; Python's own is five times as long."""

EVERYWHERE: Mapping[str, str] = MappingProxyType({"0.0.0.0": "127.0.0.1", "::": "::1"})
"""Addresses that stand for all of this machine's, and how it calls itself there."""

PING_S = 15.0
"""A client that does not answer within this time, twice, is gone."""


@dataclass(frozen=True)
class Doors:
    """Where a face is reached.

    Attributes:
        host: address that page, WebSocket and HTTP are bound to, and TCP and UDP too.
        port: of page, WebSocket and HTTP; 0 is any that is free.
        token: what clients of them must know.
        allow: further names (``name``, ``name:port``) or origins (``http://name:port``) that may be used.
        tcp_port: of text lines; None is none.
        udp_port: of OSC and VMC; None is none.
    """

    host: str = "127.0.0.1"
    port: int = DEFAULT_PORT
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    allow: tuple[str, ...] = ()
    tcp_port: int | None = None
    udp_port: int | None = None

    def link(self, port: int, host: str = "") -> str:
        """The address of the page on a port, with the token; as it is seen from here unless another host is given."""
        host = host or EVERYWHERE.get(self.host, self.host)
        return f"http://{_bracketed(host)}:{port}/?{urlencode({'token': self.token})}"

    @property
    def is_loopback(self) -> bool:
        """Whether only programs on this machine can come in."""
        try:
            return ip_address(self.host).is_loopback
        except ValueError:
            return self.host == "localhost"


@dataclass(frozen=True)
class Opened:
    """A server that runs.

    Attributes:
        link: of the page, with its token.
        ports: by what they are for: ``page``, ``tcp``, ``osc``.
        work: ends only where something is wrong with it.
    """

    link: str
    ports: Mapping[str, int]
    work: tuple[asyncio.Task[None], ...]

    async def wait(self) -> None:
        """Wait as long as all goes well; raise what does not."""
        done, _ = await asyncio.wait(self.work, return_when=asyncio.FIRST_COMPLETED)
        for task in done:
            task.result()


@asynccontextmanager
async def open_server(animator: Animator, doors: Doors) -> AsyncIterator[Opened]:
    """A server with all its doors, while the body runs; the loop of the face runs with it.

    Raises:
        MienError: a door cannot be opened; names it.
    """
    async with AsyncExitStack() as stack:
        with _naming("--port", doors.host, doors.port):
            listener = stack.enter_context(_bind(doors.host, doors.port))
        port: int = listener.getsockname()[1]
        ports = {"page": port}
        await _open_others(animator, doors, ports, stack)
        inside = make_app(animator, lambda: {**describe(animator), "ports": ports})
        app = Guard(inside, port, doors.token, *allowed(doors, port))
        server = _Server(
            uvicorn.Config(
                app,
                ws=SocketConnection,
                ws_max_size=MOST_BYTES,
                ws_ping_interval=PING_S,
                ws_ping_timeout=PING_S,
                # It saves a tenth of the bytes and takes a third of a core.
                ws_per_message_deflate=False,
                http=HttpConnection,
                lifespan="off",
                access_log=False,
                log_config=None,
                server_header=False,
                timeout_graceful_shutdown=1,
            )
        )
        # What a client does wrong is no news.
        logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)
        serving = asyncio.create_task(server.serve([listener]))
        looping = asyncio.create_task(animator.run())
        before = sys.getswitchinterval()
        sys.setswitchinterval(SWITCH_S)
        gc.collect()
        gc.freeze()  # what is there stays; a collection need not look at it again
        try:
            yield Opened(doors.link(port), ports, (serving, looping))
        finally:
            gc.unfreeze()
            sys.setswitchinterval(before)
            for outbox in animator.outboxes:
                outbox.close("the server ends")
            server.should_exit = True
            with suppress(TimeoutError):
                await asyncio.wait_for(serving, LONGEST_GOODBYE_S)
            looping.cancel()
            await asyncio.gather(looping, return_exceptions=True)


async def _open_others(animator: Animator, doors: Doors, ports: dict[str, int], stack: AsyncExitStack) -> None:
    """Open the doors that are shut unless asked for."""
    if doors.tcp_port is not None:
        with _naming("--tcp-port", doors.host, doors.tcp_port):
            server = await serve_tcp(animator, doors.host, doors.tcp_port)
        stack.callback(server.close)
        ports["tcp"] = server.sockets[0].getsockname()[1]
    if doors.udp_port is not None:
        with _naming("--osc-port", doors.host, doors.udp_port):
            transport = await serve_udp(animator, doors.host, doors.udp_port)
        stack.callback(transport.close)
        ports["osc"] = transport.get_extra_info("sockname")[1]


@contextmanager
def _naming(option: str, host: str, port: int) -> Iterator[None]:
    """Errors of the system as errors of a door."""
    try:
        yield
    except (OSError, OverflowError) as error:
        raise MienError(
            f"{option}: cannot listen on {_bracketed(host)}:{port} ({error}) — is another server running there ('mien "
            "doctor' tells)? 0 takes any port that is free"
        ) from None


def allowed(doors: Doors, port: int) -> tuple[set[str], set[str]]:
    """Hosts and origins, besides those of this machine, under which a server on a port may be used.

    Raises:
        MienError: a name cannot be one.
    """
    names, hosts, origins = {doors.host} - EVERYWHERE.keys(), set[str](), set[str]()
    if not doors.is_loopback:
        names.add(socket.gethostname())
    for each in doors.allow:
        scheme, slashes, host = each.rstrip("/").rpartition("://")
        if not host or host[-1] == ":" or any(letter in host for letter in " /*\\?#@"):
            raise MienError(f"--allow {each!r}: want NAME, NAME:PORT or an origin such as http://localhost:3000")
        if slashes:
            origins.add(f"{scheme}://{host}")
        # A proxy with HTTPS hands on its own name.
        if scheme == "https":
            hosts.add(host)
        elif not slashes:
            names.add(host)
    return hosts | {name if _has_port(name) else f"{_bracketed(name)}:{port}" for name in names}, origins


def _has_port(name: str) -> bool:
    return name.rpartition(":")[2].isdigit() and (name.count(":") == 1 or "]:" in name)


def _bracketed(host: str) -> str:
    return f"[{host}]" if ":" in host and not host.startswith("[") else host


def _bind(host: str, port: int) -> socket.socket:
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
    except (OSError, UnicodeError) as error:
        raise MienError(f"--host {host}: there is no such host here ({error})") from None
    return socket.create_server((host, port), family=family, backlog=256)


class _Server(uvicorn.Server):
    """Uvicorn without handlers for signals: whoever runs it decides when it ends."""

    def capture_signals(self) -> nullcontext[None]:  # type: ignore[override]
        return nullcontext()
