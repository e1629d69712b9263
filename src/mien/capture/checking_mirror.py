"""References that are labelled mirror-wise: left and right of the cube exchanged by who named its corners.

A cube and its mirror image cannot be turned into one another: no camera sees the one where the other's corners were
clicked. Each photograph is placed by its references as they are told and by their mirror image; the better one tells.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mien.core.errors import MienError
from mien.core.mesh import Points

from .homogeneous import homogeneous_matrix, metric_camera
from .placing import Pose, focal_lenses, likely_poses, refine_poses
from .projecting import lens_array, project
from .records import WORLD, Photograph, Survey

SOLID = 0.1
"""Thickness of references over their length, from which on a cube and its image differ clearly."""

SURELY = 12.0
"""How many times better the mirror image must fit."""

FITTING_PX = 0.01
"""How far off points of a photograph that fits may be, of its greater side, root mean square."""

CLEARLY_PX = 0.002
"""The same of one that fits so well that its mirror image cannot."""

FEWEST = 6
"""References of a photograph that tell hands apart."""

LENSES = 7
"""Focal lengths that a photograph is tried with."""

REFINED = 4
"""Places that are refined, of all that are likely."""


JUDGED = 12
"""Photographs that are looked at, at most."""


@dataclass(frozen=True)
class _Fit:
    """How well a camera fits: mean square of what is off, of the greater side; parts of x, y, z to the right in it."""

    error: float
    right: tuple[float, float, float]


@dataclass(frozen=True)
class _Image:
    """How a photograph fits references and their mirror image: mean squares, of its greater side."""

    photo: str
    told: float
    mirrored: float
    right: tuple[float, float, float]

    @property
    def is_mirrored(self) -> bool:
        return self.mirrored < FITTING_PX**2 and self.told > SURELY * self.mirrored

    @property
    def is_right(self) -> bool:
        return self.told < FITTING_PX**2 and self.mirrored > SURELY * self.told


def check_handedness(survey: Survey) -> None:
    """Whether references are where photographs show them, not where a mirror would.

    Raises:
        MienError: they are mirror images, in all photographs or in some.
    """
    images = _images(survey)
    wrong = [each for each in images if each.is_mirrored]
    if not wrong:
        return
    names = ", ".join(repr(each.photo) for each in wrong)
    if any(each.is_right for each in images):
        raise MienError(
            f"photograph {names}: references are named mirror-wise there, and rightly in the others — exchange the "
            "names of left and right corners in that photograph, or look whether the picture itself is mirrored"
        )
    axis = _across(wrong)
    pairs = _pairs(survey, axis)
    exchange = f" (or exchange names: {', '.join(f'{a} and {b}' for a, b in pairs)})" if pairs else ""
    raise MienError(
        f"references are named mirror-wise: {names} {'shows' if len(wrong) == 1 else 'show'} their mirror image, which "
        f"fits {_better(wrong)} times better — left and right are exchanged along {axis}: change the sign of all "
        f"{axis} in references.csv, or of another axis instead{exchange}; but if v was counted from the lower edge of "
        "the picture, or u and v are exchanged, mend points.csv and leave the references"
    )


def _better(images: Sequence[_Image]) -> str:
    ratio = float(np.median([each.told / max(each.mirrored, 1e-12) for each in images])) ** 0.5
    return f"{ratio:.0f}"


def _images(survey: Survey) -> list[_Image]:
    known = {each.name: each for each in survey.references if each.target == WORLD}
    images: list[_Image] = []
    for photograph in survey.photographs:
        seen = [each for each in survey.observations if each.photo == photograph.name and each.point in known]
        if len(seen) < FEWEST or len(images) == JUDGED:
            continue
        places = np.array([(known[each.point].x, known[each.point].y, known[each.point].z) for each in seen])
        places = places - places.mean(axis=0)
        spread = np.linalg.svd(places, compute_uv=False)
        if spread[2] < SOLID * spread[0]:
            continue
        pictures = np.array([(each.u, each.v) for each in seen])
        images.append(_compare(photograph, places, pictures))
    return images


def _compare(photograph: Photograph, places: Points, pictures: Points) -> _Image:
    """How a photograph fits both; the mirror image is not looked at where the places told leave nothing to wish for."""
    size_px = photograph.size_px
    told = _fit(_direct(places, pictures, size_px), places, pictures, size_px)
    if told.error < CLEARLY_PX**2:
        return _Image(photograph.name, told.error, np.inf, told.right)
    told = _fit(_likely(places, pictures, size_px), places, pictures, size_px)
    image = places * [-1.0, 1.0, 1.0]
    mirrored = _fit(_likely(image, pictures, size_px), image, pictures, size_px)
    return _Image(photograph.name, told.error, mirrored.error, mirrored.right)


def _direct(places: Points, pictures: Points, size_px: tuple[int, int]) -> list[Pose]:
    """The place that the homogeneous matrix tells, if it tells one."""
    try:
        camera = metric_camera(homogeneous_matrix(places, pictures), places)
    except MienError:
        return []
    if camera is None:
        return []
    lens = lens_array(camera.lens)
    lens[1:3] = np.array(size_px) / 2.0
    return [Pose(lens, camera.rotation, camera.place, 1.0)]


def _likely(places: Points, pictures: Points, size_px: tuple[int, int]) -> list[Pose]:
    """The likeliest places, whatever the focal length."""
    tried = likely_poses(focal_lenses(size_px, LENSES), places, pictures, max(size_px))
    return sorted((pose for poses in tried for pose in poses), key=lambda pose: pose.cost)[:REFINED]


def _fit(poses: list[Pose], places: Points, pictures: Points, size_px: tuple[int, int]) -> _Fit:
    """The best of some places of a camera, when its focal length and its bend are let go."""
    greater = float(max(size_px))
    best = min(
        refine_poses(poses, places, pictures, greater, free=(0, 3), rounds=20) if poses else [],
        key=lambda pose: pose.cost,
        default=None,
    )
    if best is None:
        return _Fit(np.inf, (1.0, 0.0, 0.0))
    off = ((project(best.camera(), places) - pictures) ** 2).sum(axis=1) / greater**2
    # A click in ten may be wrong without telling anything about hands.
    kept = np.sort(np.where(np.isfinite(off), off, 1.0))[: max(FEWEST - 1, int(0.9 * len(off)))]
    x, y, z = (abs(float(value)) for value in best.rotation[0])
    return _Fit(float(kept.mean()), (x, y, z))


def _across(images: Sequence[_Image]) -> str:
    """The axis that runs most from left to right in the photographs."""
    return "xyz"[int(np.argmax(np.sum([each.right for each in images], axis=0)))]


def _pairs(survey: Survey, axis: str) -> list[tuple[str, str]]:
    """Names to exchange where the references are their own mirror image; none where they are not."""
    references = [each for each in survey.references if each.target == WORLD]
    places = np.array([(each.x, each.y, each.z) for each in references])
    size = float(np.ptp(places, axis=0).max())
    k = "xyz".index(axis)
    image = places.copy()
    image[:, k] = places[:, k].min() + places[:, k].max() - places[:, k]
    partner = [int(np.argmin(((places - place) ** 2).sum(axis=1))) for place in image]
    if any(np.linalg.norm(places[p] - place) > 1e-3 * size for p, place in zip(partner, image, strict=True)):
        return []
    return [(references[a].name, references[b].name) for a, b in enumerate(partner) if a < b]
