"""How surely points and cameras are known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.capture.refining import Equations, Refined, group_columns
from mien.core.errors import MienError
from mien.core.mesh import Points


@dataclass(frozen=True, eq=False)
class Covariances:
    """Covariances of what was refined, for observations of the standard deviations told.

    Attributes:
        cameras: (C, C) of lenses, stations and bodies.
        points: (F, 3, 3) m² of free points, with what is uncertain of cameras.
        carried: (F, 3, C) how a point follows the columns, with the sign turned.
        shared: (F, 3, C) m × columns, covariances of points with columns, with the sign turned.
        alone: (F, 3, 3) m² of free points if cameras were exact.
    """

    cameras: Points
    points: Points
    carried: Points
    shared: Points
    alone: Points


def covariances(equations: Equations) -> Covariances:
    """The inverse of the normal equations, by blocks.

    Raises:
        MienError: the observations leave something open.

    Source: Triggs and others 2000, section 6; Hartley and Zisserman 2004, section A6.
    """
    from scipy.linalg import cho_factor, cho_solve

    width = equations.layout.columns
    # A point in the plane of two rays that are all but parallel has no depth: a far one, not none.
    diagonal = np.einsum("fii->fi", equations.points)
    floor = 1e-14 * diagonal.max(axis=1, keepdims=True) * np.ones(3) if len(diagonal) else diagonal
    alone = np.linalg.inv(equations.points + np.einsum("fi,ij->fij", floor, np.eye(3)))
    carried = np.einsum("fij,fjc->fic", alone, equations.ties)
    reduced = equations.cameras - equations.ties.reshape(-1, width).T @ carried.reshape(-1, width)
    # Columns of px, radians and metres: to one size before they are factored.
    scale = 1.0 / np.sqrt(np.maximum(np.diag(equations.cameras), 1e-300))
    try:
        if (np.diag(reduced) * scale * scale < 1e-13).any():
            raise np.linalg.LinAlgError
        inverse = cho_solve(cho_factor(reduced * np.outer(scale, scale), lower=True), np.eye(width))
    except np.linalg.LinAlgError:
        raise MienError(
            "the photographs do not tell where all cameras stand: something stays open"
            " — click more references in each photograph, spread over the cube, and points that several of them share"
        ) from None
    cameras = inverse * np.outer(scale, scale)
    shared = (carried.reshape(-1, width) @ cameras).reshape(carried.shape)
    return Covariances(cameras, alone + shared @ carried.transpose(0, 2, 1), carried, shared, alone)


def seen_covariances(refined: Refined, found: Covariances) -> Points:
    """(A, 2, 2) covariances of where active observations are solved to be, in their own standard deviations.

    This is the part of each that it decides itself: 0 where all others fix the place, 1 where it alone does.
    """
    equations, layout = refined.equations, refined.equations.layout
    numbers = layout.points[refined.problem.network.point_of[layout.order]]
    result = np.empty((len(layout.order), 2, 2))
    for group in layout.groups:
        columns = group_columns(refined.problem, layout, group)
        kept = columns >= 0
        by_columns, by_point, here = equations.by_columns[group][:, :, kept], equations.by_point[group], numbers[group]
        block = by_columns @ found.cameras[np.ix_(columns[kept], columns[kept])] @ by_columns.transpose(0, 2, 1)
        inside = np.nonzero(here >= 0)[0]
        by_point, points = by_point[inside], here[inside]
        both = by_point @ found.shared[points][:, :, columns[kept]] @ by_columns[inside].transpose(0, 2, 1)
        block[inside] += by_point @ found.points[points] @ by_point.transpose(0, 2, 1)
        block[inside] -= both + both.transpose(0, 2, 1)
        result[group] = block
    return result
