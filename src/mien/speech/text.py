"""Text made ready for a voice: lines, sentences, pieces of bearable length, and what cannot be said."""

from __future__ import annotations

import csv
import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cache
from importlib import resources
from types import MappingProxyType

SENTENCE_PAUSE_S = 0.5
LINE_PAUSE_S = 0.35
PARAGRAPH_PAUSE_S = 0.8
CLAUSE_PAUSE_S = 0.2
WORD_PAUSE_S = 0.06
"""Silence after a sentence, a line of verse, a paragraph, and where a sentence is too long to be said at once, seconds.

Chosen so that the voice neither hurries on nor waits: a reader's pauses grow with the boundary they stand at.
"""

LONGEST_PASSAGE = 280
"""Characters said at once."""

WRAPPED_LINE = 50
"""A line at least this long (characters) whose next line begins in lower case was broken by an editor, not a poet."""

_NEWLINES = re.compile(r"\r\n|[\n\r\v\f\u0085\u2028\u2029]")
_SENTENCE_END = re.compile(r"[.!?…。！？]+[\"”’)\]»]*\s+(?=\S)")
_SURROGATE = re.compile("[\ud800-\udfff]")  # what Python makes of bytes that are no UTF-8
_CLAUSE_END = re.compile(r"[,;:—–][\"”’)\]»]*\s")
_OPENING = "(\"“'‘[«"
_EDGE = '.,;:!?…"“”„«»()[]{}<>*_`~—–|'
_APOSTROPHES = "'‘’"
_ANSWERS = ("No", "no")  # a whole sentence, unless a number follows


@dataclass(frozen=True)
class Passage:
    """Text that is said at once.

    Attributes:
        text: the words as written, no line breaks.
        pause_s: silence wanted after it.
        goes_on: the sentence is not over and no mark says so: the voice should stay up, as at a comma.
        end: how many characters of the whole text are done with it.
    """

    text: str
    pause_s: float
    goes_on: bool
    end: int


@dataclass(frozen=True)
class SpokenWord:
    """A word as written, the words a voice should say for it (none when it cannot), and what it cannot say."""

    written: str
    spoken: tuple[str, ...]
    skipped: tuple[str, ...]


def split_passages(text: str, language: str = "en") -> Iterator[Passage]:
    """Passages of a text: at blank lines, line breaks, ends of sentences, and where a sentence is too long.

    Args:
        text: any.
        language: subtag like ``de``, whose abbreviations end no sentence.
    """
    for block, begin, end, blank_follows in _join_wrapped_lines(text):
        sentences = list(_split_sentences(block, language))
        for number, (first, last) in enumerate(sentences):
            final = number + 1 == len(sentences)
            pause = PARAGRAPH_PAUSE_S if final and blank_follows else SENTENCE_PAUSE_S
            ends = _ends_with_mark(block[first:last])
            if final and not ends and not blank_follows:
                pause = LINE_PAUSE_S
            pieces = list(_split_long(block, first, last))
            for piece, (start, stop) in enumerate(pieces, 1):
                words = block[start:stop].strip()
                if piece < len(pieces):
                    marked = words[-1:] in ",;:—–"
                    yield Passage(words, CLAUSE_PAUSE_S if marked else WORD_PAUSE_S, not marked, begin + stop)
                else:
                    goes_on = not ends and words[-1:] not in ",;:—–" and not blank_follows and end < len(text)
                    yield Passage(words, pause, goes_on, end if final else begin + stop)


def find_complete(text: str, language: str = "en") -> list[int]:
    """Where the sentences end that are complete in a text that is still being written, in characters.

    A sentence is complete once something that is no blank follows it, or, if nothing does yet, a blank.
    """
    return [passage.end for passage in split_passages(text + "A", language)][:-1]


def find_clause(text: str, longest: int, shortest: int) -> int:
    """How many characters the clauses are that a text begins with, within some lengths; 0 where none ends there."""
    ends = [match.end() for match in _CLAUSE_END.finditer(text, 0, longest) if match.end() >= shortest]
    return ends[-1] if ends else 0


def _split_lines(text: str) -> Iterator[tuple[int, int, int]]:
    """First character of each line, the one after its last, and the first of the next line."""
    place = 0
    for match in _NEWLINES.finditer(text):
        yield place, match.start(), match.end()
        place = match.end()
    yield place, len(text), len(text)


def _join_wrapped_lines(text: str) -> Iterator[tuple[str, int, int, bool]]:
    """Lines that belong together as one block, its first and last place, and whether a blank line follows."""
    block: list[str] = []
    begin = end = 0
    for first, last, following in _split_lines(text):
        line = text[first:last]
        stripped = line.strip()
        if block:
            wrapped = len(block[-1].strip()) >= WRAPPED_LINE and stripped[:1].islower()
            if not wrapped:
                yield " ".join(block), begin, end, not stripped
                block = []
        if stripped:
            begin = begin if block else first
            block.append(line)
            end = following
    if block:
        yield " ".join(block), begin, len(text), False


def _ends_with_mark(words: str) -> bool:
    return words.rstrip().rstrip("\"”’')]»")[-1:] in {".", "!", "?", "…", "。", "！", "？"}


def _split_sentences(block: str, language: str) -> Iterator[tuple[int, int]]:
    """First and last place of each sentence of a block."""
    start = 0
    for match in _SENTENCE_END.finditer(block):
        if block[match.end()].islower() or _is_abbreviation(block, match, language):
            continue
        yield start, match.end()
        start = match.end()
    if block[start:].strip():
        yield start, len(block)


def _is_abbreviation(block: str, match: re.Match[str], language: str) -> bool:
    """Whether the full stop follows a title, an initial or an ordinal: ``Dr. Smith``, ``J. K. Rowling``, ``3. Mai``."""
    if not match.group().startswith(".") or match.group()[1:2] == ".":
        return False
    word = block[max(0, match.start() - 12) : match.start()].split(" ")[-1].lstrip(_OPENING)
    word = "#" if word.isdecimal() and len(word) < 3 else word
    if word in _ANSWERS:
        return block[match.end()].isdecimal()
    return word in read_abbreviations(language) or (len(word) == 1 and word.isupper() and word != "I")


@cache
def read_abbreviations(language: str) -> Mapping[str, str]:
    """What is said for words with a full stop that ends no sentence, if anything else; ``#`` is a short number."""
    text = resources.files(__package__).joinpath("data/abbreviations.csv").read_text(encoding="utf-8")
    lines = (line for line in text.splitlines() if not line.startswith("# "))
    return MappingProxyType(
        {row["word"]: row["spoken"] for row in csv.DictReader(lines) if row["language"] == language}
    )


def _split_long(block: str, first: int, last: int) -> Iterator[tuple[int, int]]:
    """Places of the pieces of a sentence, each at most ``LONGEST_PASSAGE`` long, cut after clauses if possible."""
    while last - first > LONGEST_PASSAGE:
        window = block[first : first + LONGEST_PASSAGE]
        clauses = [match.end() for match in _CLAUSE_END.finditer(window) if match.end() > LONGEST_PASSAGE // 3]
        space = max((window.rfind(blank) for blank in " \t\u00a0"), default=-1) + 1
        cut = clauses[-1] if clauses else space if space > LONGEST_PASSAGE // 3 else LONGEST_PASSAGE
        if block[first : first + cut].strip():
            yield first, first + cut
        first += cut
    if block[first:last].strip():
        yield first, last


@cache
def read_spoken_symbols() -> Mapping[str, str]:
    """English words for symbols that the voice does not know itself."""
    text = resources.files(__package__).joinpath("data/symbols_en.csv").read_text(encoding="utf-8")
    lines = (line for line in text.splitlines() if not line.startswith("#"))
    return MappingProxyType({row["symbol"]: row["spoken"] for row in csv.DictReader(lines)})


def split_words(passage: str) -> list[str]:
    """Words as written: what stands between spaces and dashes; dashes and dots stay with the word before them."""
    opened = re.sub(r"(--+|—|…|\.{3,})", r"\1 ", passage)
    words: list[str] = []
    for word in opened.split():
        if (
            words
            and not any(character.isalnum() or ord(character) > 0x2FFF for character in word)
            and (set(word) <= set("-—–…."))
        ):
            words[-1] += word if word.startswith((".", "…")) else " " + word
        else:
            words.append(word)
    return words


def trim_word(word: str) -> str:
    """The word without the punctuation around it and what cannot be seen; itself when there is nothing else."""
    trimmed = "".join(
        character for character in word if unicodedata.category(character) not in {"Cc", "Cf", "Cs", "Zs"}
    )
    trimmed = trimmed.strip(_EDGE).rstrip("-")
    if trimmed[:1] in _APOSTROPHES and trimmed[-1:] in _APOSTROPHES:
        trimmed = trimmed.strip(_APOSTROPHES).strip(_EDGE)
    return trimmed or word


def must_sound(part: str) -> bool:
    """Whether leaving this out would be noticed: it holds a letter, a digit or a sign, not only punctuation."""
    return any(
        unicodedata.category(character)[0] in "LN" or unicodedata.category(character) in {"Sc", "Sm", "So"}
        for character in part
    )


def prepare_word(word: str, sayable: frozenset[str]) -> SpokenWord:
    """What a voice that can say the characters ``sayable`` should be given for a written word.

    Characters of other shapes of the same letter (wide, bold, with a rare accent) become that letter, digits of any
    script become 0 to 9, symbols become words. Marks that have no sound (joiners, soft hyphens) and punctuation need
    no mention. All else is skipped, in runs as written.
    """
    composed = unicodedata.normalize("NFC", _SURROGATE.sub("\ufffd", word))
    spoken: list[str] = []
    runs: list[str] = []
    in_run = False
    for place, character in enumerate(composed):
        category = unicodedata.category(character)
        if category in {"Cf", "Cc", "Mn", "Me"} and character not in sayable:
            if in_run and character != "\u00ad":
                runs[-1] += character
            continue
        said = _say_character(character, composed[place - 1 : place] + composed[place + 1 : place + 2], sayable)
        if said is not None:
            spoken.append(said)
            in_run = False
        elif in_run:
            runs[-1] += character
        else:
            runs.append(character)
            spoken.append(" ")
            in_run = True
    return SpokenWord(word, tuple("".join(spoken).split()), tuple(runs))


def _say_character(character: str, neighbours: str, sayable: frozenset[str]) -> str | None:
    """What to say for one character; None when the voice cannot."""
    if character in sayable:
        return character
    foreign = character.isalpha() and any(other.isalpha() and other not in sayable for other in neighbours)
    symbols = read_spoken_symbols()
    if character in symbols and not foreign:
        name = symbols[character]
        return name if name and not name[0].isalpha() else f" {name} "
    if unicodedata.category(character) == "Nd":
        return str(unicodedata.digit(character))
    for form in ("NFKC", "NFKD"):
        plain = "".join(part for part in unicodedata.normalize(form, character) if not unicodedata.combining(part))
        if plain and plain != character and all(part in sayable for part in plain):
            return plain
    if unicodedata.category(character)[0] in "PZ" or character in "´`¨¯¸":
        return " "
    return None


def match_words(before: Sequence[str], after: Sequence[str]) -> list[int]:
    """For each word of a rewritten sentence, the place of the word in the sentence before that it stands for.

    Equal words stand for themselves; between them, words share their group in order. The places never decrease.
    """
    owners: list[int] = []
    for _, start, stop, first, last in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        count, group = last - first, stop - start
        if group == 0:
            owners += [max(0, min(start, len(before)) - 1)] * count
        else:
            owners += [start + place * group // count for place in range(count)]
    return owners
