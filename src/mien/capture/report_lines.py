"""Lines between points that help the eye: of the topology where there is one, else between neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from mien.core.mesh import Points

from .marks import MARKS, plain_marks, read_marks
from .project_records import TOPOLOGY, Project

Edges = list[tuple[int, int]]

MOST = 300
"""Points up to which neighbours are looked for; more are a surface by themselves."""


def polygons_of(project: Project) -> list[tuple[str, ...]]:
    """Polygons of a project's topology, by names of their points; none where it has no topology.

    Raises:
        LoadError: what is wrong with the topology, or with the file of its names.
    """
    from mien.faces.keypose.topology_file import read_topology

    if not (project.folder / TOPOLOGY).is_file():
        return []
    topology = read_topology(project.folder / TOPOLOGY)
    file = project.folder / MARKS
    marks = (
        read_marks(file, topology.point_count, project.unit) if file.is_file() else plain_marks(topology.point_count)
    )
    return [tuple(marks.names[number - 1] for number in polygon.points) for polygon in topology.polygons]


def edges_of(names: Sequence[str], places: Points, polygons: Sequence[Sequence[str]]) -> Edges:
    """Pairs of points to join, by their numbers.

    Args:
        names: of the points.
        places: (N, 3).
        polygons: of names; corners without a place are passed over.
    """
    if not polygons:
        return neighbours(places) if len(places) <= MOST else []
    number = {name: k for k, name in enumerate(names)}
    pairs = {
        tuple(sorted((number[a], number[b])))
        for polygon in polygons
        for a, b in pairwise((*polygon, polygon[0]))
        if a in number and b in number and a != b
    }
    return [(a, b) for a, b in sorted(pairs)]


def neighbours(places: Points) -> Edges:
    """Pairs of places with no third one in the ball between them.

    Source: Gabriel and Sokal 1969, "A new statistical approach to geographic variation analysis".
    """
    squares = ((places[:, None] - places[None]) ** 2).sum(axis=2)
    found = []
    for a in range(len(places)):
        for b in range(a + 1, len(places)):
            inside = squares[a] + squares[b] < squares[a, b] * (1.0 - 1e-9)
            if squares[a, b] > 0.0 and not inside.any():
                found.append((a, b))
    return found
