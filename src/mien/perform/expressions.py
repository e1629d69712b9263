"""Expressions over time: an emotion that shows through, and those that marks ask for, one after the other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from mien.core import Face, MienError, Pose, RangeError, UnknownNameError
from mien.speech.mouth import MOUTH_CHANNELS
from mien.timeline import Track
from mien.vocab import Remap, pose_from

from .gestures import gestures
from .marks import Expression, MarkedText, Units

EASE_S = 0.6
"""An emotion comes and goes in this time, or in a third of a short text."""

CHANGE_S = 0.4
"""An expression that a mark asks for comes in this time: our choice."""

SHORTEST_S = 0.1
"""An expression that another one follows within this time is left out; no face is that fast."""

SPOKEN_SHARE = 0.45
"""Part of an emotion that is left in parameters that the mouth needs for speaking.

A laugh keeps its smile, its cheeks and its eyes, but not all of its open jaw; otherwise words drown in it.
"""

NEUTRAL = "neutral"
"""The expression that every face has: none."""


@dataclass(frozen=True)
class Change:
    """A way to an expression: when it begins and when it is there, seconds, and how far rows then lie from rest."""

    start_s: float
    end_s: float
    offsets: Mapping[str, float]


def check_emotion(face: Face, emotion: str, amount: float = 1.0) -> None:
    """Nothing, when the face has such an expression, and there can be so much of it.

    Raises:
        UnknownNameError: it has none of that name.
        RangeError: the amount is not in 0..1.
    """
    if emotion not in _expressions(face):
        raise UnknownNameError(f"emotion of {face.name!r}", emotion, _expressions(face))
    if not 0.0 <= amount <= 1.0:
        raise RangeError(f"emotion {emotion!r}: {amount:g} is out of range — it goes from 0 to 1")


def check_marks(marked: MarkedText, face: Face) -> None:
    """Nothing, when the face can do all that the marks ask for.

    Raises:
        UnknownNameError: it has no such expression; names line and column.
        MienError: it has no action units, or not that one.
    """
    for mark in marked.marks:
        if isinstance(mark.act, Expression):
            known = [*_expressions(face), NEUTRAL, *gestures(face)]
            if mark.act.name not in known:
                raise UnknownNameError(f"mark in {mark.where}:", mark.act.name, [*known, "look", "au"])
        elif isinstance(mark.act, Units):
            try:
                pose_from("facs", mark.act.values, face)
            except MienError as error:
                raise MienError(f"{mark.where}: {error}") from None


def express(
    face: Face,
    remap: Remap,
    asked: Sequence[tuple[float, Expression | Units]],
    length_s: float,
    *,
    emotion: str | None = None,
    amount: float = 1.0,
) -> dict[str, Track]:
    """Tracks that add an emotion and the expressions that were asked for to parameters, each until the next.

    At the end all is at rest again, unless an expression was asked for too late for that.

    Raises:
        UnknownNameError: the face has no such expression.
        RangeError: there is no such amount of the emotion.
    """
    ease_s = min(EASE_S, length_s / 3.0)
    changes = []
    if emotion is not None:
        check_emotion(face, emotion, amount)
        changes.append(Change(0.0, ease_s, _offsets(face, Expression(emotion, amount))))
    changes += [Change(start_s, min(start_s + CHANGE_S, length_s), _offsets(face, act)) for start_s, act in asked]
    changes = list(_one_after_another(changes))
    if changes and changes[-1].end_s <= length_s - ease_s:
        changes.append(Change(length_s - ease_s, length_s, {}))
    spoken = set(remap.reached_by(channel for channel in MOUTH_CHANNELS if channel in remap.index))
    rows = dict.fromkeys(name for change in changes for name in change.offsets)
    return {name: _change(name, changes, SPOKEN_SHARE if name in spoken else 1.0) for name in rows}


def _one_after_another(changes: Sequence[Change]) -> Iterator[Change]:
    """The changes, each over when the next begins; those that would have no time for it are left out."""
    for change, following in pairwise(changes):
        if following.start_s - change.start_s >= SHORTEST_S:
            yield replace(change, end_s=min(change.end_s, following.start_s))
    yield from changes[-1:]


def _change(name: str, changes: Iterable[Change], share: float) -> Track:
    times, values = [0.0], [0.0]
    for change in changes:
        if change.start_s > times[-1]:
            times.append(change.start_s)
            values.append(values[-1])
        times.append(change.end_s)
        values.append(share * change.offsets.get(name, 0.0))
    return Track.from_keys(times, values, "cosine", name=name)


def _expressions(face: Face) -> list[str]:
    return [name for name, preset in face.presets.items() if preset.kind == "expression"]


def _offsets(face: Face, act: Expression | Units) -> dict[str, float]:
    """How far an expression lies from the defaults, by row.

    Rows of the scene are left out: one that moved would make the eyes leave the viewer with a jerk.
    """
    table = face.parameters
    if isinstance(act, Units):
        amount = 1.0
        values: Mapping[str, float] = pose_from("facs", act.values, face, Pose.neutral(table)).changed()
    else:
        amount = act.amount
        values = {} if act.name == NEUTRAL else face.presets[act.name].values
    return {
        row: amount * (value - table[row].default)
        for name, value in values.items()
        for row in table.resolve(name)
        if value != table[row].default and table[row].role != "scene"
    }
