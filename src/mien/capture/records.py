"""What is measured on photographs, and what is found from it.

In a photograph ``u`` runs to the right and ``v`` down, in pixels from its upper left corner (the middle of the first
pixel is at 0.5, 0.5). In the frame of a camera x runs to the right of the picture, y down and z forward, so that it is
right-handed like the frame of the references. Lengths are metres, pictures pixels, angles radians.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from mien.core.mesh import Points

REST = "rest"
"""The moment of photographs for which none is told."""

WORLD = "world"
"""The target that lies still: its frame is the frame of all that is found."""


@dataclass(frozen=True)
class Photograph:
    """One photograph.

    Attributes:
        name: of its file, as points are told by.
        size_px: (width, height) upright, after its EXIF rotation.
        camera: whose lens took it; photographs of one camera have one lens, and one place too where it is ``fixed``.
        moment: photographs of one moment show the subject, and boards that are carried about, in the same place: the
            phase of a face, ``smile``.
        fixed: the camera stood still (on a tripod) in all of its photographs.
        path: where the file lies.
    """

    name: str
    size_px: tuple[int, int]
    camera: str
    moment: str = REST
    fixed: bool = False
    path: Path | None = None


@dataclass(frozen=True)
class Observation:
    """Where a point is seen in a photograph.

    Attributes:
        photo: name of the photograph.
        point: name of the point; of a reference, or of what is to be measured.
        u, v: px.
        sigma_px: standard deviation of u and of v.
        line: where it stands in ``points.csv``; 0 elsewhere.
    """

    photo: str
    point: str
    u: float
    v: float
    sigma_px: float = 1.0
    line: int = 0


@dataclass(frozen=True)
class Reference:
    """A point of known place: a corner of the cube, a surveyed mark, a corner of a board.

    Attributes:
        name: as it is called in the photographs.
        x, y, z: m, in the frame of its target.
        sigma_m: standard deviation of each of them; 0 of a point taken for exact.
        target: the body that it is part of. ``WORLD`` lies still; any other (a board that is carried about) lies in a
            place of its own at each moment, which is solved for.
    """

    name: str
    x: float
    y: float
    z: float
    sigma_m: float = 0.0
    target: str = WORLD


@dataclass(frozen=True)
class Survey:
    """All that was measured."""

    photographs: tuple[Photograph, ...]
    observations: tuple[Observation, ...]
    references: tuple[Reference, ...]

    def photograph(self, name: str) -> Photograph:
        """The photograph of that name."""
        return next(each for each in self.photographs if each.name == name)


@dataclass(frozen=True)
class Lens:
    """What a camera does to directions.

    Attributes:
        focal_px: focal length over the pitch of the pixels.
        principal_px: (u, v) where the optical axis meets the picture.
        k1, k2: radial terms: a direction (x, y, 1) at radius r is seen at (1 + k1 r² + k2 r⁴) times itself.
        freed: which of ``focal``, ``principal``, ``k1``, ``k2``, ``decentring``, ``aspect`` the data were asked for;
            the others are assumed.
        p1, p2: decentring terms: (2 p1 x y + p2 (r² + 2 x²), p1 (r² + 2 y²) + 2 p2 x y) is added to that.
        aspect: vertical over horizontal focal length; not 1 of pixels that are no squares (digitised video, scanners).

    Source: Brown 1971, "Close-range camera calibration" (signs of p1 and p2 as OpenCV has them).
    """

    focal_px: float
    principal_px: tuple[float, float]
    k1: float = 0.0
    k2: float = 0.0
    freed: tuple[str, ...] = ()
    p1: float = 0.0
    p2: float = 0.0
    aspect: float = 1.0


@dataclass(frozen=True, eq=False)
class Camera:
    """A lens at a place.

    Attributes:
        lens: of the camera.
        rotation: (3, 3), rows are the camera's x, y, z in the frame of the world.
        place: (3,) m, the centre of projection in the world.
    """

    lens: Lens
    rotation: Points
    place: Points


@dataclass(frozen=True, eq=False)
class SolvedPoint:
    """A point with what is known about its place.

    Attributes:
        name: of the point.
        moment: when it was there.
        place: (3,) m.
        covariance: (3, 3) m².
        photos: names of the photographs that it was found from.
        kind: ``measured``; ``reference``; of the pair of 1972 also ``mirrored`` (its twin across the symmetry plane was
            measured), ``symmetric`` (seen once, the rest from its twin), ``modelled`` (seen once, the rest from its
            neighbours).
    """

    name: str
    moment: str
    place: Points
    covariance: Points
    photos: tuple[str, ...]
    kind: str = "measured"


@dataclass(frozen=True)
class Residual:
    """How far a point is seen from where the solution has it: seen less solved.

    Attributes:
        observation: what was seen.
        du, dv: px.
        statistic: χ² of leaving it out, of 2 degrees of freedom: large where it does not fit all others.
    """

    observation: Observation
    du: float
    dv: float
    statistic: float = 0.0


@dataclass(frozen=True, eq=False)
class Solution:
    """Cameras and points found from a survey.

    Attributes:
        survey: what it was found from, all of it.
        cameras: by name of the photograph.
        points: measured points and references, by (moment, name).
        residuals: one each observation, also of those that are suspects.
        suspects: residuals of mis-clicks, the worst first; they took no part.
        chi2_per_dof: 1 where the sigmas are right.
        remarks: what was assumed and what to do better, a sentence each.
        method: ``metric`` or ``appendix-c`` or ``pair`` or ``pair-1972``.
    """

    survey: Survey
    cameras: Mapping[str, Camera]
    points: Mapping[tuple[str, str], SolvedPoint]
    residuals: tuple[Residual, ...]
    suspects: tuple[Residual, ...] = ()
    chi2_per_dof: float = 1.0
    remarks: tuple[str, ...] = field(default=())
    method: str = "metric"
