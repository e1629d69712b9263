"""Named poses of the head: eight expressions, and the palettes."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from mien.core import Preset

from .palettes import palette_presets

EXPRESSIONS: Mapping[str, tuple[str, Mapping[str, float]]] = {
    "neutral": ("At rest.", {}),
    "smile": (
        "A friendly smile with raised cheeks.",
        {
            "mouth.expression": 0.38,
            "cheek.raise": 0.30,
            "mouth.dimple": 0.2,
            "eyelid.opening": 0.70,
            "eyebrow.arch": 0.6,
        },
    ),
    "laugh": (
        "Mouth open, teeth shown, eyes narrowed by the cheeks.",
        {
            "mouth.expression": 0.15,
            "cheek.raise": 0.55,
            "jaw.rotation": 8.0,
            "mouth.upper_raise": 0.35,
            "eyelid.opening": 0.56,
            "eyebrow.arch": 0.5,
            "tongue.raise": 0.1,
        },
    ),
    "sad": (
        "Inner brows up, corners of the mouth down, lids heavy, head bowed.",
        {
            "eyebrow.inner_raise": 1.0,
            "eyebrow.lower": 0.3,
            "eyebrow.arch": 1.0,
            "eyebrow.separation": -8.0,
            "mouth.frown": 0.95,
            "chin.raise": 0.5,
            "eyelid.opening": 0.56,
            "head.nod": -4.0,
            "target.y": -0.2,
        },
    ),
    "angry": (
        "Brows down and together, lids tight, lips pressed.",
        {
            "eyebrow.lower": 1.0,
            "eyebrow.outer_raise": 0.25,
            "eyebrow.arch": 0.62,
            "eyebrow.separation": -25.0,
            "eyelid.squint": 0.6,
            "eyelid.opening": 0.87,
            "nose.wrinkle": 0.35,
            "mouth.press": 0.9,
            "mouth.roll_upper": 0.15,
            "mouth.roll_lower": 0.15,
            "mouth.frown": 0.42,
            "chin.raise": 0.3,
            "head.nod": -5.0,
        },
    ),
    "surprised": (
        "Brows high, eyes wide, jaw dropped.",
        {
            "eyebrow.arch": 0.3,
            "eyebrow.inner_raise": 1.0,
            "eyebrow.outer_raise": 0.5,
            "eyelid.opening": 1.0,
            "jaw.rotation": 9.5,
            "mouth.width": 0.86,
        },
    ),
    "disgusted": (
        "Nose wrinkled, upper lip raised, brows down.",
        {
            "nose.wrinkle": 1.0,
            "mouth.upper_raise": 0.42,
            "mouth.lower_depress": 0.15,
            "mouth.frown": 0.5,
            "chin.raise": 0.3,
            "cheek.raise": 0.3,
            "eyebrow.lower": 1.0,
            "eyebrow.arch": 0.8,
            "eyebrow.separation": -12.0,
            "eyelid.squint": 0.5,
            "eyelid.opening": 0.62,
        },
    ),
    "sleepy": (
        "Lids half down, brows loose, jaw slack.",
        {
            "eyelid.opening": 0.27,
            "eyebrow.arch": 0.95,
            "eyebrow.inner_raise": 0.2,
            "jaw.rotation": 0.8,
            "head.nod": -4.0,
            "target.y": -0.25,
        },
    ),
}


@cache
def head_presets() -> Mapping[str, Preset]:
    """Expressions first, then palettes."""
    out = {name: Preset(name, "expression", values, doc) for name, (doc, values) in EXPRESSIONS.items()}
    return {**out, **palette_presets()}
