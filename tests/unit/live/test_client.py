"""Both kinds of client against a server that answers as it is told."""

from __future__ import annotations

import asyncio
import inspect
import subprocess
import sys
from collections.abc import AsyncIterator, Callable, Iterator
from threading import Event as Flag
from threading import Thread
from typing import Any

import numpy as np
import pytest

from fake_live import KINDS, OK, TOKEN, fake_server
from mien import AsyncClient, Client, MienError
from mien.live import KINDS as MESSAGES
from mien.live import Session, check_message
from mien.live.reaching import choose_link

Make = Callable[..., Any]


@pytest.fixture(params=KINDS)
def connect(request: pytest.FixtureRequest) -> Make:
    return KINDS[request.param]


def event(name: str, identity: str, **rest: Any) -> dict[str, Any]:
    return {"kind": "event", "event": f"speech.{name}", "id": identity, **rest}


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda face: face.move({"jaw.rotation": np.float32(8)}, over_ms=300, ELU=0.5),
            {"kind": "move", "values": {"jaw.rotation": 8.0, "ELU": 0.5}, "over_ms": 300},
        ),
        (lambda face: face.move(ELU=1, change="cosine", layer="expression"), None),
        (lambda face: face.play("smile", strength=0.8), {"kind": "play", "motion": "smile", "strength": 0.8}),
        (lambda face: face.look("left"), {"kind": "look", "at": "left"}),
        (lambda face: face.look(np.array([0.1, 0, 0.5]), head=0), {"kind": "look", "at": [0.1, 0, 0.5], "head": 0}),
        (lambda face: face.target("cup", (0, 0, 1)), {"kind": "target", "name": "cup", "at": [0, 0, 1]}),
        (lambda face: face.stop(), {"kind": "stop"}),
        (lambda face: face.stop("gaze", over_ms=0), {"kind": "stop", "layer": "gaze", "over_ms": 0}),
        (lambda face: face.interrupt(), {"kind": "interrupt"}),
        (lambda face: face.reset(), {"kind": "reset"}),
        (lambda face: face.idle(blinks=0, sway=0.5), {"kind": "idle", "blinks": 0, "sway": 0.5}),
        (lambda face: face.say("Hello.", id="1"), {"kind": "say", "text": "Hello.", "id": "1"}),
        (lambda face: face.send({"kind": "state"}), {"kind": "state"}),
        (
            lambda face: face.hear([0.0, 1.0, -0.5], 16_000),
            {"kind": "speech.pcm", "rate_hz": 16_000, "data": "AAD/fwDA"},
        ),
        (
            lambda face: face.hear(np.array([1, -2], np.int16), 8_000),
            {"kind": "speech.pcm", "rate_hz": 8000, "data": "AQD+/w=="},
        ),
    ],
)
def test_calls_are_messages(connect: Make, call: Callable[[Any], Any], message: Any) -> None:
    with fake_server() as server, connect(server.link) as face:
        call(face)
        (sent,) = server.received
        checked = check_message(sent)
        assert message is None or checked == check_message(message)


def test_defaults_are_those_of_the_table() -> None:
    for name in ("move", "play", "look", "stop", "reset"):
        defaults = {field.name: field.default for field in MESSAGES[name].fields}
        for parameter in inspect.signature(getattr(Client, name)).parameters.values():
            if parameter.kind is parameter.KEYWORD_ONLY:
                assert parameter.default == defaults[parameter.name]


def test_both_kinds_can_do_the_same() -> None:
    names = {name for name in dir(Client) if not name.startswith("_")}
    assert names == {name for name in dir(AsyncClient) if not name.startswith("_")} - {"open"}
    for name in names - {"close"}:
        assert set(inspect.signature(getattr(Client, name)).parameters) == set(
            inspect.signature(getattr(AsyncClient, name)).parameters
        )


def test_every_kind_of_message_has_a_call() -> None:
    assert {name for name in MESSAGES if not MESSAGES[name].connection} <= set(dir(Client))


def test_a_session_answers(connect: Make) -> None:
    from mien import load_face

    session = Session(load_face("toon:olav"), idle=dict.fromkeys(("blinks", "saccades", "breathing", "sway"), 0.0))

    def reply(value: Any) -> list[Any]:
        answers = [session.handle(each) for each in (value if isinstance(value, list) else [value])]
        session.step()
        return [answers if isinstance(value, list) else answers[0]]

    with fake_server(reply) as server, connect(server.link) as face:
        assert face.move(ELU=0.25) == OK
        assert face.state("ELU") == {"ELU": pytest.approx(0.25)}
        assert face.send([{"kind": "reset", "id": "a"}, {"kind": "state", "id": "b"}])[0] == {"kind": "ok", "id": "a"}
        with pytest.raises(MienError, match="unknown motion 'smiel' — did you mean 'smile'"):
            face.play("smiel")
        with pytest.raises(MienError, match=r"1 of 2 messages were refused; message 1: .*'kind'"):
            face.send([{"kind": "state"}, {}])
        assert face.send([]) == []
        assert face.about() == {"face": "nobody"}


def test_what_is_no_message_is_not_sent(connect: Make) -> None:
    with fake_server() as server, connect(server.link) as face:
        for call in (
            lambda: face.move(ELU=float("nan")),
            lambda: face.send({"kind": "say", "text": object()}),
            lambda: face.hear(np.zeros((2, 2)), 8_000),
            lambda: face.hear([1, 2], 8_000),
            lambda: face.hear(np.zeros(8_001), 8_000),
        ):
            with pytest.raises(MienError):
                call()
        assert server.received == []


def test_answers_find_their_calls_among_events_and_pictures(connect: Make) -> None:
    def reply(message: Any) -> list[Any]:
        return [b"\x02picture", event("word", "x"), {"kind": "ok", "id": message["id"]}, event("word", "y")]

    with fake_server(reply) as server, connect(server.link) as face:
        for number in range(20):
            assert face.send({"kind": "reset", "id": str(number)})["id"] == str(number)


def test_waits_until_it_has_been_said(connect: Make) -> None:
    def reply(message: Any) -> list[Any]:
        other = [event("ended", "other", broken_off=False, more=False), event("failed", "other", message="no")]
        mine = [event("started", "me"), event("ended", "me", broken_off=False, more=True), event("started", "me")]
        mine.append(event("failed", "me", message="a sentence is passed over", more=True))
        return [OK, *other, *mine, event("ended", "me", broken_off=message["text"] == "Long.", more=False)]

    with fake_server(reply) as server, connect(server.link) as face:
        assert face.say("One. Two.", wait=True, id="me").broken_off is False
        assert face.say("Long.", wait=True, id="me").broken_off is True
        first, second = face.say("a"), face.say("b")
        assert first.id != second.id


def test_what_fails_is_raised(connect: Make) -> None:
    def reply(message: Any) -> list[Any]:
        return [OK, event("failed", message["id"], message="no voice knows this")]

    with fake_server(reply) as server, connect(server.link) as face:
        with pytest.raises(MienError, match="could not be said: no voice knows this"):
            face.say("Hm.", wait=True)
        with pytest.raises(MienError, match="could not be said: no voice knows this"):
            face.say_stream(["Hm", "."], wait=True)


def test_streamed_text_goes_out_as_it_comes(connect: Make) -> None:
    def pieces() -> Iterator[str]:
        for number, piece in enumerate(("Hel", "lo ", "there. ", "Bye.")):
            assert len(server.said) == number
            yield piece

    with fake_server() as server, connect(server.link) as face:
        said = face.say_stream(pieces())
        assert server.said == [("Hel", True), ("lo ", True), ("there. ", True), ("Bye.", True), ("", False)]
        assert {each.get("id", said.id) for each in server.received} == {said.id}
        assert not said.broken_off
        face.say_stream("All at once.")
        assert server.said[5:] == [("All at once.", True), ("", False)]


def test_text_from_an_asynchronous_generator() -> None:
    async def pieces() -> AsyncIterator[str]:
        for piece in ("One. ", "Two."):
            await asyncio.sleep(0)
            yield piece

    async def talk() -> None:
        async with AsyncClient(server.link) as face:
            await face.say_stream(pieces())

    with fake_server() as server:
        asyncio.run(talk())
        assert server.said == [("One. ", True), ("Two.", True), ("", False)]


def test_nothing_is_sent_behind_an_interruption() -> None:
    def pieces() -> Iterator[str]:
        yield "Hello. "
        thread = Thread(target=face.interrupt)
        thread.start()
        thread.join()
        yield "More."
        raise AssertionError("no more is asked for")

    with fake_server() as server, Client(server.link) as face:
        assert face.say_stream(pieces()).broken_off
        assert [each["kind"] for each in server.received] == ["subscribe", "say", "interrupt"]


def test_nothing_is_sent_behind_an_interruption_under_asyncio() -> None:
    async def talk() -> bool:
        async with AsyncClient(server.link) as face:

            async def pieces() -> AsyncIterator[str]:
                yield "Hello. "
                await face.interrupt()
                yield "More."
                raise AssertionError("no more is asked for")

            return (await face.say_stream(pieces())).broken_off

    with fake_server() as server:
        assert asyncio.run(talk())
        assert [each["kind"] for each in server.received] == ["subscribe", "say", "interrupt"]


def test_an_interruption_by_somebody_else_ends_a_stream(connect: Make) -> None:
    def reply(message: Any) -> list[Any]:
        return [event("ended", message["id"], broken_off=True, more=True), OK]

    with fake_server(reply) as server, connect(server.link) as face:
        said = face.say_stream(["Hello. ", "More."])
        assert said.broken_off
        assert server.said == [("Hello. ", True)]


@pytest.mark.parametrize(
    ("message", "breaks"),
    [
        ({"kind": "interrupt"}, True),
        ({"kind": "reset"}, True),
        ({"kind": "stop"}, True),
        ({"kind": "stop", "layer": "speech"}, True),
        ([{"kind": "play", "motion": "nod"}, {"kind": "interrupt"}], True),
        ({"kind": "stop", "layer": "gaze"}, False),
        ({"kind": "play", "motion": "nod"}, False),
    ],
)
def test_what_breaks_speech_off_lets_go_who_waits(message: Any, breaks: bool) -> None:
    # The server's own rule is the same.
    assert (
        any(check_message(each).ends_speech for each in ([message] if isinstance(message, dict) else message)) == breaks
    )
    waiting = Flag()

    def reply(value: Any) -> list[Any]:
        if isinstance(value, dict) and value["kind"] == "say":
            waiting.set()
        return [[OK, OK] if isinstance(value, list) else OK]

    with fake_server(reply) as server, Client(server.link) as face:
        outcomes: list[Any] = []
        thread = Thread(target=lambda: outcomes.append(face.say("Well.", wait=True, id="me")))
        thread.start()
        assert waiting.wait(10)
        face.send(message)
        if not breaks:
            assert thread.is_alive()
            server.tell(event("ended", "me", broken_off=False, more=False))
        thread.join()
        assert outcomes[0].broken_off is breaks


def test_events_come_until_the_client_is_closed() -> None:
    with fake_server(lambda message: [OK, event("word", message["id"], word="hi")]) as server:
        with Client(server.link) as face:
            events = face.events()
            for number in range(3):
                face.send({"kind": "say", "text": "hi", "id": str(number)})
            assert [next(events)["id"] for _ in range(3)] == ["0", "1", "2"]
        assert list(events) == []
    with pytest.raises(MienError, match="this client is closed — make a new one"):
        face.play("nod")


def test_a_lost_server_is_told_to_everybody_who_waits(connect: Make) -> None:
    waiting = Flag()

    def reply(message: Any) -> list[Any]:
        if message["kind"] == "say":
            waiting.set()
        else:
            server.connections[0].close(1008, "too much waits for being read")
        return [OK]

    with fake_server(reply) as server, connect(server.link) as face:
        outcomes: list[str] = []

        def wait() -> None:
            try:
                face.say("Well.", wait=True)
            except MienError as error:
                outcomes.append(str(error))

        thread = Thread(target=wait)
        thread.start()
        assert waiting.wait(10)
        for call in (
            lambda: face.play("nod"),
            lambda: face.play("nod"),
            lambda: face.say_stream(["Hello."]),
            lambda: next(face.events()),
        ):
            with pytest.raises(MienError, match=r"has gone \(too much waits for being read\) — start it again with"):
                call()
        thread.join()
        assert len(outcomes) == 1
        assert "has gone (too much" in outcomes[0]


def test_who_cannot_come_in_is_told_why(connect: Make) -> None:
    with fake_server() as server:
        place = server.link.removeprefix("http://").partition("/")[0]
        with pytest.raises(MienError, match=r"refuses this client.* every start of 'mien live' has another token"):
            connect(server.link, token="another")
        with connect(place, token=TOKEN) as face:
            assert face.play("nod") == OK
    with pytest.raises(MienError, match=f"{place}: no live face answers .*'mien live' starts one"):
        connect(server.link)


def test_what_is_no_live_face_is_told(connect: Make) -> None:
    with (
        fake_server(lambda message: ['"hello"']) as server,
        connect(server.link) as face,
        pytest.raises(MienError, match="is no live face of mien"),
    ):
        face.play("nod")


def test_links_come_from_the_argument_the_environment_or_the_server_that_runs(tmp_path: Any) -> None:
    empty = {"XDG_RUNTIME_DIR": str(tmp_path)}
    assert choose_link("http://localhost:9/?token=abc", None, {"MIEN_LINK": "nonsense:"}).token == "abc"
    found = choose_link(None, None, {"MIEN_LINK": "https://face.example/?token=abc"})
    assert (found.socket, found.headers) == ("wss://face.example:443/live", {"Authorization": "Bearer abc"})
    assert choose_link("[::1]", "abc", empty).socket == "ws://[::1]:8765/live"
    assert "abc" not in repr(found)
    for link, words in (
        (None, "no server of yours runs here"),
        ("http://localhost:9/", "the link has no token"),
        ("ftp://localhost", "is no link"),
        ("http://localhost:port/", "is no link"),
        ("http://[::1/", "is no link"),
        ("http:///?token=a", "is no link"),
    ):
        with pytest.raises(MienError, match=words):
            choose_link(link, None, empty)


def test_the_environment_is_that_of_the_process(monkeypatch: pytest.MonkeyPatch) -> None:
    with fake_server() as server:
        monkeypatch.setenv("MIEN_LINK", server.link)
        with Client() as face:
            assert face.play("nod") == OK


def test_importing_mien_imports_no_client() -> None:
    code = "import mien, sys; assert not {'mien.live', 'websockets', 'asyncio'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
