"""One polygon of a drawn face in any pose."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from .driving import Drive
from .equations import between_states, joint_shares, place_along, put_along
from .lines import BROWS, ENDS, MOUTH, Moment, Stretch, Track
from .motors import motors
from .outlines import flatten, half_widths, piece_steps, ribbon
from .records import Driver, Feature, Floats, Line, Outline, Polygon, State, Touch

Contours = tuple[Floats, ...]
Change = Callable[[Floats, Moment], Floats]

FADES_AT = 0.5
"""Share of its resting opening below which an eye begins to show the stroke of its shut lid: our choice."""


class Shape:
    """A polygon that knows where its vertices are in every pose; their number is always the same."""

    def __init__(self, polygon: Polygon, rest: Moment) -> None:
        self.polygon = polygon
        self._rest, self._character = rest, rest.character
        self._drivers = (*polygon.drivers, *self._character.parts.get(polygon.part, ()))
        bend = self._character.mode != "strict"  # the paper moves the vertices of a file and no others
        states = _states(polygon, self._drivers) if polygon.path or polygon.low else []
        self._steps = piece_steps(states, bend=bend) if states else ()
        self._span = tuple(self._stretch(line) for line in polygon.span or ())
        self._stroke = None if polygon.stroke is None else self._stretch(polygon.stroke)
        self._changes = tuple(self._find_changes())
        self._last: tuple[tuple[float, ...], Contours] | None = None

    @cached_property
    def motors(self) -> frozenset[str]:
        """Codes of the motors that change it."""
        return frozenset(self._find_motors())

    @cached_property
    def rest(self) -> Contours:
        """Its contours at rest."""
        return self._trace(self._rest)

    def contours(self, moment: Moment) -> Contours:
        """Contours (N, 2), y down, before the head turns."""
        key = tuple(moment.activation(code) for code in self.motors)
        if not any(key):
            return self.rest
        # From frame to frame most features stand still.
        last = self._last
        if last is None or last[0] != key:
            last = self._last = key, self._trace(moment)
        return last[1]

    def _trace(self, moment: Moment) -> Contours:
        contours = self._source(moment)
        if self._changes:
            stacked, ends = np.concatenate(contours), np.cumsum([len(each) for each in contours])[:-1]
            for change in self._changes:
                stacked = change(stacked, moment)
            contours = tuple(np.split(stacked, ends)) if len(ends) else (stacked,)
        if not self.polygon.width:
            return contours
        share, closed = _fading(moment, self.polygon.fade), self.polygon.closed
        brushes = zip(contours, self._brush, strict=True)
        return tuple(part for line, half in brushes for part in ribbon(line, half * share, closed=closed))

    def _source(self, moment: Moment) -> Contours:
        """The contours before anything moves them: of a file's outline, or of lines, which move by themselves."""
        if self._span:
            upper, lower = (stretch.points(moment) for stretch in self._span)
            if self._span[0].line.feature == self._span[1].line.feature == MOUTH:
                lower[:, 1] = np.maximum(lower[:, 1], _heights_at(upper, lower[:, 0]))
            return (np.concatenate([upper, lower[::-1]]),)
        if self._stroke is not None:
            return (self._stroke.points(moment),)
        if self.polygon.low:
            low, high = self._ends
            share = moment.share(self.polygon.motor)
            return tuple(between_states(one, other, share) for one, other in zip(low, high, strict=True))
        return self._outline

    @cached_property
    def _outline(self) -> Contours:
        return flatten(self.polygon.path, self._steps)

    @cached_property
    def _ends(self) -> tuple[Contours, Contours]:
        """The states at both ends of its motor."""
        return flatten(self.polygon.low, self._steps), flatten(self.polygon.high, self._steps)

    @cached_property
    def _brush(self) -> Contours:
        """(N,) half the width of its stroke along each line, as they lie before anything moves them."""
        return tuple(half_widths(line, self.polygon.width) for line in self._source(self._rest))

    def _stretch(self, line: Line) -> Stretch:
        return Stretch(line, self._character.features[line.feature])

    def _find_changes(self) -> Iterator[Change]:
        """What moves the vertices, in order."""
        polygon = self.polygon
        if polygon.feature and polygon.path and polygon.kind in ("feature", "hole"):
            feature = self._character.features[polygon.feature]
            literal = feature.literal and polygon.reach is None
            yield self._follow_lines(feature) if literal else self._follow_curve(feature)
        if polygon.dilate is not None:
            yield self._dilate
        if polygon.point:
            yield self._move_along
        if self._drivers:
            rest = np.concatenate(self._source(self._rest))
            for driver in self._drivers:
                yield Drive(driver, self._character, self._flat, rest)

    def _flat(self, state: State) -> Floats:
        """(N, 2) vertices of a state."""
        return np.concatenate(flatten(state, self._steps)) if isinstance(state, tuple) else np.zeros((0, 2))

    def _follow_lines(self, feature: Feature) -> Change:
        """Vertices keep their place along the straight lines and their distance from them (A1.3, A1.4)."""
        vertices = np.concatenate(self._outline)
        names = _line_names(feature, self.polygon.line)
        at = {name: np.array(xy) for name, xy in feature.points.items()}
        lines = [(at[one], at[other]) for one, other in names]
        places = [place_along(vertices, *line) for line in lines]
        shares = joint_shares(vertices, lines)

        def follow(points: Floats, moment: Moment) -> Floats:
            moved = np.zeros_like(points)
            for (one, other), (share, distance), weight in zip(names, places, shares, strict=True):
                start, end = (np.array(moment.points[name]) for name in (one, other))
                moved += weight[:, None] * put_along(share, distance, start, end)
            return points + self.polygon.follow * (moved - points)

        return follow

    def _follow_curve(self, feature: Feature) -> Change:
        """Vertices go along with the curve at their place between its ends; of two curves more with the nearer one."""
        vertices = np.concatenate(self._outline)
        named, paired = self.polygon.line, feature.name not in BROWS
        lines = [named == "lower"] if named or not paired else [False, True]
        tracks = [self._track(feature, vertices, lower=lower) for lower in lines]
        rests = [track.points(self._rest, lower=lower) for track, lower in zip(tracks, lines, strict=True)]
        shares = _nearness(vertices, rests) * self.polygon.follow
        if self.polygon.reach is not None:
            away = np.min([np.abs(vertices[:, 1] - rest[:, 1]) for rest in rests], axis=0)
            near = np.maximum(0.0, 1.0 - away / self.polygon.reach)
            shares = shares * near * np.sqrt(near)

        def follow(points: Floats, moment: Moment) -> Floats:
            for track, lower, rest, share in zip(tracks, lines, rests, shares, strict=True):
                points = points + share[:, None] * (track.points(moment, lower=lower) - rest)
            return points

        return follow

    def _track(self, feature: Feature, vertices: Floats, *, lower: bool) -> Track:
        """Where vertices are along a line."""
        left, middle, right = self._rest.ends(feature.name, lower=lower)
        side = vertices[:, 0] < middle[0]
        run = np.where(side, middle[0] - left[0], right[0] - middle[0])
        places = np.clip((vertices[:, 0] - middle[0]) / np.where(np.abs(run) > 1e-6, run, 1.0), -1.0, 1.0)
        return Track(feature, places)

    def _move_along(self, points: Floats, moment: Moment) -> Floats:
        """The whole outline goes along with one control point."""
        rest, (x, y) = self._rest.points[self.polygon.point], moment.points[self.polygon.point]
        return points + np.array([x - rest[0], y - rest[1]])

    def _dilate(self, points: Floats, moment: Moment) -> Floats:
        factor = 1.0 + moment.activation("PD") * ((self.polygon.dilate or 1.0) - 1.0)
        center = np.array(self._character.features[self.polygon.feature].points[self.polygon.feature])
        return center + (points - center) * np.array([factor, 1.0 + DILATES_UP * (factor - 1.0)])

    def _find_motors(self) -> Iterator[str]:
        polygon, states = self.polygon, [state for each in self._drivers for state in (each.low, each.high)]
        touched = [state.line for state in states if isinstance(state, Touch)]
        lines = [line for line in (*(polygon.span or ()), polygon.stroke, *touched) if line is not None]
        features = {polygon.feature, polygon.fade, *(line.feature for line in lines)} - {""}
        for name, feature in self._character.features.items():
            if polygon.point in feature.points:
                features.add(name)
        yield from (code for code in self._character.motors if motors()[code].feature in features)
        yield from (driver.motor for driver in self._drivers)
        yield from (line.offset_by[0] for line in lines if line.offset_by is not None)
        yield from ([polygon.motor] if polygon.motor else [])
        yield from (["PD"] if polygon.dilate is not None else [])


DILATES_UP = 0.25
"""How much of its growth a pupil has in height: slits widen."""


def _states(polygon: Polygon, drivers: tuple[Driver, ...]) -> list[Outline]:
    """The outlines that a polygon has, which all are drawn in the same steps."""
    ends = [state for driver in drivers for state in (driver.low, driver.high) if isinstance(state, tuple)]
    return [polygon.path, *ends] if polygon.path else [polygon.low, polygon.high]


def _line_names(feature: Feature, line: str) -> list[tuple[str, str]]:
    """Pairs of control points that lines connect, of one line or of all."""
    left, upper, lower, right = ENDS[feature.name]
    above, below = (left, upper, right), (left, lower, right)
    chosen = [above] if line == "upper" or feature.name in BROWS else [below] if line == "lower" else [above, below]
    return [pair for names in chosen for pair in pairwise(names)]


def _nearness(vertices: Floats, lines: Sequence[Floats]) -> Floats:
    """(L, N) share of each vertex in each of one or two lines (N, 2), the upper first: all of it beyond either."""
    if len(lines) == 1:
        return np.ones((1, len(vertices)))
    upper, lower = (line[:, 1] for line in lines)
    gap = lower - upper
    down = np.where(gap > 1e-6, (vertices[:, 1] - upper) / np.where(gap > 1e-6, gap, 1.0), vertices[:, 1] > upper)
    down = np.clip(down, 0.0, 1.0)
    return np.stack([1.0 - down, down])


def _fading(moment: Moment, eye: str) -> float:
    """How much of its width a stroke has that appears as an eye shuts: all where no eye is named."""
    if not eye:
        return 1.0
    lowered = 2.2 * (max(-moment.activation(eye + "U"), 0.0) - 0.15)
    narrowed = 3.0 * (FADES_AT - moment.eye_opening(eye))
    return float(np.sqrt(min(max(lowered, narrowed, 0.0), 1.0)))


def _heights_at(line: Floats, x: Floats) -> Floats:
    """Heights (N,) of a line (M, 2) from left to right at places ``x`` (N,)."""
    order = np.argsort(line[:, 0], kind="stable")
    return np.interp(x, line[order, 0], line[order, 1])
