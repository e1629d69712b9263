"""The loop under asyncio, with a clock that the test turns."""

import asyncio
import json

import pytest
from live_server import STILL, Plain

from mien.core import MienError
from mien.live import CATCH_UP, Session
from mien.live.serving.animator import MOST_CLIENTS, SHARE, Animator
from mien.live.serving.outbox import Outbox
from support import face


class Clock:
    """Time that passes by sleeping, and by what a test says that work takes."""

    def __init__(self):
        self.now_s = 100.0

    def now(self):
        return self.now_s

    async def sleep(self, seconds):
        self.now_s += seconds
        await asyncio.sleep(0)


def make(clock=None, encoder=None, loop_s=1 / 60):
    clock = clock or Clock()
    session = Session(face("head"), loop_s, idle=STILL)
    return Animator(session, encoder or Plain(), clock=clock.now, sleep=clock.sleep), clock


def run_for(animator, clock, seconds, meanwhile=None):
    async def run():
        work = [asyncio.create_task(animator.run())]
        if meanwhile is not None:
            work.append(asyncio.create_task(meanwhile()))
        end = clock.now_s + seconds
        while clock.now_s < end:
            await asyncio.sleep(0)
        for task in work:
            task.cancel()
        await asyncio.gather(*work, return_exceptions=True)

    asyncio.run(run())


def test_two_minutes_drift_by_nothing():
    animator, clock = make()
    run_for(animator, clock, 120.0)
    assert animator.session.loop == pytest.approx(7_200, abs=2)
    assert (animator.report.late, animator.report.dropped) == (0, 0)


def test_late_loops_are_caught_up_and_counted_and_clients_see_the_newest():
    animator, clock = make()
    outbox = Outbox()
    outbox.frames = True
    animator.join(outbox)
    slow = iter([0.06] + [0.0] * 1000)
    animator.on_frame(lambda frame: setattr(clock, "now_s", clock.now_s + next(slow)))
    run_for(animator, clock, 0.5)
    assert 1 <= animator.report.late <= CATCH_UP
    assert animator.report.worst_s >= 0.04


def test_messages_get_their_share_of_a_loop_and_no_more():
    animator, clock = make()
    handled = []

    async def flood():
        while True:
            await animator.turn()
            animator.handle({"kind": "state", "names": ["jaw.rotation"]})
            animator._spent += 0.002  # what it would take
            handled.append(animator.session.loop)

    run_for(animator, clock, 1.0, flood)
    busiest = max(handled.count(loop) for loop in set(handled))
    assert busiest <= SHARE * animator.session.loop_s / 0.002 + 2
    assert len(set(handled)) > 50
    assert animator.session.loop >= 59


def test_nobody_draws_what_nobody_sees():
    class Counting(Plain):
        drawn = 0

        def encode(self, frame):
            self.drawn += 1
            return super().encode(frame)

    encoder = Counting()
    animator, clock = make(encoder=encoder)
    outbox = Outbox()
    animator.join(outbox)
    run_for(animator, clock, 1.0)
    assert encoder.drawn == 0
    animator.handle({"kind": "subscribe", "frames": True}, outbox)
    run_for(animator, clock, 1.0)
    assert encoder.drawn == pytest.approx(60, abs=2)


def test_a_new_setup_goes_to_those_who_watch_before_its_pictures():
    class Changing(Plain):
        number = 1

        def encode(self, frame):
            self.number = 1 + frame.loop // 3
            return b"picture %d" % self.number

        @property
        def setup(self):
            return b"setup %d" % self.number

    animator, clock = make(encoder=Changing())
    outbox = Outbox()
    animator.join(outbox)
    animator.handle({"kind": "subscribe", "frames": True}, outbox)
    seen = []

    async def read():
        while True:
            seen.append(await outbox.next())
            outbox.drawn(animator.session.loop)

    run_for(animator, clock, 0.4, read)
    current = b""
    for item in seen:
        kind, number = item.split()
        if kind == b"setup":
            current = number
        assert number == current
    assert len(set(seen)) > 6


def test_there_is_an_end_to_clients():
    animator, _ = make()
    outboxes = [Outbox() for _ in range(MOST_CLIENTS)]
    for outbox in outboxes:
        animator.join(outbox)
    with pytest.raises(MienError, match="no more are let in"):
        animator.join(Outbox())
    animator.leave(outboxes[3])
    animator.join(Outbox())


def test_what_is_about_a_connection_needs_one():
    animator, _ = make()
    for message in ({"kind": "subscribe", "events": True}, {"kind": "report"}):
        assert animator.handle(message)["kind"] == "error"


def test_answers_to_garbage_are_json():
    animator, _ = make()
    for data in (b"", b"\xff", "[[]]", "[{}]", '{"kind": []}', '{"kind": "state", "id": "' + "x" * 300 + '"}', "[]"):
        answers = json.loads(animator.handle_text(data))
        for answer in answers if isinstance(answers, list) else [answers]:
            assert answer["kind"] == "error"
