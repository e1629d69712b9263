"""People nobody has met: values drawn by chance as they spread among people, and mixtures of people."""

from __future__ import annotations

from collections.abc import Sequence

from .chance import around, stream
from .errors import MienError, RangeError
from .face import Face
from .parameters import SIDES, Pose

ALIKE = 0.94
"""Share of a draw that both sides have in common: faces are nearly symmetric."""

REACH = 3.0
"""Standard deviations within which everything lies; ``around`` has a third of its reach as deviation."""


def random_person(face: Face, seed: int) -> Pose:
    """The rest of a person drawn by chance: a palette, and every value that differs among people; never moved.

    Nothing is left of who the face is but what no parameter says, such as hair.

    The same seed gives the same person on every machine, and each parameter has its own stream: a parameter that is
    added later changes nobody's other values.
    """
    palettes = [preset for preset in face.presets.values() if preset.kind == "palette"]
    values = {row.name: row.usual for row in face.parameters if row.usual is not None}
    if palettes:
        values.update(palettes[int(stream(seed, "palette").random() * len(palettes))].values)
    for row in face.parameters:
        if row.spread:
            common = around(stream(seed, row.name.removesuffix(SIDES[0]).removesuffix(SIDES[1])), 0.0, REACH)
            own = around(stream(seed, row.name), 0.0, REACH)
            draw = ALIKE * common + (1.0 - ALIKE) * own if row.name.endswith(SIDES) else common
            usual = row.default if row.usual is None else row.usual
            values[row.name] = min(max(usual + row.spread * draw, row.low), row.high)
    return Pose.neutral(face.parameters).replace(values)


def mix_people(pose: Pose, face: Face, others: Sequence[tuple[Face, float]]) -> Pose:
    """The pose with shares of other people instead of so much of ``face``.

    Raises:
        RangeError: the shares are not from 0 to 1, or are more than 1 together.
        MienError: another face has other parameters.
    """
    shares = [share for _, share in others]
    if not (all(share >= 0.0 for share in shares) and sum(shares) <= 1.0 + 1e-9):
        said = ", ".join(f"{other.name}={share:g}" for other, share in others)
        raise RangeError(f"mix {said}: want shares from 0 to 1, together no more than 1")
    values = pose.values.copy()
    for other, share in others:
        if other.parameters.names != face.parameters.names:
            raise MienError(f"{face.name} and {other.name} cannot be mixed: they have other parameters")
        values += share * (other.neutral.values - face.neutral.values)
    return Pose(pose.table, values).clamped()
