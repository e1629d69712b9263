"""Lids that shut as the reference's do: where the margins meet, and what arcs about the eye miss of its blink."""

from __future__ import annotations

import numpy as np

from mien.faces.head.lids import on_sphere
from mien.faces.head.lids_fit import fit_lids
from mien.faces.head.measured import LID_RINGS, Archive
from mien.faces.head.residual import refine_cage

MARGIN, EDGE = LID_RINGS.index("margin"), LID_RINGS.index("lip")
"""Rings up to the lip are the edge of a lid."""

STATIONS, CORNERS = 12, (0, 6)
KINDS = ("cage", "surface")


def shut(arrays: dict[str, np.ndarray]) -> None:
    """Fit the shut lids of both position sets anew, in place."""
    archive = _archive(arrays)
    centres, radius = archive.floats("eye_centre"), float(archive.floats("eye_radius"))
    for kind, refine in zip(KINDS, (refine_cage(archive), None), strict=True):
        measured = archive.measured(kind)
        fitted = fit_lids(measured.points, measured.lids, centres, radius, refine)
        arrays[f"lid_{kind}_el_closed"] = fitted.elevation_shut.astype(np.float32)
        arrays[f"lid_{kind}_r_closed"] = fitted.radius_shut.astype(np.float32)


def slide(arrays: dict[str, np.ndarray], kind: str, blink: np.ndarray, side: int) -> np.ndarray:
    """(V, 3) m, what the arcs of one shut eye, 1 left or -1 right, miss of its measured blink (V, 3) m.

    The reference's lower lid does not rise but slides towards the nose, by 3 mm. On the edges only that is taken,
    alike above and below, so that they meet as they are; at the corners the edge sinks with the lip.
    """
    archive = _archive(arrays)
    lids = archive.measured(kind).lids
    flip = np.array([side, 1.0, 1.0])
    arcs = on_sphere(lids.azimuth, lids.elevation_shut, lids.radius_shut)
    arcs -= on_sphere(lids.azimuth, lids.elevation, lids.radius)
    out = blink.copy()
    station = archive.ints("lid_station")
    own = lids.side == side
    margin, lip = (
        {int(station[n]): int(lids.index[n]) for n in np.flatnonzero(own & (lids.ring == ring))}
        for ring in (MARGIN, EDGE)
    )
    for n in np.flatnonzero(own):
        vertex, here = int(lids.index[n]), int(station[n])
        if lids.ring[n] > EDGE or (lids.ring[n] == EDGE and here in CORNERS):
            out[vertex] -= arcs[n] * flip
        else:
            across = margin[(STATIONS - here) % STATIONS]
            down, back = blink[lip[here], 1:] if here in CORNERS else (0.0, 0.0)
            out[vertex] = 0.5 * (blink[margin[here], 0] + blink[across, 0]), down, back
    return out


def _archive(arrays: dict[str, np.ndarray]) -> Archive:
    return Archive({name: np.asarray(array) for name, array in arrays.items()})
