"""The process in which a live face's texts are made: sound, phones, and what the face does with them.

It answers tasks on its standard input, one after the other, on its standard output: pickled, since both ends are the
same program, answers behind their lengths. The end of the input ends the process.
"""

from __future__ import annotations

import os
import pickle
import struct
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE, MienError
from mien.live.saying import Cues, Utterance, make_utterance
from mien.live.sentences import LEAD_S, Sentence, time_acts
from mien.perform.directions import follow_marks
from mien.perform.marks import MarkedText
from mien.speech import Voice, find_voice, speak

Json = Mapping[str, Any]

LENGTH = struct.Struct("<Q")

WARM_UP = "Hello there, nice to meet you."
SILENT_S = 0.02
"""What is said of a text without words, seconds."""


@dataclass(frozen=True)
class Setup:
    """What a worker is told first: a voice or the usual one, loops a second, and the seed of the session."""

    voice: str | None
    rate: Fraction
    seed: int


@dataclass(frozen=True)
class Cued:
    """A text whose phones and words somebody knows already."""

    text: str
    phones: Cues
    words: Cues


Task = Sentence | Cued


@dataclass(frozen=True, eq=False)
class Made:
    """What became of a task.

    Attributes:
        utterance: what the face does, without its acts.
        phones: start and end, seconds, and symbol; empty where somebody knows them already.
        words: likewise.
        acts: loop and JSON of the messages that marks stand for.
        samples: (N,) int16; None where somebody else has the sound.
        rate_hz: samples a second.
    """

    utterance: Utterance
    phones: Cues = ()
    words: Cues = ()
    acts: tuple[tuple[int, Json], ...] = ()
    samples: NDArray[np.int16] | None = None
    rate_hz: int = 0


def make(task: Task, voice: Voice, setup: Setup) -> Made:
    """What a task asks for.

    Raises:
        MienError: the voice cannot say it, or a phone is none.
    """
    if isinstance(task, Cued):
        return Made(_utterance(task.text, task.phones, task.words, setup))
    if not task.text:
        length_s = max(SILENT_S, sum(task.marked.pauses.values()))
        phones: Cues = ((0.0, length_s, SILENCE),)
        utterance = _utterance("", phones, (), setup)
        acts = time_acts(follow_marks(task.marked, (), length_s))
        return Made(utterance, phones, (), _place(acts, utterance, setup))
    speech = speak(task.text + "," * task.goes_on, voice, pauses=task.marked.pauses, lead_s=LEAD_S, tail_s=task.tail_s)
    phones, words = (
        tuple((cue.start_s, cue.end_s, cue.symbol) for cue in cues) for cues in (speech.phones, speech.words)
    )
    utterance = _utterance(task.text, phones, words, setup)
    acts = time_acts(follow_marks(task.marked, speech.words, speech.sound.length_s))
    samples = np.array(speech.sound.samples)
    return Made(utterance, phones, words, _place(acts, utterance, setup), samples, speech.sound.rate_hz)


def _utterance(text: str, phones: Cues, words: Cues, setup: Setup) -> Utterance:
    return make_utterance(text, phones, words, rate=setup.rate, seed=setup.seed)


def _place(acts: Iterable[tuple[float, Json]], utterance: Utterance, setup: Setup) -> tuple[tuple[int, Json], ...]:
    return tuple((min(int(time_s * setup.rate), utterance.loops - 1), message) for time_s, message in acts)


@dataclass(frozen=True)
class Ready:
    """The answer to the setup, once all is warm: the language of the voice."""

    language: str


@dataclass(frozen=True)
class Refused:
    """The answer where a user can mend something, in words."""

    message: str


def serve(tasks: BinaryIO, answers: BinaryIO) -> None:
    """Answer until the tasks end; the first of them is the setup."""
    setup: Setup = pickle.load(tasks)
    try:
        voice = find_voice(setup.voice)
        make(Sentence(MarkedText(WARM_UP)), voice, setup)
    except MienError as error:
        _send(answers, Refused(str(error)))
        return
    _send(answers, Ready(voice.language.split("-")[0]))
    while True:
        try:
            task: Task = pickle.load(tasks)
        except EOFError:
            return
        try:
            answer: Made | Refused = make(task, voice, setup)
        except MienError as error:
            answer = Refused(str(error))
        _send(answers, answer)


def _send(answers: BinaryIO, answer: Ready | Refused | Made) -> None:
    data = pickle.dumps(answer)
    answers.write(LENGTH.pack(len(data)) + data)
    answers.flush()


def main() -> None:
    """Serve on the standard streams, until whoever asks is gone."""
    # Whatever a voice prints is not an answer.
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    with suppress(BrokenPipeError), answers:
        serve(sys.stdin.buffer, answers)
