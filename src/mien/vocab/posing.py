"""A pose of a face from values under other people's names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from mien.core import Face, Parameter, Pose, UnknownNameError

from .remap import Remap, load_remap, next_step
from .rules import load_rules, settle
from .vocabulary import vocabulary


def pose_from(name: str, values: Mapping[str, float], face: Face, base: Pose | None = None) -> Pose:
    """The pose of a face with values under the names of a vocabulary on top of another pose.

    Names of a vocabulary that fight, or mean nothing alone, first settle it among themselves (``load_rules``). Then
    what several names do to one parameter is combined so that it never passes the end of its range and is never cut
    off there: pushes in one direction each take their part of the way that the others leave to the end, and pushes in
    opposite directions are subtracted. A single name gives its exact value; the order of names does not matter. What
    multiplies (a blink) does so last. A vocabulary without a table for the face goes by way of another one.

    Args:
        name: of the vocabulary: ``arkit``, ``facs`` …
        values: by its names or their aliases; a symmetric name sets both sides, a later name wins.
        face: of a family that has a table for the vocabulary.
        base: what the face looks like without the values; None is neutral.

    Raises:
        UnknownNameError: there is no such vocabulary or name.
        RangeError: a value is out of its name's range.
        MienError: the vocabulary has no table for this family of faces.
    """
    base = face.neutral if base is None else base
    settled = settle(read_values(name, values), load_rules(name))
    step = next_step(name, face.family)
    if step == face.family:
        return _move(base, load_remap(name, step), settled)
    moved = _move(Pose.neutral(vocabulary(step)), load_remap(name, step), settled)
    return pose_from(step, moved.changed(), face, base)


def _move(base: Pose, remap: Remap, values: Mapping[str, float]) -> Pose:
    changes = {}
    for name, pushes in remap.pushes(values).items():
        row = base.table[name]
        changes[name] = combine(row, ((base[name] - row.default, 1.0), *pushes))
    for name, factor in remap.scale(values).items():
        changes[name] = changes.get(name, base[name]) * factor
    return base.replace(changes)


def read_values(name: str, values: Mapping[str, float]) -> dict[str, float]:
    """Values by the vocabulary's own names, those at rest left out.

    Raises:
        UnknownNameError: there is no such vocabulary or name.
        RangeError: a value is out of its name's range.
    """
    table = vocabulary(name)
    for key in values:
        if key not in table:
            raise UnknownNameError(f"name in the vocabulary {name!r}:", key, [*table.names, *table.symmetric])
    return Pose.neutral(table).replace(values).changed()


def combine(row: Parameter, pushes: Iterable[tuple[float, float]]) -> float:
    """The value of a parameter that several pushes move from its default; always in its range.

    Args:
        row: the parameter.
        pushes: (how far a full one goes, how much of it is there); a full one that would pass the end of the range
            goes to the end, and half of it half as far.
    """
    room = {True: row.high - row.default, False: row.default - row.low}
    way = {True: 0.0, False: 0.0}
    for gain, amount in pushes:
        up, share = gain * amount > 0.0, abs(amount)
        if gain and room[up]:
            push = min(abs(gain) * max(share, 1.0), room[up]) * min(share, 1.0)
            way[up] += push - way[up] * (push / room[up])
    # Rounding alone can pass an end.
    return min(max(row.default + way[True] - way[False], row.low), row.high)
