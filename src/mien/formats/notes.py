"""What every file of ours says about itself: who made it, of which face, and that nobody was filmed."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.metadata import version
from pathlib import PurePath

SYNTHETIC = "Synthetic: computed from a model of a face; nobody was photographed or recorded."


@cache
def software() -> str:
    """Name and version."""
    return f"mien {version('mien')}"


def notes(face: str, text: str = "", seed: int | None = None) -> Mapping[str, str]:
    """Keywords and texts for pictures and films.

    Args:
        face: address of the face; of a path only the file's name is told, so that bytes are the same in any folder.
        text: what it says, if anything.
        seed: of what chance decided in it, if anything.
    """
    title = {"Title": text[:200]} if text else {}
    chance = {} if seed is None else {"Seed": str(seed)}
    return {**title, "Software": software(), "Face": PurePath(face).name, **chance, "Description": SYNTHETIC}
