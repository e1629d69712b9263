"""Links to a live face, as ``mien live`` prints them: ``http://127.0.0.1:8765/?token=…``."""

from __future__ import annotations

from dataclasses import dataclass, field
from urllib.parse import parse_qs, urlsplit

from mien.core import MienError

DEFAULT_PORT = 8765
SCHEMES = {"http": False, "ws": False, "https": True, "wss": True}
"""What a link may begin with, and whether it is encrypted."""


@dataclass(frozen=True)
class Link:
    """A link in parts.

    Attributes:
        host: name or address, without brackets.
        port: of the page.
        token: what a client must know; empty if the link does not tell.
        secure: whether it goes through a proxy with HTTPS.
    """

    host: str
    port: int
    token: str = field(default="", repr=False)
    secure: bool = False

    @property
    def place(self) -> str:
        """Host and port."""
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"

    @property
    def socket(self) -> str:
        """Address of the WebSocket."""
        return f"{'wss' if self.secure else 'ws'}://{self.place}/live"

    @property
    def headers(self) -> dict[str, str]:
        """What lets a client in that is no browser."""
        return {"Authorization": f"Bearer {self.token}"}


def parse_link(text: str) -> Link:
    """The parts of a link; ``http://`` can be left out.

    Raises:
        MienError: it is none.
    """
    wanted = "as in http://127.0.0.1:8765/?token=…, which 'mien live' prints"
    try:
        parts = urlsplit(text if "://" in text else f"http://{text}")
        port = parts.port
    except ValueError as error:
        raise MienError(f"{text!r} is no link ({error}) — {wanted}") from None
    if parts.scheme not in SCHEMES or not parts.hostname:
        raise MienError(f"{text!r} is no link — {wanted}")
    secure = SCHEMES[parts.scheme]
    token = parse_qs(parts.query).get("token", [""])[0]
    return Link(parts.hostname, port or (443 if secure else DEFAULT_PORT), token, secure)
