"""Random poses of a head within Parke's ranges, and what must hold of every one of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mien.core import ParameterTable, Pose
from mien.faces.head import Head
from sightings import eye_pixels, mouth_pixels
from soundness import (
    RIGID,
    Posed,
    flipped_polygons,
    lids_into_balls_mm,
    skin_into_balls_mm,
    through_skin_mm,
    tongue_in_teeth_mm,
)

PARKE = ("Parke 1974, fig", "Parke 1974, section 3.5")
NO_SHAPE = ("color", "target", "light", "viewer")
A_THIRD_OF_A_PIXEL_MM = 0.1
"""Of the default picture: what cuts an eyeball no deeper is not seen."""

GAZE = ("eye.turn", "eye.nod")
LEFT_ALONE = ("mouth.upper_lip", "mouth.tuck", "jaw.rotation")
"""What opens the lips of a mouth at rest: a raised upper lip, a tucked lower one, the jaw."""


def parke_names(table: ParameterTable) -> list[str]:
    """Parke's parameters of expression and conformation, and where the eyes turn."""
    return [
        row.name
        for row in table
        if row.group not in NO_SHAPE and (row.source.startswith(PARKE) or row.name.startswith(GAZE))
    ]


def parke_pose(head: Head, seed: int) -> Posed:
    """All of Parke's parameters at random, in odd draws many at an end; the eyes look anywhere ahead."""
    generator, table = np.random.default_rng(seed), head.parameters
    names = parke_names(table)
    share = generator.uniform(-0.3, 1.3, len(names)) if seed % 2 else generator.uniform(0.0, 1.0, len(names))
    return _at(head, names, np.clip(share, 0.0, 1.0), generator)


def corner_pose(head: Head, seed: int) -> Posed:
    """Every parameter at one of its ends, but the moves of the whole head on its neck."""
    return _corner(head, [row.name for row in head.parameters if row.group not in NO_SHAPE], seed)


def parke_corner(head: Head, seed: int) -> Posed:
    """All of Parke's parameters each at one of its ends, but the moves of the whole head on its neck."""
    return _corner(head, parke_names(head.parameters), seed)


def _corner(head: Head, names: list[str], seed: int) -> Posed:
    generator = np.random.default_rng(seed)
    moved = [name for name in names if name not in RIGID]
    return _at(head, moved, generator.integers(0, 2, len(moved)).astype(float), generator)


def _at(head: Head, names: list[str], share: np.ndarray, generator: np.random.Generator) -> Posed:
    low, high = (np.array([getattr(head.parameters[name], end) for name in names]) for end in ("low", "high"))
    values = dict(zip(names, (low + share * (high - low)).tolist(), strict=True))
    place = generator.uniform((-1.0, -1.0, 0.2), (1.0, 1.0, 2.0))
    values |= {f"target.{axis}": float(value) for axis, value in zip("xyz", place, strict=True)}
    return Posed(head, Pose.neutral(head.parameters).replace(values))


def changed(posed: Posed, **values: float) -> Posed:
    """The head with some values more; dots of names as two underlines."""
    return replace(posed, pose=posed.pose.replace({name.replace("__", "."): v for name, v in values.items()}))


def shut(posed: Posed) -> Posed:
    """With its eyes shut."""
    return changed(posed, eyelid__opening=0.0)


def resting(posed: Posed) -> Posed:
    """With the jaw up, and nothing that raises or tucks a lip."""
    return changed(posed, **{name.replace(".", "__"): 0.0 for name in LEFT_ALONE})


@dataclass(frozen=True)
class Measure:
    """What must hold.

    Attributes:
        name: what is measured, with its unit.
        most: the most that is wanted.
        of: how much there is in a pose.
        dear: whether it needs pictures.
    """

    name: str
    most: float
    of: Callable[[Posed], float]
    dear: bool = False


def not_finite(posed: Posed) -> float:
    """Numbers of the mesh that are not finite."""
    mesh = posed.mesh
    return float(sum((~np.isfinite(array)).sum() for array in (mesh.points, mesh.colors)))


def eyes_shown(posed: Posed) -> float:
    """Pixels of the eyes that show between shut lids."""
    return float(max(eye_pixels(shut(posed), side) for side in ("left", "right")))


def mouth_shown(posed: Posed) -> float:
    """Pixels of the inside of the mouth that show between closed lips."""
    return float(sum(mouth_pixels(changed(posed, mouth__closure=1.0))))


def teeth_through_mm(posed: Posed) -> float:
    """How far teeth and gums come through the skin; but for a lower lip that is tucked, which lies behind them."""
    return through_skin_mm(changed(posed, mouth__tuck=0.0), "teeth", "gums")


def teeth_shown(posed: Posed) -> float:
    """Pixels of teeth and gums that show before closed lips or between them."""
    return float(mouth_pixels(changed(posed, mouth__closure=1.0))[0])


def resting_mouth_shown(posed: Posed) -> float:
    """Pixels of the inside of a mouth at rest."""
    return float(sum(mouth_pixels(resting(posed))))


MEASURES = (
    Measure("numbers that are not finite", 0.0, not_finite),
    Measure("teeth through the skin, mm", 0.5, teeth_through_mm),
    Measure("tongue through the skin, mm", 0.5, lambda p: through_skin_mm(p, "tongue")),
    Measure("tongue in the teeth, mm", 0.5, tongue_in_teeth_mm),
    Measure("eyeballs through the skin, mm", 0.5, skin_into_balls_mm),
    Measure("lids into the eyeballs, mm", A_THIRD_OF_A_PIXEL_MM, lids_into_balls_mm),
    Measure(
        "lids wide open into the eyeballs, mm",
        A_THIRD_OF_A_PIXEL_MM,
        lambda p: lids_into_balls_mm(changed(p, eyelid__opening=1.0)),
    ),
    Measure("flipped polygons", 0.0, lambda p: float(len(flipped_polygons(p)))),
    Measure("eye between shut lids, pixels", 0.0, eyes_shown, dear=True),
    Measure("mouth between closed lips, pixels", 0.0, mouth_shown, dear=True),
    Measure("teeth before closed lips, pixels", 0.0, teeth_shown, dear=True),
    Measure("mouth at rest, pixels", 0.0, resting_mouth_shown, dear=True),
)
