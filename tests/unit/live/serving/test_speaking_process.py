"""The process that speaks: it answers, survives what cannot be said, dies when told to, and leaves nothing behind."""

import asyncio
import os
import signal
import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from mien.core import MienError
from mien.live import check_message
from mien.live.saying import make_utterance
from mien.live.sentences import Sentence
from mien.live.serving.speaker import Failure, Part, Speaker
from mien.live.serving.speaking_process import StoppedError, start_process
from mien.live.serving.speaking_worker import Cued, Setup
from mien.perform.marks import MarkedText

SETUP = Setup(None, Fraction(60), 5)
HELLO = Sentence(MarkedText("Hello there."))


def gone(pid: int) -> bool:
    """Whether there is no such process, not even one that nobody has waited for."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    return False


def ended(pid: int) -> bool:
    """Whether a process of somebody else's runs no more; who had to wait for it may not have."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().split()[2] == "Z"
    except (FileNotFoundError, ProcessLookupError):
        return True


def test_it_makes_sound_phones_and_what_the_face_does_until_it_hangs():
    async def scene():
        process = await start_process(SETUP)
        try:
            made = await process.make(HELLO)
            with pytest.raises(MienError, match="cannot say"):
                await process.make(Sentence(MarkedText("☃")))
            own = await process.make(Cued("Hello there.", made.phones, made.words))
            assert process.language == "en"
            # A terminal's interrupt goes to the group of processes in front.
            assert os.getpgid(process.pid) != os.getpgid(0)
            os.kill(process.pid, signal.SIGSTOP)
            process.longest_s = 0.1
            with pytest.raises(StoppedError, match=r"within 0\.1 s"):
                await process.make(HELLO)
        finally:
            await process.close()
        assert gone(process.pid)
        return made, own

    made, own = asyncio.run(scene())
    here = make_utterance("Hello there.", made.phones, made.words, rate=SETUP.rate, seed=SETUP.seed)
    assert [word[2] for word in made.words] == ["Hello", "there"]
    assert len(made.samples) == round(made.phones[-1][1] * made.rate_hz)
    for utterance in (made.utterance, own.utterance):
        np.testing.assert_array_equal(utterance.channels, here.channels)
        assert utterance.events == here.events


def test_a_voice_that_is_not_there_is_named_and_no_process_stays(monkeypatch: pytest.MonkeyPatch):
    started = []
    create = asyncio.create_subprocess_exec

    async def note(*arguments, **options):
        started.append(await create(*arguments, **options))
        return started[-1]

    monkeypatch.setattr(asyncio, "create_subprocess_exec", note)
    with pytest.raises(MienError, match="unknown voice 'nobody'"):
        asyncio.run(start_process(Setup("nobody", Fraction(60), 5)))
    assert [gone(process.pid) for process in started] == [True]


def test_a_speaker_whose_process_is_killed_fails_once_and_goes_on():
    delivered: list[Part | Failure] = []

    async def scene():
        news = asyncio.Event()

        def deliver(what):
            delivered.append(what)
            news.set()

        speaker = Speaker(None, Fraction(60), 5, deliver)
        await speaker.start()
        try:
            pids = [speaker._worker.pid]
            os.kill(pids[0], signal.SIGKILL)
            for text in ("One.", "Two."):
                speaker.say(check_message({"kind": "say", "text": text, "id": text}))
                await news.wait()
                news.clear()
            pids.append(speaker._worker.pid)
        finally:
            await speaker.close()
        return pids

    pids = asyncio.run(scene())
    failure, part = delivered
    assert isinstance(failure, Failure)
    assert (failure.id, "ended with status -9" in failure.message) == ("One.", True)
    assert isinstance(part, Part)
    assert part.message["text"] == "Two."
    assert len(set(pids)) == 2
    assert all(map(gone, pids))


def test_it_ends_with_its_server_however_that_ends():
    program = (
        "import asyncio, os\n"
        "from fractions import Fraction\n"
        "from mien.live.serving.speaking_process import start_process\n"
        "from mien.live.serving.speaking_worker import Setup\n"
        "async def main():\n"
        "    process = await start_process(Setup(None, Fraction(60), 5))\n"
        "    print(process.pid, flush=True)\n"
        "    os.kill(os.getpid(), 9)\n"
        "asyncio.run(main())\n"
    )
    root = Path(__file__).parents[4]
    server = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(root / "src")},
    )
    # Its error stream is the server's: reading that to its end has waited for both, but for their last moments.
    assert server.stderr == ""
    while not ended(int(server.stdout)):
        time.sleep(0.01)
