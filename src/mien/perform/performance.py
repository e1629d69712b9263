"""Speech, blinks, glances, nods, brows and emotion put together for one face."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from mien.core import Face, ParameterTable, RangeError, Scene, Sound, UnknownNameError
from mien.gaze import blinks, brow_raises, find_accents, head_sway, nods, saccades
from mien.speech import Speech
from mien.speech.mouth import MOUTH_CHANNELS, articulate
from mien.timeline import Layer, Timeline, Track
from mien.vocab import Remap, load_remap, weigh

from .style import Style

USUAL = Style()

VOCABULARY = "channels"

EASE_S = 0.6
"""An emotion comes and goes in this time, or in a third of a short text."""

SPOKEN_SHARE = 0.45
"""Part of an emotion that is left in parameters that the mouth needs for speaking.

A laugh keeps its smile, its cheeks and its eyes, but not all of its open jaw; otherwise words drown in it.
"""

SCENE_GROUPS = ("target", "viewer", "light")
"""Rows that the scene fills in; an emotion that moved one of them would make the eyes leave the viewer with a jerk."""

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
) -> Performance:
    """What a face does while it says something, as a timeline of named layers, with the sound.

    Layers, lowest first: ``idle`` (sway), ``gaze`` (glances), ``expression`` (the emotion), ``speech`` (mouth, nods,
    brows) are added up; ``shut`` multiplies, so that blinks shut the eyes and p, b, m the lips whatever lies beneath;
    ``direct`` is free for what is set by hand.

    Args:
        speech: words, phones and sound.
        face: of a family that the table ``channels`` exists for.
        seed: of everything that chance decides; the same seed gives the same bits.
        style: how lively.
        emotion: a preset of the kind ``expression``, eased in and out.
        emotion_amount: how much of it, 0..1.

    Raises:
        MienError: the face is of a family that cannot be played.
        UnknownNameError: the face has no such expression.
        RangeError: there is no such amount.
    """
    remap = load_remap(VOCABULARY, face.family)
    voiced = listen(speech, face)
    length_s = voiced.timeline.length_s
    lids = _lids(speech, length_s, seed, style)
    mouth = articulate(speech.phones, style)
    moved = {**mouth, **_accents(speech, length_s, seed, style)}
    layers = (
        Layer("idle", "add", _play(remap, {**_sway(length_s, seed, style), **lids})),
        Layer("gaze", "add", _play(remap, _glances(speech, length_s, seed, style))),
        Layer("expression", "add", _expression(face, remap, emotion, emotion_amount, length_s)),
        Layer("speech", "add", _play(remap, moved)),
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


def check_emotion(face: Face, emotion: str, amount: float = 1.0) -> None:
    """Nothing, when the face has such an expression, and there can be so much of it.

    Raises:
        UnknownNameError: it has none of that name.
        RangeError: the amount is not in 0..1.
    """
    expressions = [name for name, preset in face.presets.items() if preset.kind == "expression"]
    if emotion not in expressions:
        raise UnknownNameError(f"emotion of {face.name!r}", emotion, expressions)
    if not 0.0 <= amount <= 1.0:
        raise RangeError(f"emotion {emotion!r}: {amount:g} is out of range — it goes from 0 to 1")


def _lids(speech: Speech, length_s: float, seed: int, style: Style) -> Mapping[str, Track]:
    return blinks(length_s, seed, speech.phones, often=style.blinks) if style.blinks else {}


def _sway(length_s: float, seed: int, style: Style) -> Mapping[str, Track]:
    return _scaled(head_sway(length_s, seed), style.head)


def _glances(speech: Speech, length_s: float, seed: int, style: Style) -> Mapping[str, Track]:
    return _scaled(saccades(length_s, seed, speech.phones), style.gaze)


def _accents(speech: Speech, length_s: float, seed: int, style: Style) -> Mapping[str, Track]:
    accents = find_accents(speech.words, speech.phones, seed)
    return {
        **_scaled({"head_nod": nods(accents, length_s, seed)}, style.head),
        **_scaled({"brow_raise": brow_raises(accents, length_s, seed)}, style.brows),
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


def _expression(face: Face, remap: Remap, emotion: str | None, amount: float, length_s: float) -> dict[str, Track]:
    """Tracks that add an amount of what a preset changes, eased in and out."""
    if emotion is None:
        return {}
    check_emotion(face, emotion, amount)
    spoken = set(remap.reached_by(_spoken(remap)))
    ease = min(EASE_S, length_s / 3.0)
    tracks = {}
    for name, offset in _offsets(face.parameters, face.presets[emotion].values).items():
        reached = amount * offset * (SPOKEN_SHARE if name in spoken else 1.0)
        times = [0.0, ease, length_s - ease, length_s]
        tracks[name] = Track.from_keys(times, [0.0, reached, reached, 0.0], "cosine", name=name)
    return tracks


def _spoken(remap: Remap) -> Iterable[str]:
    return [channel for channel in MOUTH_CHANNELS if channel in remap.index]


def _offsets(table: ParameterTable, values: Mapping[str, float]) -> dict[str, float]:
    """How far a preset lies from the defaults, by row, without the rows of the scene."""
    return {
        row: value - table[row].default
        for name, value in values.items()
        for row in table.resolve(name)
        if value != table[row].default and row.split(".")[0] not in SCENE_GROUPS
    }


def _title(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= TITLE_LENGTH else line[: TITLE_LENGTH - 1].rstrip() + "…"
