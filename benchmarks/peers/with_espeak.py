"""Speech with known phone times, by espeak-ng: ``python with_espeak.py SCRIPT FOLDER``, in the peers' environment.

SCRIPT has lines ``name<tab>voice<tab>words a minute<tab>pitch<tab>sentence``. FOLDER gets a .wav, a .lab of IPA
letters and a .txt of each. The engine says at which sample each phone begins. A stop is told at its burst: its closure
before, samples that are silent, is given to it.
"""

from __future__ import annotations

import array
import ctypes
import sys
import wave
from pathlib import Path

import espeakng_loader

SYNCHRONOUS, WITH_PHONEMES_IN_IPA = 2, 3
END, PHONEME = 0, 7
RATE, PITCH = 1, 3
CHARACTERS_UTF8 = 1

STOPS = ("p", "b", "t", "d", "k", "ɡ")
SILENT = 12
"""Largest sample of a closure."""

LONGEST_CLOSURE_S = 0.08
"""More silence before a burst than this is a pause."""

QUIET_S = 0.25
"""Silence before and after each sentence."""

MARKS = str.maketrans("", "", "ˈˌ")


class EventId(ctypes.Union):
    _fields_ = (("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * 8))


class Event(ctypes.Structure):
    _fields_ = (
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position_ms", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", EventId),
    )


Callback = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(Event))


class Engine:
    """The engine, which can say one text after another."""

    def __init__(self) -> None:
        self.library = ctypes.CDLL(espeakng_loader.get_library_path())
        data = espeakng_loader.get_data_path().encode()
        self.rate_hz = self.library.espeak_Initialize(SYNCHRONOUS, 0, data, WITH_PHONEMES_IN_IPA)
        self.samples, self.events = array.array("h"), []
        self.callback = Callback(self._receive)
        self.library.espeak_SetSynthCallback(self.callback)

    def say(self, voice: str, words_a_minute: int, pitch: int, text: str) -> tuple[array.array, list[tuple[int, str]]]:
        """Samples, and phones with the sample at which each begins; a pause has no letters."""
        if self.library.espeak_SetVoiceByName(voice.encode()):
            raise SystemExit(f"espeak-ng has no voice {voice!r}")
        self.library.espeak_SetParameter(RATE, words_a_minute, 0)
        self.library.espeak_SetParameter(PITCH, pitch, 0)
        self.samples, self.events = array.array("h"), []
        encoded = text.encode()
        self.library.espeak_Synth(encoded, len(encoded) + 1, 0, 1, 0, CHARACTERS_UTF8, None, None)
        return self.samples, self.events

    def _receive(self, samples, count, events) -> int:
        if samples and count:
            self.samples.extend(samples[:count])
        number = 0
        while events[number].type != END:
            if events[number].type == PHONEME:
                letters = bytes(events[number].id.string).decode().translate(MARKS)
                self.events.append((events[number].sample, letters))
            number += 1
        return 0


def phones_of(samples: array.array, events: list[tuple[int, str]], rate_hz: int) -> list[tuple[int, int, str]]:
    """First sample, sample after the last, and letters of each phone, without holes."""
    starts = [(0, "")]
    for sample, letters in events:
        first = sample
        if letters.startswith(STOPS):
            while first > starts[-1][0] and first > sample - LONGEST_CLOSURE_S * rate_hz:
                if abs(samples[first - 1]) > SILENT:
                    break
                first -= 1
        starts.append((max(first, starts[-1][0]), letters))
    ends = [start for start, _ in starts[1:]] + [len(samples)]
    return [(start, end, letters) for (start, letters), end in zip(starts, ends, strict=True) if end > start]


def main() -> None:
    script, folder = Path(sys.argv[1]), Path(sys.argv[2])
    engine = Engine()
    for line in script.read_text(encoding="utf-8").splitlines():
        name, voice, words_a_minute, pitch, text = line.split("\t")
        said, events = engine.say(voice, int(words_a_minute), int(pitch), text)
        quiet = array.array("h", bytes(2 * round(QUIET_S * engine.rate_hz)))
        samples, phones = quiet + said + quiet, [(sample + len(quiet), letters) for sample, letters in events]
        with wave.open(str(folder / f"{name}.wav"), "wb") as file:
            file.setparams((1, 2, engine.rate_hz, 0, "NONE", ""))
            file.writeframes(samples.tobytes())
        spans = phones_of(samples, phones, engine.rate_hz)
        rows = [f"{end / engine.rate_hz:.6f} 125 {letters}" for _, end, letters in spans]
        lines = [f"signal {name}", "nfields 1", "#", *rows, ""]
        (folder / f"{name}.lab").write_text("\n".join(lines), encoding="utf-8")
        (folder / f"{name}.txt").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
