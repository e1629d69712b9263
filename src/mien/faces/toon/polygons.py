"""One polygon of a drawn face in any pose."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property, partial
from itertools import pairwise

import numpy as np

from mien.core import exact

from .equations import between_states, joint_shares, place_along, put_along
from .lines import BROWS, ENDS, MOUTH, Moment, line_points, trace_line
from .motors import motors
from .outlines import flatten, piece_steps, ribbon
from .records import Character, Driver, Feature, Floats, Outline, Polygon, Shift, Touch

Contours = tuple[Floats, ...]
Change = Callable[[Floats, Moment], Floats]

FADES_AT = 0.5
"""Share of its resting opening below which an eye begins to show the stroke of its shut lid: our choice."""


class Shape:
    """A polygon that knows where its vertices are in every pose; their number is always the same."""

    def __init__(self, polygon: Polygon, rest: Moment) -> None:
        self.polygon = polygon
        self._rest, self._character = rest, rest.character
        character = rest.character
        self._drivers = (*polygon.drivers, *character.parts.get(polygon.part, ()))
        self._steps = piece_steps(_states(polygon, self._drivers)) if polygon.path or polygon.low else ()
        self._changes = tuple(self._find_changes())

    @cached_property
    def motors(self) -> frozenset[str]:
        """Codes of the motors that change it."""
        return frozenset(_motors(self.polygon, self._character, self._drivers))

    @cached_property
    def rest(self) -> Contours:
        """Its contours at rest."""
        return self._trace(self._rest)

    def contours(self, moment: Moment) -> Contours:
        """Contours (N, 2), y down, before the head turns."""
        if not any(moment.activation(code) for code in self.motors):
            return self.rest
        return self._trace(moment)

    def _trace(self, moment: Moment) -> Contours:
        contours = self._source(moment)
        if self._changes:
            stacked, ends = np.concatenate(contours), np.cumsum([len(each) for each in contours])[:-1]
            for change in self._changes:
                stacked = change(stacked, moment)
            contours = tuple(np.split(stacked, ends))
        if not self.polygon.width:
            return contours
        share = _fading(moment, self.polygon.fade)
        brush, closed = self.polygon.width, self.polygon.closed
        return tuple(part for line in contours for part in ribbon(line, brush, closed=closed, share=share))

    def _source(self, moment: Moment) -> Contours:
        """The contours before anything moves them: of a file's outline, or of lines, which move by themselves."""
        polygon = self.polygon
        if polygon.span is not None:
            upper, lower = (trace_line(moment, line) for line in polygon.span)
            if polygon.span[0].feature == polygon.span[1].feature == MOUTH:
                lower = np.stack([lower[:, 0], np.maximum(lower[:, 1], _at(upper, lower[:, 0]))], axis=1)
            return (np.concatenate([upper, lower[::-1]]),)
        if polygon.stroke is not None:
            return (trace_line(moment, polygon.stroke),)
        if polygon.low:
            low, high = (flatten(outline, self._steps) for outline in (polygon.low, polygon.high))
            share = moment.share(polygon.motor)
            return tuple(between_states(a, b, share) for a, b in zip(low, high, strict=True))
        return self._outline

    @cached_property
    def _outline(self) -> Contours:
        return flatten(self.polygon.path, self._steps)

    def _find_changes(self) -> Iterator[Change]:
        polygon = self.polygon
        if polygon.feature and polygon.path and polygon.kind in ("feature", "hole"):
            feature = self._character.features[polygon.feature]
            yield self._follow_lines(feature) if _literal(polygon, feature) else self._follow_curve(feature)
        if polygon.dilate is not None:
            yield self._dilate
        if polygon.point:
            yield self._move_along
        for driver in self._drivers:
            yield partial(self._drive, driver)

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
        """Vertices go along with the curve at their place between its ends."""
        vertices = np.concatenate(self._outline)
        lower = self.polygon.line == "lower"
        left, middle, right = self._rest.ends(feature.name, lower=lower)
        side = vertices[:, 0] < middle[0]
        run = np.where(side, middle[0] - left[0], right[0] - middle[0])
        places = np.clip((vertices[:, 0] - middle[0]) / np.where(np.abs(run) > 1e-6, run, 1.0), -1.0, 1.0)
        rest = line_points(self._rest, feature, places, lower=lower)
        share = np.full(len(vertices), self.polygon.follow)
        if self.polygon.reach is not None:
            near = np.maximum(0.0, 1.0 - np.abs(vertices[:, 1] - rest[:, 1]) / self.polygon.reach)
            share = share * near * np.sqrt(near)

        def follow(points: Floats, moment: Moment) -> Floats:
            return points + share[:, None] * (line_points(moment, feature, places, lower=lower) - rest)

        return follow

    def _move_along(self, points: Floats, moment: Moment) -> Floats:
        """The whole outline goes along with one control point."""
        name = self.polygon.point
        rest = self._rest.points[name]
        x, y = moment.points[name]
        return points + np.array([x - rest[0], y - rest[1]])

    def _dilate(self, points: Floats, moment: Moment) -> Floats:
        factor = 1.0 + moment.activation("PD") * ((self.polygon.dilate or 1.0) - 1.0)
        center = np.array(self._character.features[self.polygon.feature].points[self.polygon.feature])
        return center + (points - center) * np.array([factor, 1.0 + 0.25 * (factor - 1.0)])

    def _drive(self, driver: Driver, points: Floats, moment: Moment) -> Floats:
        """What one motor does to the outline, in proportion to how far it has gone (A1.5, A1.6)."""
        value = moment.activation(driver.motor)
        state, share = (driver.high if value > 0.0 else driver.low), min(abs(value), 1.0)
        if not share or state is None:
            return points
        if isinstance(state, Shift):
            return shift(points, state, share)
        if isinstance(state, Touch):
            line = trace_line(moment, state.line)
            rise = line[len(line) // 2, 1] + state.offset - points[:, 1].min()
            return points + np.array([0.0, share * min(rise, 0.0)])
        goal = np.concatenate(flatten(state, self._steps))
        return points + share * (goal - np.concatenate(self._outline))


def shift(points: Floats, state: Shift, share: float) -> Floats:
    """Points (N, 2) a share of the way into a state that turns, scales and moves them, in this order."""
    sine, cosine = (float(each) for each in exact.sin_cos(np.deg2rad(state.rotate_deg * share)))
    (px, py), (sx, sy) = state.about, state.scale
    across = (points[:, 0] - px) * (1.0 + (sx - 1.0) * share)
    down = (points[:, 1] - py) * (1.0 + (sy - 1.0) * share)
    x = px + across * cosine - down * sine + state.move[0] * share
    y = py + across * sine + down * cosine + state.move[1] * share
    moved = np.stack([x, y], axis=1)
    if state.ramp is None:
        return moved
    top, full = state.ramp
    weight = exact.smoothstep((points[:, 1] - top) / (full - top))[:, None]
    return points + weight * (moved - points)


def _states(polygon: Polygon, drivers: Iterable[Driver]) -> list[Outline]:
    """The outlines that a polygon has, which all are drawn in the same steps."""
    ends = [state for driver in drivers for state in (driver.low, driver.high) if isinstance(state, tuple)]
    return [polygon.path, *ends] if polygon.path else [polygon.low, polygon.high]


def _literal(polygon: Polygon, feature: Feature) -> bool:
    return feature.literal and polygon.reach is None


def _line_names(feature: Feature, line: str) -> list[tuple[str, str]]:
    """Pairs of control points that lines connect, of one line or of all."""
    left, upper, lower, right = ENDS[feature.name]
    above, below = (left, upper, right), (left, lower, right)
    chosen = [above] if line == "upper" or feature.name in BROWS else [below] if line == "lower" else [above, below]
    return [pair for names in chosen for pair in pairwise(names)]


def _fading(moment: Moment, eye: str) -> float:
    """How much of its width a stroke has that appears as an eye shuts: all where no eye is named."""
    if not eye:
        return 1.0
    lowered = 2.2 * (max(-moment.activation(eye + "U"), 0.0) - 0.15)
    narrowed = 3.0 * (FADES_AT - moment.eye_opening(eye))
    return float(np.sqrt(min(max(lowered, narrowed, 0.0), 1.0)))


def _at(line: Floats, x: Floats) -> Floats:
    """Heights (N,) of a line (M, 2) from left to right at places ``x`` (N,)."""
    order = np.argsort(line[:, 0], kind="stable")
    return np.interp(x, line[order, 0], line[order, 1])


def _motors(polygon: Polygon, character: Character, drivers: Iterable[Driver]) -> Iterator[str]:
    lines = [line for line in (*(polygon.span or ()), polygon.stroke) if line is not None]
    for driver in drivers:
        yield driver.motor
        lines += [state.line for state in (driver.low, driver.high) if isinstance(state, Touch)]
    features = {polygon.feature, polygon.fade, *(line.feature for line in lines)} - {""}
    if polygon.point:
        features |= {name for name, feature in character.features.items() if polygon.point in feature.points}
    yield from (code for code in character.motors if motors()[code].feature in features)
    yield from (line.offset_by[0] for line in lines if line.offset_by is not None)
    if polygon.motor:
        yield polygon.motor
    if polygon.dilate is not None:
        yield "PD"
