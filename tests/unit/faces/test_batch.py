"""Many poses of a face that has no batch form of its own."""

from dataclasses import dataclass, field

import numpy as np

from mien.core import Drawing, Face, Parameter, ParameterTable, Path, Pose
from mien.faces import shapes

TABLE = ParameterTable((Parameter("smile", -1.0, 1.0),))
NEUTRAL = Pose.neutral(TABLE)


@dataclass(frozen=True)
class Mask:
    """Two lines: eyes that stay, and a mouth whose end goes up."""

    name: str = "mask"
    family: str = "mask"
    parameters: ParameterTable = TABLE
    neutral: Pose = NEUTRAL
    presets: dict = field(default_factory=dict)

    @property
    def unsubdivided(self):
        return self

    def shape(self, pose):
        eyes, mouth = np.array([[0.0, 2.0], [2.0, 2.0]]), np.array([[0.0, 0.0], [2.0, pose["smile"]]])
        return Drawing(
            (4.0, 4.0), tuple(Path(name, (c,), (1, 1, 1, 1)) for name, c in (("eyes", eyes), ("mouth", mouth)))
        )


def test_a_drawing_is_its_contours_one_after_the_other():
    assert isinstance(Mask(), Face)
    many = shapes(Mask(), np.array([[0.25], [-1.0]]))
    assert many.shape == (2, 4, 2)
    assert many[:, 3, 1].tolist() == [0.25, -1.0]
    assert many[:, 1].tolist() == [[2.0, 2.0]] * 2


def test_no_poses_have_no_points():
    assert shapes(Mask(), np.zeros((0, 1))).shape == (0, 4, 2)
