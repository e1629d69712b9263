"""A drawing on an egg: as wide as the drawn head on every side, and as deep as it is wide.

A point of the drawing lies on the egg where a ray from the front meets it. In coordinates of a unit ball its direction
from the middle stays, and its distance is a share of how far the head reaches there, so that the outline of the head
is the rim between front and back. What has turned away is cut off at the horizon, along which the outlines of the rest
close.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, pairwise

import numpy as np

from mien.core import exact

from .records import Floats
from .solid_form import Indices
from .solid_motion import Motion
from .solid_rim import COUNT, INSIDE, directions, place_around, reach

OPPOSITE = 0.9
"""A viewer who is this near to opposite of one side, in radii of the ball, sees nothing but the other side."""

NEAR_RIM = 0.7
"""So far from the middle of the ball, and farther, the drawing is stretched towards the outline of the head."""

WHOLLY = 0.03
"""By an angle with this versine (14 degrees) the stretch is complete."""

SINKS = 0.35
"""So far behind the horizon, in radii of the ball, nothing that stands out over the rim is seen: our choice."""

STEEP = 0.9
"""From more above or below, another direction serves to tell left from right."""

BESIDE = 0.2
"""What stands out less than this before or behind the middle, in half depths, is drawn where it was: our choice."""


@dataclass(frozen=True, eq=False)
class Egg:
    """A ball as wide in each direction as a drawn head.

    Attributes:
        radii: (COUNT,) of ``solid_rim``, from the middle of the head.
        motion: how it is turned.
    """

    radii: Floats
    motion: Motion

    @cached_property
    def size(self) -> tuple[float, float, float]:
        """Half its width, height and depth; the depth is the width."""
        count = len(self.radii)
        wide = 0.5 * float(self.radii[0] + self.radii[count // 2])
        tall = 0.5 * float(self.radii[count // 4] + self.radii[3 * count // 4])
        return wide, tall, wide

    @cached_property
    def viewer(self) -> Floats:
        """(3,) a unit vector: points of the ball on its side face the viewer."""
        # On an ellipsoid with half axes s the normal is p / s where the point is p s.
        way = np.array([w / s for w, s in zip(self.motion.towards_viewer, self.size, strict=True)])
        return way / np.sqrt((way * way).sum())

    def carry(self, polygons: Sequence[Sequence[Floats]], *, back: bool = False) -> list[list[Floats]]:
        """What is seen of polygons of the drawing, each of closed contours (N, 2), from the middle of the head, y up.

        Args:
            polygons: each of some contours, or none.
            back: they lie on the back of the egg instead of its front.
        """
        contours = list(chain(*polygons))
        if not contours:
            return [[] for _ in polygons]
        ends = np.cumsum([len(contour) for contour in contours])
        landed = self._land(np.concatenate(contours), ends, back=back)
        parts = iter([landed.part(start, end) for start, end in pairwise([0, *ends.tolist()])])
        # From outside, what lies on the back runs the other way round; all outlines shall run alike.
        sense = -1 if back else 1
        outlines = [[self._outline_of(next(parts))[::sense] for _ in polygon] for polygon in polygons]
        return [self._unwound([outline for outline in each if len(outline)], back=back) for each in outlines]

    def _unwound(self, outlines: list[Floats], *, back: bool) -> list[Floats]:
        """The outlines of a polygon, with that of the egg as often as they run around it where nobody sees it."""
        # What lies on one side of the egg does not run around a point of the other: where it seems to, the outline of
        # the egg the other way round takes that back.
        point = self.viewer + np.array([0.0, 0.0, 1.0 if back else -1.0])
        length = float(np.sqrt((point * point).sum()))
        if not outlines or length < OPPOSITE:
            return outlines
        other = self.place(point[None] / length, 1.0)[0]
        rounds = sum(winding(outline, other) for outline in outlines)
        return [*outlines, *([self.outline[::-1] if rounds > 0 else self.outline] * abs(rounds))]

    def _land(self, points: Floats, ends: Indices, *, back: bool) -> Landed:
        """Points (N, 2) of closed contours on the ball; where each contour ends among them."""
        ball, over = self.on_ball(points, -1.0 if back else 1.0)
        if back == self.motion.shows_front:
            over = np.ones(len(over))  # What stands out is shown once, by the side that is seen more.
        facing = (ball * self.viewer).sum(axis=1)
        # What stands out over the rim sinks behind the horizon little by little.
        sinking = (over > 1.0) & (facing < 0.0) & (facing > -SINKS)
        ball = np.where(sinking[:, None], self._to_horizon(ball, facing), ball)
        over = np.where(sinking, 1.0 + (over - 1.0) * (1.0 + facing / SINKS), over)
        facing = np.where(sinking, 0.0, facing)
        rims, rim_turns = self._cross_horizon(ball, over, facing, ends)
        return Landed(ball, over, facing, self.place(ball, over), self._horizon_place(ball), rims, rim_turns)

    def _cross_horizon(self, ball: Floats, over: Floats, facing: Floats, ends: Indices) -> tuple[Floats, Floats]:
        """(N, 2) and (N,) where the edge from each vertex to the next one passes the horizon; 0 where it does not."""
        after = np.arange(1, len(ball) + 1)
        after[ends - 1] = [0, *ends[:-1]]
        hidden = facing < 0.0
        crossing = np.flatnonzero(hidden != hidden[after])
        beyond, sinks = after[crossing], hidden[after[crossing]]
        seen, gone = np.where(sinks, crossing, beyond), np.where(sinks, beyond, crossing)
        share = (facing[seen] / (facing[seen] - facing[gone]))[:, None]
        passing = ball[seen] * (1.0 - share) + ball[gone] * share
        passing = passing / np.sqrt((passing * passing).sum(axis=1))[:, None]
        rims, turns = np.zeros((len(ball), 2)), np.zeros(len(ball))
        rims[crossing], turns[crossing] = self.place(passing, over[seen]), self._horizon_place(passing)
        return rims, turns

    def _outline_of(self, landed: Landed) -> Floats:
        """The outline of what is seen of a contour on the ball, along the horizon where the contour is hidden."""
        hidden = landed.facing < 0.0
        if not (landed.facing > 0.0).any():
            return landed.placed[:0]
        if not hidden.any():
            return landed.placed
        count = len(hidden)
        outline = []
        for begin in np.flatnonzero(~hidden & np.roll(hidden, 1)):
            around = np.roll(hidden, -begin)
            end = int(np.argmax(around))
            after = end + int(np.argmin(around[end:])) if not around[end:].all() else count
            seen, gone = ((begin + np.arange(*ends)) % count for ends in ((0, end), (end - 1, after + 1)))
            outline += [landed.placed[seen], *self._along_horizon(landed, gone)]
        return np.concatenate(outline)

    def _along_horizon(self, landed: Landed, gone: Indices) -> tuple[Floats, Floats, Floats]:
        """The way along the horizon from one point that is seen, by hidden ones, to the next one that is seen."""
        leaves, returns = gone[0], gone[-2]  # each names the edge that starts there
        steps = np.diff([landed.rim_turns[leaves], *landed.turns[gone[1:-1]], landed.rim_turns[returns]])
        steps -= np.rint(steps / COUNT) * COUNT
        way = self._arc(float(landed.rim_turns[leaves]), float(steps.sum()))
        return landed.rims[leaves : leaves + 1], way, landed.rims[returns : returns + 1]

    def _arc(self, start: float, length: float) -> Floats:
        """Corners of the outline of the whole egg between a place and another further on, or further back."""
        if length >= 0.0:
            numbers = np.arange(np.floor(start) + 1.0, np.ceil(start + length))
        else:
            numbers = np.arange(np.ceil(start) - 1.0, np.floor(start + length), -1.0)
        return self.outline[numbers.astype(np.int64) % COUNT]

    def _horizon_place(self, ball: Floats) -> Floats:
        """(N,) places 0..COUNT around the outline of the whole egg that points of the ball (N, 3) are next to."""
        across, up = self._horizon
        return place_around(np.stack([(ball * across).sum(axis=1), (ball * up).sum(axis=1)], axis=1))

    def _to_horizon(self, ball: Floats, facing: Floats) -> Floats:
        """(N, 3) points of the horizon that are nearest to hidden points."""
        flat = ball - facing[:, None] * self.viewer
        length = np.sqrt((flat * flat).sum(axis=1))
        return np.asarray(flat / np.where(length > 0.0, length, 1.0)[:, None])

    def on_ball(self, points: Floats, side: float) -> tuple[Floats, Floats]:
        """(N, 3) points of the ball under points of the drawing, and (N,) how far these stand out beyond its rim."""
        share = points / reach(self.radii, points)[:, None]
        square = (share * share).sum(axis=1)
        over = np.sqrt(np.maximum(square, 1.0))
        ahead = side * np.sqrt(np.maximum(1.0 - square, 0.0))
        return np.column_stack([share / over[:, None], ahead]), over

    def place(self, ball: Floats, over: Floats | float) -> Floats:
        """(N, 2) where points (N, 3) of the ball are seen, from the middle of the head, y up."""
        flat = ball[:, :2]
        # The rim lies a little within the outline of the head; on a turned egg it takes the place of that outline.
        towards = abs(self.motion.towards_viewer[2])
        turned = min((1.0 - towards) / WHOLLY, 1.0)
        margin = 1.0 / INSIDE - 1.0
        from_middle = np.sqrt((flat * flat).sum(axis=1))
        grown = margin * turned * exact.smoothstep((from_middle - NEAR_RIM) / (1.0 - NEAR_RIM))
        beyond = np.minimum(over - 1.0, margin) * (1.0 - turned) + np.maximum(over - 1.0 - margin, 0.0) * towards
        flat = flat * (reach(self.radii, flat) * (1.0 + grown + beyond))[:, None]
        return self.motion.apply(np.column_stack([flat, ball[:, 2] * self.size[2]]))[:, :2]

    def stand(self, contour: Floats, anchor: Floats) -> tuple[Floats, int]:
        """A contour of something that stands out, and whether it is behind (-1), before (1) or beside the egg (0).

        It keeps its shape, but is narrower from the side, and goes along with its middle.

        Args:
            contour: (N, 2) of the drawing, from the middle of the head, y up.
            anchor: (2,) its middle at rest.
        """
        x, y, ahead = self.motion.apply(np.array([[*anchor, 0.0]]))[0]
        (a, b), (c, d) = self.motion.lean
        right, up = ((contour - anchor) * self.motion.widths).T
        seen = np.stack([x + a * right + b * up, y + c * right + d * up], axis=1)
        return seen, 0 if abs(ahead) < BESIDE * self.size[2] else 1 if ahead > 0.0 else -1

    @cached_property
    def outline(self) -> Floats:
        """(COUNT, 2) the outline of the whole egg, counter-clockwise."""
        across, up = self._horizon
        way = directions()
        return self.place(way[:, :1] * across + way[:, 1:] * up, 1.0)

    @cached_property
    def _horizon(self) -> tuple[Floats, Floats]:
        """Two directions (3,) across the way to the viewer and one another, to the right and up of it."""
        x, y, z = self.viewer
        across = np.array([z, 0.0, -x]) if abs(y) < STEEP else np.array([y, -x, 0.0])
        across = across / np.sqrt((across * across).sum())
        a, b, c = across
        return across, np.array([y * c - z * b, z * a - x * c, x * b - y * a])


@dataclass(frozen=True, eq=False)
class Landed:
    """Points of a drawing on the ball.

    Attributes:
        ball: (N, 3) where they lie.
        over: (N,) how far they stand out beyond the rim.
        facing: (N,) above 0 where they face the viewer.
        placed: (N, 2) where they are seen.
        turns: (N,) places around the horizon that they are next to.
        rims: (N, 2) where the edges to the next points pass the horizon, of those that do.
        rim_turns: (N,) places around the horizon of ``rims``.
    """

    ball: Floats
    over: Floats
    facing: Floats
    placed: Floats
    turns: Floats
    rims: Floats
    rim_turns: Floats

    def part(self, start: int, end: int) -> Landed:
        """Some of them, in a row."""
        columns = (self.ball, self.over, self.facing, self.placed, self.turns, self.rims, self.rim_turns)
        return Landed(*(column[start:end] for column in columns))


def winding(contour: Floats, point: Floats) -> int:
    """How often a closed contour (N, 2) runs around a point, counter-clockwise."""
    x, y = (contour - point).T
    above = y > 0.0
    if above.all() or not above.any():
        return 0
    after = np.arange(1 - len(contour), 1)
    next_x, next_y, then_above = x[after], y[after], above[after]
    left = x * next_y - next_x * y
    up, down = ~above & then_above & (left > 0.0), above & ~then_above & (left < 0.0)
    return int(up.sum()) - int(down.sum())
