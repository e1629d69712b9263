"""A recording heard: its words and phones with their times, with a transcript or without one."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mien.core import SILENCE, Cue, MienError, Sound

from .align import Aligner, FoundWord, PhoneRecogniser, Recogniser
from .hearing_follow import Follower, HeardWord, count_finished, find_piece, is_spoken, mean_score
from .hearing_phones import is_understood, put_phones
from .hearing_sound import Loudness, measure_loudness, take_piece
from .hearing_words import Transcript, add_stress, read_transcript
from .voice import Speech, find_speaker, is_english
from .warping import warp

SILENT_DB = -65.0
"""Loudest parts below this are silence: less than noise of 16 bits under a whisper."""

CLIPPED_SHARE = 1e-4
"""Of the samples, from which on a recording is said to be clipped."""

SHORTEST_S = 0.1
"""Less is no word, seconds."""

ALIGNED_SCORE, RECOGNISED_SCORE = (38.0, 6.0), (49.0, 10.0)
"""Score of a word that is as likely right as wrong, and what makes that e times as likely, with and without a text.

Measured on 32 sentences by six speakers, with their own words and with those of other sentences; and on 24 of them
recognised, where 83 % of the words were right and those had a median score of 30, the others of 36.
"""

Report = Callable[[int, int, str], None]


@dataclass(frozen=True, eq=False)
class Heard:
    """What was heard in a recording.

    Attributes:
        speech: as a voice's: the text, the sound, its words and phones with their times. ``skipped`` holds the words
            of the transcript that are not heard; ``voice`` is empty.
        sure: for each word of ``speech``, how likely it is what is heard, 0 to 1.
        notices: what a person should know: clipping, places where text and sound differ.
    """

    speech: Speech
    sure: tuple[float, ...]
    notices: tuple[str, ...]


def hear(sound: Sound, text: str | None = None, *, language: str = "en", report: Report | None = None) -> Heard:
    """The words and phones of a recording.

    Args:
        sound: at 8000 samples a second or more; may be hours long.
        text: what is said in it; None where nobody knows, and then it is recognised, less surely; only in English.
        language: in which it is said, a tag like ``de`` or ``pt-BR``; all but English need espeak-ng.
        report: told (seconds heard, seconds in all, what is being done).

    Raises:
        MienError: nothing is heard (silence, noise, music), the text is empty or another one than what is said.
        UnknownNameError: nobody here speaks the language.
    """
    if text is not None and not text.strip():
        raise MienError("the transcript is empty — leave it out, and the words are recognised")
    voice = None if is_english(language) else find_speaker(language)
    if voice is not None and text is None:
        raise MienError(f"language {language!r}: words are recognised in English only — give the transcript")
    loudness = measure_loudness(sound)
    if sound.length_s < SHORTEST_S:
        raise MienError(f"the sound lasts {sound.length_s:.2f} s — no word is as short as that")
    if loudness.loud_db < SILENT_DB:
        raise MienError("nothing is heard: the sound is silent — is it the right file, and the right channel?")
    notices = []
    if loudness.clipped_share > CLIPPED_SHARE:
        notices.append(f"the sound is clipped ({loudness.clipped_share:.1%} of its samples): record it less loud")

    def tell(time_s: float) -> None:
        if report is not None:
            report(round(time_s), round(sound.length_s), "listening")

    if voice is not None and text is not None:
        warped = warp(sound, loudness, text, voice, tell)
        phones = _fill_gaps((phone for word in warped.words for phone in word.phones), sound.length_s)
        cues = tuple(Cue(word.phones[0].start_s, word.phones[-1].end_s, word.written) for word in warped.words)
        speech = Speech(text, sound, cues, phones, (*warped.missing, *warped.skipped), "")
        return Heard(speech, warped.sure, (*notices, *warped.notices))
    skipped: tuple[str, ...] = ()
    recognised = text is None
    if text is None:
        words = [_Word(word, word.spelling, word.spelling) for word in _listen(sound, loudness, tell)]
        # Sounds alone are no proof of a voice: a chord that swells and fades has phones too.
        if not any(word.written for word in words):
            raise MienError(
                "no word is heard: the sound is noise, music or not English — if it is speech, give its transcript"
            )
        text = " ".join(word.written for word in words if word.written)
        notices += _tell_unspelled(words)
    else:
        aligner = Aligner()
        transcript = read_transcript(text, aligner.lookup)
        if not transcript.tokens:
            raise MienError(f"transcript {text.strip()[:40]!r}: there is no word in it that can be said in English")
        aligner.learn(transcript.learned)
        follower = Follower(sound, loudness, aligner, transcript.tokens)
        found = list(follower.follow(tell))
        if not any(heard.place is not None for heard in found):
            raise MienError("none of the words of the transcript is heard — is it the transcript of this sound?")
        words = [_place_word(heard, transcript) for heard in found]
        notices += follower.notices
        skipped = _find_skipped(words, transcript)
    cues, sure = _time_words(words, RECOGNISED_SCORE if recognised else ALIGNED_SCORE)
    speech = Speech(text, sound, cues, _fill_gaps(_spell_phones(words), sound.length_s), skipped, "")
    return Heard(speech, sure, tuple(notices))


@dataclass(frozen=True)
class _Word:
    """A word that was found, as it is written, as it is spoken, and the place of the written word; -1 for its own."""

    found: FoundWord
    written: str
    spoken: str
    owner: int = -1


def _listen(sound: Sound, loudness: Loudness, tell: Callable[[float], None]) -> Iterator[FoundWord]:
    """The words of a sound, recognised, in order of time.

    Where they are not understood, phones come as words without a spelling.
    """
    recogniser, phone_recogniser = Recogniser(), PhoneRecogniser()
    piece = find_piece(sound, loudness, 0.0)
    while piece is not None:
        samples = take_piece(sound, *piece, loudness)
        found = [word.later(piece[0]) for word in recogniser.recognise(samples) if is_spoken(word)]
        if found and not is_understood(found, piece, loudness):
            found = put_phones(found, [phone.later(piece[0]) for phone in phone_recogniser.recognise(samples)])
        count = count_finished(found, piece, sound)
        yield from found[:count]
        next_s = piece[1] if count == len(found) else found[count - 1].end_s
        tell(next_s)
        piece = find_piece(sound, loudness, next_s)


def _tell_unspelled(words: Iterable[_Word]) -> list[str]:
    """What to say of stretches whose phones are heard, but no words."""
    found = [word.found for word in words if not word.written]
    length_s = sum(word.end_s - word.start_s for word in found)
    if not found:
        return []
    return [
        f"{length_s:.1f} s are heard as sounds, not as words, from {found[0].start_s:.1f} s on — give the transcript"
    ]


def _place_word(heard: HeardWord, transcript: Transcript) -> _Word:
    if heard.place is None:
        return _Word(heard.word, heard.word.spelling, heard.word.spelling)
    token = transcript.tokens[heard.place]
    return _Word(heard.word, transcript.written[token.owner], token.spoken, token.owner)


def _find_skipped(words: Iterable[_Word], transcript: Transcript) -> tuple[str, ...]:
    """What is written and not heard, each once, in order."""
    heard = {word.owner for word in words}
    missing = [word for place, word in enumerate(transcript.written) if place not in heard]
    return tuple(dict.fromkeys([*missing, *transcript.skipped]))


def _time_words(words: Sequence[_Word], scale: tuple[float, float]) -> tuple[tuple[Cue, ...], tuple[float, ...]]:
    """A cue for each written word from its first sound to its last, and how sure each is."""
    groups: list[list[_Word]] = []
    for word in words:
        if not word.written:
            continue
        if groups and word.owner >= 0 and groups[-1][-1].owner == word.owner:
            groups[-1].append(word)
        else:
            groups.append([word])
    cues = [Cue(group[0].found.start_s, group[-1].found.end_s, group[0].written) for group in groups]
    sure = [_how_sure(mean_score([word.found for word in group]), *scale) for group in groups]
    return tuple(cues), tuple(sure)


def _how_sure(score: float, half: float, step: float) -> float:
    return float(1.0 / (1.0 + np.exp((score - half) / step)))


def _spell_phones(words: Sequence[_Word]) -> Iterator[Cue]:
    """Phones of words with their stresses."""
    for word in words:
        symbols = add_stress([phone.symbol for phone in word.found.phones], word.spoken)
        for symbol, phone in zip(symbols, word.found.phones, strict=True):
            yield Cue(phone.start_s, max(phone.start_s, phone.end_s), symbol)


def _fill_gaps(phones: Iterable[Cue], length_s: float) -> tuple[Cue, ...]:
    """Phones from 0 to the end without holes: pauses where none is."""
    cues: list[Cue] = []
    end_s = 0.0
    for phone in phones:
        start_s, stop_s = max(phone.start_s, end_s), min(phone.end_s, length_s)
        if stop_s <= start_s:
            continue
        if start_s > end_s:
            cues.append(Cue(end_s, start_s, SILENCE))
        cues.append(Cue(start_s, stop_s, phone.symbol))
        end_s = stop_s
    if length_s > end_s:
        cues.append(Cue(end_s, length_s, SILENCE))
    return tuple(cues)
