"""Where Parke sees creases: under the eyes, beside the nose, at the edge of the lips, at the corner of the mouth.

Classic pictures double the vertices there. The subdivided skin models its creases as rings instead, which keeps
them soft.

Source: Parke 1972, "Representation of the face", item 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from mien.core.creases import double_creases
from mien.core.mesh import Ints

from .measured import Archive

LINES: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("under the eye", tuple(f"e1_{station}" for station in (6, 7, 8, 9, 10, 11, 0))),
    ("side of the nose", ("p1", "p2", "p3", "p4", "p5", "p6")),
    ("edge of the lips", tuple(f"m1_{station}" for station in range(10))),
    ("corner of the mouth", ("m1_5", "mb_5", "m2_5")),
)
"""Names of vertices of the left half along each crease; the right half mirrors them."""


def crease_edges(archive: Archive) -> list[tuple[int, int]]:
    """Pairs of vertices along all creases of both halves."""
    edges = []
    for _, names in LINES:
        left = [archive.vertex[name] for name in names]
        for line in (left, [int(archive.mirror[vertex]) for vertex in left]):
            edges += list(pairwise(line))
    return edges


@dataclass(frozen=True, eq=False)
class CreasedSkin:
    """The skin's polygons with doubled vertices.

    Attributes:
        quads: (F, 4).
        source: (V',) the measured vertex of each vertex.
        mirror: (V',) the vertex that each becomes in the mirror.
        beside_lips: (K,) vertices at the edge of the lips that belong to the skin around them.
    """

    quads: Ints
    source: Ints
    mirror: Ints
    beside_lips: Ints


@lru_cache(maxsize=2)
def creased_skin(archive: Archive) -> CreasedSkin:
    """The skin cut open along the creases."""
    count = len(archive.mirror)
    rows, doubled = double_creases(archive.quads.tolist(), crease_edges(archive), count)
    quads = np.array(rows, dtype=np.int64)
    source = np.concatenate([np.arange(count), doubled])
    by_corners = {frozenset(row): number for number, row in enumerate(archive.quads.tolist())}
    mirror = np.zeros(len(source), dtype=np.int64)
    for row in quads.tolist():
        twins = [int(archive.mirror[source[vertex]]) for vertex in row]
        other = quads[by_corners[frozenset(twins)]]
        for vertex, twin in zip(row, twins, strict=True):
            mirror[vertex] = other[source[other] == twin][0]
    red = np.isin(np.arange(len(source)), quads[archive.groups == archive.group_names.index("lips")])
    edge = np.isin(source, [archive.vertex[name] for name in LINES[2][1]])
    edge |= np.isin(archive.mirror[source], [archive.vertex[name] for name in LINES[2][1]])
    return CreasedSkin(quads, source, mirror, np.flatnonzero(edge & ~red))
