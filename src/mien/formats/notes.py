"""What every file of ours says about itself: who made it, of which face, and that nobody was filmed."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.metadata import version

SYNTHETIC = "Synthetic: computed from a model of a face; nobody was photographed or recorded."


@cache
def software() -> str:
    """Name and version."""
    return f"mien {version('mien')}"


def notes(face: str, text: str = "", seed: int | None = None) -> Mapping[str, str]:
    """Keywords and texts for pictures and films.

    Args:
        face: address of the face.
        text: what it says, if anything.
        seed: of what chance decided in it, if anything.
    """
    title = {"Title": text[:200]} if text else {}
    chance = {} if seed is None else {"Seed": str(seed)}
    return {**title, "Software": software(), "Face": face, **chance, "Description": SYNTHETIC}
