"""A face of one triangle, and a renderer that paints values, so that these tests need neither heads nor Numba."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from mien.core import Cue, Material, Mesh, Parameter, ParameterTable, Pose, Preset, Scene, Sound, build_topology, color
from mien.timeline import Layer, Timeline, Track

TABLE = ParameterTable(
    (
        Parameter("jaw.rotation", 0, 20, unit="deg", doc="Opens the mouth.", source="test"),
        Parameter("eyelid.opening.left", 0, 1, 0.7),
        Parameter("eyelid.opening.right", 0, 1, 0.7),
        *color("skin.color", (0.5, 0.4, 0.3)),
    )
)


@dataclass(frozen=True, eq=False)
class SmallFace:
    name: str = "small"
    family: str = "small"
    parameters: ParameterTable = TABLE
    presets: Mapping[str, Preset] = field(
        default_factory=lambda: {
            "agape": Preset("agape", "expression", {"jaw.rotation": 15}, "Mouth open."),
            "rosy": Preset("rosy", "palette", {"skin.color.red": 0.9}, "Rosy."),
        }
    )

    @property
    def unsubdivided(self) -> SmallFace:
        return self

    def shape(self, pose: Pose) -> Mesh:
        points = np.array([[0.0, -0.001 * pose["jaw.rotation"], 0.0], [0.05, 0, 0], [0, 0.05, 0]])
        topology = build_topology(3, [("skin", np.array([[0, 1, 2]]), Material())])
        return Mesh(topology, points, np.full((3, 3), 0.5))


class SmallRenderer:
    """Paints the first three values, as shares of their ranges, all over the picture."""

    def __init__(self, scene: Scene, threads: int = 1) -> None:
        self.scene = scene

    def __enter__(self) -> SmallRenderer:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def draw(self, face: SmallFace, pose: Pose) -> np.ndarray:
        width, height = self.scene.size_px
        pixels = np.full((height, width, 4), 255, dtype=np.uint8)
        pixels[:, :, :3] = np.rint(255 * (pose.values / face.parameters.highs)[:3])
        return pixels


@dataclass(frozen=True, eq=False)
class SmallPerformance:
    timeline: Timeline
    face: SmallFace = field(default_factory=SmallFace)
    sound: Sound | None = None
    scene: Scene = field(default_factory=lambda: Scene(size_px=(32, 16)))


def opening_jaw(
    length_s: float = 1.0,
    sound: bool = True,
    *,
    words: Sequence[str] = (),
    still: bool = False,
    size_px: tuple[int, int] = (32, 16),
) -> SmallPerformance:
    """The jaw opens from 0 to 20 degrees, or stays open; words are said at the beginning, a tenth of a second each."""
    track = Track.from_keys([0.0, length_s], [20.0 if still else 0.0, 20.0])
    timeline = Timeline(
        (Layer("speech", "replace", {"jaw.rotation": track}),),
        length_s,
        words=tuple(Cue(0.1 * number, 0.1 * number + 0.1, word) for number, word in enumerate(words)),
        title="Ah",
        seed=3,
    )
    noise = np.random.default_rng(1).integers(-9000, 9000, round(length_s * 24000), dtype=np.int16)
    return SmallPerformance(timeline, sound=Sound(noise, 24000) if sound else None, scene=Scene(size_px=size_px))
