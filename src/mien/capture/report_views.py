"""Drawings of the points from outside, with their error ellipsoids, and of the cameras from above: SVG."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from mien.core.mesh import Points

from .records import Camera, Solution, SolvedPoint
from .report_lines import Edges
from .report_numbers import REFERENCE, Unit, round_down, significant

CHI2_95 = 7.815
"""What χ² of three degrees of freedom exceeds once in twenty times."""

ANGLES_DEG: Mapping[str, float] = {"front": 0.0, "three-quarter": 45.0, "side": 90.0}
"""Turns to the right around the subject, from the middle of the cameras."""

SIZE = 360.0
"""Of the longer side of a view, in units of its drawing."""

USUAL_ELLIPSOID = 9.0
"""Semi-axis of the usual ellipsoid when magnified, at most, in units of the drawing; smaller where there are many."""

MANY = 100
"""Points from which on they are drawn smaller."""

FARTHEST = 300.0
"""Cameras farther away than so many times what the points reach are as good as endlessly far, and are not drawn."""

BAR = 0.32
"""Share of the width that a scale bar takes at most."""


@dataclass(frozen=True, eq=False)
class Standpoint:
    """Directions of a view.

    Attributes:
        rows: (3, 3), right, up and towards the viewer, in the frame of the world.
        middle: (3,) m, what the view turns around.
    """

    rows: Points
    middle: Points

    def turned(self, angle_deg: float) -> Standpoint:
        """From further right, so that the subject's left side comes to the front."""
        angle = math.radians(angle_deg)
        right, up, near = self.rows
        rows = [math.cos(angle) * right - math.sin(angle) * near, up, math.sin(angle) * right + math.cos(angle) * near]
        return Standpoint(np.array(rows), self.middle)

    def above(self) -> Standpoint:
        """From above, with the subject looking down the page."""
        right, up, near = self.rows
        return Standpoint(np.array([right, -near, up]), self.middle)

    def places(self, places: Points) -> Points:
        """(N, 3) places in the view: m to the right, upwards, towards the viewer."""
        return (places - self.middle) @ self.rows.T

    def ellipse(self, covariance: Points) -> tuple[float, float, float]:
        """Semi-axes (m) and turn (degrees, on paper, where v runs down) of the outline of the 95 % ellipsoid."""
        flat = (self.rows @ covariance @ self.rows.T)[:2, :2]
        values, vectors = np.linalg.eigh((flat + flat.T) / 2.0)
        small, large = np.sqrt(np.maximum(values, 0.0) * CHI2_95)
        return float(large), float(small), -math.degrees(math.atan2(vectors[1, 1], vectors[0, 1]))


def standpoint(solution: Solution, points: Sequence[SolvedPoint]) -> Standpoint:
    """The view of points from the middle of the cameras, upright as the photographs are.

    The pair of 1972 is solved in the frame of the head itself, and is looked at along that.
    """
    places = np.array([point.place for point in points])
    middle = (places.min(axis=0) + places.max(axis=0)) / 2.0
    cameras = list(solution.cameras.values())
    if solution.method.startswith("pair") or not cameras:
        return Standpoint(np.eye(3), middle)
    up = _unit(-sum((camera.rotation[1] for camera in cameras), np.zeros(3)), np.array([0.0, 1.0, 0.0]))
    near = sum((_unit(camera.place - middle, -camera.rotation[2]) for camera in cameras), np.zeros(3))
    near = _unit(near - (near @ up) * up, -cameras[0].rotation[2])
    near = _unit(near - (near @ up) * up, np.array([up[1], up[2], up[0]]))
    return Standpoint(np.array([np.cross(up, near), up, near]), middle)


def magnification(points: Sequence[SolvedPoint], scale: float) -> float:
    """How much larger than they are ellipsoids are drawn where a metre is so many units; 1, 2, 5, 10 …"""
    axes = [math.sqrt(max(float(np.trace(point.covariance)), 0.0) / 3.0 * CHI2_95) for point in points]
    usual = float(np.median(axes)) if axes else 0.0
    room = USUAL_ELLIPSOID * _smaller(len(points))
    return max(round_down(room / (usual * scale)), 1.0) if usual > 0.0 else 1.0


def _smaller(number: int) -> float:
    return min(1.0, math.sqrt(MANY / max(number, 1)))


def format_views(
    center: Standpoint, points: Sequence[SolvedPoint], edges: Edges, unit: Unit, references: Sequence[SolvedPoint]
) -> tuple[str, float]:
    """Figures of the points from front, three-quarter and side, and how much their ellipsoids are magnified."""
    places = np.array([point.place for point in points])
    reach = 2.0 * float(np.abs(center.places(places)).max()) if len(points) else 0.0
    scale = (SIZE - 40.0) / (reach or 1.0)
    times = magnification(points, scale)
    views = (
        (name, _format_view(center.turned(angle), points, edges, scale, times, unit, references))
        for name, angle in ANGLES_DEG.items()
    )
    figures = "".join(f"<figure>{drawing}<figcaption>{escape(name)}</figcaption></figure>\n" for name, drawing in views)
    return figures, times


def _format_view(
    view: Standpoint,
    points: Sequence[SolvedPoint],
    edges: Edges,
    scale: float,
    times: float,
    unit: Unit,
    references: Sequence[SolvedPoint],
) -> str:
    at = view.places(np.array([point.place for point in points]))
    drawn = at * np.array([scale, -scale, 1.0]) + np.array([SIZE / 2.0, SIZE / 2.0, 0.0])
    order = np.argsort(at[:, 2], kind="stable")
    lines = "".join(f"M{drawn[a, 0]:.1f} {drawn[a, 1]:.1f}L{drawn[b, 0]:.1f} {drawn[b, 1]:.1f}" for a, b in edges)
    marks = "".join(_format_mark(view, points[k], drawn[k], scale * times, 1.4 * _smaller(len(points))) for k in order)
    known = ""
    if references:
        corners = view.places(np.array([point.place for point in references])) * [scale, -scale, 1.0] + SIZE / 2.0
        known = "".join(
            f'<rect class="reference" x="{u - 2:.1f}" y="{v - 2:.1f}" width="4" height="4">'
            f"<title>{escape(point.name)}</title></rect>"
            for point, (u, v, _) in zip(references, corners, strict=True)
            if 0 < u < SIZE and 0 < v < SIZE
        )
    return (
        f'<svg class="view" viewBox="0 0 {SIZE:g} {SIZE:g}" role="img"><path class="edges" d="{lines}"/>{known}{marks}'
        f"{_format_bar(scale, SIZE, SIZE, unit)}</svg>"
    )


def _format_mark(view: Standpoint, point: SolvedPoint, at: Points, scale: float, dot: float) -> str:
    large, small, turn = view.ellipse(point.covariance)
    kind = escape(point.kind, quote=True)
    return (
        f'<g class="{kind}"><title>{escape(point.name)}</title>'
        f'<ellipse cx="{at[0]:.1f}" cy="{at[1]:.1f}" rx="{large * scale:.2f}" ry="{small * scale:.2f}" '
        f'transform="rotate({turn:.1f} {at[0]:.1f} {at[1]:.1f})"/>'
        f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="{dot:.2f}"/></g>'
    )


def _format_bar(scale: float, width: float, height: float, unit: Unit) -> str:
    """A bar of a round length, lower left."""
    length = round_down(BAR * width / scale / unit.metres)
    end = 12.0 + length * unit.metres * scale
    return (
        f'<g class="bar"><path d="M12 {height - 12:.0f}v-5m0 5H{end:.1f}v-5"/>'
        f'<text x="{end + 5:.1f}" y="{height - 11:.0f}">{significant(length, 1)} {escape(unit.name)}</text></g>'
    )


def format_plan(named: Mapping[str, Camera], center: Standpoint, points: Sequence[SolvedPoint], unit: Unit) -> str:
    """Cameras by name of their photograph from above: where they stand, what they see; empty if endlessly far."""
    view = center.above()
    cameras = list(_distinct(named))
    subject = view.places(np.array([point.place for point in points]))[:, :2]
    stands = view.places(np.array([camera.place for _, camera in cameras]).reshape(-1, 3))[:, :2]
    if len(stands) and np.abs(stands).max() > FARTHEST * np.abs(subject).max():
        return ""
    everything = np.vstack([subject, stands, np.zeros((1, 2))])
    low, high = everything.min(axis=0), everything.max(axis=0)
    width, margin = 720.0, 70.0
    extent = float(max(high[0] - low[0], (high[1] - low[1]) * 1.4)) or 1.0
    scale = (width - 2.0 * margin) / extent
    height = (high[1] - low[1]) * scale + 2.0 * margin
    spare = (width - 2.0 * margin - (high[0] - low[0]) * scale) / 2.0

    def paper(places: Points) -> Points:
        return np.stack(
            [(places[:, 0] - low[0]) * scale + margin + spare, (high[1] - places[:, 1]) * scale + margin], axis=1
        )

    dots = "".join(
        f'<circle class="{escape(point.kind, quote=True)}" cx="{u:.1f}" cy="{v:.1f}" r="1.6"/>'
        for point, (u, v) in zip(points, paper(subject), strict=True)
    )
    center_at = paper(np.zeros((1, 2)))[0]
    marks = "".join(
        _format_camera(names, camera, place, view, float(np.hypot(*(place - center_at))), width)
        for (names, camera), place in zip(cameras, paper(stands), strict=True)
    )
    return (
        f'<svg viewBox="0 0 {width:g} {height:.0f}" role="img">'
        f"{marks}<g>{dots}</g>{_format_bar(scale, width, height, unit)}</svg>"
    )


def _format_camera(names: str, camera: Camera, at: Points, view: Standpoint, far: float, width: float) -> str:
    """A camera as a wedge as wide as its picture."""
    forward = view.rows[:2] @ camera.rotation[2]
    aim = math.atan2(-forward[1], forward[0])
    half = math.atan(camera.lens.principal_px[0] / camera.lens.focal_px)
    near = 12.0
    corners = [
        (at[0] + reach * math.cos(aim + side), at[1] + reach * math.sin(aim + side))
        for reach, side in ((far, -half), (far, half), (near, half), (near, -half))
    ]
    path = "M{:.1f} {:.1f}".format(*at) + "".join(f"L{u:.1f} {v:.1f}" for u, v in corners[:2]) + "Z"
    body = "M{:.1f} {:.1f}".format(*at) + "".join(f"L{u:.1f} {v:.1f}" for u, v in corners[2:]) + "Z"
    back = (at[0] - 14.0 * math.cos(aim), at[1] - 14.0 * math.sin(aim))
    anchor = "start" if back[0] < 0.2 * width else "end" if back[0] > 0.8 * width else "middle"
    return (
        f'<g class="camera"><path class="sight" d="{path}"/><path d="{body}"/>'
        f'<text x="{back[0]:.1f}" y="{back[1] + 4:.1f}" text-anchor="{anchor}">{escape(names)}</text></g>'
    )


def _distinct(cameras: Mapping[str, Camera]) -> Iterator[tuple[str, Camera]]:
    """Cameras, those that stand in one place together under the names of their photographs."""
    groups: list[tuple[list[str], Camera]] = []
    for name, camera in cameras.items():
        for names, other in groups:
            if np.allclose(camera.place, other.place, atol=1e-9) and np.allclose(camera.rotation, other.rotation):
                names.append(name)
                break
        else:
            groups.append(([name], camera))
    for names, camera in groups:
        yield names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more", camera


def references_of(solution: Solution, moment: str) -> list[SolvedPoint]:
    """Points of a moment that were known beforehand."""
    return [point for (at, _), point in solution.points.items() if at == moment and point.kind == REFERENCE]


def _unit(vector: Points, otherwise: Points) -> Points:
    length = float(np.linalg.norm(vector))
    return vector / length if length > 1e-9 else otherwise
