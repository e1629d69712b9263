"""The process that makes texts, as the server's loop sees it."""

from __future__ import annotations

import asyncio
import os
import pickle
import sys
from asyncio.subprocess import PIPE, Process
from pathlib import Path

from mien.core import MienError

from .speaking_worker import LENGTH, Made, Ready, Refused, Setup, Task

PROGRAM = "from mien.live.serving.speaking_worker import main; main()"

LONGEST_S = 60.0
"""A task that takes longer will not end: the largest take a few seconds."""


class StoppedError(MienError):
    """The process ended by itself, or has to be ended."""


class SpeakingProcess:
    """A worker that is asked one thing at a time; made by ``start_process``.

    Attributes:
        language: of its voice.
        longest_s: how long a task may take, seconds.
    """

    def __init__(self, process: Process) -> None:
        self._process = process
        self.language, self.longest_s = "", LONGEST_S

    @property
    def pid(self) -> int:
        """Its number in the system."""
        return self._process.pid

    async def begin(self, setup: Setup) -> None:
        """Wait until it is warm.

        Raises:
            MienError: the voice is not there.
            StoppedError: it ended by itself.
        """
        answer = await self._ask(setup)
        if isinstance(answer, Ready):
            self.language = answer.language

    async def make(self, task: Task) -> Made:
        """What a task asks for.

        Raises:
            MienError: it cannot be made.
            StoppedError: the process ended by itself, or does not answer; it can only be closed then.
        """
        try:
            async with asyncio.timeout(self.longest_s):
                answer = await self._ask(task)
        except TimeoutError:
            raise StoppedError(f"nothing has been made within {self.longest_s:g} s — say it in smaller parts") from None
        if not isinstance(answer, Made):
            raise StoppedError("the process that speaks answered something else")
        return answer

    async def _ask(self, question: Setup | Task) -> Ready | Made:
        writer, reader = self._process.stdin, self._process.stdout
        if writer is None or reader is None:
            raise StoppedError("the process that speaks has no pipes")
        try:
            writer.write(pickle.dumps(question))
            await writer.drain()
            (length,) = LENGTH.unpack(await reader.readexactly(LENGTH.size))
            answer: Ready | Refused | Made = pickle.loads(await reader.readexactly(length))
        except (asyncio.IncompleteReadError, ConnectionError):
            status = await self._process.wait()
            raise StoppedError(f"the process that speaks ended with status {status} — say it again") from None
        if isinstance(answer, Refused):
            raise MienError(answer.message)
        return answer

    async def close(self) -> None:
        """End it, in the midst of whatever it does."""
        if self._process.returncode is None:
            self._process.kill()
        # Reads what is left, too: pipes are closed only then.
        await self._process.communicate()


async def start_process(setup: Setup) -> SpeakingProcess:
    """A worker that is warm.

    Raises:
        MienError: the voice is not there.
        StoppedError: it ended by itself.
    """
    paths = [str(Path(__file__).parents[3]), os.environ.get("PYTHONPATH", "")]
    try:
        started = await asyncio.create_subprocess_exec(
            # Nothing of the caller's folder is imported.
            *(sys.executable, "-P", "-c", PROGRAM),
            stdin=PIPE,
            stdout=PIPE,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))},
            start_new_session=True,  # an interrupt is the server's; the process ends with its input
        )
    except OSError as error:
        raise StoppedError(f"the process that speaks does not start ({error.strerror})") from None
    process = SpeakingProcess(started)
    try:
        await process.begin(setup)
    except BaseException:
        await process.close()
        raise
    return process
