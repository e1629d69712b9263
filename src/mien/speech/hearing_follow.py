"""A transcript followed through sound of any length, a piece of a few seconds at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError, Sound

from .align import Aligner, FoundWord, Recogniser
from .hearing_merge import merge_words
from .hearing_sound import Loudness, take_piece
from .hearing_words import OWN_MARK, Token

SHORTEST_PIECE_S, LONGEST_PIECE_S = 5.0, 12.0
"""A piece ends at the quietest place between these, seconds."""

MOST_WORDS_A_SECOND = 7.0
"""More than anybody says."""

UNFINISHED_S = 0.12
"""A word that ends so near the end of a piece may go on in the next, seconds."""

POOR_SCORE, POOR_SCORE_IN_NOISE = 36.0, 46.0
"""Mean score of the words of a piece from which on they are not what is heard.

Measured on 32 sentences by six speakers: their own text has at most 20, in noise of 10 dB below them at most 41; the
text of another sentence has 36 and more, 63 in the median, in noise 45 to 50 in the median.
"""

NOISY_DB = 25.0
"""Less than this between what is loud and what is quiet is noise."""

UNEXPLAINED_S = 0.6
"""So much sound between two words is more than a breath: there are words that the text does not have, seconds."""

LEAST_AGREEMENT = 0.3
"""Of the words that are recognised, the share that must stand in the text."""

TRUSTED = 20
"""Words of the text that were heard, from which on it is believed where the sound is not understood."""

MOST_QUOTED = 8
"""Words in a message."""

LONGEST_PHONE_S = 1.5

Report = Callable[[float], None]


@dataclass(frozen=True)
class HeardWord:
    """A word in the sound, and the place of its token in the transcript; None for one that the text does not have."""

    word: FoundWord
    place: int | None


def find_piece(sound: Sound, loudness: Loudness, start_s: float) -> tuple[float, float] | None:
    """From when to when to listen next, from a time on; None when all that is left is silence."""
    start_s, last_s = loudness.trim(start_s, sound.length_s)
    if last_s <= start_s:
        return None
    if last_s - start_s <= LONGEST_PIECE_S:
        return start_s, last_s
    return start_s, loudness.find_cut_s(start_s + SHORTEST_PIECE_S, start_s + LONGEST_PIECE_S)


def count_finished(words: Sequence[FoundWord], piece: tuple[float, float], sound: Sound) -> int:
    """How many words of a piece are over when it ends; all where it has but one, so that there is progress."""
    cut = len(words) > 1 and words[-1].end_s > piece[1] - UNFINISHED_S and piece[1] < sound.length_s - UNFINISHED_S
    return len(words) - cut


def is_spoken(word: FoundWord) -> bool:
    """Whether a word that was recognised can be one: no sound of speech lasts as long as hum or noise may."""
    return max(phone.end_s - phone.start_s for phone in word.phones) < LONGEST_PHONE_S


def find_unexplained_s(words: Sequence[FoundWord], piece: tuple[float, float], loudness: Loudness) -> list[float]:
    """How much is heard before each word of a piece, and after the last one, beside the words, seconds."""
    ends = [piece[0], *(word.end_s for word in words)]
    starts = [*(word.start_s for word in words), piece[1]]
    return [loudness.count_loud_s(*gap) for gap in zip(ends, starts, strict=True)]


def mean_score(words: Sequence[FoundWord]) -> float:
    """How much worse words fit than what fits best, over their time."""
    spans = [word.end_s - word.start_s for word in words]
    return sum(word.score * span for word, span in zip(words, spans, strict=True)) / max(sum(spans), 1e-9)


class Follower:
    """Finds the tokens of a transcript in a sound."""

    def __init__(self, sound: Sound, loudness: Loudness, aligner: Aligner, tokens: Sequence[Token]) -> None:
        self._sound, self._loudness, self._aligner, self._tokens = sound, loudness, aligner, tokens
        self._recogniser: Recogniser | None = None
        self._strange = True  # whether the piece before was none of the text's; nothing heard yet is no excuse
        self._over = False  # whether the text has come to its end
        self._known = 0  # how many words of the text fitted so far
        self.notices: list[str] = []

    def follow(self, report: Report) -> Iterator[HeardWord]:
        """The words in order of time.

        Raises:
            MienError: the text is not what is said.
        """
        place, piece = 0, find_piece(self._sound, self._loudness, 0.0)
        while piece is not None:
            found = self._hear_piece(*piece, place)
            words = [heard.word for heard in found]
            count = count_finished(words, piece, self._sound)
            if count > 1 and find_unexplained_s(words, piece, self._loudness)[-1] >= UNEXPLAINED_S:
                count -= 1  # the search ended too early: what is left is a piece of its own, from the last word on
            yield from found[:count]
            place = max([place, *(heard.place + 1 for heard in found[:count] if heard.place is not None)])
            next_s = piece[1] if count == len(found) else found[count - 1].word.end_s
            report(next_s)
            piece = find_piece(self._sound, self._loudness, next_s)
        if place < len(self._tokens):
            word = self._tokens[place]
            self.notices.append(
                f"the sound ends before the text: {len(self._tokens) - place} words, "
                f"from {word.spoken!r} on, are not heard"
            )

    def _hear_piece(self, start_s: float, end_s: float, place: int) -> list[HeardWord]:
        samples = take_piece(self._sound, start_s, end_s, self._loudness)
        count = 1 + round((end_s - start_s) * MOST_WORDS_A_SECOND)
        ahead = self._tokens[place : place + count]
        last = find_piece(self._sound, self._loudness, end_s) is None and place + count >= len(self._tokens)
        chain = [token.spellings for token in ahead]
        found = self._aligner.align(samples, chain, open_end=not last) if chain else None
        found = found and [word.later(start_s) for word in found]
        if found and self._explains(found, (start_s, end_s)):
            quiet = self._loudness.loud_db - self._loudness.low_db >= NOISY_DB
            if mean_score(found) <= (POOR_SCORE if quiet else POOR_SCORE_IN_NOISE):
                self._known += len(found)
                return self._accept(found, place)
        else:
            found = None
        return self._repair(samples, start_s, place, ahead, found)

    def _explains(self, words: Sequence[FoundWord], piece: tuple[float, float]) -> bool:
        """Whether nothing else is heard in a piece; after the last of several words is another piece."""
        gaps_s = find_unexplained_s(words, piece, self._loudness)
        return max(gaps_s[:-1] if len(words) > 1 else gaps_s) < UNEXPLAINED_S

    def _accept(self, words: Sequence[FoundWord], place: int) -> list[HeardWord]:
        self._strange = False
        return [HeardWord(word, place + number) for number, word in enumerate(words)]

    def _repair(
        self,
        samples: NDArray[np.int16],
        start_s: float,
        place: int,
        ahead: Sequence[Token],
        found: Sequence[FoundWord] | None,
    ) -> list[HeardWord]:
        """What is heard in a piece that seems not to hold the words ahead: as much of them as possible, and the rest.

        Words ahead that were found, and fit better than those recognised, are what is said, by a strange voice.
        """
        self._recogniser = self._recogniser or Recogniser()
        heard = [word for word in self._recogniser.recognise(samples) if is_spoken(word)]
        if not heard:
            return []  # noise or music: the text goes on after it
        if found and mean_score(found) < mean_score(heard):
            return self._accept(found, place)
        spellings = [word.spelling for word in heard]
        merge = merge_words([token.spellings[0].removesuffix(OWN_MARK) for token in ahead], spellings)
        strange = merge.agreed < LEAST_AGREEMENT * len(heard)
        if strange and ahead and self._strange:
            where = (
                f"{start_s + heard[0].start_s:.1f} s into the sound, where word {place + 1} of the text, "
                f"{ahead[0].spoken!r}, should come, it says something like {_quote(spellings)}"
            )
            if self._known < TRUSTED:
                raise MienError(
                    f"the text is not what is said: {where} — is it the text of this sound, and in English?"
                )
            self.notices.append(f"the text may not be what is said: {where}")
            if found:
                return self._accept(found, place)
        if not ahead and not self._over:
            self.notices.append(f"the text ends {start_s + heard[0].start_s:.1f} s into the sound, which goes on")
        self._strange, self._over = strange, not ahead
        for difference in merge.differences if ahead else ():
            said, written = spellings[slice(*difference.heard)], ahead[slice(*difference.text)]
            time_s = start_s + heard[min(difference.heard[0], len(heard) - 1)].start_s
            self.notices.append(
                f"{time_s:.1f} s: the sound says {_quote(said)} where the text, word {place + difference.text[0] + 1}, "
                f"has {_quote([token.spoken for token in written])}"
            )
        chain = [(spellings[other],) if own < 0 else ahead[own].spellings for own, other in merge.words]
        found = self._aligner.align(samples, chain) if chain else None
        if found is None:
            return [HeardWord(word.later(start_s), None) for word in heard]
        return [
            HeardWord(word.later(start_s), None if own < 0 else place + own)
            for word, (own, _) in zip(found, merge.words, strict=True)
        ]


def _quote(words: Sequence[str]) -> str:
    """The words, the first of them where they are many."""
    if not words:
        return "nothing"
    return repr(" ".join(words[:MOST_QUOTED]) + (" …" if len(words) > MOST_QUOTED else ""))
