"""Recordings and transcripts that do not go together, and what is no speech."""

from __future__ import annotations

import numpy as np
import pytest
from hearing_cases import GARDEN, MARKET, chords, joined, noise, said, words

from mien.core import MienError, Sound
from mien.speech import hear

PAUSE = Sound.silence(6.0)


def test_a_transcript_of_another_sound_is_refused_with_the_place():
    with pytest.raises(
        MienError, match=r"^the text is not what is said: 0\.\d s .*word 1 of the text, 'We'.*like 'she"
    ):
        hear(said(MARKET).sound, GARDEN)


def test_a_transcript_in_another_language_is_refused():
    with pytest.raises(MienError, match=r"word 1 of the text, 'Die', .* in English"):
        hear(said(MARKET).sound, "Die Kinder spielen im Garten, und die Mutter liest ein gutes Buch.")


@pytest.mark.parametrize("text", ["", "  \n"])
def test_an_empty_transcript_is_refused(text: str):
    with pytest.raises(MienError, match="transcript is empty"):
        hear(said(MARKET).sound, text)


def test_a_transcript_without_words_is_refused():
    with pytest.raises(MienError, match="transcript '日本': there is no word"):
        hear(said(MARKET).sound, "日本")


def test_a_longer_transcript_ends_with_the_sound():
    heard = hear(said(MARKET).sound, f"{MARKET} {GARDEN}")
    assert words(heard) == [cue.symbol for cue in said(MARKET).words]
    assert heard.notices == ("the sound ends before the text: 13 words, from 'We' on, are not heard",)
    assert heard.speech.skipped[:3] == ("We", "have", "never")


def test_a_shorter_transcript_is_told_where_it_ends():
    first, pause, second = said(MARKET).sound, Sound.silence(8.0), said(GARDEN).sound
    heard = hear(joined(first, pause, second), MARKET)
    assert words(heard)[:14] == [cue.symbol for cue in said(MARKET).words]
    ends_s = first.length_s + 8.0 + said(GARDEN).words[0].start_s
    assert heard.notices == (f"the text ends {ends_s:.1f} s into the sound, which goes on",)


def test_words_that_are_not_said_are_told_with_their_place():
    more = MARKET.replace("butter", "some very old and smelly cheese, butter")
    heard = hear(said(MARKET).sound, more)
    assert words(heard) == [cue.symbol for cue in said(MARKET).words]
    assert len(heard.notices) == 1
    assert "the sound says nothing where the text, word" in heard.notices[0]
    assert "smelly" in heard.notices[0]
    assert "smelly" in heard.speech.skipped


@pytest.mark.parametrize("text", [None, MARKET])
@pytest.mark.parametrize("sound", [noise(4.0, 3000.0), chords(4.0)], ids=["noise", "music"])
def test_what_is_no_speech_is_refused(sound: Sound, text: str | None):
    with pytest.raises(MienError, match=r"no word is heard|none of the words of the transcript is heard"):
        hear(sound, text)


def test_silence_is_refused():
    with pytest.raises(MienError, match="the sound is silent"):
        hear(Sound.silence(3.0), MARKET)


def test_no_sound_is_refused():
    with pytest.raises(MienError, match=r"lasts 0\.00 s"):
        hear(Sound.silence(0.0))


def test_a_chord_that_swells_and_fades_moves_no_mouth():
    rate_hz, time_s = 16000, np.arange(64000) / 16000
    chord = sum(np.sin(2.0 * np.pi * hz * time_s) for hz in (220, 277, 330, 440))
    swell = 0.6 + 0.4 * np.sign(np.sin(4.0 * np.pi * time_s))
    with pytest.raises(MienError, match="no word is heard"):
        hear(Sound((3000.0 * chord * swell).astype(np.int16), rate_hz))


def test_a_text_that_was_right_for_long_is_not_refused_for_what_follows():
    strange = "Nine large ships sailed slowly towards the northern harbour before dawn."
    sound = joined(*(part for text in (MARKET, GARDEN, strange, strange) for part in (said(text).sound, PAUSE)))
    wrong = "Perhaps you could explain why everybody left without saying a single word."
    heard = hear(sound, f"{MARKET} {GARDEN} {wrong} {wrong}")
    assert words(heard)[:27] == [cue.symbol for text in (MARKET, GARDEN) for cue in said(text).words]
    assert any("the text may not be what is said" in notice and "word 28" in notice for notice in heard.notices)
