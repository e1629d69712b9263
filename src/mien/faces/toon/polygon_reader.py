"""Polygons of a drawn face's file as records."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from mien.core import MienError, UnknownNameError

from .fields import Fields
from .lines import ENDS
from .outlines import parse_path, polygon_outline, same_pieces
from .records import (
    KINDS,
    LAYERS,
    Depth,
    Driver,
    Feature,
    Kind,
    Layer,
    Limits,
    Line,
    Mode,
    Outline,
    Polygon,
    Shift,
    State,
    Touch,
)

MOST_POINTS = 100_000
"""More than any drawing needs; less than what stops a machine."""

COLOR = re.compile(r"#[0-9a-fA-F]{6}")


def depth_of(fields: Fields) -> Depth | None:
    """How far something lies in front of the head's axis; None where the file does not say."""
    if not {"depth", "bulge", "shorten"} & set(fields.keys):
        return None
    return Depth(fields.number("depth", 0.0), fields.number("bulge", 0.0), fields.number("shorten", 0.0))


class PolygonReader:
    """Reads polygons, which name colours, features, motors and one another."""

    def __init__(
        self, mode: Mode, palette: Mapping[str, str], features: Mapping[str, Feature], limits: Mapping[str, Limits]
    ) -> None:
        self.mode, self.palette, self.features, self.limits = mode, palette, features, limits
        self._seen: set[str] = set()
        self._points = 0

    def fill(self, fields: Fields, key: str) -> str:
        """A colour of the palette, or one by its code."""
        name = fields.text(key)
        if name not in self.palette and not COLOR.fullmatch(name):
            raise UnknownNameError(f"{fields.at(key)}: colour", name, self.palette)
        return name

    def polygon(self, fields: Fields, parts: Mapping[str, tuple[Driver, ...]]) -> Polygon:
        """One polygon of the file.

        Raises:
            MienError: it cannot be understood.
        """
        name = fields.text("id")
        if name in self._seen:
            raise fields.error("id", f"{name!r} is the id of another polygon")
        self._seen.add(name)
        kind: Kind = fields.choice("kind", KINDS)
        path, low, high = (self._outline(fields, key) for key in ("path", "min", "max"))
        layer: Layer = fields.choice("layer", LAYERS, kind)
        polygon = Polygon(
            id=name,
            kind=kind,
            fill=self.fill(fields, "fill"),
            layer=layer,
            path=path,
            low=low,
            high=high,
            motor=self._known(fields, "motor", self.limits),
            feature=self._known(fields, "feature", self.features),
            line=fields.choice("line", ("", "upper", "lower"), ""),
            span=self._span(fields),
            stroke=self.line(fields.inner("stroke")) if "stroke" in fields.keys else None,
            width=fields.knots("width") if "width" in fields.keys else (),
            closed=fields.flag("closed"),
            follow=fields.number("follow", 1.0),
            reach=fields.number("reach") if "reach" in fields.keys else None,
            drivers=tuple(self.drivers(list(fields.items("drivers")))) if "drivers" in fields.keys else (),
            point=self._known(fields, "with", self._control_points()) or self._pupil(kind, fields),
            dilate=fields.number("dilate") if "dilate" in fields.keys else None,
            fade=self._known(fields, "fade", ("ER", "EL")),
            clip=fields.names("clip"),
            rule=fields.choice("rule", ("evenodd", "nonzero"), "evenodd" if self.mode == "strict" else "nonzero"),
            depth=depth_of(fields),
            body=fields.flag("body"),
            part=self._known(fields, "part", parts),
            opacity=fields.number("opacity", 1.0),
        )
        self._check(polygon, fields)
        fields.done()
        return polygon

    def _check(self, polygon: Polygon, fields: Fields) -> None:
        sources = [bool(polygon.path), bool(polygon.low or polygon.high), polygon.span is not None]
        if sum([*sources, polygon.stroke is not None]) != 1:
            raise fields.error("", "want one of path, min and max, span, stroke")
        if polygon.low or polygon.high:
            if not (polygon.low and polygon.high and polygon.motor):
                raise fields.error("", "want both states, min and max, and the motor between them")
            if not same_pieces(polygon.low, polygon.high):
                raise fields.error("max", "has other path commands than min, so one cannot become the other")
        if polygon.stroke is not None and not polygon.width:
            raise fields.error("width", "a stroke wants a width")
        if polygon.kind in ("feature", "pupil") and polygon.path and not polygon.feature:
            raise fields.error("feature", f"a polygon of kind {polygon.kind!r} is attached to one, but none is named")
        for driver in polygon.drivers:
            for state in (driver.low, driver.high):
                if isinstance(state, tuple) and not same_pieces(polygon.path, state):
                    raise fields.error("drivers", f"a state at {driver.motor} has other path commands than the path")
        if not 0.0 <= polygon.opacity <= 1.0:
            raise fields.error("opacity", f"{polygon.opacity:g} is out of range — it goes from 0 to 1")

    def _control_points(self) -> tuple[str, ...]:
        return tuple(point for feature in self.features.values() for point in feature.points)

    def _pupil(self, kind: str, fields: Fields) -> str:
        """Pupils go along with their control point."""
        return fields.text("feature", "") if kind == "pupil" else ""

    def _span(self, fields: Fields) -> tuple[Line, Line] | None:
        if "span" not in fields.keys:
            return None
        lines = [self.line(each) for each in fields.items("span")]
        if len(lines) != 2:
            raise fields.error("span", f"want two lines, got {len(lines)}")
        return lines[0], lines[1]

    def line(self, fields: Fields) -> Line:
        """A stretch of a feature's line."""
        feature = self._known(fields, "feature", [name for name in self.features if name in ENDS])
        if not feature:
            raise fields.error("feature", "is missing: which feature's line?")
        offset_by = None
        if "offset_by" in fields.keys:
            inner = fields.inner("offset_by")
            offset_by = (self._known(inner, "motor", self.limits), inner.number("share"))
            inner.done()
        held = fields.inner("at") if "at" in fields.keys else None
        line = Line(
            feature,
            fields.choice("line", ("upper", "lower"), "upper") == "lower",
            fields.knots("offset") if "offset" in fields.keys else ((0.0, 0.0),),
            offset_by,
            {code: held.number(code) for code in held.keys} if held is not None else {},
            *fields.point("range", (-1.0, 1.0)),
            int(fields.number("count", 28)),
        )
        for code in line.at:
            if code not in self.limits:
                raise UnknownNameError(f"{fields.at('at')}: motor", code, self.limits)
        if not 2 <= line.count <= 400:
            raise fields.error("count", f"want 2 to 400 pieces, got {line.count}")
        fields.done()
        return line

    def drivers(self, items: list[Fields]) -> Iterator[Driver]:
        """What motors do to an outline."""
        for fields in items:
            motor = self._known(fields, "motor", self.limits)
            if not motor:
                raise fields.error("motor", "is missing: which motor moves it?")
            driver = Driver(motor, self._state(fields, "min"), self._state(fields, "max"))
            fields.done()
            yield driver

    def _state(self, fields: Fields, key: str) -> State | None:
        if key not in fields.keys:
            return None
        if not fields.is_group(key):
            return self._outline(fields, key)
        inner = fields.inner(key)
        state: State
        if "touch" in inner.keys:
            state = Touch(self.line(inner.inner("touch")), inner.number("offset", 0.0))
        else:
            ramp = inner.point("ramp") if "ramp" in inner.keys else None
            if ramp is not None and ramp[0] == ramp[1]:
                raise inner.error("ramp", "wants two different heights")
            state = Shift(
                inner.point("move", (0.0, 0.0)),
                inner.number("rotate", 0.0),
                inner.point("scale", (1.0, 1.0)),
                inner.point("about", (0.0, 0.0)),
                ramp,
            )
        inner.done()
        return state

    def _outline(self, fields: Fields, key: str) -> Outline:
        if key not in fields.keys:
            return ()
        value = fields.raw(key)
        try:
            outline = parse_path(value) if isinstance(value, str) else polygon_outline(fields.points(key))
        except MienError as error:
            raise fields.error(key, str(error)) from None
        self._points += len(outline)
        if self._points > MOST_POINTS:
            raise fields.error(key, f"the drawing has more than {MOST_POINTS:,} points")
        return outline

    def _known(self, fields: Fields, key: str, known: Any) -> str:
        name = fields.text(key, "")
        if name and name not in known:
            raise UnknownNameError(f"{fields.at(key)}: {key}", name, known)
        return name


def check_clips(polygons: tuple[Polygon, ...], fields: Fields) -> None:
    """Nothing, when every polygon that others are cut by is there.

    Raises:
        UnknownNameError: one is not.
    """
    names = [polygon.id for polygon in polygons]
    for number, polygon in enumerate(polygons):
        for name in polygon.clip:
            if name not in names:
                raise UnknownNameError(f"{fields.at('polygons')}[{number}].clip: polygon", name, names)
