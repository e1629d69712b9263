"""What a person's head has beyond the parameters: points of its own for the whole cage.

Hair, collar, teeth, gums and tongue are carried by the skin near them; the eyes by what is around them.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass, replace
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from mien.core import LoadError, Material, build_topology
from mien.core.mesh import Points
from mien.core.sparse import SparseMatrix
from mien.core.subdivision import refine

from .lids_fit import FLIP, fit_lids
from .measured import Archive, Measured


@dataclass(frozen=True, eq=False)
class Residual:
    """Moves (V, 3) m of the two position sets, and the eyes of the person.

    Attributes:
        cage, surface: (V, 3) m.
        eye_shift: (3,) m, of the left eye, which the right one mirrors; or (2, 3) of both.
        eye_scale: radius of the ball over the neutral one.
    """

    cage: Points
    surface: Points
    eye_shift: Points
    eye_scale: float = 1.0


def read_residual(path: Path, vertex_count: int) -> Residual:
    """The residual of an ``.npz``: ``cage`` and ``surface`` (V, 3) m, ``eye_shift`` (3,) or (2, 3) m, ``eye_scale``.

    Raises:
        LoadError: an array is missing, has another shape or is not finite.
    """
    try:
        with path.open("rb") as file, np.load(file) as loaded:
            arrays = {name: loaded[name].astype(np.float64) for name in loaded.files}
    except OSError as error:
        raise LoadError(path, f"cannot be read: {error.strerror or error}") from None
    except (ValueError, TypeError, AttributeError, EOFError, BadZipFile, zlib.error) as error:
        raise LoadError(path, f"not a file of arrays (.npz): {error}", hint="write it with numpy.savez") from None
    wanted = {"cage": (vertex_count, 3), "surface": (vertex_count, 3), "eye_shift": (3,), "eye_scale": ()}
    if "eye_shift" in arrays and arrays["eye_shift"].ndim == 2:
        wanted["eye_shift"] = (2, 3)
    for name, shape in wanted.items():
        if name not in arrays:
            raise LoadError(path, f"array {name!r} is missing", hint=f"want {', '.join(wanted)}")
        if arrays[name].shape != shape or not np.isfinite(arrays[name]).all():
            raise LoadError(path, f"array {name!r}: want finite numbers of shape {shape}, got {arrays[name].shape}")
    return Residual(arrays["cage"], arrays["surface"], arrays["eye_shift"], float(arrays["eye_scale"]))


def refine_cage(archive: Archive) -> SparseMatrix:
    """One subdivision step of the skin alone."""
    topology = build_topology(len(archive.mirror), [("skin", archive.quads, Material(subdivide=True))])
    return refine(topology).matrix


def apply_residual(measured: Measured, residual: Residual, archive: Archive) -> Measured:
    """The measured head with the person's points and lids that fit them."""
    move = residual.cage if measured.kind == "cage" else residual.surface
    points = measured.points + move
    centres, radius = eyes_of(residual, archive)
    matrix = refine_cage(archive) if measured.kind == "cage" else None
    lids = fit_lids(points, measured.lids, centres, radius, matrix, archive.mirror)
    return replace(measured, points=points, lids=lids)


def eyes_of(residual: Residual | None, archive: Archive) -> tuple[Points, float]:
    """(2, 3) m centres and radius m of the eyes."""
    centres, radius = archive.floats("eye_centre"), float(archive.floats("eye_radius"))
    if residual is None:
        return centres, radius
    shift = residual.eye_shift
    both = shift if shift.ndim == 2 else np.stack([shift, shift * FLIP])
    return centres + both, radius * residual.eye_scale
