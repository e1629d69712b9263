"""Speech, blinks, glances, nods, brows and emotion put together for one face."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from mien.core import Face, Scene, Sound
from mien.gaze import Glance, blinks, brow_raises, find_accents, head_sway, looks, nods, saccades
from mien.speech import Speech
from mien.speech.mouth import articulate
from mien.speech.prosody import Prosody, measure_prosody
from mien.timeline import Layer, Timeline, Track
from mien.vocab import Remap, load_remap, weigh

from .directions import Directions, follow_marks
from .expressions import check_marks, express
from .gestures import gesture, part_gestures
from .marks import MarkedText
from .marks_reader import parse_marks
from .style import Style

USUAL = Style()

VOCABULARY = "channels"

PHRASE_LOOK_S = 0.3
"""A speaker looks at the listener before a phrase ends.

Source: Kendon 1967, Some functions of gaze-direction in social interaction, Acta Psychologica 26; the time is ours.
"""

TITLE_LENGTH = 80


@dataclass(frozen=True, eq=False)
class Performance:
    """What a face does over time, with the sound that it does it to.

    Attributes:
        timeline: named layers of tracks.
        face: who plays it.
        sound: the voice, if any.
        scene: where it is seen from.
    """

    timeline: Timeline
    face: Face
    sound: Sound | None = None
    scene: Scene = field(default_factory=Scene)

    def write(self, path: Path | str, **options: Any) -> None:
        """Writes it; the suffix picks the format: a film (``.mp4``, ``.webm``, ``.gif`` …), a folder of pictures,
        ``.wav``, ``.srt``, ``.TextGrid``, ``.json``, ``.csv``, ``.glb``.

        Options are those of ``mien.formats.write_performance``: ``fps``, ``scene``, ``threads``, ``subtitles`` (a file,
        or ``"burn"``), ``variable``, ``report``.
        """
        from mien.formats import write_performance

        write_performance(self, path, **options)


def perform(
    speech: Speech,
    face: Face,
    *,
    seed: int = 0,
    style: Style = USUAL,
    emotion: str | None = None,
    emotion_amount: float = 1.0,
    glances: Sequence[Glance] = (),
) -> Performance:
    """What a face does while it says something, as a timeline of named layers, with the sound.

    Marks in the script of the speech (``parse_marks``) are followed.

    Layers, lowest first: ``idle`` (sway), ``gaze`` (glances and looks), ``expression`` (emotion, marks), ``hand``
    (where marks ask for it), ``speech`` (mouth, nods, brows) are added up; ``shut`` multiplies, so that blinks shut the
    eyes and p, b, m the lips whatever lies beneath; ``direct`` is free for what is set by hand.

    Args:
        speech: words, phones and sound, with the script where it has marks.
        face: of a family that the table ``channels`` exists for.
        seed: of everything that chance decides; the same seed gives the same bits.
        style: how lively.
        emotion: a preset of the kind ``expression``, eased in and out; a mark of an expression takes its place.
        emotion_amount: how much of it, 0..1.
        glances: looks besides those that marks ask for.

    Raises:
        MienError: the face is of a family that cannot be played, or a mark cannot be understood.
        UnknownNameError: the face has no such expression.
        RangeError: there is no such amount.
    """
    remap = load_remap(VOCABULARY, face.family).on(face.parameters)
    voiced = listen(speech, face)
    length_s = voiced.timeline.length_s
    marked = parse_marks(speech.script) if speech.script else MarkedText(speech.text)
    check_marks(marked, face)
    asked = follow_marks(marked, speech.words, length_s)
    directions = replace(asked, glances=tuple(sorted([*asked.glances, *glances], key=lambda glance: glance.start_s)))
    take = _Take(speech, measure_prosody(speech.sound, speech.words, speech.phones), directions, length_s, seed, style)
    lids, mouth = _lids(take), articulate(speech.phones, style)
    signs, shown = part_gestures(face, directions.expressions)
    expression = express(face, remap, shown, length_s, emotion=emotion, amount=emotion_amount)
    hand = gesture(face, signs, length_s)
    layers = (
        Layer("idle", "add", _play(remap, {**_sway(take), **lids})),
        Layer("gaze", "add", _play(remap, _gaze(take))),
        Layer("expression", "add", expression),
        *([Layer("hand", "add", hand)] if hand else []),
        Layer("speech", "add", _play(remap, {**mouth, **_accents(take)})),
        Layer("shut", "multiply", _shut(remap, {**mouth, **lids})),
        Layer("direct", "replace", {}),
    )
    return replace(voiced, timeline=replace(voiced.timeline, layers=layers, seed=seed))


def listen(speech: Speech, face: Face) -> Performance:
    """What is heard alone, the sound with its words and phones: a performance in which nothing moves yet."""
    # Bytes that are no UTF-8 come as halves of characters, which no file can hold.
    text = speech.text.encode("utf-8", "replace").decode("utf-8")
    timeline = Timeline(
        (), speech.sound.length_s, words=speech.words, phones=speech.phones, title=_title(text), text=text
    )
    return Performance(timeline, face, speech.sound)


@dataclass(frozen=True, eq=False)
class _Take:
    """What is said, what is heard in it, what its marks ask for, and how lively it is to be."""

    speech: Speech
    prosody: Prosody
    directions: Directions
    length_s: float
    seed: int
    style: Style


def _lids(take: _Take) -> Mapping[str, Track]:
    often = take.style.blinks
    ends = take.prosody.ends_s
    return blinks(take.length_s, take.seed, take.speech.phones, often=often, ends_s=ends) if often else {}


def _sway(take: _Take) -> Mapping[str, Track]:
    return _scaled(head_sway(take.length_s, take.seed), take.style.head)


def _gaze(take: _Take) -> Mapping[str, Track]:
    """What the eyes do by themselves, and over it the looks that were asked for, whatever the style."""
    asked = [(glance.start_s, glance.end_s) for glance in take.directions.glances]
    rests = sorted([*asked, *((end_s - PHRASE_LOOK_S, end_s) for end_s in take.prosody.ends_s)])
    idle = _scaled(saccades(take.length_s, take.seed, take.speech.phones, rests), take.style.gaze)
    moved = looks(take.directions.glances, take.length_s, take.seed)
    both = {name: weigh([(1.0, idle[name]), (1.0, moved[name])], name=name) for name in idle.keys() & moved.keys()}
    return {**idle, **moved, **both}


def _accents(take: _Take) -> Mapping[str, Track]:
    speech, heard = take.speech, take.prosody
    accents = find_accents(
        speech.words, speech.phones, take.seed, take.directions.stressed, heard.prominence, heard.ends_s
    )
    return {
        **_scaled({"head_nod": nods(accents, take.length_s, take.seed)}, take.style.head),
        **_scaled({"brow_raise": brow_raises(accents, take.length_s, take.seed)}, take.style.brows),
    }


def _scaled(tracks: Mapping[str, Track], amount: float) -> dict[str, Track]:
    return {name: weigh([(amount, track)], name=name) for name, track in tracks.items()} if amount else {}


def _play(remap: Remap, channels: Mapping[str, Track]) -> dict[str, Track]:
    """Tracks of what is added to parameters; channels that a face has nothing for are left out."""
    return _moving(remap.apply_tracks(_known(remap, channels)), 0.0)


def _shut(remap: Remap, channels: Mapping[str, Track]) -> dict[str, Track]:
    """Tracks of what parameters are multiplied by."""
    return _moving(remap.scale_tracks(_known(remap, channels)), 1.0)


def _known(remap: Remap, channels: Mapping[str, Track]) -> dict[str, Track]:
    return {name: track for name, track in channels.items() if name in remap.index}


def _moving(tracks: Mapping[str, Track], rest: float) -> dict[str, Track]:
    return {name: track for name, track in tracks.items() if np.any(track.given()[1] != rest)}


def _title(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= TITLE_LENGTH else line[: TITLE_LENGTH - 1].rstrip() + "…"
