"""The parametric head of a person from measured points of one neutral face.

The likeliest head through the points (``fitting_field``) is told by values of the shape parameters and a residual
(``fitting_shape``); points that contradict all others take no part.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from mien.core import MienError, UnknownNameError

from .fitting_checks import check_points, check_size, expression_remarks, find_swap
from .fitting_field import Estimate, Evidence, Placing, estimate
from .fitting_places import find_place, weights_of
from .fitting_shape import Wanted, find_residual, find_values

if TYPE_CHECKING:
    from mien.core.mesh import Points
    from mien.faces.head.head import Head
    from mien.faces.head.measured import Floats
    from mien.faces.head.residual import Residual

SIGMA_M = 0.001
"""Standard deviation of points of which none is told."""

SUSPICIOUS = 30.0
"""χ² of 3 degrees of freedom from which on a point contradicts all others: by chance one in 700 000 does."""

LEFT_OUT_AT_MOST = 0.1
"""Share of the points: where more contradict each other it is the whole that is wrong."""

PRECISE_M = 0.003
"""Points are precise enough for a residual up to this standard deviation, half of them."""

FACE_ENDING, RESIDUAL_ENDING = ".face.json", ".residual.npz"


@dataclass(frozen=True, eq=False)
class FittedHead:
    """A person's head.

    Attributes:
        values: of the shape parameters that are not at rest.
        residual: points of the person's own; None where parameters alone were asked for.
        placing: where the head is in the frame of the points.
        misses: name -> (3,) m, measured less fitted, in the head's frame; of the points left out too.
        suspects: names of points left out, the worst first.
        remarks: what was assumed and what to do better, a sentence each.
        chi2_per_dof: 1 where sigmas are right and the person is like other people.
    """

    values: Mapping[str, float]
    residual: Residual | None
    placing: Placing
    misses: Mapping[str, Points]
    suspects: tuple[str, ...]
    remarks: tuple[str, ...]
    chi2_per_dof: float

    @property
    def rms_m(self) -> float:
        """Root mean square distance of the points that took part from the fitted skin."""
        kept = [miss for name, miss in self.misses.items() if name not in self.suspects]
        return float(np.sqrt(np.mean([miss @ miss for miss in kept])))

    def head(self, hair: str = "bald") -> Head:
        """The head that can be posed and drawn."""
        from mien.faces.head.people import make_head

        return make_head("fitted", _choices({"hair": hair}), self.values, self.residual)


def fit_head(
    points: Mapping[str, Points],
    covariances: Mapping[str, Floats] | float = SIGMA_M,
    *,
    residual: bool | Literal["auto"] = "auto",
    scaled: bool = False,
    leave_out: bool = True,
) -> FittedHead:
    """The likeliest head through points of a neutral face.

    Args:
        points: name -> (3,) m in any right-handed frame; names are landmarks (``pronasale``, ``cheilion_L``), the 68
            points of 300-W (``ibug_0``) and vertices of the head's cage (``m0_5``, ``m0_5.right``).
        covariances: of each (3, 3) m², or one standard deviation for all.
        residual: whether the head gets points of its own beyond its parameters; ``auto``: if the points are precise.
        scaled: whether the unit of the points may be anything: the head then is as large as most are.
        leave_out: whether points that contradict all others take no part.

    Raises:
        UnknownNameError: no such point of a head.
        MienError: too few points, on a line, in another unit, mirrored, or two of them exchanged.
    """
    places = {name: find_place(name) for name in points}
    check_points(points)
    names = list(points)
    blocks = _covariances(names, covariances)
    apart = np.array([places[name].apart_m for name in names])
    evidence = Evidence(
        np.array([np.asarray(points[name], dtype=np.float64) for name in names]),
        blocks + apart[:, None, None] ** 2 * np.eye(3),
        weights_of(places.values(), row_count()),
    )
    remarks = list(check_size(evidence, scaled=scaled))
    found, kept = _without_suspects(evidence, names, scaled=scaled, leave_out=leave_out)
    suspects = tuple(names[k] for k in np.flatnonzero(~kept)[np.argsort(-_statistics_of(found, evidence, kept))])
    remarks += [_left_out(suspects)] if suspects else []
    remarks += expression_remarks(found, evidence.only(kept))
    precise = float(np.median(np.sqrt(np.trace(blocks, axis1=1, axis2=2) / 3.0))) <= PRECISE_M
    detailed = precise if residual == "auto" else residual
    wanted = Wanted.of(found.moves, found.growth)
    values = find_values(wanted, lids=not detailed)
    freedom = 3 * int(kept.sum()) - 6 - int(scaled)
    return FittedHead(
        values,
        find_residual(wanted, values) if detailed else None,
        found.placing,
        dict(zip(names, _misses(found, evidence), strict=True)),
        suspects,
        tuple(remarks),
        found.chi2 / freedom,
    )


def write_head(fitted: FittedHead, path: Path, *, choices: Mapping[str, str] | None = None) -> tuple[Path, Path | None]:
    """The face file and the residual beside it, as written: the same bytes for the same head.

    Args:
        fitted: the head.
        path: ``*.face.json``; the residual is called alike, ``*.residual.npz``.
        choices: name, doc, hair, beard, glasses, palette of the face file.

    Raises:
        MienError: the name has another ending, a choice is not there, or the files cannot be written.
    """
    from mien.faces.head.people import FORMAT, KEYS, VERSION, make_head
    from mien.formats.atomic import check_file, writing

    if not path.name.endswith(FACE_ENDING):
        raise MienError(f"{path}: a face is written to a file *{FACE_ENDING} — try {path.stem}{FACE_ENDING}")
    record: dict[str, object] = {"format": FORMAT, "version": VERSION, **(choices or {})}
    for key in record:
        if key not in KEYS:
            raise UnknownNameError("key", key, sorted(KEYS))
    make_head(str(path), _choices(choices or {}), fitted.values, fitted.residual)
    beside = path.with_name(path.name.removesuffix(FACE_ENDING) + RESIDUAL_ENDING)
    record["values"] = dict(sorted(fitted.values.items()))
    check_file(path)
    if fitted.residual is not None:
        record["residual"] = beside.name
        with writing(beside) as temporary, temporary.open("wb") as file:
            np.savez(file, allow_pickle=False, **_arrays(fitted.residual))
    with writing(path) as temporary:
        temporary.write_text(json.dumps(record, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    return path, beside if fitted.residual is not None else None


def _arrays(residual: Residual) -> dict[str, Floats]:
    arrays = {name: getattr(residual, name) for name in ("cage", "surface", "eye_shift", "eye_scale")}
    return {name: np.asarray(array, dtype=np.float32) for name, array in arrays.items()}


def _choices(choices: Mapping[str, str]) -> dict[str, str]:
    from mien.faces.head.people import DEFAULTS

    return {**DEFAULTS, **choices}


def row_count() -> int:
    """Rows of what a head is estimated by: the vertices of its cage and two eyes."""
    from .fitting_people import population

    return len(population().rows.points)


def _covariances(names: list[str], covariances: Mapping[str, Floats] | float) -> Floats:
    """(N, 3, 3) m²."""
    if not isinstance(covariances, Mapping):
        return np.broadcast_to(covariances**2 * np.eye(3), (len(names), 3, 3))
    missing = [name for name in names if name not in covariances]
    if missing:
        raise MienError(f"point {missing[0]!r}: no covariance — give one for each point, or one sigma for all")
    out = np.array([np.asarray(covariances[name], dtype=np.float64) for name in names])
    for name, block in zip(names, out, strict=True):
        if block.shape != (3, 3) or not np.isfinite(block).all() or np.linalg.eigvalsh(block).min() < -1e-15:
            raise MienError(f"point {name!r}: covariance must be a (3, 3) matrix of finite numbers, not negative")
    return out


def _without_suspects(
    evidence: Evidence, names: list[str], *, scaled: bool, leave_out: bool
) -> tuple[Estimate, np.ndarray[tuple[int], np.dtype[np.bool_]]]:
    """The head through the points that agree, and which (N,) they are.

    Raises:
        MienError: two points are exchanged.
    """
    kept = np.ones(len(names), dtype=bool)
    found = estimate(evidence, scaled=scaled)
    for _ in range(int(LEFT_OUT_AT_MOST * len(names)) if leave_out else 0):
        if found.statistics.max() < SUSPICIOUS:
            break
        find_swap(found, [name for name, keep in zip(names, kept, strict=True) if keep])
        kept[np.flatnonzero(kept)[int(found.statistics.argmax())]] = False
        found = estimate(evidence.only(kept), scaled=scaled)
    return found, kept


def _misses(found: Estimate, evidence: Evidence) -> Points:
    """(N, 3) m, measured less fitted, in the head's frame."""
    from .fitting_people import population

    points = population().rows.points + found.moves
    return found.placing.to_head(evidence.places) - evidence.weights @ points


def _statistics_of(found: Estimate, evidence: Evidence, kept: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> Floats:
    """(M,) how far the points that are left out are from the fitted head, m."""
    return np.asarray(np.linalg.norm(_misses(found, evidence)[~kept], axis=1))


def _left_out(suspects: tuple[str, ...]) -> str:
    return (
        f"{len(suspects)} of the points contradict all others and took no part: {', '.join(suspects[:8])}"
        f"{' …' if len(suspects) > 8 else ''}; look at their places and names again"
    )
