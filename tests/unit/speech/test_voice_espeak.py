from __future__ import annotations

import ast
import sys
import unicodedata
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from mien.core import SILENCE, MienError, UnknownNameError
from mien.speech import espeak_worker, find_voice, speak, strip_stress, voice_espeak, voice_espeak_engine, voices
from mien.speech.phones import check_symbol, convert_ipa, read_ipa_table
from mien.speech.text import split_passages
from mien.speech.voice_espeak import find_espeak, share_joined, time_events
from mien.speech.voice_espeak_engine import Engine, Event, Said, find_installation
from mien.speech.voice_times import TimedPhone

needs_espeak = pytest.mark.skipif(find_installation() is None, reason="needs the extra: pip install 'mien[espeak]'")

SENTENCES = {
    "espeak-de": "Zwölf Boxkämpfer jagen Viktor quer über Deich; Häuser, Pferde, Bücher, Jazz und Genie.",
    "espeak-fr": "Portez ce vieux whisky au juge blond qui fume. Un bon vin blanc, huit œufs, la montagne.",
    "espeak-es": "El pingüino Wenceslao hizo kilómetros bajo exhaustiva lluvia; añoraba. Lobo, agua.",
    "espeak-es-419": "Hace cien años, jugaba ella con la guitarra; el perro y la lluvia, nada más.",
    "espeak-it": "Quel vituperabile xenofobo assaggia il whisky! Gli gnomi, la pizza, lo zaino, sci.",
    "espeak-nl": "Pa's wijze lynx bezag vroom het fikse aquaduct. Een huis, geel, vuur, deur, koud, schoen, jongen.",
    "espeak-pt": "Luís argüia à Júlia que brações, chá, óxido, zângão eram palavras. Mãe, põe, vinho, filho.",
    "espeak-pt-br": "Um pequeno jabuti xereta viu dez cegonhas felizes. São João não tem pão, amanhã, trabalho.",
    "espeak-en": "The quick brown fox jumps over the lazy dog; judge, church, thing, measure, boy, hour, fire, near.",
    "espeak-en-gb": "The quick brown fox jumps over the lazy dog; church, thing, measure, boy, fire, near.",
}


def say(text: str, voice: str) -> str:
    """Phones without stress."""
    return " ".join(strip_stress(cue.symbol) for cue in speak(text, voice).phones if cue.symbol != SILENCE)


@needs_espeak
@pytest.mark.parametrize(
    ("voice", "text", "phones"),
    [
        ("espeak-de", "Schöne Grüße", "SH OE N AH G RR UE S AH"),
        ("espeak-de", "ich, Bach, Pferd", "IH HY B AA KH P F EC RR T"),
        ("espeak-fr", "un bon vin blanc", "OEH B OC V AE B L AO"),
        ("espeak-fr", "la rue", "L AA GH UE"),
        ("espeak-es", "el lobo, la niña", "EC L L OC BH OC L AA N IY NY AA"),
        ("espeak-it", "gli gnomi", "LY IH NY AO M IH"),
        ("espeak-nl", "het huis", "HH AH T HH OEH UE S"),
        ("espeak-pt", "não", "N AW"),
        ("espeak-en", "My boat", "M AY B OW T"),
    ],
)
def test_each_language_has_its_own_sounds(voice: str, text: str, phones: str) -> None:
    assert say(text, voice) == phones


@needs_espeak
@pytest.mark.parametrize("name", [voice.name for voice in find_espeak()])
def test_every_letter_that_the_engine_writes_is_in_the_table(name: str) -> None:
    voice = next(voice for voice in find_espeak() if voice.name == name)
    table = read_ipa_table(voice.language[:2], units=True)
    strange: dict[str, str] = {}
    with Engine() as engine:
        said = engine.say(SENTENCES[name], voice.engine, 160)
    for event in said.events:
        letters = unicodedata.normalize("NFC", event.letters).translate(dict.fromkeys(map(ord, "ˈˌː-̩")))
        covered = {place for _, first, last in convert_ipa(letters, table) for place in range(first, last)}
        strange |= {letters[k]: letters for k in range(len(letters)) if k not in covered and letters[k] != "ʔ"}
    assert strange == {}


@needs_espeak
@pytest.mark.parametrize("name", ["espeak-de", "espeak-fr", "espeak-pt"])
def test_speech_has_no_holes_and_known_phones_and_is_the_same_again(name: str) -> None:
    speech = speak(SENTENCES[name] * 2, name)
    assert speech.phones[0].start_s == 0.0
    assert speech.phones[-1].end_s == pytest.approx(speech.sound.length_s)
    assert all(cue.end_s == after.start_s for cue, after in pairwise(speech.phones))
    for cue in speech.phones:
        check_symbol(cue.symbol, name)
    again = speak(SENTENCES[name] * 2, name)
    np.testing.assert_array_equal(again.sound.samples, speech.sound.samples)
    assert (again.phones, again.words) == (speech.phones, speech.words)


@needs_espeak
def test_words_are_as_written_with_their_own_times() -> None:
    words = speak("Am 3. Oktober kostet es 1984 €, Herr Dr. Meier.", "espeak-de").words
    assert [word.symbol for word in words] == ["Am", "3", "Oktober", "kostet", "es", "1984", "€", "Herr", "Dr", "Meier"]
    assert all(word.end_s > word.start_s for word in words)
    assert all(word.end_s <= after.start_s for word, after in pairwise(words))


@needs_espeak
def test_little_words_that_the_engine_joins_are_told_apart() -> None:
    assert [word.symbol for word in speak("One of the men.", "espeak-en").words] == ["One", "of", "the", "men"]


def test_joined_words_share_phones_by_their_letters() -> None:
    phones = [TimedPhone(10 * k, 10 * k + 10, symbol, 0) for k, symbol in enumerate(["AH0", "V", "DH", "AH0"])]
    assert [phone.word for phone in share_joined(phones, ["of", "the"])] == [0, 0, 1, 1]
    assert [phone.word for phone in share_joined(phones, ["of", "—"])] == [0, 0, 0, 0]


@needs_espeak
def test_ordinals_and_abbreviations_are_read_in_full() -> None:
    assert say("Am 3. Mai", "espeak-de") == "AA M D RR IH T AH M AY"
    assert say("z. B. du", "espeak-de") == say("zum Beispiel du", "espeak-de")
    assert say("M. Dupont", "espeak-fr") == say("Monsieur Dupont", "espeak-fr")


def test_an_abbreviation_ends_no_sentence_of_its_language() -> None:
    text = "Am 3. Mai kommt Nr. 5. Dann nicht."
    assert [passage.text for passage in split_passages(text, "de")] == ["Am 3. Mai kommt Nr. 5. Dann nicht."]
    assert [passage.text for passage in split_passages("Il est là. M. Petit aussi.", "fr")] == [
        "Il est là.",
        "M. Petit aussi.",
    ]
    assert len(list(split_passages("Chapter 5. Dawn.", "en"))) == 2


@needs_espeak
def test_letters_of_other_scripts_are_skipped_and_said_so() -> None:
    assert speak("Guten Tag, Москва!", "espeak-de").skipped == ("Москва",)
    with pytest.raises(MienError, match="speaks de-DE, and it cannot say Москва"):
        speak("Москва", "espeak-de")


def test_a_stop_begins_where_the_sound_before_it_falls_silent() -> None:
    samples = np.full(4000, 1000, np.int16)
    samples[1500:2000] = 0
    events = (Event(0, place=0), Event(0, letters="ˈa"), Event(2000, letters="t"), Event(2500, letters="oː"))
    phones = time_events(Said(samples, 10000, events), [0], "de")
    assert [(phone.symbol, phone.start, phone.end) for phone in phones] == [
        ("AA1", 0, 1500),
        ("T", 1500, 2500),
        ("OC0", 2500, 4000),
    ]


def test_what_the_engine_takes_for_one_sound_shares_its_time() -> None:
    events = (
        Event(0, place=0),
        Event(0, letters="ˈœy"),
        Event(1000, letters="pf"),
        Event(1400),
        Event(1420, letters="a"),
    )
    phones = time_events(Said(np.full(2000, 1000, np.int16), 1000, events), [0], "nl")
    assert [(phone.symbol, phone.start) for phone in phones] == [
        ("OEH1", 0),
        ("UE0", 500),
        ("P", 1000),
        ("F", 1200),
        ("AA0", 1420),
    ]


def test_without_the_extra_its_install_command_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(voice_espeak, "find_installation", lambda: None)
    monkeypatch.setattr(voice_espeak_engine, "find_installation", lambda: None)
    assert not any(name.startswith("espeak") for name in voices())
    with pytest.raises(MienError, match=r"'espeak-de' needs the voice.*pip install 'mien\[espeak\]'"):
        find_voice("espeak-de")
    with pytest.raises(UnknownNameError):
        find_voice("espeak-xx")
    with pytest.raises(MienError, match="pip install"), Engine():
        pass


@needs_espeak
def test_an_engine_that_stops_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    broken = tmp_path / "broken.py"
    broken.write_text("import sys; sys.stdin.readline(); raise SystemExit(3)")
    monkeypatch.setattr(voice_espeak_engine, "_WORKER", broken)
    with Engine() as engine, pytest.raises(MienError, match="stopped with status 3"):
        engine.say("a", "de", 160)


@needs_espeak
def test_a_voice_that_the_engine_does_not_have_is_told() -> None:
    with Engine() as engine, pytest.raises(MienError, match="no voice 'tlh-x'"):
        engine.say("a", "tlh-x", 160)


@needs_espeak
def test_the_engine_is_never_loaded_into_this_process() -> None:
    speak("Guten Tag.", "espeak-de")
    assert "espeakng_loader" not in sys.modules
    if (maps := Path("/proc/self/maps")).exists():
        assert "libespeak" not in maps.read_text()


def test_the_worker_imports_nothing_of_ours() -> None:
    tree = ast.parse(Path(espeak_worker.__file__).read_text(encoding="utf-8"))
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module or "." for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert names <= {"__future__", "array", "ctypes", "json", "re", "sys", "typing"}
