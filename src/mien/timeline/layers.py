"""Layers: tracks that belong together, and the rule by which they act on what lies beneath."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from mien.core import MienError, RangeError, UnknownNameError

from .track import Floats, Track

Blend = Callable[[Floats, Floats, float], Floats]

STANDARD_LAYERS = ("idle", "gaze", "expression", "speech", "direct")
"""Names of the layers of a performance, lowest first."""


def replace(below: Floats, value: Floats, weight: float) -> Floats:
    """The layer's own value, whatever lies beneath. It knows no weight: a part of a replacement is ``weighted``."""
    return value


def add(below: Floats, value: Floats, weight: float) -> Floats:
    """What lies beneath plus the layer's value: below + w x."""
    return below + weight * value


def multiply(below: Floats, value: Floats, weight: float) -> Floats:
    """What lies beneath, scaled: below ((1 - w) + w x)."""
    return below * ((1.0 - weight) + weight * value)


def weighted(below: Floats, value: Floats, weight: float) -> Floats:
    """Between what lies beneath and the layer's value: (1 - w) below + w x."""
    return below * (1.0 - weight) + value * weight


BLENDS: Mapping[str, Blend] = MappingProxyType(
    {"replace": replace, "add": add, "multiply": multiply, "weighted": weighted}
)
"""Blend rule of each name: (value beneath (N,), the layer's value (N,), weight) -> value (N,)."""


@dataclass(frozen=True)
class Layer:
    """Tracks by parameter name and how they act on the layers beneath.

    A name may be a row of the face's table, one of its aliases or a symmetric name, which drives both sides; several
    names that reach the same row act one after the other, in order. Before the first key of a track the layer leaves
    the value beneath alone. After the last key the last value is held and goes on acting, whatever the blend rule.

    Attributes:
        name: what it is for; ``STANDARD_LAYERS`` are the usual ones.
        blend: a name of ``BLENDS``.
        tracks: parameter name -> track, read-only.
        weight: 0 (as if it were not there) to 1; ``replace`` has none but 1.
    """

    name: str
    blend: str
    tracks: Mapping[str, Track]
    weight: float = 1.0

    def __post_init__(self) -> None:
        if self.blend not in BLENDS:
            raise UnknownNameError(f"blend rule of layer {self.name!r}", self.blend, BLENDS)
        if not (math.isfinite(self.weight) and 0.0 <= self.weight <= 1.0):
            raise RangeError(f"layer {self.name!r}: weight {self.weight} is not in 0..1")
        if self.blend == "replace" and self.weight != 1.0:
            raise MienError(
                f"layer {self.name!r}: 'replace' knows no weight but 1, got {self.weight} — 'weighted' mixes"
            )
        object.__setattr__(self, "tracks", MappingProxyType(dict(self.tracks)))

    @property
    def length_s(self) -> float:
        """When its last segment ends, s; 0 without tracks."""
        return max((track.length_s for track in self.tracks.values()), default=0.0)
