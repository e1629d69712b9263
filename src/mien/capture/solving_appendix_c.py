"""A survey solved as Appendix C has it: each photograph by itself, then each point, all by normal equations.

Nothing is refined together and no click is doubted. Covariances follow from the same equations to first order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.capture.appendix_c import FEWEST, locate, location_system, picture, transformation, transformation_system
from mien.capture.homogeneous import metric_camera
from mien.capture.networks import Network, connect
from mien.capture.records import Camera, Residual, Solution, SolvedPoint, Survey
from mien.core.errors import MienError
from mien.core.mesh import Points


@dataclass(frozen=True, eq=False)
class _View:
    """The matrix (4, 3) of a photograph, the covariance (11, 11) of its unknowns, and its redundancy."""

    matrix: Points
    covariance: Points
    redundancy: int


def solve_appendix_c(survey: Survey) -> Solution:
    """Cameras and points of a survey by Appendix C.

    The origin is put amid the references while it is solved, for T43 = 1 to be possible.

    Raises:
        MienError: references on boards that are carried about, or no two photographs that show six references.
    """
    network = connect(survey)
    if len(network.bodies) > 1:
        raise MienError(
            f"Appendix C knows references that lie still only, got some on {network.bodies[1][0]!r}"
            " — solve with the method 'metric'"
        )
    if not network.known.any():
        raise MienError("Appendix C: there are no references — tell corners of the cube in references.csv")
    centre = network.told[network.known].mean(axis=0)
    views, remarks = _views(network, centre)
    if len(views) < 2 and not network.known[network.point_of].all():
        raise MienError(
            f"Appendix C: two photographs with six references each are wanted, got {len(views)}"
            " — click more corners of the cube; the method 'metric' can place photographs with fewer"
        )
    points, redundancy = _points(network, views, centre)
    residuals = _residuals(network, views, points, centre)
    redundancy += sum(view.redundancy for view in views.values())
    chi2 = sum(each.statistic for each in residuals)
    for photo, photograph in enumerate(survey.photographs):
        if photo not in views:
            remarks.append(f"photograph {photograph.name!r} was left out: it shows fewer than six references")
    return Solution(
        survey=survey,
        cameras=_cameras(network, views, centre),
        points=points,
        residuals=residuals,
        chi2_per_dof=chi2 / redundancy if redundancy else 1.0,
        remarks=tuple(remarks),
        method="appendix-c",
    )


def _views(network: Network, centre: Points) -> tuple[dict[int, _View], list[str]]:
    """Of photographs that show six references, by number."""
    views: dict[int, _View] = {}
    remarks = []
    for photo in range(len(network.survey.photographs)):
        which = (network.photo_of == photo) & network.known[network.point_of]
        if which.sum() < FEWEST:
            continue
        places, pictures = network.told[network.point_of[which]] - centre, network.pictures[which]
        try:
            matrix = transformation(places, pictures)
        except MienError as error:
            raise MienError(f"photograph {network.photo_name(photo)!r}: {error}") from None
        system, _ = transformation_system(places, pictures)
        depth = np.column_stack([places, np.ones(len(places))]) @ matrix[:, 2]
        normal = np.linalg.inv(system.T @ system)
        spread = np.tile(depth * network.sigmas[which], 2)
        gain = normal @ system.T * spread
        views[photo] = _View(matrix, gain @ gain.T, 2 * len(places) - 11)
        if len(places) < 10:
            remarks.append(
                f"photograph {network.photo_name(photo)!r}: {len(places)} references for 11 unknowns"
                " leave little to judge by; twenty are good, or the method 'metric'"
            )
    return views, remarks


def _points(
    network: Network, views: dict[int, _View], centre: Points
) -> tuple[dict[tuple[str, str], SolvedPoint], int]:
    """Measured points and references by (moment, name), and the redundancy of the measured ones."""
    points: dict[tuple[str, str], SolvedPoint] = {}
    redundancy = 0
    shown: dict[tuple[str, str], list[int]] = {}
    for number, seen in enumerate(network.survey.observations):
        if int(network.photo_of[number]) in views:
            moment = network.survey.photographs[network.photo_of[number]].moment
            shown.setdefault((moment, seen.point), []).append(number)
    for key, numbers in sorted(shown.items()):
        photos = tuple(network.photo_name(int(network.photo_of[number])) for number in numbers)
        point = network.point_of[numbers[0]]
        if network.known[point]:
            covariance = np.eye(3) * network.loose[point] ** 2
            points[key] = SolvedPoint(key[1], key[0], network.told[point].copy(), covariance, photos, "reference")
        elif len(numbers) >= 2:
            own = [views[int(network.photo_of[number])] for number in numbers]
            place, covariance = _place(own, network.pictures[numbers], network.sigmas[numbers], key[1])
            points[key] = SolvedPoint(key[1], key[0], place + centre, covariance, photos)
            redundancy += 2 * len(numbers) - 3
    return points, redundancy


def _place(views: list[_View], pictures: Points, sigmas: Points, name: str) -> tuple[Points, Points]:
    """(3,) m and (3, 3) m² of a point, from the origin amid the references."""
    matrices = np.array([view.matrix for view in views])
    try:
        place = locate(matrices, pictures)
    except MienError as error:
        raise MienError(f"point {name!r}: {error}") from None
    planes, _ = location_system(matrices, pictures)
    gain = np.linalg.inv(planes.T @ planes) @ planes.T
    near = np.append(place, 1.0)
    covariance = np.zeros((3, 3))
    for number, (view, (u, v), sigma) in enumerate(zip(views, pictures, sigmas, strict=True)):
        slopes = np.zeros((2, 12))
        slopes[0, :4], slopes[0, 8:] = near, -u * near
        slopes[1, 4:8], slopes[1, 8:] = near, -v * near
        depth = near @ view.matrix[:, 2]
        errors = slopes[:, :11] @ view.covariance @ slopes[:, :11].T + (depth * sigma) ** 2 * np.eye(2)
        own = gain[:, 2 * number : 2 * number + 2]
        covariance += own @ errors @ own.T
    return place, covariance


def _residuals(
    network: Network, views: dict[int, _View], points: dict[tuple[str, str], SolvedPoint], centre: Points
) -> tuple[Residual, ...]:
    residuals = []
    for number, seen in enumerate(network.survey.observations):
        photo = int(network.photo_of[number])
        point = points.get((network.survey.photographs[photo].moment, seen.point))
        if photo in views and point is not None:
            u, v = picture(views[photo].matrix, (point.place - centre)[None])[0]
            du, dv = float(seen.u - u), float(seen.v - v)
            residuals.append(Residual(seen, du, dv, (du * du + dv * dv) / seen.sigma_px**2))
    return tuple(residuals)


def _cameras(network: Network, views: dict[int, _View], centre: Points) -> dict[str, Camera]:
    """The metric cameras nearest to the matrices, of those that there is one to."""
    cameras = {}
    for photo, view in views.items():
        matrix = view.matrix.T.copy()
        matrix[:, 3] -= matrix[:, :3] @ centre
        which = (network.photo_of == photo) & network.known[network.point_of]
        camera = metric_camera(matrix, network.told[network.point_of[which]])
        if camera is None:
            raise MienError(
                f"photograph {network.photo_name(photo)!r}: its matrix is that of a mirror"
                " — an axis of the references is measured the other way, or names are exchanged"
            )
        cameras[network.photo_name(photo)] = camera
    return cameras
