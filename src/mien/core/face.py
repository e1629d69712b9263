"""What every kind of face is: a pure function from named parameters to coloured polygons."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

from .drawing import Drawing
from .mesh import Mesh
from .parameters import ParameterTable, Pose


@dataclass(frozen=True)
class Preset:
    """A named set of values: an expression, a palette, what a hand does.

    Attributes:
        keys: of a move, when, seconds, and values; what the first leaves out rests, what a later one leaves out stays.
    """

    name: str
    kind: str
    values: Mapping[str, float] = field(default_factory=dict)
    doc: str = ""
    source: str = ""
    keys: tuple[tuple[float, Mapping[str, float]], ...] = ()


@runtime_checkable
class Face(Protocol):
    """A face that can be played.

    Attributes:
        name: its address, ``head`` or ``toon:gus``.
        family: which tables of names fit it (``data/<vocabulary>.<family>.csv``).
        parameters: its table.
        neutral: the pose in which every parameter has its default.
        presets: expressions and palettes by name.
    """

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def family(self) -> str: ...  # noqa: D102
    @property
    def parameters(self) -> ParameterTable: ...  # noqa: D102
    @property
    def neutral(self) -> Pose: ...  # noqa: D102
    @property
    def presets(self) -> Mapping[str, Preset]: ...  # noqa: D102
    @property
    def unsubdivided(self) -> Face:
        """The same face with points meant for pictures without subdivision; often the face itself."""

    def shape(self, pose: Pose) -> Mesh | Drawing:
        """Polygons of a pose of this face's table."""
