"""Who speaks: order, parts of texts, what is cancelled, bounds; by a voice that hums, in no process of its own."""

import asyncio
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pytest

from mien.core import Cue, MienError
from mien.live import Session, check_message, read_log, replay
from mien.live.sentences import LEAD_S
from mien.live.serving.speaker import AHEAD_S, MOST_CHARACTERS, MOST_WAITING, Failure, Part, Speaker
from mien.live.serving.speaking_process import StoppedError
from mien.live.serving.speaking_worker import Cued, Setup, make
from mien.live.streams import SILENCE_S
from mien.speech import Utterance
from support import face

RATE_HZ = 1000
PHONES = [[0.0, 0.1, "HH"], [0.1, 0.6, "AH0"]]


@dataclass(frozen=True)
class Hum:
    """A tenth of a second for each letter; snowmen are skipped."""

    name: str = "hum"
    language: str = "en-US"
    description: str = "hums"
    rate_hz: int = RATE_HZ

    def utterances(self, text: str) -> Iterator[Utterance]:
        samples, words, phones = 0, [], []
        for word in filter(lambda word: word[0].isalpha(), text.split()):
            start, samples = samples, samples + 100 * len(word)
            words.append(Cue(start / RATE_HZ, samples / RATE_HZ, word.strip(",.")))
            phones.append(Cue(start / RATE_HZ, samples / RATE_HZ, "AH1"))
        yield Utterance(
            np.full(samples, 9, np.int16), tuple(words), tuple(phones), ("☃",) * ("☃" in text), 0.0, len(text)
        )


class Worker:
    """Makes what it is asked for at once, or once it may; dies of some texts."""

    def __init__(self, setup: Setup) -> None:
        self.setup, self.language, self.closed = setup, "en", False
        self.asked: list[str] = []
        self.may = asyncio.Event()
        self.may.set()

    async def make(self, task):
        self.asked.append(task.text)
        await self.may.wait()
        if task.text == "Die.":
            raise StoppedError("the process that speaks ended")
        return make(task, Hum(), self.setup)

    async def close(self) -> None:
        self.closed = True


class Stage:
    """A speaker, its workers, a clock and what was delivered."""

    def __init__(self, seed: int = 7) -> None:
        self.now_s = 0.0
        self.workers: list[Worker] = []
        self.delivered: list[Part | Failure] = []
        self.speaker = Speaker(
            None, Fraction(60), seed, self.delivered.append, now=lambda: self.now_s, open_worker=self._open
        )

    async def _open(self, setup: Setup) -> Worker:
        self.workers.append(Worker(setup))
        return self.workers[-1]

    async def __aenter__(self) -> "Stage":
        await self.speaker.start()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.speaker.close()
        assert all(worker.closed for worker in self.workers)

    def say(self, text, **more) -> None:
        self.speaker.say(check_message({"kind": "say", "text": text, **more}))

    async def settle(self, unsaid_s: float = 0.0) -> list[tuple]:
        """What has been delivered: text, id and more; or what failed."""
        self.speaker.tick(unsaid_s)
        for _ in range(100):
            await asyncio.sleep(0)
        found = [
            ("failed", part.id, part.more) if isinstance(part, Failure)
            else (part.message["text"], part.message.id, part.message["more"])
            for part in self.delivered
        ]  # fmt: skip
        self.delivered.clear()
        return found


def play(scene) -> None:
    async def whole() -> None:
        async with Stage() as stage:
            await scene(stage)

    asyncio.run(whole())


def test_texts_come_sentence_by_sentence_in_the_order_of_their_messages():
    async def scene(stage):
        stage.say("One. Two? Three", id="a")
        stage.say("Four", id="b", phones=PHONES)
        stage.say("Five.")
        assert await stage.settle() == [
            ("One.", "a", True), ("Two?", "a", True), ("Three", "a", False),
            ("Four", "b", False), ("Five.", None, False),
        ]  # fmt: skip

    play(scene)


def test_a_part_has_its_phones_and_its_sound_begins_with_it():
    async def scene(stage):
        stage.say("Hm. <break time='1s'/> Oh")
        stage.say("Own", phones=PHONES)
        await asyncio.sleep(0)
        for _ in range(50):
            await asyncio.sleep(0)
        first, second, own = stage.delivered
        assert [word[2] for word in first.message["words"]] == ["Hm"]
        for part, lead_s in ((first, LEAD_S), (second, 1.0)):
            heard = np.flatnonzero(part.samples)
            assert heard[0] == round(lead_s * RATE_HZ)
            assert part.message["words"][0][0] == pytest.approx(lead_s)
            assert part.utterance.loops / 60 > heard[-1] / RATE_HZ
            assert part.rate_hz == RATE_HZ
        assert own.samples is None
        assert [list(phone) for phone in own.message["phones"]] == PHONES

    play(scene)


def test_a_text_in_parts_is_said_as_its_sentences_complete():
    async def scene(stage):
        for part in ("Hel", "lo. ", "[smi"):
            stage.say(part, id="s", more=True)
        assert await stage.settle() == [("Hello.", "s", True)]
        stage.say("Aside.", id="other")
        stage.say("le] How are", id="s", more=True)
        assert await stage.settle() == [("Aside.", "other", False)]
        stage.say(" you", id="s")
        stage.say("Bye. ", id="s", more=True)
        stage.say("", id="s")
        assert await stage.settle() == [("How are you", "s", False), ("Bye.", "s", True), ("", "s", False)]

    play(scene)


def test_a_text_that_stops_in_its_middle_is_said_after_a_while():
    async def scene(stage):
        stage.say("Well, I", more=True)
        stage.now_s = SILENCE_S / 2
        assert await stage.settle() == []
        stage.now_s = SILENCE_S
        assert await stage.settle() == [("Well, I", None, True)]
        stage.say("[smi", more=True)
        stage.now_s = 5 * SILENCE_S
        assert await stage.settle() == [("failed", None, True)]
        stage.say("think so.")
        assert await stage.settle() == [("think so.", None, False)]

    play(scene)


def test_what_was_cancelled_is_not_delivered_though_it_is_being_made():
    async def scene(stage):
        stage.workers[0].may.clear()
        stage.say("One. Two. Three.")
        stage.say("Half a", id="s", more=True)
        stage.say("Whole.", id="w")
        assert await stage.settle() == []
        assert stage.speaker.cancel() == (None, "w", "s")
        assert stage.speaker.cancel() == ()
        stage.say("Four.")
        stage.workers[0].may.set()
        assert await stage.settle() == [("Four.", None, False)]
        assert stage.workers[0].asked == ["One.", "Four."]
        stage.say("Fresh.", id="s")
        assert await stage.settle() == [("Fresh.", "s", False)]
        assert stage.speaker.cancel() == ()
        stage.workers[0].may.clear()
        stage.say("The last one.", id="l")
        await stage.settle()
        assert stage.speaker.cancel() == ("l",)

    play(scene)


def test_a_text_with_nothing_that_can_be_said_fails_and_a_sentence_of_others_is_passed_over():
    async def scene(stage):
        stage.say("☃", id="a")
        stage.say("☃. ☃", id="b")
        stage.say("One. ☃. Two.", id="c")
        stage.say("One. ☃", id="d")
        stage.say("Bye. ", id="e", more=True)
        stage.say("☃", id="e")
        stage.say("QQ", id="f", phones=[[0, 1, "QQ"]])
        assert await stage.settle() == [
            ("failed", "a", False),
            ("failed", "b", True), ("failed", "b", False),
            ("One.", "c", True), ("failed", "c", True), ("Two.", "c", False),
            ("One.", "d", True), ("failed", "d", True), ("", "d", False),
            ("Bye.", "e", True), ("failed", "e", True), ("", "e", False),
            ("failed", "f", False),
        ]  # fmt: skip

    play(scene)


def test_a_worker_that_dies_is_replaced_and_its_text_has_failed():
    async def scene(stage):
        stage.say("One. Die. Two.", id="a")
        stage.say("Three.", id="b")
        assert await stage.settle() == [("One.", "a", True), ("failed", "a", False), ("Three.", "b", False)]
        first, second = stage.workers
        assert first.closed
        assert second.asked == ["Three."]

    play(scene)


def test_a_worker_that_does_not_start_again_is_tried_with_the_next_text():
    async def scene(stage):
        opened = stage.speaker._open_worker

        async def broken(setup):
            raise StoppedError("no memory")

        stage.speaker._open_worker = broken
        stage.say("Die.")
        assert await stage.settle() == [("failed", None, False)]
        stage.say("One.")
        assert await stage.settle() == [("failed", None, False)]
        stage.speaker._open_worker = opened
        stage.say("Two.")
        assert await stage.settle() == [("Two.", None, False)]

    play(scene)


@pytest.mark.parametrize("text", ["", " \n", "[dance]", "[smile", "[au 1=1] Oh"])
def test_what_can_be_seen_to_be_wrong_is_refused_at_once(text):
    async def scene(stage):
        with pytest.raises(MienError):
            stage.say(text)
        assert await stage.settle() == []

    play(scene)


def test_no_more_is_made_than_can_be_said_soon():
    async def scene(stage):
        stage.say("Aaaaaaaaa bbbbbbbbbb. " * 100)
        made = await stage.settle()
        assert 8 < len(made) < 16  # each lasts about 2.4 s
        assert await stage.settle(AHEAD_S) == []
        assert len(await stage.settle(AHEAD_S - 1.0)) == 1

    play(scene)


def test_what_waits_for_being_made_is_bounded_phones_and_all():
    async def scene(stage):
        stage.workers[0].may.clear()
        many = [[n / 100, (n + 1) / 100, "AH0"] for n in range(9000)]

        def fill(**more) -> int:
            for number in range(99_999):
                try:
                    stage.say(**more)
                except MienError:
                    return number
            return -1

        assert fill(text="x" * 1000, phones=many) == MOST_CHARACTERS // 10_000
        stage.speaker.cancel()
        assert fill(text="y" * 250, more=True) == MOST_CHARACTERS // 250
        stage.speaker.cancel()
        assert fill(text="Well. ") == MOST_WAITING
        stage.workers[0].may.set()

    play(scene)


def test_a_long_sentence_begins_with_a_clause_where_nothing_is_being_said():
    long = "Since it was late, and the day had been long, we went home without a word to anybody, and slept until noon."

    async def scene(stage):
        stage.say(long)
        assert [text for text, *_ in await stage.settle()] == [long[:85], long[86:]]
        stage.speaker.tick(5.0)
        stage.say(long)
        assert [text for text, *_ in await stage.settle(5.0)] == [long]

    play(scene)


def test_a_session_says_what_is_delivered_and_a_replay_gives_the_same_frames():
    async def scene(stage):
        log = []
        session = Session(face("toon:gus"), seed=7, log=log.append)
        stage.say("One. [smile] Two. [look left] Three, [nod] and four.", id="a")
        stage.say("Own", phones=PHONES)
        await stage.settle()
        for _ in range(2):
            stage.say("Again. [neutral]")
        frames = []
        while len(frames) < 700:
            for part in [*stage.delivered]:
                reply = session.handle(part.message, part.utterance)
                assert reply["kind"] == "ok"
            stage.delivered.clear()
            frames.append(session.step())
            stage.speaker.tick(session.unsaid_s)
            await asyncio.sleep(0)
        session.close()
        ended = [event["more"] for frame in frames for event in frame.events if event["event"] == "speech.ended"]
        assert session.unsaid_s == 0.0
        assert ended[-2:] == [False, False]
        again = list(replay(read_log(log), face("toon:gus")))
        assert len(again) == len(frames)
        for frame, same in zip(frames, again, strict=True):
            np.testing.assert_array_equal(frame.pose.values, same.pose.values)

    play(scene)


def test_what_a_worker_makes_does_not_depend_on_what_it_made_before():
    setup = Setup(None, Fraction(60), 3)
    task = Cued("Hello", tuple(map(tuple, PHONES)), ((0.0, 0.6, "Hello"),))
    once, again = (make(task, Hum(), setup).utterance.channels for _ in range(2))
    np.testing.assert_array_equal(once, again)
