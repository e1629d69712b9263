"""The parameters of a drawn face: its motors, its colours, its proportions, and the viewer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from mien.core import Parameter, ParameterTable, exact
from mien.core.parameters import color

from .gazing import MOST_CURVED
from .lines import resting_share
from .motors import Motor, motors
from .records import Character, Limits

SOURCE = "Thórisson 1996, A1.2.1"
OWN = "own"

GROUPS: Mapping[str, str] = {"ER": "eyelid", "EL": "eyelid", "PR": "pupil", "PL": "pupil", "M": "mouth"}

PROPORTIONS: Mapping[str, tuple[float, str, str]] = {
    "face.width": (1.0, "factor", "Width of the head."),
    "face.height": (1.0, "factor", "Height of the head."),
    "eyes.size": (1.0, "factor", "Size of the eyes with their pupils."),
    "eyes.spacing": (0.0, "drawing unit", "How much further the eyes lie from the middle."),
    "eyes.up": (0.0, "drawing unit", "How much higher the eyes lie."),
    "brows.up": (0.0, "drawing unit", "How much higher the eyebrows lie."),
    "mouth.width": (1.0, "factor", "Width of the mouth."),
    "mouth.up": (0.0, "drawing unit", "How much higher the mouth lies."),
    "nose.size": (1.0, "factor", "Size of the nose."),
    "ears.size": (1.0, "factor", "Size of the ears."),
}
"""Resting value, unit and meaning of each proportion."""

SPREAD_SHARE = 1.0 / 3.0
"""Standard deviation among people drawn by chance, as a share of the room to the nearer limit."""

VIEWER_M = 5.0


def make_table(character: Character) -> ParameterTable:
    """The table of a character: rows of those motors that it has limits for, and aliases by code and number."""
    rows = [
        *_motor_rows(character),
        *_proportion_rows(character),
        *_color_rows(character),
        *_viewer_rows(),
        *_gaze_rows(),
    ]
    aliases = {alias: motors()[code].parameter for code in character.motors for alias in motors()[code].aliases}
    return ParameterTable(tuple(rows), aliases)


def _motor_rows(character: Character) -> Iterator[Parameter]:
    for code, motor in motors().items():
        if code in character.motors:
            yield _motor_row(motor, character.motors[code])


def _motor_row(motor: Motor, limits: Limits) -> Parameter:
    low, high = (limits.low_deg, limits.high_deg) if motor.unit == "deg" else (0.0, 1.0)
    if motor.unit == "signed":
        low = -1.0
    group = GROUPS.get(motor.feature, motor.parameter.split(".")[0])
    source = f"{SOURCE}, motor {motor.code}" if motor.paper else OWN
    default = resting_share(motor.code, limits)
    return Parameter(
        motor.parameter,
        low,
        high,
        default,
        "deg" if motor.unit == "deg" else "share",
        group,
        motor.odd,
        f"{motor.doc[:-1]} ({motor.code}).",
        source,
        role=motor.role,
        closed=motor.closed,
    )


def _proportion_rows(character: Character) -> Iterator[Parameter]:
    for name, (low, high) in character.proportions.items():
        default, unit, doc = PROPORTIONS[name]
        spread = SPREAD_SHARE * min(high - default, default - low)
        yield Parameter(name, low, high, default, unit, "proportion", doc=doc, source=OWN, spread=spread, role="shape")


def _color_rows(character: Character) -> Iterator[Parameter]:
    for name, code in character.palette.items():
        yield from color(
            f"palette.{name}",
            linear_color(code),
            group="palette",
            unit="linear light",
            doc=f"Colour {name!r}",
            source=OWN,
        )


def _viewer_rows() -> Iterator[Parameter]:
    for axis, low, default in (("x", -VIEWER_M, 0.0), ("y", -VIEWER_M, 0.0), ("z", 0.1, 1.0)):
        doc = f"Where the viewer is: {axis} from the middle of the head."
        yield Parameter(
            f"viewer.{axis}",
            low,
            VIEWER_M,
            default,
            "m",
            "viewer",
            doc=doc,
            source="Parke 1974, section 3.5",
            odd=axis == "x",
            role="scene",
        )


def _gaze_rows() -> Iterator[Parameter]:
    source = "Thórisson 1996, A1.4 (wished for there)"
    doc = "How far pupils and head are drawn so that the gaze appears to the viewer as it is meant."
    yield Parameter("gaze.compensation", 0.0, 1.0, 0.0, "share", "viewer", doc=doc, source=source, role="scene")
    doc = "Curvature of the screen that the face is seen on; positive is convex, 0 flat."
    limits = (-MOST_CURVED, MOST_CURVED)
    yield Parameter("screen.curvature", *limits, 0.0, "1/m", "viewer", doc=doc, source=source, role="scene")


def linear_color(code: str) -> tuple[float, float, float]:
    """Linear RGB 0..1 of ``#rrggbb``."""
    red, green, blue = (exact.srgb_to_linear(int(code[k : k + 2], 16) / 255.0) for k in (1, 3, 5))
    return red, green, blue
