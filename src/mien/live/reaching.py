"""How a client reaches a live face: which one, over which connection, and what to say where that fails."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from http.client import HTTPConnection, HTTPException, HTTPSConnection
from typing import Any

from mien.core import MienError

from .link import Link, parse_link
from .serving.runtime import find_server

CLOSE_S = 2.0


def choose_link(link: str | None, token: str | None, environment: Mapping[str, str]) -> Link:
    """The link that was given, or that of MIEN_LINK, or of the one server that runs.

    Raises:
        MienError: it is no link, has no token, or there is not exactly one server.
    """
    text = link or environment.get("MIEN_LINK")
    found = parse_link(text) if text else find_server(environment).address
    found = replace(found, token=token) if token else found
    if not found.token:
        raise MienError(f"{found.place}: the link has no token — give all of what 'mien live' printed, or token=")
    return found


def fetch(link: Link, path: str, timeout_s: float) -> Any:
    """What a server tells at a path, JSON.

    Raises:
        MienError: it does not answer, or refuses.
    """
    connection = (HTTPSConnection if link.secure else HTTPConnection)(link.host, link.port, timeout=timeout_s)
    try:
        connection.request("GET", path, headers=link.headers)
        response = connection.getresponse()
        data = response.read()
        if response.status != 200:
            raise _refused(link, response.status)
        return json.loads(data)
    except (OSError, HTTPException, ValueError) as error:
        raise _unreached(link, error) from None
    finally:
        connection.close()


def connection_options(link: Link, timeout_s: float) -> dict[str, Any]:
    """How both kinds of connection are made."""
    return {
        "additional_headers": link.headers,
        "compression": None,
        # What runs on this machine is not reached through a proxy.
        "proxy": None,
        "open_timeout": timeout_s,
        "close_timeout": CLOSE_S,
        "max_size": None,
    }


@contextmanager
def opening(link: Link) -> Iterator[None]:
    """What goes wrong inside, in words that help."""
    from websockets.exceptions import InvalidStatus, WebSocketException

    try:
        yield
    except InvalidStatus as error:
        raise _refused(link, error.response.status_code) from None
    except (OSError, WebSocketException, ValueError) as error:
        raise _unreached(link, error) from None


def _refused(link: Link, status: int) -> MienError:
    return MienError(
        f"{link.place}: refuses this client (HTTP status {status}) — every start of 'mien live' has another token: "
        "give the link that it has printed now"
    )


def _unreached(link: Link, error: Exception) -> MienError:
    reason = str(error) or type(error).__name__
    return MienError(
        f"{link.place}: no live face answers ({reason}) — 'mien live' starts one, 'mien doctor' lists those that run"
    )


def gone(link: Link, connection: Any) -> str:
    """Why a connection is no more."""
    why = f" ({connection.close_reason})" if connection.close_reason else ""
    return f"{link.place}: the live face has gone{why} — start it again with 'mien live', then make a new client"
