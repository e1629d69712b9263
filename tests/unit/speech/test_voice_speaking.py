from __future__ import annotations

import gc
import resource
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

from mien.core import Cue, MienError, UnknownNameError, sound_store
from mien.speech import Speech, Utterance, Voice, find_voice, speak, voice, voice_espeak, voices
from mien.speech.speaking import LEAD_S, TAIL_S

RATE = 1000


def hum(word: str = "a", *, head: int = 100, speech: int = 200, tail: int = 300, pause_s: float = 0.5) -> Utterance:
    """An utterance of one word and one phone; samples and milliseconds are the same."""
    samples = np.concatenate([np.zeros(head), np.full(speech, 1000), np.zeros(tail)]).astype(np.int16)
    edges = [edge / RATE for edge in (0, head, head + speech, len(samples))]
    phones = tuple(Cue(*span) for span in zip(edges, edges[1:], ("SIL", "AH1", "SIL"), strict=False))
    return Utterance(samples, (Cue(edges[1], edges[2], word),), phones, (), pause_s, 1)


@dataclass(frozen=True)
class Fake:
    said: tuple[Utterance, ...]
    name: str = "fake"
    language: str = "en"
    description: str = "hums"
    rate_hz: int = RATE
    taken: list[int] = field(default_factory=list)

    def utterances(self, text: str) -> Iterator[Utterance]:
        for number, utterance in enumerate(self.said):
            self.taken.append(number)
            yield utterance


def spans(speech: Speech) -> list[tuple[int, int, str]]:
    return [(round(cue.start_s * RATE), round(cue.end_s * RATE), cue.symbol) for cue in speech.phones]


def test_silence_before_and_after_is_as_long_as_a_film_needs():
    speech = speak("a", Fake((hum(),)))
    lead, tail = round(LEAD_S * RATE), round(TAIL_S * RATE)
    assert spans(speech) == [(0, lead, "SIL"), (lead, lead + 200, "AH1"), (lead + 200, lead + 200 + tail, "SIL")]
    assert speech.words == (Cue(lead / RATE, (lead + 200) / RATE, "a"),)
    np.testing.assert_array_equal(np.flatnonzero(speech.sound.samples), np.arange(lead, lead + 200))


def test_silence_before_and_after_can_be_asked_for():
    speech = speak("a", Fake((hum(),)), lead_s=0.08, tail_s=0.5)
    assert spans(speech) == [(0, 80, "SIL"), (80, 280, "AH1"), (280, 780, "SIL")]


@pytest.mark.parametrize(("head", "tail"), [(0, 0), (10, 20), (100, 300), (900, 900)])
def test_the_pause_between_utterances_is_the_one_asked_for(head: int, tail: int):
    speech = speak("a b", Fake((hum(head=head, tail=tail, pause_s=0.4), hum("b", head=head, tail=tail))))
    assert spans(speech)[:4] == [
        (0, 200, "SIL"), (200, 400, "AH1"), (400, 800, "SIL"), (800, 1000, "AH1"),
    ]  # fmt: skip
    assert speech.phones[-1].end_s == speech.sound.length_s
    heard = np.flatnonzero(speech.sound.samples)
    np.testing.assert_array_equal(heard, [*range(200, 400), *range(800, 1000)])


@dataclass(frozen=True)
class Echo(Fake):
    """Hums once for each text, and notes what it was given."""

    given: list[str] = field(default_factory=list)

    def utterances(self, text: str) -> Iterator[Utterance]:
        self.given.append(text)
        yield hum(text, pause_s=0.9)


def test_pauses_are_as_long_as_asked_and_words_move_with_them():
    echo = Echo(())
    seen: list[tuple[int, int, str]] = []
    speech = speak("one two. three", echo, pauses={4: 0.4, 9: 0.07}, report=lambda *step: seen.append(step))
    assert echo.given == ["one,", "two. ", "three"]
    assert spans(speech) == [
        (0, 200, "SIL"), (200, 400, "AH1"), (400, 800, "SIL"), (800, 1000, "AH1"), (1000, 1080, "SIL"),
        (1080, 1280, "AH1"), (1280, 1630, "SIL"),
    ]  # fmt: skip
    assert [(round(word.start_s * RATE), word.symbol) for word in speech.words] == [
        (200, "one,"), (800, "two. "), (1080, "three"),
    ]  # fmt: skip
    np.testing.assert_array_equal(
        np.flatnonzero(speech.sound.samples), [*range(200, 400), *range(800, 1000), *range(1080, 1280)]
    )
    assert [done for done, _, _ in seen] == [1, 5, 10, 14]


@pytest.mark.parametrize(("pause_s", "lead", "tail"), [(0.05, 200, 350), (1.5, 1500, 1500)])
def test_a_pause_before_the_first_or_after_the_last_word_only_adds(pause_s: float, lead: int, tail: int):
    speech = speak("one", Echo(()), pauses={0: pause_s, 3: pause_s})
    assert spans(speech) == [(0, lead, "SIL"), (lead, lead + 200, "AH1"), (lead + 200, lead + 200 + tail, "SIL")]


def test_a_pause_within_a_clause_keeps_the_voice_up():
    echo = Echo(())
    speak("a b, c? d", echo, pauses={2: 0.1, 5: 0.1, 8: 0.1})
    assert echo.given == ["a,", "b, ", "c? ", "d"]


def test_holes_that_a_voice_leaves_are_pauses():
    samples = np.full(600, 1000, np.int16)
    phones = (Cue(0.0, 0.1, "AH1"), Cue(0.3, 0.6, "B"))
    speech = speak("a", Fake((Utterance(samples, (Cue(0.0, 0.6, "a"),), phones),)))
    assert [symbol for _, _, symbol in spans(speech)] == ["SIL", "AH1", "SIL", "B", "SIL"]
    assert all(before.end_s == after.start_s for before, after in zip(speech.phones, speech.phones[1:], strict=False))


def test_phones_of_another_alphabet_are_refused():
    utterance = Utterance(np.ones(100, np.int16), (Cue(0.0, 0.1, "a"),), (Cue(0.0, 0.1, "ə"),))
    with pytest.raises(MienError, match="voice 'fake': 'ə' is no phone of ours"):
        speak("a", Fake((utterance,)))


@pytest.mark.parametrize("text", ["", " ", "\n\t\u3000"])
def test_an_empty_text_is_refused(text: str):
    with pytest.raises(MienError, match="the text is empty"):
        speak(text, Fake(()))


def test_a_text_without_anything_to_say_is_refused_with_the_reason():
    nothing = Utterance(np.zeros(0, np.int16), (), (), ("🙂",))
    with pytest.raises(MienError, match="'🙂!': voice 'fake' speaks en, and it cannot say 🙂"):
        speak("🙂!", Fake((nothing,)))
    with pytest.raises(MienError, match="there is no word in it"):
        speak("...", Fake(()))


def test_what_was_skipped_is_told_once_in_order():
    quiet = Utterance(np.zeros(0, np.int16), (), (), ("🙂", "你好", "🙂"))
    assert speak("a", Fake((quiet, hum(), quiet))).skipped == ("🙂", "你好")


def test_progress_counts_characters():
    seen: list[tuple[int, int, str]] = []
    speak("ab", Fake((hum(), hum())), report=lambda *step: seen.append(step))
    assert seen == [(1, 2, "speaking"), (1, 2, "speaking"), (2, 2, "speaking")]


def test_long_sound_lives_in_a_file_that_goes_with_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    short = speak("a", Fake((hum(),) * 20))
    monkeypatch.setattr(sound_store, "LONGEST_IN_MEMORY_S", 1.0)
    long = speak("a", Fake((hum(),) * 20), folder=tmp_path)
    assert isinstance(long.sound.samples, np.memmap)
    assert not isinstance(short.sound.samples, np.memmap)
    np.testing.assert_array_equal(long.sound.samples, short.sound.samples)
    assert long.phones == short.phones
    gc.collect()
    assert list(tmp_path.iterdir()) == []
    assert long.sound.samples[200] == 1000  # still readable


def test_no_room_for_long_sound_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(sound_store, "LONGEST_IN_MEMORY_S", 1.0)
    with pytest.raises(MienError, match=r"cannot keep .* MB of sound here: No such file"):
        speak("a", Fake((hum(),) * 20), folder=tmp_path / "gone")


def test_a_full_disk_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(sound_store, "LONGEST_IN_MEMORY_S", 1.0)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
    try:
        with pytest.raises(MienError, match=r"cannot keep .* File too large — set TMPDIR"):
            speak("a", Fake((hum(),) * 20), folder=tmp_path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_speech_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(sound_store, "LONGEST_IN_MEMORY_S", 1.0)

    def interrupt(done: int, total: int, what: str) -> None:
        if list(tmp_path.iterdir()):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        speak("a", Fake((hum(),) * 20), folder=tmp_path, report=interrupt)
    assert list(tmp_path.iterdir()) == []


def test_utterances_are_taken_one_at_a_time():
    fake = Fake((hum(),) * 3)
    seen: list[int] = []
    speak("a", fake, report=lambda *_: seen.append(len(fake.taken)))
    assert seen == [1, 2, 3, 3]


class Plug:
    """An entry point that finds what it is given."""

    def __init__(self, name: str, found: object) -> None:
        self.name, self.value, self.found = name, f"plug:{name}", found

    def load(self) -> object:
        if isinstance(self.found, ImportError):
            raise self.found
        return lambda: self.found


def test_voices_are_those_that_are_present(monkeypatch: pytest.MonkeyPatch):
    plugs = [Plug("fake", Fake(())), Plug("absent", None), Plug("broken", ImportError("x"))]
    monkeypatch.setattr(voice, "entry_points", lambda group: plugs if group == "mien.voices" else [])
    monkeypatch.setattr(voice_espeak, "find_installation", lambda: None)
    assert list(voices()) == ["hibari", "fake"]
    assert all(isinstance(each, Voice) for each in voices().values())
    assert find_voice().name == "hibari"
    assert find_voice("fake") is plugs[0].found


def test_a_plug_in_that_is_no_voice_is_named(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(voice, "entry_points", lambda group: [Plug("odd", 3)])
    with pytest.raises(MienError, match="plug:odd"):
        voices()


def test_an_unknown_voice_is_named_with_near_matches():
    with pytest.raises(UnknownNameError, match=r"unknown voice 'hibary' — did you mean 'hibari'\?"):
        speak("Hello.", "hibary")


def test_importing_loads_no_engine():
    code = "import sys, mien.speech; mien.speech.voices(); print({'hibari', 'onnxruntime'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"
