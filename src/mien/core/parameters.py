"""Parameters by name: one table of rows from which sliders, docs, help, checks and socket addresses are derived."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import MienError, RangeError, UnknownNameError

Values = NDArray[np.float64]

SIDES = (".left", ".right")

ROLES: Mapping[str, str] = MappingProxyType(
    {
        "motion": "expresses something, or speaks",
        "gaze": "aims the eyes at something",
        "contact": "brings lips, teeth or fingers together",
        "shape": "who it is",
        "color": "a colour",
        "scene": "filled in by the scene",
    }
)
"""What a row can be for."""


@dataclass(frozen=True)
class Parameter:
    """One row: a name, its range and what it means.

    Left and right are the face's own. A name that ends in ``.left`` has a twin that ends in ``.right``; the name
    without either sets both. ``odd`` marks a quantity that changes its sign in the mirror (a turn to the left).
    ``spread`` is the standard deviation among people, 0 for what moves or what they do not differ in; ``usual`` is
    their mean, None where that is the default. ``reach_mm`` tells how far the point that moves most goes at ``low``
    and at ``high``, None where that was not measured. ``role`` is one of ``ROLES``.
    ``closed`` is the value, an end of the range, at which it shuts an eye or the lips; None where it shuts nothing.
    """

    name: str
    low: float
    high: float
    default: float = 0.0
    unit: str = ""
    group: str = ""
    odd: bool = False
    doc: str = ""
    source: str = ""
    spread: float = 0.0
    usual: float | None = None
    reach_mm: tuple[float, float] | None = None
    role: str = "motion"
    closed: float | None = None

    def __post_init__(self) -> None:
        if not self.low <= self.default <= self.high:
            raise RangeError(f"{self.name}: default {self.default} is not in {self.low}..{self.high}")
        if self.role not in ROLES:
            raise UnknownNameError(f"role of {self.name!r}:", self.role, ROLES)
        if self.closed not in (None, self.low, self.high):
            raise RangeError(f"{self.name}: closed at {self.closed}, which is no end of {self.low}..{self.high}")

    @property
    def mirror(self) -> str:
        """Name of the parameter that has this value in a mirror."""
        for side, other in (SIDES, SIDES[::-1]):
            if self.name.endswith(side):
                return self.name.removesuffix(side) + other
        return self.name

    def to_json(self) -> dict[str, Any]:
        """What programs that show sliders need to know."""
        shown = ("name", "default", "low", "high", "unit", "group", "mirror", "doc", "source", "reach_mm")
        return {name: getattr(self, name) for name in shown}

    def check(self, value: float) -> float:
        """The value as a float.

        Raises:
            RangeError: it is not finite or not in ``low..high``.
        """
        number: object = value
        if isinstance(number, str | bytes):  # float() would take it
            raise RangeError(f"{self.name}: {number!r} is a text, not a number — {self._range()}")
        value = float(value)
        if not math.isfinite(value):
            raise RangeError(f"{self.name}: {value} is not a finite number — {self._range()}")
        if not self.low <= value <= self.high:
            raise RangeError(f"{self.name}: {value:g} is out of range — {self._range()}")
        return value

    def _range(self) -> str:
        return f"it goes from {self.low:g} to {self.high:g}" + (f" {self.unit}" if self.unit else "")


def both_sides(row: Parameter) -> tuple[Parameter, Parameter]:
    """The rows ``name.left`` and ``name.right`` of a row; ``{side}`` in its doc becomes the side."""
    left, right = (replace(row, name=row.name + side, doc=row.doc.replace("{side}", side[1:])) for side in SIDES)
    return left, right


def color(name: str, rgb: tuple[float, float, float], **more: str) -> tuple[Parameter, Parameter, Parameter]:
    """The three rows of a colour, linear RGB 0..1."""
    doc = more.pop("doc", "")
    red, green, blue = (
        Parameter(f"{name}.{channel}", 0.0, 1.0, value, doc=f"{doc} ({channel}, linear light)", role="color", **more)  # type: ignore[arg-type]
        for channel, value in zip(("red", "green", "blue"), rgb, strict=True)
    )
    return red, green, blue


@dataclass(frozen=True, eq=False)
class ParameterTable:
    """An ordered, immutable table of parameters.

    ``aliases`` are other names of rows (ToonFace's motor codes), or of a left and a right one. ``symmetric`` names
    (``eyelid.opening``) stand for a left and a right row and are derived.
    """

    rows: tuple[Parameter, ...]
    aliases: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if len(self.index) != len(self.rows):
            seen: set[str] = set()
            twice = next(row.name for row in self.rows if row.name in seen or seen.add(row.name))  # type: ignore[func-returns-value]
            raise MienError(f"parameter {twice!r} is in the table twice")
        for row in self.rows:
            if row.mirror not in self.index:
                raise MienError(f"parameter {row.name!r} has no twin {row.mirror!r}")
        for alias, name in self.aliases.items():
            if name not in self.index and name not in self.symmetric:
                raise UnknownNameError(f"parameter behind alias {alias!r}", name, self.names)

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Row number of each name."""
        return {row.name: number for number, row in enumerate(self.rows)}

    @cached_property
    def names(self) -> tuple[str, ...]:
        """All names, in order."""
        return tuple(row.name for row in self.rows)

    @cached_property
    def symmetric(self) -> Mapping[str, tuple[str, str]]:
        """Name without a side -> (left name, right name)."""
        stems = [name.removesuffix(".left") for name in self.names if name.endswith(".left")]
        return {stem: (stem + ".left", stem + ".right") for stem in stems}

    @cached_property
    def defaults(self) -> Values:
        """(P,) default values, read-only."""
        return _frozen([row.default for row in self.rows])

    @cached_property
    def lows(self) -> Values:
        """(P,) least values, read-only."""
        return _frozen([row.low for row in self.rows])

    @cached_property
    def highs(self) -> Values:
        """(P,) greatest values, read-only."""
        return _frozen([row.high for row in self.rows])

    @cached_property
    def mirror_index(self) -> NDArray[np.int64]:
        """(P,) row number of each parameter's twin."""
        return np.array([self.index[row.mirror] for row in self.rows], dtype=np.int64)

    @cached_property
    def mirror_sign(self) -> Values:
        """(P,) -1 where the mirror changes the sign, else 1."""
        return _frozen([-1.0 if row.odd else 1.0 for row in self.rows])

    @cached_property
    def fingerprint(self) -> str:
        """Twelve hex digits that change when a name, range, unit or default does; saved files carry it."""
        text = "\n".join(f"{r.name} {r.low!r} {r.high!r} {r.default!r} {r.unit} {r.odd}" for r in self.rows)
        return hashlib.sha256(text.encode()).hexdigest()[:12]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Parameter]:
        return iter(self.rows)

    def __contains__(self, name: str) -> bool:
        return name in self.index or name in self.symmetric or name in self.aliases

    def __getitem__(self, name: str) -> Parameter:
        """The row of a name or alias.

        Raises:
            UnknownNameError: there is none, or the name stands for two sides.
        """
        name = self.aliases.get(name, name)
        if name not in self.index:
            raise self._unknown(name)
        return self.rows[self.index[name]]

    def resolve(self, name: str) -> tuple[str, ...]:
        """The one or two row names that a name, alias or symmetric name stands for."""
        name = self.aliases.get(name, name)
        if name in self.index:
            return (name,)
        if name in self.symmetric:
            return self.symmetric[name]
        raise self._unknown(name)

    def groups(self) -> Mapping[str, tuple[Parameter, ...]]:
        """Rows by group, in order."""
        out: dict[str, list[Parameter]] = {}
        for row in self.rows:
            out.setdefault(row.group, []).append(row)
        return {group: tuple(rows) for group, rows in out.items()}

    def _unknown(self, name: str) -> UnknownNameError:
        return UnknownNameError("parameter", name, [*self.names, *self.symmetric, *self.aliases])


@dataclass(frozen=True, eq=False)
class Pose:
    """A vector of values that knows its table; immutable."""

    table: ParameterTable
    values: Values

    def __post_init__(self) -> None:
        if self.values.shape != (len(self.table),):
            raise MienError(f"a pose of {len(self.table)} parameters cannot hold values of shape {self.values.shape}")
        object.__setattr__(self, "values", _frozen(self.values))

    @classmethod
    def neutral(cls, table: ParameterTable) -> Pose:
        """The pose in which every parameter has its default."""
        return cls(table, table.defaults)

    def __repr__(self) -> str:
        changed = ", ".join(f"{name}={value:g}" for name, value in self.changed().items())
        return f"<Pose of {len(self.table)} parameters: {changed or 'neutral'}>"

    def __getitem__(self, name: str) -> float:
        return float(self.values[self.table.index[self.table[name].name]])

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pose):
            return NotImplemented
        return self.table is other.table and bool(np.array_equal(self.values, other.values))

    def __hash__(self) -> int:
        return hash((id(self.table), self.values.tobytes()))

    def replace(self, changes: Mapping[str, float]) -> Pose:
        """The pose with some values changed; a symmetric name changes both sides, a later name wins.

        Raises:
            UnknownNameError: a name is not in the table.
            RangeError: a value is not finite or out of range.
        """
        values = self.values.copy()
        for name, value in changes.items():
            for row in self.table.resolve(name):
                values[self.table.index[row]] = self.table[row].check(value)
        return Pose(self.table, values)

    def blend(self, other: Pose, amount: float) -> Pose:
        """The pose ``amount`` of the way to another: 0 gives this one, 1 the other.

        Source: Parke 1974, section 2.1; his coefficient, as printed, runs the other way: at 1 it gives value 1.
        """
        if other.table is not self.table:
            raise MienError("poses of different faces cannot be blended")
        return Pose(self.table, self.values * (1.0 - amount) + other.values * amount)

    def mirrored(self) -> Pose:
        """The pose as a mirror shows it."""
        return Pose(self.table, self.values[self.table.mirror_index] * self.table.mirror_sign)

    def clamped(self) -> Pose:
        """The pose with every value brought into its range."""
        return Pose(self.table, np.clip(self.values, self.table.lows, self.table.highs))

    def changed(self) -> dict[str, float]:
        """The values that differ from the defaults, by name."""
        return {
            name: float(value)
            for name, value, default in zip(self.table.names, self.values, self.table.defaults, strict=True)
            if value != default
        }


def _frozen(values: Iterable[float] | Values) -> Values:
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array
