"""A face of three quads that can be a puppet: a skin that bends, an eye and a jaw that turn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import pytest

from mien.core import Joint, Material, Mesh, Parameter, ParameterTable, Pose, Preset, Rig, build_topology
from mien.vocab import Remap, parse_remap, vocabulary

TABLE = ParameterTable(
    (
        Parameter("jaw.rotation", 0, 90, unit="deg"),
        Parameter("smile", 0, 1),
        Parameter("wide", 0, 1),
        Parameter("nose.size", 0.5, 2, 1.0),
        Parameter("head.turn", -90, 90, unit="deg"),
    )
)

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
JAW_PIVOT = (0.0, 0.0, 2.0)

PLAYED = {"jawOpen": ("jaw.rotation", 60.0), "mouthSmileLeft": ("smile", 1.0), "browInnerUp": ("wide", 1.0)}
"""What names of ARKit do to this face; all others do nothing."""


def teach(monkeypatch: pytest.MonkeyPatch) -> None:
    """Makes the names of ARKit known for this family."""
    rows = (f"{name},{','.join(map(str, PLAYED.get(name, ('smile', 0.0))))},test" for name in vocabulary("arkit").names)
    remap = parse_remap("\n".join(["name,parameter,gain,source", *rows]), title="arkit.smallpuppet", place="test")

    def load_remap(name: str, family: str) -> Remap:
        assert (name, family) == ("arkit", "smallpuppet")
        return remap

    monkeypatch.setattr("mien.vocab.posing.load_remap", load_remap)
    for module in ("mien.vocab.posing", "mien.formats.glb_targets"):
        monkeypatch.setattr(f"{module}.next_step", lambda name, family: family)


def turn_about(axis: int, angle_deg: float) -> np.ndarray:
    """(3, 3) rotation."""
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    a, b = (axis + 1) % 3, (axis + 2) % 3
    out = np.eye(3)
    out[a, a], out[a, b], out[b, a], out[b, b] = c, -s, s, c
    return out


@dataclass(frozen=True, eq=False)
class SmallPuppet:
    """Vertices 0..3 are the skin, of which 3 is half neck; 4..7 the jaw; 8..11 the collar, which nothing moves."""

    name: str = "small"
    family: str = "smallpuppet"
    parameters: ParameterTable = TABLE
    presets: Mapping[str, Preset] = field(default_factory=dict)
    materials: tuple[Material, ...] = (
        Material(gloss=0.05, gloss_power=14),
        Material(two_sided=True),
        Material(lit=False),
    )

    @property
    def neutral(self) -> Pose:
        return Pose.neutral(self.parameters)

    @property
    def unsubdivided(self) -> SmallPuppet:
        return self

    def rig(self, pose: Pose) -> Rig:
        shares = np.zeros((12, 3))
        shares[:3, 1] = shares[4:8, 2] = shares[8:, 0] = 1.0
        shares[3] = 0.25, 0.75, 0.0
        return Rig(
            (
                Joint("body", None, (0.0, 0.0, 0.0), (8, 9, 10), ()),
                Joint("head", "body", (0.0, 0.0, 0.0), (0, 1, 2), ("head.turn",)),
                Joint("jaw.lower", "head", JAW_PIVOT, (4, 5, 6), ("jaw.rotation",)),
            ),
            shares,
        )

    def shape(self, pose: Pose) -> Mesh:
        points = np.concatenate([SQUARE, SQUARE + JAW_PIVOT, SQUARE - [0, 2, 0]])
        points[3, 2] += 0.1 * pose["smile"] + 0.3 * pose["wide"]
        points[3, 0] -= 0.2 * pose["wide"] ** 2
        points[4:8] = (points[4:8] - JAW_PIVOT) @ turn_about(0, pose["jaw.rotation"]).T + JAW_PIVOT
        turn = turn_about(1, pose["head.turn"])
        points[[0, 1, 2, 4, 5, 6, 7]] = points[[0, 1, 2, 4, 5, 6, 7]] @ turn.T
        points[3] = 0.75 * points[3] @ turn.T + 0.25 * points[3]
        parts = [
            (name, np.arange(4)[None] + first, material)
            for name, first, material in zip(("skin", "teeth", "collar"), (0, 4, 8), self.materials, strict=True)
        ]
        return Mesh(build_topology(12, parts), points, np.repeat([[0.5, 0.25, 0.125]], 12, axis=0))
