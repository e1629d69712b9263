"""What a voice is, which voices there are, and what speech is made of."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.metadata import entry_points
from types import MappingProxyType
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from mien.core import Cue, MienError, Sound, UnknownNameError

ENTRY_POINT_GROUP = "mien.voices"
DEFAULT_VOICE = "hibari"


@dataclass(frozen=True, eq=False)
class Utterance:
    """A sentence or line, said.

    Attributes:
        samples: (N,) int16, at the voice's rate.
        words: words as written with their times, from the beginning of this utterance.
        phones: ARPABET phones with their times; vowels carry a stress digit.
        skipped: what the voice could not say.
        pause_s: silence wanted before the next utterance.
        done: how many characters of the text are said with it.
    """

    samples: NDArray[np.int16]
    words: tuple[Cue, ...]
    phones: tuple[Cue, ...]
    skipped: tuple[str, ...] = ()
    pause_s: float = 0.5
    done: int = 0


@dataclass(frozen=True, eq=False)
class Speech:
    """A text, said.

    Attributes:
        text: what was to be said.
        sound: the voice, int16; long sound is a memory map of a temporary file.
        words: words as written, without the punctuation around them.
        phones: ARPABET phones from 0 to the end of the sound without holes; vowels carry a stress digit (``AE1``).
        skipped: what the voice could not say, each once, in order.
        voice: name of the voice.
        script: the text as it was written, with its marks; empty where nobody wrote any.
    """

    text: str
    sound: Sound
    words: tuple[Cue, ...]
    phones: tuple[Cue, ...]
    skipped: tuple[str, ...]
    voice: str
    script: str = ""


@runtime_checkable
class Voice(Protocol):
    """Something that says text, a sentence at a time, so that a book needs no more memory than a sentence.

    Attributes:
        name: what users ask for.
        language: BCP 47 tag of what it speaks, ``en-US``.
        description: one line for people.
        rate_hz: samples a second.
    """

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def language(self) -> str: ...  # noqa: D102
    @property
    def description(self) -> str: ...  # noqa: D102
    @property
    def rate_hz(self) -> int: ...  # noqa: D102

    def utterances(self, text: str) -> Iterator[Utterance]:
        """The text said in order; the same text gives the same samples and cues."""


def voices() -> Mapping[str, Voice]:
    """The voices that can speak on this machine, the built-in one first.

    A plug-in is an entry point of the group ``mien.voices`` that names a function without arguments; it returns a
    voice, or None when something it needs is absent. A plug-in that cannot be imported is absent, too.

    Raises:
        MienError: for a plug-in that returns something else.
    """
    from .voice_espeak import find_espeak
    from .voice_hibari import find_hibari

    found: list[Voice | None] = [find_hibari(), *find_espeak()]
    for entry in sorted(entry_points(group=ENTRY_POINT_GROUP), key=lambda entry: entry.name):
        try:
            voice = entry.load()()
        except ImportError:
            continue
        if voice is not None and not isinstance(voice, Voice):
            raise MienError(
                f"voice plug-in {entry.value!r}: want a mien.speech.Voice or None, got {type(voice).__name__}"
            )
        found.append(voice)
    return MappingProxyType({voice.name: voice for voice in found if voice is not None})


def find_voice(name: str | None = None) -> Voice:
    """The voice of that name; the built-in one without a name.

    Raises:
        UnknownNameError: for a name that no voice has.
        MienError: when there is no voice at all, or what the named one needs is not installed.
    """
    from .voice_espeak import check_installed

    known = voices()
    if not known:
        raise MienError("no voice is installed — try: pip install 'hibari-tts==0.2.1' onnxruntime")
    if name is None:
        return known.get(DEFAULT_VOICE) or next(iter(known.values()))
    if name not in known:
        check_installed(name)
        raise UnknownNameError("voice", name, known)
    return known[name]


def find_speaker(language: str) -> Voice:
    """The first voice that speaks a language: ``de``, ``pt-BR``.

    Raises:
        UnknownNameError: nobody does.
        MienError: somebody would, if an extra were installed.
    """
    from .voice_espeak import check_installed

    known: dict[str, Voice] = {}
    for voice in voices().values():
        for tag in language_tags(voice):
            known.setdefault(tag, voice)
    if language.lower() not in known:
        check_installed(language)
        raise UnknownNameError("language", language, known)
    return known[language.lower()]


def language_tags(voice: Voice) -> tuple[str, str]:
    """What a voice's language is called, in lower case: with its country, and without."""
    tag = voice.language.lower()
    return tag, tag.split("-")[0]


def is_english(language: str) -> bool:
    """Whether a tag is English of any country: ``en-GB``."""
    return language.lower().split("-")[0] == "en"
