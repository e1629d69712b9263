"""Ways around the lists of hosts and origins and the token, tried at the guard alone."""

import asyncio

import pytest

from mien.core import MienError
from mien.live.serving.guard import Guard
from mien.live.serving.server import Doors, allowed

TOKEN, PORT = "a-token-of-ours", 8765
IN = 299


def knock(*headers, doors=None, port=PORT, kind="http", method="GET", path="/about", query="", server="127.0.0.1"):
    """Status of the answer, ``IN`` where one is let in, and its headers."""
    sent, let_in = [], []

    async def app(scope, receive, send):
        let_in.append(scope)

    async def receive():
        return {"type": "websocket.connect"}

    async def send(event):
        sent.append(event)

    scope = {
        "type": kind,
        "method": method,
        "path": path,
        "query_string": query.encode(),
        "headers": [(name.encode(), value.encode("latin-1")) for name, value in headers],
        "server": (server, port),
    }
    guard = Guard(app, port, TOKEN, *allowed(doors or Doors(port=port), port))
    asyncio.run(guard(scope, receive, send))
    if let_in:
        return IN, {}
    return sent[0].get("status", 403), dict(sent[0].get("headers", []))


OURS = ("authorization", f"Bearer {TOKEN}")
HOST = ("host", "127.0.0.1:8765")


@pytest.mark.parametrize("host", ["127.0.0.1:8765", "LocalHost:8765", "[::1]:8765"])
def test_this_machine_goes_by_its_own_names(host):
    assert knock(("host", host), OURS)[0] == IN


@pytest.mark.parametrize(
    "host",
    [
        "",
        "127.0.0.1",
        "127.0.0.1:80",
        "127.0.0.1:8765.",
        "127.0.0.1.:8765",
        "user@127.0.0.1:8765",
        "127.0.0.1:8765@evil.example",
        "127.0.0.1:8765, evil.example",
        "localhost.evil.example:8765",
        "0.0.0.0:8765",
        "2130706433:8765",
        "::1:8765",
        "evil.example:8765",
    ],
)
def test_other_names_are_refused(host):
    assert knock(("host", host), OURS)[0] == 421


def test_a_host_that_is_missing_or_there_twice_is_refused():
    assert knock(OURS)[0] == 421
    assert knock(HOST, HOST, OURS)[0] == 421
    assert knock(HOST, ("host", "evil.example"), OURS)[0] == 421


@pytest.mark.parametrize(
    "origin",
    [
        "null",
        "",
        "http://127.0.0.1:8766",
        "http://127.0.0.1",
        "https://127.0.0.1:8765",
        "http://127.0.0.1:8765/",
        "http://127.0.0.1:8765.evil.example",
        "http://127.0.0.1:8765@evil.example",
        "ftp://127.0.0.1:8765",
        "127.0.0.1:8765",
    ],
)
@pytest.mark.parametrize("kind", ["http", "websocket"])
def test_pages_of_other_origins_are_refused_even_with_the_token(origin, kind):
    assert knock(HOST, OURS, ("origin", origin), kind=kind)[0] == 403


def test_two_origins_are_none():
    ours = ("origin", "http://127.0.0.1:8765")
    assert knock(HOST, OURS, ours)[0] == IN
    assert knock(HOST, OURS, ours, ours)[0] == 403


@pytest.mark.parametrize(
    ("headers", "query"),
    [
        ([("authorization", TOKEN)], ""),
        ([("authorization", "Basic " + TOKEN)], ""),
        ([("authorization", "Bearer ")], ""),
        ([("authorization", f"Bearer {TOKEN}x")], ""),
        ([("authorization", "Bearer \xe9")], ""),
        ([("cookie", f"mien_8766={TOKEN}")], ""),
        ([("cookie", f"xmien_8765={TOKEN}")], ""),
        ([("cookie", "mien_8765=")], ""),
        ([], "token="),
        ([], "token=%ff%00"),
        ([], f"Token={TOKEN}"),
    ],
)
@pytest.mark.parametrize("method", ["GET", "HEAD", "OPTIONS", "POST"])
def test_without_the_token_no_method_comes_in(headers, query, method):
    assert knock(HOST, *headers, method=method, query=query)[0] == 401


def test_the_token_may_be_in_the_link_of_a_socket_or_of_a_request():
    assert knock(HOST, kind="websocket", query=f"token={TOKEN}")[0] == IN
    assert knock(HOST, method="POST", query=f"token={TOKEN}")[0] == IN


@pytest.mark.parametrize("other", ['{"a": [1, "b;c"]}', "a=b=c", "\xe9", "=", 'q="open', ""])
def test_cookies_of_other_servers_on_this_machine_do_not_hide_ours(other):
    assert knock(HOST, ("cookie", f"{other}; mien_8765={TOKEN}; {other}"))[0] == IN
    assert knock(HOST, ("cookie", other), ("cookie", f"mien_8765={TOKEN}"))[0] == IN


@pytest.mark.parametrize(
    "path",
    [
        "//evil.example/",
        "/\\evil.example/",
        "/\t/evil.example",
        "http://evil.example/",
        "/a\r\nset-cookie: b=c",
        "/é漢",
    ],
)
def test_a_link_never_leads_elsewhere(path):
    status, headers = knock(HOST, path=path, query=f"token={TOKEN}&mute=1")
    place = headers[b"location"].decode("ascii")
    assert status == 303
    assert place.endswith("?mute=1")
    assert place[0] == "/"
    assert place[1] not in "/\\"
    assert not set(place) & set("\\\r\n\t")


@pytest.mark.parametrize("host", ["127.0.0.2", "::1", "192.0.2.7", "face.example"])
def test_the_link_of_any_host_is_let_in(host):
    doors = Doors(host, PORT)
    place = doors.link(PORT).split("/")[2]
    assert knock(("host", place), OURS, ("origin", f"http://{place}"), doors=doors)[0] == IN


def test_who_listens_everywhere_is_reached_by_the_address_that_a_connection_has_come_to():
    doors = Doors("0.0.0.0", PORT)
    own = ("host", "192.0.2.7:8765")
    assert knock(own, OURS, ("origin", "http://192.0.2.7:8765"), doors=doors, server="192.0.2.7")[0] == IN
    assert knock(own, OURS, doors=doors, server="192.0.2.8")[0] == 421
    assert knock(own, OURS, ("origin", "http://192.0.2.8:8765"), doors=doors, server="192.0.2.7")[0] == 403
    assert knock(("host", "[2001:db8::7]:8765"), OURS, doors=Doors("::", PORT), server="2001:db8::7")[0] == IN


def test_browsers_leave_the_usual_port_out():
    assert knock(("host", "127.0.0.1"), OURS, ("origin", "http://127.0.0.1"), port=80)[0] == IN
    assert knock(("host", "localhost:80"), OURS, port=80)[0] == IN


def test_names_and_origins_that_are_allowed_come_in():
    doors = Doors(port=PORT, allow=("Kiosk.lan", "robot.lan:9000", "http://localhost:3000", "https://face.example"))
    assert knock(("host", "kiosk.lan:8765"), OURS, ("origin", "http://kiosk.lan:8765"), doors=doors)[0] == IN
    assert knock(("host", "robot.lan:9000"), OURS, doors=doors)[0] == IN
    assert knock(HOST, OURS, ("origin", "http://localhost:3000"), doors=doors)[0] == IN
    assert knock(("host", "localhost:3000"), OURS, doors=doors)[0] == 421
    assert knock(("host", "face.example"), OURS, ("origin", "https://face.example"), doors=doors)[0] == IN


@pytest.mark.parametrize("wrong", ["", "*", "http://", "a b", "http://x/path", "https://*.example", "http://a@b"])
def test_what_cannot_be_a_name_is_not_allowed(wrong):
    with pytest.raises(MienError, match="--allow"):
        allowed(Doors(allow=(wrong,)), PORT)
