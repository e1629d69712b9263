"""Who may come in: exact lists of hosts and origins, and a token. Pure ASGI, around all of the server.

A page of another site can make a browser send requests to a server on the same machine. Its name resolved to this
machine (DNS rebinding) shows in ``Host``; its own address shows in ``Origin``; and it does not know the token.
"""

from __future__ import annotations

import hmac
from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from typing import Any
from urllib.parse import parse_qs, quote, urlencode

Scope = MutableMapping[str, Any]
Event = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Event]]
Send = Callable[[Event], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

USUAL_PORT = 80
"""Of HTTP."""

LOOPBACK = ("127.0.0.1", "localhost", "[::1]")

POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' data:",
        "connect-src 'self'",
        "media-src 'self' blob:",
        "worker-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'self'",
    )
)
"""What a page of ours may load."""

SECURITY_HEADERS = (
    (b"content-security-policy", POLICY.encode()),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"cache-control", b"no-store"),
)

REFUSED = 1008
"""Code of a WebSocket that is closed for the sake of a rule (RFC 6455, 7.4.1)."""


class Guard:
    """An application behind the lists and the token.

    Args:
        app: what is guarded.
        port: where it is reached.
        token: what a client must know: in a cookie, as bearer token, or in the query of the link.
        hosts: further hosts (``name:port``) under which it is reached, and whose pages may connect. The address that
            a connection comes to is always one: no name was resolved for it.
        origins: further origins whose pages may connect: ``http://localhost:3000``.
    """

    def __init__(self, app: App, port: int, token: str, hosts: Iterable[str] = (), origins: Iterable[str] = ()) -> None:
        self.app, self.token = app, token
        self.hosts = {f"{host}:{port}" for host in LOOPBACK} | {_with_port(host.lower()) for host in hosts}
        self.origins = {origin.lower() for origin in origins}
        # Cookies do not tell ports apart.
        self.cookie = f"mien_{port}"

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, or hand on to the application."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        socket = scope["type"] == "websocket"
        status, reason = self._refusal(scope)
        if status and socket:
            await receive()
            await send({"type": "websocket.close", "code": REFUSED, "reason": reason})
        elif status:
            await _answer(send, status, reason)
        elif not socket and scope["method"] == "GET" and "token" in _query(scope):
            await self._keep_token(scope, send)
        else:
            await self.app(scope, receive, _with_headers(send))

    def _refusal(self, scope: Scope) -> tuple[int, str]:
        """Status and reason; status 0 lets in."""
        headers = _headers(scope)
        host, origin = headers.get("host", []), headers.get("origin", [])
        hosts = self.hosts | _own_address(scope)
        if len(host) != 1 or _with_port(host[0].lower()) not in hosts:
            return 421, "this server is not reached under that name — allow it with --allow NAME:PORT"
        if len(origin) > 1 or (origin and not self._is_ours(origin[0], hosts)):
            return 403, "pages of that origin may not connect — allow it with --allow ORIGIN"
        if not any(hmac.compare_digest(given.encode(), self.token.encode()) for given in self._tokens(scope, headers)):
            return 401, "a token is needed — open the link that 'mien live' has printed"
        return 0, ""

    def _tokens(self, scope: Scope, headers: dict[str, list[str]]) -> list[str]:
        found = list(_query(scope).get("token", []))
        found += [value[7:] for value in headers.get("authorization", []) if value[:7].lower() == "bearer "]
        # Other servers of this machine may have put anything into theirs, which a strict reader takes for the end.
        for pair in ";".join(headers.get("cookie", [])).split(";"):
            name, _, value = pair.strip().partition("=")
            found += [value] if name == self.cookie else []
        return found

    def _is_ours(self, origin: str, hosts: set[str]) -> bool:
        scheme, _, host = origin.partition("://")
        return origin in self.origins or (scheme == "http" and _with_port(host) in hosts)

    async def _keep_token(self, scope: Scope, send: Send) -> None:
        """Put the token of a link into a cookie and take it out of the address, where it would be seen and kept."""
        rest = {name: values for name, values in _query(scope).items() if name != "token"}
        # A path that begins with two slashes would be another host.
        place = "/" + quote(scope["path"].lstrip("/")) + (f"?{urlencode(rest, doseq=True)}" if rest else "")
        cookie = f"{self.cookie}={self.token}; HttpOnly; SameSite=Strict; Path=/"
        headers = [(b"location", place.encode()), (b"set-cookie", cookie.encode())]
        await _answer(send, 303, "", headers)


def _own_address(scope: Scope) -> set[str]:
    """Where the connection has come to, as a host; of an address, unlike a name, nobody can say that it is another."""
    host, port = scope.get("server") or ("", None)
    return set() if port is None else {f"[{host}]:{port}" if ":" in host else f"{host}:{port}"}


def _with_port(host: str) -> str:
    """A host as it is in lists; browsers leave the usual port out."""
    return host if host.rpartition(":")[2].isdigit() else f"{host}:{USUAL_PORT}"


def _headers(scope: Scope) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for name, value in scope["headers"]:
        found.setdefault(name.decode("latin-1").lower(), []).append(value.decode("latin-1"))
    return found


def _query(scope: Scope) -> dict[str, list[str]]:
    return parse_qs(scope["query_string"].decode("latin-1"), keep_blank_values=True)


def _with_headers(send: Send) -> Send:
    async def sending(event: Event) -> None:
        if event["type"] == "http.response.start":
            event = {**event, "headers": [*event.get("headers", []), *SECURITY_HEADERS]}
        await send(event)

    return sending


async def _answer(send: Send, status: int, text: str, headers: Iterable[tuple[bytes, bytes]] = ()) -> None:
    body = f"{text}\n".encode() if text else b""
    own = [(b"content-type", b"text/plain; charset=utf-8"), (b"content-length", str(len(body)).encode())]
    start = {"type": "http.response.start", "status": status, "headers": [*own, *headers, *SECURITY_HEADERS]}
    await send(start)
    await send({"type": "http.response.body", "body": body})
