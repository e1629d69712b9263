"""A person of the reference folder at a moment: the scanned surface, and the state by which a half is placed on it."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from measuring.reference import CM, Reference, similarity

from mien.faces.head.measured import archive

from .halves import State

PHASES = Path(__file__).with_name("phases.csv")
BALL = 0.975
"""Radius of the ball that is photographed, over one that the lids would touch between their corners."""
KAPPA = 0.03
"""How far the eyes look outwards while the head looks at something: the optical axis is not the line of sight."""
REST = {"eyeBlink": 0.12}
"""What the scans, taken with wide open eyes, need to look at ease; part of every phase."""


def phase_rows() -> dict[str, dict[str, float]]:
    """Phase -> how much of each expression it has; a name without a side has both."""
    out = {}
    with PHASES.open(encoding="utf-8", newline="") as lines:
        for row in csv.DictReader(lines):
            words = row["expressions"].split()
            out[row["phase"]] = {name: float(share) for name, share in zip(words[::2], words[1::2], strict=True)}
    return out


@dataclass(frozen=True, eq=False)
class Scan:
    """What all people of the folder share."""

    reference: Reference

    @cached_property
    def head(self) -> dict[str, np.ndarray]:
        """Arrays of the scanned head."""
        return self.reference.read("ict_head")

    @cached_property
    def expressions(self) -> dict[str, np.ndarray]:
        """Name -> (V, 3) m; a name without a side is both sides."""
        arrays = self.reference.read("ict_expressions")
        out: dict[str, np.ndarray] = {}
        for name, delta in zip(arrays["names"].tolist(), arrays["deltas"].astype(np.float64) * CM, strict=True):
            out[name] = delta
            if name.endswith(("_L", "_R")):
                out[name[:-2]] = out.get(name[:-2], 0.0) + delta
        return out

    def vertices(self, *groups: str) -> np.ndarray:
        """Numbers of the vertices of groups."""
        names = [str(name) for name in self.head["group_names"]]
        return np.flatnonzero(np.isin(self.head["vert_group"], [names.index(group) for group in groups]))

    def polygons(self, *groups: str) -> np.ndarray:
        """(F, 4) polygons of groups, triangles with their last corner twice."""
        names = [str(name) for name in self.head["group_names"]]
        rows = self.head["faces"][np.isin(self.head["face_group"], [names.index(group) for group in groups])]
        return np.where(rows < 0, rows[:, [0, 1, 2, 2]], rows).astype(np.int64)

    def identity(self, name: str) -> np.ndarray:
        """(V, 3) m, a person less the mean one; ``more:12`` is the twelfth of that file, counted from 0."""
        file, _, number = name.partition(":")
        return self.reference.read(f"ict_identities_{file}")["deltas"][int(number)].astype(np.float64) * CM


@dataclass(frozen=True, eq=False)
class Subject:
    """A person.

    Attributes:
        scan: the folder.
        identity: (V, 3) m.
    """

    scan: Scan
    identity: np.ndarray

    def points(self, expressions: dict[str, float]) -> np.ndarray:
        """(V, 3) m of the scanned head."""
        both = {name: REST.get(name, 0.0) + expressions.get(name, 0.0) for name in {**REST, **expressions}}
        moved = sum((share * self.scan.expressions[name] for name, share in both.items()), start=0.0)
        return self.scan.reference.scans.points + self.identity + moved

    def skin(self, expressions: dict[str, float]) -> np.ndarray:
        """(S, 3) m, our skin on it; what is hidden goes along with its rim."""
        onto = self.scan.reference.scans.onto_skin
        surface = archive().floats("surface")
        return surface + onto @ (self.points(expressions) - self.scan.reference.scans.points)

    def eye(self, expressions: dict[str, float], side: str) -> tuple[np.ndarray, float, np.ndarray]:
        """Centre m, radius m and gaze of an eye, ``L`` or ``R``.

        The scanned ball is no sphere, so that of the shipped head goes where it goes, as large as it is.
        """
        ball = self.scan.vertices(f"sclera_{side}")
        mean, rest, now = self.scan.reference.scans.points[ball], self.points({})[ball], self.points(expressions)[ball]
        grown, shift = similarity(mean, rest)
        centre = grown @ archive().floats("eye_centre")["LR".index(side)] + shift
        turn, shift = similarity(rest, now)
        gaze = turn @ np.array([KAPPA if side == "L" else -KAPPA, 0.0, 1.0])
        radius = BALL * float(archive().floats("eye_radius")) * float(np.cbrt(np.linalg.det(grown)))
        return turn @ centre + shift, radius, gaze / np.linalg.norm(gaze)

    def jaw(self, expressions: dict[str, float]) -> np.ndarray:
        """(3, 4) m, how the lower teeth move."""
        names, starts = self.scan.head["tooth_names"], self.scan.head["tooth_start"]
        first = next(k for k, name in enumerate(names) if str(name).startswith("L"))
        teeth = np.arange(starts[first], starts[-1])
        turn, shift = similarity(self.points({})[teeth], self.points(expressions)[teeth])
        return np.column_stack([turn / np.cbrt(np.linalg.det(turn)), shift])

    def states(self, expressions: dict[str, float]) -> tuple[State, State]:
        """The left half as it is and the right half in the mirror."""
        skin, rest, jaw = self.skin(expressions), self.skin({}), self.jaw(expressions)
        centre, radius, gaze = self.eye(expressions, "L")
        left = State(skin, centre, radius, gaze, jaw, rest)
        other, _, other_gaze = self.eye(expressions, "R")
        return left, left.mirrored(other, other_gaze)
