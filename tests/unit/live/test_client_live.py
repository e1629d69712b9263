"""Both kinds of client with a real server."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from itertools import islice
from typing import Any

import pytest

import mien
from fake_live import KINDS
from live_process import STILL, LiveProcess, live_process
from mien import MienError


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveProcess]:
    with live_process(tmp_path_factory.mktemp("run"), "--face", "toon:olav", "--idle", STILL) as running:
        yield running


@pytest.fixture(params=KINDS)
def face(request: pytest.FixtureRequest, server: LiveProcess) -> Iterator[Any]:
    with KINDS[request.param](server.link) as client:
        client.reset(over_ms=0)
        yield client


def test_finds_the_server_by_itself(server: LiveProcess, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("XDG_RUNTIME_DIR", "XDG_CACHE_HOME"):
        monkeypatch.setenv(name, server.environment[name])
    monkeypatch.delenv("MIEN_LINK", raising=False)
    with mien.Client() as face:
        assert face.link.place in server.link


def test_moves_and_reads_back(face: Any) -> None:
    face.move(MB=1)
    while face.state("MB")["MB"] < 1:
        pass
    face.send([{"kind": "reset", "over_ms": 0}, {"kind": "state"}])
    assert face.send([]) == []
    assert face.play("nod", strength=0.5)["loops"] > 1
    assert face.about()["face"] == "toon:olav"
    assert "smile" in face.about()["motions"]


def test_refusals_are_the_server_s_words(face: Any) -> None:
    with pytest.raises(MienError, match="unknown motion 'smlie' — did you mean 'smile'"):
        face.play("smlie")
    with pytest.raises(MienError, match="over_ms: -1 is out of range — it goes from 0 to 600000 ms"):
        face.move(ELU=1, over_ms=-1)
    with pytest.raises(MienError, match="want 0 to 100 of them, got 101"):
        face.send([{"kind": "state"}] * 101)


@pytest.mark.timeout(60)
def test_speech_has_words_and_an_end(face: Any) -> None:
    events = face.events()
    said = face.say_stream(iter(["Hi", " there.", " Bye."]), wait=True)
    assert not said.broken_off
    heard = [event["event"] for event in islice((event for event in events if event["id"] == said.id), 3)]
    assert heard == ["speech.started", "speech.word", "speech.word"]
    assert not face.say("Well.", wait=True).broken_off


@pytest.mark.timeout(60)
def test_somebody_else_can_break_it_off(face: Any, server: LiveProcess) -> None:
    with mien.Client(server.link) as other:
        events = other.events()

        def pieces() -> Iterator[str]:
            yield "This is a long story, which nobody wants to hear to its end. "
            while next(events)["event"] != "speech.started":
                pass
            other.interrupt()
            while next(events)["event"] != "speech.ended":
                pass
            for _ in range(1000):
                yield "And so on. "
            raise AssertionError("nobody told")

        assert face.say_stream(pieces()).broken_off


@pytest.mark.timeout(60)
def test_a_text_that_was_not_begun_is_broken_off_too(face: Any, server: LiveProcess) -> None:
    with mien.Client(server.link) as other:

        def pieces() -> Iterator[str]:
            yield "Half a sen"
            other.interrupt()
            yield "tence. "
            raise AssertionError("nobody told")

        assert face.say_stream(pieces()).broken_off


def test_a_server_that_ends_says_so(tmp_path: Any) -> None:
    async def talk(link: str) -> str:
        async with mien.AsyncClient(link) as face:
            await face.state()
            return str(await asyncio.gather(ended(face), return_exceptions=True))

    async def ended(face: mien.AsyncClient) -> None:
        running.process.terminate()
        async for _ in face.events():
            pass

    with live_process(tmp_path, "--no-voice", "--face", "toon:olav") as running:
        assert "the live face has gone" in asyncio.run(talk(running.link))
