"""Where the viewer stands, where the light comes from, what is behind the face."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

from . import exact
from .drawing import Rgba
from .errors import RangeError, UnknownNameError
from .face import Face
from .parameters import Pose

Vector = tuple[float, float, float]
Shading = Literal["smooth", "smooth+", "polygon", "wire"]

SHADINGS: tuple[Shading, ...] = ("smooth", "smooth+", "polygon", "wire")

CENTRE: Vector = (0.0, -0.026, 0.0)
"""What a picture of a whole head is centred on, metres."""

DISTANCE_M = 1.10
FRONT: Vector = (0.0, 0.0, DISTANCE_M)
"""Where the viewer of a drawing stands unless said, metres: straight before it."""

FOV_DEG = 17.2

VIEWS: Mapping[str, tuple[float, float]] = {
    "front": (0.0, 2.0),
    "three-quarter": (22.0, 3.0),
    "side": (90.0, 2.0),
}
"""Views by name: degrees around the face's own left, degrees upwards."""

BACKGROUND: tuple[Rgba, Rgba] = ((0.32, 0.23, 0.18, 1.0), (0.87, 0.80, 0.73, 1.0))
"""Linear RGBA at the bottom and at the top of a picture where neither scene nor face says anything."""


@dataclass(frozen=True)
class Light:
    """A light far or near.

    Attributes:
        position: (x, y, z) m.
        color: linear RGB, its strength included.
        wrap: 0 for a point, up to 1 for a light so large that it reaches around the form.
    """

    position: Vector
    color: Vector
    wrap: float = 0.0


@dataclass(frozen=True)
class Scene:
    """Camera, lights, background, shading, size.

    Attributes:
        position: (x, y, z) m, where the picture is taken from.
        at: (x, y, z) m, the point in the middle of the picture.
        fov_deg: field of view along the shorter side.
        size_px: (width, height).
        background: linear RGBA at the bottom and at the top of the picture; alpha 0 is transparent. None is the face's
            own, or ``BACKGROUND``.
        lights: none means the default: key, fill and two rims, placed with the viewer.
        ambient: linear RGB that falls from below and from above.
        cosine_power: whole power of the cosine in the diffuse term; Parke's "cosine power".
        gloss: factor on the highlights of all materials.
        shading: smooth (shades interpolated), smooth+ (normals interpolated, light on every pixel), polygon (one
            shade a polygon) or wire.
        subdivide: Catmull-Clark steps, 0..2.
        target: what the eyes look at, m, where the pose says nothing; None is the viewer.
    """

    position: Vector = (0.0, -0.026, DISTANCE_M)
    at: Vector = CENTRE
    fov_deg: float = FOV_DEG
    size_px: tuple[int, int] = (1024, 1024)
    background: tuple[Rgba, Rgba] | None = None
    lights: tuple[Light, ...] = ()
    ambient: tuple[Vector, Vector] = ((0.075, 0.062, 0.058), (0.125, 0.13, 0.145))
    cosine_power: int = 1
    gloss: float = 1.0
    shading: Shading = "smooth"
    subdivide: int = 2
    target: Vector | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.size_px, tuple) or len(self.size_px) != 2:
            raise RangeError(f"size_px {self.size_px!r}: want (width, height) in pixels")
        width, height = self.size_px
        if not (1 <= width <= 16384 and 1 <= height <= 16384):
            raise RangeError(f"size {width}x{height} is out of range — each side is 1 to 16384 pixels")
        if not 0.1 <= self.fov_deg <= 170.0:
            raise RangeError(f"field of view {self.fov_deg:g} is out of range — it goes from 0.1 to 170 degrees")
        if self.shading not in SHADINGS:
            raise UnknownNameError("shading", str(self.shading), SHADINGS)
        if self.subdivide not in (0, 1, 2):
            raise RangeError(f"subdivide {self.subdivide} is out of range — it is 0, 1 or 2")
        if not 1 <= self.cosine_power <= 64:
            raise RangeError(f"cosine power {self.cosine_power} is out of range — it goes from 1 to 64")
        if not all(math.isfinite(x) for x in (*self.position, *self.at, self.fov_deg)):
            raise RangeError(f"camera at {self.position}, towards {self.at}: every number must be finite")
        if math.dist(self.position, self.at) < 1e-6:
            raise RangeError(f"the camera stands at {self.position}, the very point that it looks at")

    def seen(self, view: str) -> Scene:
        """The scene from a named view: front, three-quarter or side."""
        if view not in VIEWS:
            raise UnknownNameError("view", view, VIEWS)
        return self.turned(*VIEWS[view])

    def turned(self, yaw_deg: float, pitch_deg: float = 0.0, distance_m: float | None = None) -> Scene:
        """The scene from ``yaw_deg`` around the face's own left and ``pitch_deg`` above, at the same distance."""
        distance = math.dist(self.position, self.at) if distance_m is None else distance_m
        (sin_yaw, cos_yaw), (sin_pitch, cos_pitch) = _sin_cos(yaw_deg), _sin_cos(pitch_deg)
        way = (sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch)
        x, y, z = (round(a + distance * w, 6) for a, w in zip(self.at, way, strict=True))
        return replace(self, position=(x, y, z))

    def behind(self, own: Rgba | None = None) -> tuple[Rgba, Rgba]:
        """Linear RGBA at the bottom and at the top of the picture of a face; ``own`` is what it brings along."""
        if self.background is not None:
            return self.background
        return BACKGROUND if own is None else (own, own)

    @property
    def lamps(self) -> tuple[Light, ...]:
        """The lights that shine: the scene's own, or the default ones around this viewer."""
        return self.lights or studio_lights(self)

    @classmethod
    def parke(cls, diffuse: float = 0.3, cosine_power: int = 1, **more: object) -> Scene:
        """Parke's scene: one light at the viewer's shoulder, shade = d + (1 - d) cos^p, no highlights, plain grey.

        Source: Parke 1974, section 3.5 (diffuse factor and cosine power).

        Raises:
            RangeError: the diffuse factor is not a share, or a field is out of range.
        """
        if not 0.0 <= diffuse <= 1.0:
            raise RangeError(f"diffuse factor {diffuse:g} is out of range — it goes from 0 to 1")
        rest = 1.0 - diffuse
        light = Light((0.35, 0.45, 1.2), (rest, rest, rest))
        grey: Rgba = (0.12, 0.12, 0.13, 1.0)
        ambient = ((diffuse,) * 3, (diffuse,) * 3)
        scene = cls(lights=(light,), ambient=ambient, cosine_power=cosine_power, gloss=0.0, background=(grey, grey))
        return replace(scene, **more)  # type: ignore[arg-type]


def studio_lights(scene: Scene) -> tuple[Light, ...]:
    """A warm key from the left of the picture, a cool fill, two rims; they move around with the viewer."""
    dx, _, dz = (p - a for p, a in zip(scene.position, scene.at, strict=True))
    level = math.sqrt(dx * dx + dz * dz)
    aside, ahead = (dx / level, dz / level) if level else (0.0, 1.0)
    rows = (  # degrees around from the viewer, degrees up, colour, wrap
        (-38.0, 34.0, (1.00, 0.925, 0.83), 0.25),
        (36.0, 6.0, (0.23, 0.25, 0.29), 0.35),
        (150.0, 35.0, (0.42, 0.42, 0.42), 0.0),
        (-150.0, 20.0, (0.20, 0.24, 0.30), 0.0),
    )
    lights = []
    for around, up, rgb, wrap in rows:
        (sin_around, cos_around), (sin_up, cos_up) = _sin_cos(around), _sin_cos(up)
        across, along = aside * cos_around + ahead * sin_around, ahead * cos_around - aside * sin_around
        x, y, z = (round(3.0 * c, 6) for c in (across * cos_up, sin_up, along * cos_up))
        lights.append(Light((x, y, z), rgb, wrap))
    return tuple(lights)


def _sin_cos(angle_deg: float) -> tuple[float, float]:
    sine, cosine = exact.sin_cos(math.radians(angle_deg))
    return float(sine), float(cosine)


def fill_rows(face: Face, pose: Pose, scene: Scene) -> Pose:
    """The pose with the rows ``light.* viewer.* target.*`` taken from the scene, where it leaves them at rest.

    Source: Parke 1974, section 3.5 (light, viewer and target are parameters of the face).
    """
    target = scene.position if scene.target is None else scene.target
    places = {"light": scene.lamps[0].position, "viewer": scene.position, "target": target}
    table = face.parameters
    changes: dict[str, float] = {}
    for group, place in places.items():
        names = [f"{group}.{axis}" for axis in "xyz"]
        if all(name in table for name in names) and all(pose[name] == table[name].default for name in names):
            for name, value in zip(names, place, strict=True):
                changes[name] = min(max(value, table[name].low), table[name].high)
    return pose.replace(changes) if changes else pose
