"""Where a drawn face seems to look, and how its eyes and head must be drawn to seem to look where they should.

Angles are degrees in the senses of the motors: positive to the left as one sees the picture, and upwards. An apparent
gaze of 0 meets the viewer's eyes. The model is linear, as is that of Otsuka, Mareschal and Clifford (2016): what the
eyes show times a gain, plus what the head shows times another, less the share of the viewer's own direction that a
curved screen shows. ``docs/gaze.md`` tells what is known of each, and what is our choice.

Source: Thórisson 1996, A1.4 (the wish); Anstis, Mayhew and Morley 1969 (eyes that turn seem to turn farther).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from mien.core import exact

from .records import Character, Limits

AXES = (("HH", ("PRH", "PLH")), ("HV", ("PRV", "PLV")))
"""Motors of the head and of both pupils, sideways and up."""

EYE_GAIN = (1.5, 1.3)
"""Apparent turn of the eyes by their true one, sideways and up.

Source: 1.5 is the common factor of overestimation (Horstmann and Linke 2025, after Anstis et al. 1969); Alting and
Horstmann 2025 found 1.79 on average, 1.49 to 2.24 among faces. It is less upwards (Horstmann 2024): 1.3 is our choice.
"""

HEAD_GAIN = (1.3, 1.2)
"""How far the same eyes seem to look to the side to which the head is turned, by its turn: our choice.

It is less than the gain of the eyes: eyes that meet the viewer's from a turned head seem to look past, away from the
head's direction (Moors et al. 2016; Otsuka et al. 2014). It is above 0: the same eyes drawn in another head
seem to follow it (Wollaston 1824).
"""

HEAD_DEPTH = 0.75
"""How far before the axis of a head its eyes lie, in half widths of the head: our choice.

A drawn head whose eyes lie less deep shifts them less as it turns, and so seems to turn less.
"""

LEAST_ROUND = 0.25
"""The flattest that a drawn head is taken for."""

EYEBALL = 0.8
"""Radius of the eyeball by half the width of the opening between the lids: 12 mm by 15 mm."""

PLACEMENT = (0.5, 2.5)
"""Least and most that pupils are taken to show by their angle."""

FACE_SLANT_SEEN = 0.5
"""How much of the slant of a flat picture is seen in the face, while the eyes show nothing of it.

Source: Sato and Hosokawa 2012 (gaze follows the viewer always, the face in 40 to 50 % of all trials).
"""

HALF_WIDTH_M = 0.09
"""Half the width of the face on the screen: of life size."""

MOST_CURVED = 1.0 / HALF_WIDTH_M
"""A screen as curved as the head itself, 1/m."""


def screen_depth(curvature: float) -> float:
    """How far the middle of the face stands out by the curvature of a screen (1/m, convex positive), in half widths.

    It is 0 on a flat screen, whose picture shows every viewer the same gaze, and 1 on a screen as round as a head,
    whose picture looks in one direction of the room.

    Source: geometry (the sagitta of an arc); that a round screen does away with the effect of a flat one: Al Moubayed,
    Edlund and Beskow 2012.
    """
    half = curvature * HALF_WIDTH_M
    return half / (1.0 + math.sqrt(max(1.0 - half * half, 0.0)))


def viewer_angles(x: float, y: float, z: float) -> tuple[float, float]:
    """Degrees sideways and up from straight ahead to a viewer at (x, y, z) m; x is to the face's own left."""
    level = math.sqrt(x * x + z * z)
    return -math.degrees(exact.arctan(x / z)), math.degrees(exact.arctan(y / level))


@dataclass(frozen=True)
class Seen:
    """What a drawing shows of its gaze in one direction.

    Attributes:
        placement: turn of the eyes that their pupils show by the angle of their motors.
        roundness: turn that a head shows by the angle of its motor.
        eye_gain: apparent turn of the eyes by the turn that they show.
        head_gain: the same of the head.
    """

    placement: float
    roundness: float
    eye_gain: float
    head_gain: float

    def gaze_deg(self, pupil_deg: float, head_deg: float, viewer_deg: float = 0.0, depth: float = 0.0) -> float:
        """Where the eyes seem to look, from the line to the viewer.

        Args:
            pupil_deg: of the motor.
            head_deg: of the motor.
            viewer_deg: where the viewer is.
            depth: of the screen, as ``screen_depth``.
        """
        return self._eyes * pupil_deg + self._head * head_deg - depth * viewer_deg

    def pupil_deg(self, gaze_deg: float, head_deg: float, viewer_deg: float = 0.0, depth: float = 0.0) -> float:
        """The angle of a pupil's motor with which the eyes seem to look at ``gaze_deg`` from the line to the viewer."""
        return (gaze_deg - self._head * head_deg + depth * viewer_deg) / self._eyes

    def facing_deg(self, head_deg: float, viewer_deg: float = 0.0, depth: float = 0.0) -> float:
        """Where the head seems to be turned, from the line to the viewer."""
        return self._head * head_deg - max(depth, FACE_SLANT_SEEN) * viewer_deg

    def head_deg(self, facing_deg: float, viewer_deg: float = 0.0, depth: float = 0.0) -> float:
        """The angle of the head's motor with which it seems to be turned to ``facing_deg``."""
        return (facing_deg + max(depth, FACE_SLANT_SEEN) * viewer_deg) / self._head

    @property
    def _eyes(self) -> float:
        return self.eye_gain * self.placement

    @property
    def _head(self) -> float:
        return self.head_gain * self.roundness


def what_is_seen(character: Character, *, solid: bool = False) -> tuple[Seen, Seen]:
    """What a character's drawing shows sideways and up; on a solid body the head turns wholly."""
    eye = character.features["ER"]
    half_width = 0.5 * abs(eye.points["ERI"][0] - eye.points["ERO"][0])
    roundness = 1.0 if solid else _roundness(character)
    sideways, up = (
        Seen(_placement(character.motors[pupils[0]], EYEBALL * half_width), roundness, eye_gain, head_gain)
        for (_, pupils), eye_gain, head_gain in zip(AXES, EYE_GAIN, HEAD_GAIN, strict=True)
    )
    return sideways, up


def compensate(
    shares: Mapping[str, float],
    character: Character,
    seen: tuple[Seen, Seen],
    amount: float,
    viewer: tuple[float, float, float],
    curvature: float,
) -> dict[str, float]:
    """Shares and degrees of motors, of head and pupils so changed that they seem to look where the given ones do.

    The given pupils look in the direction of head and pupils together, from straight out of the picture; with
    ``amount`` 1 a viewer sees that direction, as far as the limits of the motors allow.

    Args:
        shares: P_ctrl or degrees by motor code.
        character: whose.
        seen: of ``what_is_seen``.
        amount: 0 leaves all as it is, 1 compensates wholly.
        viewer: (x, y, z) m from the middle of the head.
        curvature: of the screen, 1/m.
    """
    changed = dict(shares)
    depth = screen_depth(curvature)
    for (head, pupils), axis, angle in zip(AXES, seen, viewer_angles(*viewer), strict=True):
        wanted = shares[head]
        goal = axis.head_deg(wanted - angle, angle, depth)
        changed[head] = _within(wanted + amount * (goal - wanted), character.motors[head])
        for pupil in pupils:
            given = shares[pupil]
            goal = axis.pupil_deg(given + wanted - angle, changed[head], angle, depth)
            changed[pupil] = _within(given + amount * (goal - given), character.motors[pupil])
    return changed


def _within(angle_deg: float, limits: Limits) -> float:
    return min(max(angle_deg, limits.low_deg), limits.high_deg)


def _placement(limits: Limits, radius: float) -> float:
    """The turn that a pupil shows, as the centre of an iris on an eyeball of a radius would, by its motor's angle."""
    end_deg, way = (limits.high_deg, limits.high) if limits.high > 0.0 else (-limits.low_deg, -limits.low)
    sine = float(exact.sin(math.radians(end_deg)))
    if not way or not sine or not radius:
        return 1.0
    return min(max(way / radius / sine, PLACEMENT[0]), PLACEMENT[1])


def _roundness(character: Character) -> float:
    """How deep the eyes lie, by how deep they would on a head."""
    eye, head = character.features["ER"], character.head
    depth = eye.depth or head.depth
    u, v = (
        (sum(point[axis] for point in eye.points.values()) / len(eye.points) - head.center[axis]) / head.radius[axis]
        for axis in (0, 1)
    )
    forward = depth.depth + depth.bulge * math.sqrt(max(0.0, 1.0 - u * u - v * v))
    return min(max(forward / HEAD_DEPTH, LEAST_ROUND), 1.0)
