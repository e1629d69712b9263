"""Control points of a pose, and the lines between them.

A feature's line runs from its left end as seen (place -1) by its middle point (0) to its right end (1).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from mien.core import exact

from .motors import motors
from .outlines import look_up
from .records import Character, Feature, Floats, Limits, Line, Point, Profile

EYES, BROWS, MOUTH = ("ER", "EL"), ("BR", "BL"), "M"

ENDS: Mapping[str, tuple[str, str, str, str]] = {
    "BR": ("BRL", "BRC", "BRC", "BRM"),
    "BL": ("BLM", "BLC", "BLC", "BLL"),
    "ER": ("ERO", "ERU", "ERL", "ERI"),
    "EL": ("ELI", "ELU", "ELL", "ELO"),
    "M": ("MR", "MT", "MB", "ML"),
}
"""Of each feature with lines: left end as seen, middle of the upper line, middle of the lower one, right end."""

ROUND = Profile(2.0, 2.0)
"""A pursed mouth is an ellipse."""

OPENS_AT = 0.45
"""Share of its opening at which a mouth has its open profile: our choice."""

ROUND_AT = 1.4
"""How much sooner than its corners are all the way in an open mouth is an ellipse: our choice."""

SHUTS_AT = 0.7
"""Share of its resting opening below which an eye begins to take its shut profile: our choice."""

SHAPE_FADES, SHAPE_PURSED = 1.6, 0.75
"""How fast the shape of a mouth's lower line fades as it opens, and how much of both goes as it purses: our choice."""


OFFSET_GOES = 2.2
"""An offset that a motor shrinks is small before the motor is at its minimum: our choice."""


@dataclass(frozen=True, eq=False)
class Moment:
    """What the motors of a character do at one moment.

    Attributes:
        character: who.
        shares: P_ctrl 0..1 or degrees of every motor, by code.
        held: activations that hold whatever the shares say.
    """

    character: Character
    shares: Mapping[str, float]
    held: Mapping[str, float] = field(default_factory=dict)

    @cached_property
    def activations(self) -> Mapping[str, float]:
        """Share of the way from rest to the maximum (positive) or to the minimum (negative) of each motor, -1..1."""
        limits = self.character.motors
        given = {code: activation(code, limits[code], share) for code, share in self.shares.items()}
        return {**given, **{code: value for code, value in self.held.items() if code in given}}

    def activation(self, code: str) -> float:
        """The activation of a motor; 0 of one that the character has not."""
        return self.activations.get(code, 0.0)

    def share(self, code: str) -> float:
        """P_ctrl of a motor, 0..1 between its limits, also of one that is measured in degrees."""
        limits = self.character.motors[code]
        if motors()[code].unit != "deg":
            return self.shares[code]
        return (self.shares[code] - limits.low_deg) / ((limits.high_deg - limits.low_deg) or 1.0)

    @cached_property
    def points(self) -> Mapping[str, Point]:
        """Where every control point is."""
        places = dict(self._moved)
        middle = 0.5 * (places["MT"][1] + places["MB"][1])
        for corner in ("MR", "ML") if self.roundness else ():
            x, y = places[corner]
            places[corner] = (x, y + self.roundness * max(middle - y, 0.0))
        return places

    @cached_property
    def _moved(self) -> Mapping[str, Point]:
        """Where the motors put every control point."""
        places = {name: xy for feature in self.character.features.values() for name, xy in feature.points.items()}
        for code, value in self.activations.items():
            motor = motors()[code]
            if value and motor.point in places:
                offset = _offset(self.character.motors[code], value)
                x, y = places[motor.point]
                places[motor.point] = (x + offset * motor.direction[0], y + offset * motor.direction[1])
        if self.character.mode == "extended":
            for eye in EYES:
                places[eye + "U"] = self._resting_lid(eye, places)
            top, bottom = places["MT"], places["MB"]
            places["MB"] = (bottom[0], max(bottom[1], top[1]))
        return places

    def _resting_lid(self, eye: str, places: Mapping[str, Point]) -> Point:
        """Where an upper lid is: shut it lies on the lower one wherever that is, and never below it."""
        upper, lower = places[eye + "U"], places[eye + "L"]
        shut = max(-self.activation(eye + "U"), 0.0)
        arrives = self.character.features[eye].points[eye + "U"][1] - self.character.motors[eye + "U"].low
        return upper[0], min(upper[1] + shut * max(lower[1] - arrives, 0.0), lower[1])

    def held_at(self, values: Mapping[str, float]) -> Moment:
        """The moment with some activations held."""
        return Moment(self.character, self.shares, {**self.held, **values}) if values else self

    @cached_property
    def mouth_opening(self) -> float:
        """How far the mouth is open, 0..1 of what its lower lip can do."""
        reach = self.character.motors["MB"].high
        gap = self._moved["MB"][1] - self._moved["MT"][1] - _gap(self.character.features["M"], "MT", "MB")
        return min(max(gap / reach, 0.0), 1.0) if reach else 0.0

    @cached_property
    def pursing(self) -> float:
        """How far the corners of the mouth are drawn in, 0..1."""
        return min(max(-0.5 * (self.activation("MLH") + self.activation("MRH")), 0.0), 1.0)

    @cached_property
    def roundness(self) -> float:
        """How far the mouth is an ellipse, 0..1, its corners half-way between its lips: as it purses and opens."""
        if self.character.features[MOUTH].profile_open is None:
            return 0.0
        return min(1.0, self.mouth_opening / OPENS_AT) * min(1.0, ROUND_AT * self.pursing)

    def eye_opening(self, eye: str) -> float:
        """Opening of an eye as a share of that at rest."""
        gap = self.points[eye + "L"][1] - self.points[eye + "U"][1]
        return gap / max(_gap(self.character.features[eye], eye + "U", eye + "L"), 1e-6)

    def ends(self, feature: str, *, lower: bool) -> tuple[Point, Point, Point]:
        """Left end as seen, middle and right end of a line."""
        left, upper, under, right = ENDS[feature]
        return self.points[left], self.points[under if lower else upper], self.points[right]


def activation(code: str, limits: Limits, share: float) -> float:
    """Share of the way from rest to a limit, -1..1, of a motor's P_ctrl or degrees."""
    if motors()[code].unit == "signed":
        return share
    if motors()[code].unit == "deg":
        end = limits.high_deg if share > 0.0 else -limits.low_deg
        return share / end if end else 0.0
    rest = resting_share(code, limits)
    room = 1.0 - rest if share > rest else rest
    return (share - rest) / room if room else 0.0


def resting_share(code: str, limits: Limits) -> float:
    """P_ctrl at which a motor moves nothing: where rest lies between its limits; 0 of degrees and of what is signed."""
    if motors()[code].unit != "share" or limits.high == limits.low:
        return 0.0
    # Adding 0 makes -0 a 0.
    return -limits.low / (limits.high - limits.low) + 0.0


def rest_of(character: Character) -> Moment:
    """The moment at which all motors rest."""
    return Moment(character, {code: resting_share(code, limits) for code, limits in character.motors.items()})


def _offset(limits: Limits, value: float) -> float:
    """Drawing units from rest at an activation; what is measured in degrees goes with their sine."""
    end, degrees = (limits.high, limits.high_deg) if value > 0.0 else (limits.low, -limits.low_deg)
    share = abs(value)
    if degrees:
        share = float(exact.sin(np.deg2rad(degrees * share)) / exact.sin(np.deg2rad(degrees)))
    return end * share


class Track:
    """Places on a feature's line, -1..1 between its ends, with all that no pose changes."""

    def __init__(self, feature: Feature, places: Floats) -> None:
        self.feature, self._places = feature, places
        self._left, self._s = places < 0.0, np.abs(places)
        self._rest, self._round = (profile_weights(each, self._s) for each in (feature.profile, ROUND))
        self._open, self._shut = (
            None if each is None else profile_weights(each, self._s)
            for each in (feature.profile_open, feature.profile_shut)
        )
        self._shape = look_up(feature.shape, places) if feature.shape else None
        t = places
        self._curve = (0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0))

    def points(self, moment: Moment, *, lower: bool) -> Floats:
        """(N, 2) where the places are.

        With straight profiles this is A1.3 and A1.4 without their slope: X SL + IYL is V0 + vrl (V1 - V0), which also
        an upright line has.
        """
        left, middle, right = moment.ends(self.feature.name, lower=lower)
        points = np.empty((len(self._places), 2))
        points[:, 0] = middle[0] + self._s * (np.where(self._left, left[0], right[0]) - middle[0])
        if self.feature.smooth:
            points[:, 1] = self._curve[0] * left[1] + self._curve[1] * middle[1] + self._curve[2] * right[1]
        else:
            end = np.where(self._left, left[1], right[1])
            points[:, 1] = end + (middle[1] - end) * self._weights(moment)
        if self._shape is not None:
            opening = moment.mouth_opening
            share = max(0.0, 1.0 - SHAPE_FADES * opening) if lower else 1.0
            share *= 1.0 - SHAPE_PURSED * moment.pursing * min(1.0, 2.0 * opening)
            points[:, 1] += share * self._shape
        return points

    def _weights(self, moment: Moment) -> Floats:
        """(N,) weight of the middle point."""
        weights, opened, shut = self._rest, self._open, self._shut
        if opened is not None:
            weights = weights + min(1.0, moment.mouth_opening / OPENS_AT) * (opened - weights)
            weights = weights + moment.roundness * (self._round - weights)
        if shut is not None:
            weights = weights + max(0.0, 1.0 - moment.eye_opening(self.feature.name) / SHUTS_AT) * (shut - weights)
        return weights


class Stretch:
    """A stretch of a line that can be traced in any pose."""

    def __init__(self, line: Line, feature: Feature) -> None:
        self.line = line
        share = np.arange(line.count + 1) / line.count
        # Points lie closer to one another towards the ends, where lines bend most.
        places = line.start + (line.end - line.start) * 0.5 * (exact.sin(np.pi * (share - 0.5)) + 1.0)
        self._track = Track(feature, places)
        self._offset = look_up(line.offset, places)

    def points(self, moment: Moment) -> Floats:
        """(N, 2) points from its start to its end."""
        points = self._track.points(moment.held_at(self.line.at), lower=self.line.lower)
        points[:, 1] += self._offset * self._left_of_offset(moment)
        return points

    def _left_of_offset(self, moment: Moment) -> float:
        if self.line.offset_by is None:
            return 1.0
        code, left = self.line.offset_by
        return 1.0 - (1.0 - left) * min(max(-OFFSET_GOES * moment.activation(code), 0.0), 1.0)


def profile_weights(profile: Profile, s: Floats) -> Floats:
    """(1 - s^p)^(1/q) at ``s`` (N,); a straight line goes on beyond its end."""
    if profile.p == profile.q == 1.0:
        return 1.0 - s
    inside = 1.0 - _power(np.minimum(s, 1.0), profile.p)
    return _power(np.maximum(inside, 0.0), 1.0 / profile.q)


def _power(x: Floats, exponent: float) -> Floats:
    if exponent == 1.0:
        return x
    if exponent == 2.0:
        return x * x
    return np.sqrt(x) if exponent == 0.5 else exact.power(x, exponent)


def _gap(feature: Feature, upper: str, lower: str) -> float:
    """How far one point lies below another at rest."""
    return feature.points[lower][1] - feature.points[upper][1]
