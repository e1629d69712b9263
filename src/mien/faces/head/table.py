"""The table of the head: Parke's expression parameters by his names, ranges and senses, then what they lack."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from mien.core import Parameter, ParameterTable, Pose, both_sides, color

from .palettes import DEFAULT, linear, palettes
from .shipped import shipped_rows

SCENE = "Parke 1974, section 3.5"

COLORS = (
    ("skin", "Skin."),
    ("blush", "Warmth of cheeks, nose, ears and chin, mixed into the skin."),
    ("lip", "Lips."),
    ("shade", "Skin under the eyes and beside the nose."),
    ("eyebrow", "Eyebrows; lashes are a darker shade of it."),
    ("hair", "Hair."),
    ("iris", "Iris."),
    ("garment", "Collar and shoulders."),
)
FIXED_COLORS = (
    ("fringe", "#23221a", "Fringe around the iris."),
    ("pupil", "#0a0a0c", "Pupil."),
    ("spot", "#ffffff", "Reflection spot."),
    ("white", "#e3ded7", "White of the eye."),
    ("tooth", "#f0e9da", "Teeth."),
    ("gum", "#a85a56", "Gums."),
    ("tongue", "#b0605e", "Tongue."),
    ("cavity", "#571f1e", "Inside of the mouth."),
)
PLACES = (
    ("target", "what the eyes look at", (0.0, 0.0, 1.0)),
    ("light", "the light that the eyes reflect", (-1.5, 1.7, 2.0)),
    ("viewer", "the viewer, who sees the reflection", (0.0, 0.0, 1.1)),
)


def face_rows() -> tuple[dict[str, str], ...]:
    """Rows of ``data/parameters.csv``: name, sides, low, high, default, unit, group, mirror, morph, doc, source.

    ``low_mm`` and ``high_mm`` are the largest displacements at both ends, ``role`` and ``closed`` as in ``Parameter``.
    """
    return shipped_rows("parameters")


def conformation_rows() -> tuple[dict[str, str], ...]:
    """Rows of ``data/conformation.csv``, in the order in which they act.

    They have what the others have but ``role``, ``closed`` and ``morph``, and the mechanism: kind (blend, field,
    scale, move, lids, turn, brow or head), axis, region and origin; and the spread among people, by least squares on
    the fifty identities of ICT-FaceKit Light (chosen for brows and teeth, which these do not have).
    """
    return shipped_rows("conformation")


@cache
def head_table(own: tuple[tuple[str, float], ...] = ()) -> ParameterTable:
    """The parameters of every head; ``own`` are a person's values instead of the defaults, by name.

    Raises:
        UnknownNameError, RangeError: a value of ``own`` does not fit the table.
    """
    table = ParameterTable(
        (*_face(face_rows(), "motion"), *_face(conformation_rows(), "shape"), *_places(), *_colors())
    )
    if not own:
        return table
    values = Pose.neutral(table).replace(dict(own))
    return ParameterTable(tuple(replace(row, default=values[row.name], usual=row.default) for row in table))


def _face(cells_of: tuple[dict[str, str], ...], role: str) -> list[Parameter]:
    rows: list[Parameter] = []
    for row in cells_of:
        low, high, default, low_mm, high_mm = (
            float(row[key]) for key in ("low", "high", "default", "low_mm", "high_mm")
        )
        parameter = Parameter(
            *(row["name"], low, high, default, row["unit"], row["group"], row["mirror"] == "odd"),
            *(row["doc"], row["source"], float(row.get("spread") or 0.0)),
            reach_mm=(low_mm, high_mm),
            role=row.get("role") or role,
            closed=float(row["closed"]) if row.get("closed") else None,
        )
        rows += both_sides(parameter) if row["sides"] else (parameter,)
    return rows


def _places() -> list[Parameter]:
    rows = []
    for group, what, place in PLACES:
        for axis, value, way in zip("xyz", place, ("to the own left", "up", "forward"), strict=True):
            doc = f"Place of {what}: {way}. A scene fills it in where the pose leaves it at rest."
            odd = axis == "x"
            rows.append(Parameter(f"{group}.{axis}", -100, 100, value, "m", group, odd, doc, SCENE, role="scene"))
    return rows


def _colors() -> list[Parameter]:
    palette = palettes()[DEFAULT]
    rows: list[Parameter] = []
    for name, doc in COLORS:
        rows += color(f"{name}.color", palette[name], unit="linear light", group="color", doc=doc, source=SCENE)
    for name, hex_color, doc in FIXED_COLORS:
        rows += color(f"{name}.color", linear(hex_color), unit="linear light", group="color", doc=doc, source=SCENE)
    return rows
