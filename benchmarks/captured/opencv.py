"""The same clicks by OpenCV: ``calibrateCamera`` on the references, then ``triangulatePoints``.

It is given what is hard to find for it, the true focal lengths to start from, and the settings that suit it best:
whoever reads the table takes the best column.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import cv2
import numpy as np

from mien.capture.records import Camera, Observation, Photograph, Survey

KNOWN = cv2.CALIB_USE_INTRINSIC_GUESS | cv2.CALIB_FIX_ASPECT_RATIO | cv2.CALIB_ZERO_TANGENT_DIST | cv2.CALIB_FIX_K3
"""Square pixels and two radial terms, as our cameras have."""

SETTINGS = {
    "all free": KNOWN,
    "centre fixed": KNOWN | cv2.CALIB_FIX_PRINCIPAL_POINT | cv2.CALIB_FIX_K2,
    "focal only": KNOWN | cv2.CALIB_FIX_PRINCIPAL_POINT | cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2,
}
HALF_PX = 0.5
"""OpenCV's first pixel has its middle at 0, ours at a half."""


@dataclass(frozen=True)
class View:
    """What ``calibrateCamera`` found of a photograph: (3, 3) and (5,) of its lens, (3, 4) from the world to it."""

    matrix: np.ndarray
    distortion: np.ndarray
    placed: np.ndarray


def locate(survey: Survey, start: Mapping[str, Camera], flags: int) -> dict[tuple[str, str], np.ndarray]:
    """(3,) m of every point that is no reference and is seen twice, by (moment, name)."""
    views: dict[str, View] = {}
    for name in {photograph.camera for photograph in survey.photographs}:
        of_camera = [photograph for photograph in survey.photographs if photograph.camera == name]
        views |= _calibrate(survey, of_camera, start[of_camera[0].name], flags)
    known = {reference.name for reference in survey.references}
    clicks: dict[tuple[str, str], list[Observation]] = {}
    for click in survey.observations:
        if click.point not in known:
            clicks.setdefault((survey.photograph(click.photo).moment, click.point), []).append(click)
    return {key: _triangulate(seen, views) for key, seen in clicks.items() if len(seen) > 1}


def _calibrate(survey: Survey, photographs: Sequence[Photograph], start: Camera, flags: int) -> dict[str, View]:
    places = {each.name: (each.x, each.y, each.z) for each in survey.references}
    world, pictures = [], []
    for photograph in photographs:
        seen = [click for click in survey.observations if click.photo == photograph.name and click.point in places]
        world.append(np.array([places[click.point] for click in seen], dtype=np.float32))
        pictures.append(np.array([(click.u - HALF_PX, click.v - HALF_PX) for click in seen], dtype=np.float32))
    size = photographs[0].size_px
    focal, (u, v) = start.lens.focal_px, (0.5 * size[0] - HALF_PX, 0.5 * size[1] - HALF_PX)
    guess = np.array([[focal, 0.0, u], [0.0, focal, v], [0.0, 0.0, 1.0]])
    until = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 100, 1e-10)
    _, matrix, distortion, turns, shifts, *_ = cv2.calibrateCamera(
        world, pictures, size, guess, None, flags=flags, criteria=until
    )
    placed = [
        np.hstack([cv2.Rodrigues(turn)[0], shift.reshape(3, 1)]) for turn, shift in zip(turns, shifts, strict=True)
    ]
    return {
        photograph.name: View(matrix, distortion, each) for photograph, each in zip(photographs, placed, strict=True)
    }


def _triangulate(clicks: Sequence[Observation], views: Mapping[str, View]) -> np.ndarray:
    """(3,) m, the mean of all pairs of photographs, as ``triangulatePoints`` takes two."""
    rays = []
    for click in clicks:
        view, place = views[click.photo], np.array([[[click.u - HALF_PX, click.v - HALF_PX]]])
        rays.append((view.placed, cv2.undistortPoints(place, view.matrix, view.distortion).reshape(2, 1)))
    found = []
    for (one, ray), (other, its_ray) in combinations(rays, 2):
        homogeneous = cv2.triangulatePoints(one, other, ray, its_ray).ravel()
        found.append(homogeneous[:3] / homogeneous[3])
    return np.mean(found, axis=0)
