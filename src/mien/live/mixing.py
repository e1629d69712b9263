"""How the layers of a live face become one pose: as a performance's do, and ``direct`` over all of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.core import Face, ParameterTable, Pose
from mien.perform.expressions import SPOKEN_SHARE
from mien.speech.mouth import MOUTH_CHANNELS
from mien.vocab import Remap, load_remap, vocabulary

from .slices import Floats, Rows

CHANNELS = "channels"


@dataclass(frozen=True, eq=False)
class Moment:
    """What the layers say at one moment; C channels, P parameters.

    Attributes:
        idle: (C,) what the face does by itself.
        gaze: (C,) where it looks.
        expression: (P,) how far motions are from rest.
        speech: (C,) what the mouth says.
        direct: (P,) values that somebody holds.
        held: (P,) how much they count, 0..1.
        borrowed: how much of the mouth speech has, 0..1.
    """

    idle: Floats
    gaze: Floats
    expression: Floats
    speech: Floats
    direct: Floats
    held: Floats
    borrowed: float


class Mixer:
    """The rules for one face.

    ``idle``, ``gaze``, ``expression`` and ``speech`` are added to the pose at rest; then what shuts eyes and lips
    multiplies; ``direct`` replaces all of it as far as it is held. While the mouth speaks it has what it needs: of an
    expression there, or of a value that somebody holds there, a part is left, and all of it comes back afterwards.
    """

    def __init__(self, face: Face, rest: Pose | None = None) -> None:
        self.table, self.rest = face.parameters, (rest or face.neutral).values
        remap = load_remap(CHANNELS, face.family).on(self.table)
        self._add = _by_channel(remap, self.table, "add")
        self._scale = _by_channel(remap, self.table, "multiply")
        spoken = remap.reached_by(channel for channel in MOUTH_CHANNELS if channel in remap.index)
        self.mouth = np.zeros(len(self.table), dtype=np.bool_)
        """(P,) the rows that speech moves."""
        self.mouth[[self.table.index[name] for name in spoken]] = True

    def mix(self, moment: Moment) -> Floats:
        """(P,) values within their ranges.

        Source: the rules of layers are those of ``mien.perform``.
        """
        table, borrowed = self.table, moment.borrowed * self.mouth
        held = moment.held * (1.0 - borrowed)
        values = self.rest + moment.expression * (1.0 - (1.0 - SPOKEN_SHARE) * borrowed)
        if moment.borrowed:
            values += (SPOKEN_SHARE * moment.held * borrowed) * (moment.direct - self.rest)
        for channels in (moment.idle, moment.gaze, moment.speech):
            for channel in np.flatnonzero(channels).tolist():
                rows, gains = self._add[channel]
                values[rows] += gains * channels[channel]
        for channels in (moment.idle, moment.speech):
            for channel in np.flatnonzero(channels).tolist():
                rows, gains = self._scale[channel]
                values[rows] *= 1.0 + gains * channels[channel]
        below = np.clip(values, table.lows, table.highs)
        mixed = np.where(held >= 1.0, moment.direct, below * (1.0 - held) + moment.direct * held)
        # Adding 0 makes -0 a 0: they look alike everywhere but in the bytes.
        return np.clip(mixed, table.lows, table.highs) + 0.0


def _by_channel(remap: Remap, table: ParameterTable, blend: str) -> tuple[tuple[Rows, Floats], ...]:
    """Rows and gains of each channel for a blend rule; a row that a channel reaches twice is there once."""
    channels = vocabulary(CHANNELS)
    found: list[dict[int, float]] = [{} for _ in channels]
    for link in remap.links:
        if link.blend == blend:
            gains, row = found[channels.index[link.name]], table.index[link.parameter]
            gains[row] = gains.get(row, 0.0) + link.gain
    return tuple((np.array(list(gains), dtype=np.intp), np.array(list(gains.values()))) for gains in found)
