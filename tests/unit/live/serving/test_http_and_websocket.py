"""WebSocket and HTTP in front of a running face."""

import asyncio
import base64
import json
import struct
from contextlib import suppress

import pytest
from live_server import answer, live_server, request
from websockets.exceptions import ConnectionClosed, InvalidStatus

from mien.live.serving.outbox import WINDOW
from mien.live.wire import FRAME, HEADER, SETUP


def send(messages, **more):
    async def run():
        async with live_server(**more) as live, live.socket() as socket:
            answers = []
            for message in messages:
                await socket.send(message if isinstance(message, str | bytes) else json.dumps(message))
                answers.append(json.loads(await answer(socket)))
            return answers

    return asyncio.run(run())


def test_messages_are_answered_one_by_one_and_in_batches():
    first, second, third = send(
        [
            {"kind": "move", "values": {"jaw.rotation": 5}, "id": "a"},
            [{"kind": "play", "motion": "smile"}, {"kind": "play", "motion": "smirkle"}],
            {"kind": "state", "names": ["jaw.rotation"]},
        ]
    )
    assert first == {"kind": "ok", "id": "a"}
    assert [reply["kind"] for reply in second] == ["ok", "error"]
    assert "smirk" in second[1]["message"]
    assert third["kind"] == "state"
    assert third["values"].keys() == {"jaw.rotation"}


@pytest.mark.parametrize(
    ("message", "words"),
    [
        ("{", "no JSON"),
        ("[" * 5000, "nested too deeply"),
        ("NaN", "no number"),
        ("17", "want an object"),
        ('{"kind": "move", "values": {"jaw.rotation": NaN}}', "NaN is no number"),
        (json.dumps([{"kind": "state"}] * 101), "0 to 100"),
        (b"", "binary message of 0 bytes"),
        (b"\x09abc", "type 9"),
        (b"\x02\0\0\0" + struct.pack("<I", 7), "out of range"),
        ({"kind": "report", "drawn_fps": "many"}, "want a number"),
        ({"kind": "subscribe", "pictures": True}, "pictures"),
        ({"kind": "speech.pcm", "rate_hz": 16000, "data": "*"}, "no base64"),
        ({"kind": "speech.pcm", "rate_hz": 16000, "data": base64.b64encode(b"abc").decode()}, "16-bit"),
    ],
)
def test_what_cannot_be_understood_is_answered_and_the_client_stays(message, words):
    refused, after = send([message, {"kind": "state"}])
    assert refused["kind"] == "error"
    assert words in refused["message"]
    assert after["kind"] == "state"


def test_a_window_of_pictures_is_sent_and_the_newest_follows_when_they_are_drawn():
    async def run():
        async with live_server() as live, live.socket() as socket:
            await socket.send(json.dumps({"kind": "subscribe", "frames": True}))
            kinds, loops = [], []

            async def picture():
                while True:
                    message = await asyncio.wait_for(socket.recv(), 10)
                    if isinstance(message, bytes):
                        kind, _, _, loop, _ = HEADER.unpack_from(message)
                        kinds.append(kind)
                        return loop

            await picture()
            loops += [await picture() for _ in range(WINDOW)]
            start = live.animator.session.loop
            while live.animator.session.loop < start + 6:
                await asyncio.sleep(0.01)
            await socket.send(struct.pack("<BBHI", 1, 0, 1, loops[-1]))
            loops.append(await picture())
            return kinds, loops, start

    kinds, loops, start = asyncio.run(run())
    assert kinds == [SETUP] + [FRAME] * (WINDOW + 1)
    assert loops == sorted(loops)
    assert loops[-1] >= start + 3  # not what was newest then, but what is now


def test_events_go_to_those_who_asked():
    say = {"kind": "say", "text": "Ma", "phones": [[0.0, 0.1, "M"], [0.1, 0.2, "AA1"]], "id": "7"}

    async def run():
        async with live_server() as live, live.socket() as asks, live.socket() as does_not:
            await asks.send(json.dumps({"kind": "subscribe", "events": True}))
            await answer(asks)
            await does_not.send(json.dumps(say))
            events = [json.loads(await answer(asks)) for _ in range(2)]
            await does_not.send(json.dumps({"kind": "state"}))
            return events, [json.loads(await answer(does_not))["kind"] for _ in range(2)]

    events, others = asyncio.run(run())
    assert [event["event"] for event in events] == ["speech.started", "speech.ended"]
    assert all(event["id"] == "7" and event["loop"] >= 0 for event in events)
    assert others == ["ok", "state"]


def test_posted_messages_are_answered():
    async def run():
        async with live_server() as live:
            headers = {"Authorization": f"Bearer {live.doors.token}"}

            async def post(body):
                found = await request(live.port, "/messages", method="POST", headers=headers, body=body)
                return found.status, json.loads(found.body)

            return [
                await post(b'{"kind": "play", "motion": "nod"}'),
                await post(b'[{"kind": "state", "names": ["jaw.rotation"]}]'),
                await post(b'{"kind": "subscribe", "events": true}'),
                await post(b"\xff\xfe"),
                await post(b" " * 1_000_001),
            ]

    (played, found), (listed, states), (refused, subscribe), (garbled, _), (large, _) = asyncio.run(run())
    assert (played, found["kind"]) == (200, "ok")
    assert (listed, states[0]["kind"]) == (200, "state")
    assert (refused, subscribe["kind"]) == (400, "error")
    assert (garbled, large) == (400, 413)


def test_a_server_tells_of_itself_and_of_what_pages_have_measured():
    async def run():
        async with live_server() as live, live.socket() as socket:
            await socket.send(json.dumps({"kind": "report", "drawn_fps": 59.5, "offset_p95_ms": 12}))
            await answer(socket)
            headers = {"Authorization": f"Bearer {live.doors.token}"}
            about = json.loads((await request(live.port, "/about", headers=headers)).body)
            rows = json.loads((await request(live.port, "/parameters", headers=headers)).body)
            return about, rows

    about, rows = asyncio.run(run())
    assert about["face"] == rows["face"] == "head"
    assert about["clients"][0]["drawn_fps"] == 59.5
    assert about["loops"]["run"] >= 0
    assert "smile" in about["motions"]
    assert rows["parameters"][0].keys() >= {"name", "low", "high", "default", "unit", "doc"}


@pytest.mark.parametrize(
    ("status", "headers"),
    [
        (401, {}),
        (401, {"Authorization": "Bearer wrong"}),
        (401, {"Cookie": "mien_1=TOKEN"}),
        (421, {"Authorization": "Bearer TOKEN", "Host": "evil.example"}),
        (421, {"Authorization": "Bearer TOKEN", "Host": "127.0.0.1"}),
        (403, {"Authorization": "Bearer TOKEN", "Origin": "http://evil.example"}),
        (403, {"Authorization": "Bearer TOKEN", "Origin": "null"}),
        (200, {"Authorization": "Bearer TOKEN"}),
        (200, {"Authorization": "Bearer TOKEN", "Origin": "http://127.0.0.1:PORT"}),
        (200, {"Cookie": "other=1; mien_PORT=TOKEN"}),
    ],
)
def test_only_those_who_know_the_token_come_in_and_only_by_our_name(status, headers):
    async def run():
        async with live_server() as live:
            filled = {
                name: value.replace("TOKEN", live.doors.token).replace("PORT", str(live.port))
                for name, value in headers.items()
            }
            http = (await request(live.port, "/about", headers=filled)).status
            try:
                async with live.socket(additional_headers=filled if "Host" not in filled else {}) as socket:
                    await socket.ping()
                    return http, 101
            except InvalidStatus as error:
                return http, error.response.status_code

    http, socket = asyncio.run(run())
    assert http == status
    assert socket == (101 if status == 200 else 403)


def test_the_link_hands_its_token_to_a_cookie_and_out_of_sight():
    async def run():
        async with live_server() as live:
            path = f"/?token={live.doors.token}&mute=1"
            sent = await request(live.port, path)
            cookie = sent.headers["set-cookie"].split(";")[0]
            away = await request(live.port, f"//evil.example/?token={live.doors.token}")
            return sent, away, await request(live.port, "/about", headers={"Cookie": cookie})

    sent, away, about = asyncio.run(run())
    assert (sent.status, sent.headers["location"]) == (303, "/?mute=1")
    assert "HttpOnly" in sent.headers["set-cookie"]
    assert "SameSite=Strict" in sent.headers["set-cookie"]
    assert away.headers["location"] == "/evil.example/"
    assert about.status == 200
    assert "default-src 'none'" in about.headers["content-security-policy"]


@pytest.mark.parametrize(
    "path", ["/page/../session.py", "/page/%2e%2e%2fsession.py", "/page/..%5csession.py", "/page/", "/page/x.py", "//"]
)
def test_no_path_leads_out_of_the_page(path):
    async def run():
        async with live_server() as live:
            headers = {"Authorization": f"Bearer {live.doors.token}"}
            return (await request(live.port, path, headers=headers)).status

    assert asyncio.run(run()) == 404


def test_a_message_that_is_too_large_ends_its_connection_and_no_other():
    async def run():
        async with live_server() as live, live.socket() as good, live.socket() as bad:
            with suppress(ConnectionClosed):
                await bad.send(" " * 5_000_000)
            with pytest.raises(ConnectionClosed):
                await bad.recv()
            await good.send(json.dumps({"kind": "state"}))
            return bad.close_code, json.loads(await answer(good))["kind"]

    assert asyncio.run(run()) == (1009, "state")
