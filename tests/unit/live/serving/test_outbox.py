"""What waits for a client is bounded, and of pictures only the newest waits."""

import asyncio

import pytest

from mien.live.serving.outbox import MOST_BYTES, MOST_WAITING, WINDOW, Outbox


def watching():
    outbox = Outbox()
    outbox.frames = True
    return outbox


def take_all(outbox):
    found = []
    while (item := outbox.take()) is not None:
        found.append(item)
    return found


def test_of_pictures_only_the_newest_waits_and_a_window_is_on_its_way():
    outbox = watching()
    for loop in range(10):
        outbox.show(loop, b"%d" % loop)
    assert take_all(outbox) == [b"9"]
    outbox.show(10, b"10")
    assert take_all(outbox) == [b"10"]
    assert not outbox.open_for_pictures
    outbox.show(11, b"11")
    outbox.show(12, b"12")
    assert take_all(outbox) == []
    outbox.drawn(9)
    assert take_all(outbox) == [b"12"]
    outbox.drawn(12)
    assert outbox.open_for_pictures


def test_a_client_that_draws_nothing_gets_a_window_of_pictures_and_no_more():
    outbox, sent = watching(), []
    for loop in range(100_000):
        outbox.show(loop, bytes(10))
        sent += take_all(outbox)
    assert len(sent) == WINDOW


def test_answers_go_before_pictures_and_in_order():
    outbox = watching()
    outbox.show(1, b"picture")
    outbox.put("a")
    outbox.put(b"b")
    assert take_all(outbox) == ["a", b"b", b"picture"]


def test_after_a_new_setup_no_picture_of_before_counts():
    outbox = watching()
    for loop in range(WINDOW):
        outbox.show(loop, b"old")
        outbox.take()
    outbox.show(2, b"old")
    outbox.start_over()
    outbox.put(b"setup")
    outbox.show(3, b"new")
    assert take_all(outbox) == [b"setup", b"new"]


@pytest.mark.parametrize("item", ["x", b"x" * (MOST_BYTES // 8)])
def test_who_does_not_read_is_closed_and_holds_nothing(item):
    outbox = watching()
    for _ in range(MOST_WAITING):
        outbox.put(item)
        outbox.show(1, b"picture")
        assert len(outbox._waiting) <= MOST_WAITING
        assert outbox._bytes <= MOST_BYTES
    outbox.put(item)
    assert outbox.closed == "too much waits for being read"
    assert take_all(outbox) == []
    outbox.put("later")
    outbox.show(2, b"later")
    assert take_all(outbox) == []


def test_what_comes_wakes_who_waits_and_closing_ends_it():
    async def run():
        outbox = watching()
        waiting = asyncio.create_task(outbox.next())
        await asyncio.sleep(0)
        outbox.put("news")
        first = await waiting
        waiting = asyncio.create_task(outbox.next())
        closing = asyncio.create_task(outbox.wait_closed())
        await asyncio.sleep(0)
        outbox.close("enough")
        outbox.close("again")
        await closing
        return first, await waiting, outbox.closed

    assert asyncio.run(run()) == ("news", None, "enough")


def test_a_client_that_asked_for_no_pictures_gets_none():
    outbox = Outbox()
    outbox.show(1, b"picture")
    assert outbox.take() is None
    assert not outbox.open_for_pictures
