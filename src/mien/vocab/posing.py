"""A pose of a face from values under other people's names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from mien.core import Face, Parameter, ParameterTable, Pose, UnknownNameError

from .loading import load_remap, next_step
from .remap import HALVES, Remap
from .rules import load_rules, settle
from .vocabulary import vocabulary

MOTORS = "toonface"
"""The vocabulary whose names are set like parameters: ToonFace's motor codes."""


def pose_from(name: str, values: Mapping[str, float], face: Face, base: Pose | None = None) -> Pose:
    """The pose of a face with values under the names of a vocabulary on top of another pose.

    Names of a vocabulary that fight, or mean nothing alone, first settle it among themselves (``load_rules``). Then
    what several names do to one parameter is combined so that it never passes the end of its range and is never cut
    off there: pushes in one direction each take their part of the way that the others leave to the end, and pushes in
    opposite directions are subtracted. A single name gives its exact value; the order of names does not matter. What
    multiplies (a blink) does so last. A vocabulary without a table for the face goes by way of another one. What the
    face cannot show is left out, or something stands in for it: ``mien.vocab.loss`` tells.

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
    given = {**settled, **halves(settled, vocabulary(name))}
    if step == face.family:
        return _move(base, load_remap(name, step), given)
    moved = _move(Pose.neutral(vocabulary(step)), load_remap(name, step), given)
    return pose_from(step, moved.changed(), face, base)


def set_values(values: Mapping[str, float], face: Face, base: Pose) -> Pose:
    """The pose with values of the face's own parameters; motor codes of ToonFace move any face, its own names win.

    Raises:
        UnknownNameError: a name is neither a parameter of the face nor a motor.
        RangeError: a value is not finite or out of range.
    """
    codes = vocabulary(MOTORS)
    motors = {name: value for name, value in values.items() if name in codes and name not in face.parameters}
    if motors:
        base = pose_from(MOTORS, motors, face, base)
    return base.replace({name: value for name, value in values.items() if name not in motors})


def _move(base: Pose, remap: Remap, values: Mapping[str, float]) -> Pose:
    remap = remap.on(base.table)
    given = {name: value for name, value in values.items() if name in remap.index}
    changes = {name: combine(base.table[name], moves) for name, moves in remap.moves(given).items()}
    for name, value in remap.places(given).items():
        row = base.table[name]
        changes[name] = min(max(value, row.low), row.high)
    for name, pushes in remap.pushes(given).items():
        row, acting = base.table[name], [push for push in pushes if push[1]]
        if acting:
            changes[name] = combine(row, ((changes.get(name, base[name]) - row.default, 1.0), *acting))
    for name, factor in remap.scale(given).items():
        changes[name] = changes.get(name, base[name]) * factor
    return base.replace(changes)


def read_values(name: str, values: Mapping[str, float]) -> dict[str, float]:
    """Values by the vocabulary's own names, for those that are given.

    Raises:
        UnknownNameError: there is no such vocabulary or name.
        RangeError: a value is out of its name's range.
    """
    table = vocabulary(name)
    for key in values:
        if key not in table:
            raise UnknownNameError(f"name in the vocabulary {name!r}:", key, [*table.names, *table.symmetric])
    pose = Pose.neutral(table).replace(values)
    return {row: pose[row] for key in values for row in table.resolve(key)}


def halves(values: Mapping[str, float], table: ParameterTable) -> dict[str, float]:
    """How far values lie above and below rest, by ``NAME+`` and ``NAME-``: shares of the way to the end.

    Only of names that rest between the ends of their range, not at 0.
    """
    found = {}
    for name, value in values.items():
        row = table[name]
        if row.default:
            found[name + HALVES[0]] = max(value - row.default, 0.0) / (row.high - row.default)
            found[name + HALVES[1]] = max(row.default - value, 0.0) / (row.default - row.low)
    return found


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
