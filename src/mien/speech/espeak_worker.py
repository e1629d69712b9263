"""espeak-ng in a process of its own: ``python espeak_worker.py LIBRARY DATA``; imports nothing of mien.

Each line of standard input is JSON: ``{"voice": "de", "words_a_minute": 160, "text": "…"}``. Each answer is a line of
JSON, ``{"rate_hz": …, "bytes": …, "events": [[sample, "word", place in the text], [sample, "phone", IPA], …]}``, and
so many bytes of samples, 16 bits, little-endian. A phone without letters is a pause. A voice that the engine does not
have is answered with ``{"error": "…"}``. The end of the input ends the process.

Source: espeak-ng 1.52, speak_lib.h.
"""

from __future__ import annotations

import array
import ctypes
import json
import re
import sys
from typing import Any

SYNCHRONOUS, PHONEMES_AS_EVENTS_IN_IPA = 2, 3
EVENT_END, EVENT_WORD, EVENT_PHONEME = 0, 1, 7
PARAMETER_RATE = 1
FROM_CHARACTER = 1
CHARACTERS_UTF8 = 1

LANGUAGE_MARK = re.compile(r"\([\w-]*\)")
"""What the engine writes where it reads a foreign word: ``(en)``."""


class EventId(ctypes.Union):
    """What an event is about."""

    _fields_ = (("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * 8))


class Event(ctypes.Structure):
    """Something that happens at a sample."""

    _fields_ = (
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", EventId),
    )


Receiver = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(Event))


class Engine:
    """The engine, loaded."""

    def __init__(self, library: str, data: str) -> None:
        self._library = ctypes.CDLL(library)
        self.rate_hz: int = self._library.espeak_Initialize(SYNCHRONOUS, 0, data.encode(), PHONEMES_AS_EVENTS_IN_IPA)
        self._samples, self._events = array.array("h"), list[tuple[int, str, Any]]()
        self._receiver = Receiver(self._receive)
        self._library.espeak_SetSynthCallback(self._receiver)

    def choose(self, voice: str, words_a_minute: int) -> bool:
        """Whether the engine has the voice, which then speaks."""
        if self._library.espeak_SetVoiceByName(voice.encode()):
            return False
        self._library.espeak_SetParameter(PARAMETER_RATE, words_a_minute, 0)
        return True

    def say(self, text: str) -> tuple[array.array[int], list[tuple[int, str, Any]]]:
        """Samples, and words and phones with the sample at which each begins."""
        self._samples, self._events = array.array("h"), []
        encoded = text.encode()
        self._library.espeak_Synth(encoded, len(encoded) + 1, 0, FROM_CHARACTER, 0, CHARACTERS_UTF8, None, None)
        return self._samples, self._events

    def _receive(self, samples: Any, count: int, events: Any) -> int:
        if samples and count:
            self._samples.extend(samples[:count])
        number = 0
        while (event := events[number]).type != EVENT_END:
            if event.type == EVENT_WORD:
                self._events.append((event.sample, "word", event.text_position - 1))
            elif event.type == EVENT_PHONEME:
                letters = bytes(event.id.string).decode(errors="ignore")
                self._events.append((event.sample, "phone", LANGUAGE_MARK.sub("", letters)))
            number += 1
        return 0


def serve(engine: Engine) -> None:
    """Answers until the input ends."""
    for line in sys.stdin.buffer:
        wanted = json.loads(line)
        samples, answer = array.array("h"), dict[str, Any]()
        if engine.choose(wanted["voice"], wanted["words_a_minute"]):
            samples, events = engine.say(wanted["text"])
            answer = {"rate_hz": engine.rate_hz, "bytes": 2 * len(samples), "events": events}
        else:
            answer = {"error": f"espeak-ng has no voice {wanted['voice']!r}"}
        if sys.byteorder == "big":
            samples.byteswap()
        sys.stdout.buffer.write(json.dumps(answer).encode() + b"\n" + samples.tobytes())
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    serve(Engine(*sys.argv[1:]))
