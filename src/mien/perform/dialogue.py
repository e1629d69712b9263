"""Several who speak in turn: one speaks, the others listen and look at whoever does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from mien.core import SILENCE, Cue, Face, MienError, Sound, SoundStore
from mien.gaze import Glance
from mien.speech import Speech

from .performance import USUAL, Performance, listen, perform
from .style import Style

REACT_S = 0.25
"""Who listens looks at the speaker this long after the first word: about the time of a saccade to a sound (our choice).
"""


@dataclass(frozen=True, eq=False)
class Turn:
    """What one says, before the next does."""

    speaker: str
    speech: Speech


@dataclass(frozen=True, eq=False)
class Dialogue:
    """A performance for each speaker, all of the same length and sound.

    Attributes:
        heard: the sound with the words of all; nothing moves in it.
        parts: what each speaker does, by name, from the left one to the right one.
        turns: when each turn begins, seconds, and whose it is.
    """

    heard: Performance
    parts: Mapping[str, Performance]
    turns: tuple[tuple[float, str], ...]


def converse(turns: Sequence[Turn], faces: Mapping[str, Face], *, seed: int = 0, style: Style = USUAL) -> Dialogue:
    """The turns said one after the other.

    Who speaks first sits on the left; the others follow in the order in which they first speak.

    Args:
        turns: in order.
        faces: by speaker.
        seed: of everything that chance decides; every speaker has chances of their own.
        style: how lively they are.

    Raises:
        MienError: voices of different rates.
        UnknownNameError: a face has no expression that a mark asks for.
    """
    sound, starts = _join(turns)
    shifted = [replace(turn, speech=_later(turn.speech, start_s)) for turn, start_s in zip(turns, starts, strict=True)]
    names = list(dict.fromkeys(turn.speaker for turn in turns))
    heard = _gather(shifted, sound)
    parts = {
        name: perform(
            _gather([turn for turn in shifted if turn.speaker == name], sound),
            faces[name],
            seed=seed + number,
            style=style,
            glances=_attend(name, names, shifted),
        )
        for number, name in enumerate(names)
    }
    return Dialogue(
        listen(heard, faces[names[0]]),
        parts,
        tuple((start_s, turn.speaker) for start_s, turn in zip(starts, turns, strict=True)),
    )


def _join(turns: Sequence[Turn]) -> tuple[Sound, list[float]]:
    """All sounds as one, and when each begins, seconds."""
    rates = sorted({turn.speech.sound.rate_hz for turn in turns})
    if len(rates) > 1:
        raise MienError(f"voices of {rates[0]} and of {rates[1]} samples a second do not fit into one sound")
    store, starts = SoundStore(rates[0]), []
    try:
        for turn in turns:
            starts.append(store.length_s)
            store.write(turn.speech.sound.samples)
        return store.sound(), starts
    finally:
        store.close()


def _later(speech: Speech, shift_s: float) -> Speech:
    def move(cues: Sequence[Cue]) -> tuple[Cue, ...]:
        return tuple(Cue(cue.start_s + shift_s, cue.end_s + shift_s, cue.symbol) for cue in cues)

    return replace(speech, words=move(speech.words), phones=move(speech.phones))


def _gather(turns: Sequence[Turn], sound: Sound) -> Speech:
    """The turns as one speech with the whole sound; where others speak, nothing is said."""
    phones: list[Cue] = []
    end_s = 0.0
    for cue in [*(cue for turn in turns for cue in turn.speech.phones), Cue(sound.length_s, sound.length_s, SILENCE)]:
        if cue.start_s > end_s:
            phones.append(Cue(end_s, cue.start_s, SILENCE))
        if cue.end_s > cue.start_s:
            phones.append(cue)
        end_s = cue.end_s
    return Speech(
        "\n".join(turn.speech.text for turn in turns),
        sound,
        tuple(word for turn in turns for word in turn.speech.words),
        tuple(phones),
        tuple(dict.fromkeys(run for turn in turns for run in turn.speech.skipped)),
        turns[0].speech.voice,
        "\n".join(turn.speech.script for turn in turns),
    )


def _attend(name: str, names: Sequence[str], turns: Sequence[Turn]) -> tuple[Glance, ...]:
    """Where one who listens looks, from soon after another's first word until the next turn begins."""
    found: list[Glance] = []
    for turn in turns:
        if turn.speaker != name:
            side = "left" if names.index(turn.speaker) < names.index(name) else "right"
            found.append(Glance(turn.speech.words[0].start_s + REACT_S, turn.speech.phones[-1].end_s, side))
    return tuple(found)
