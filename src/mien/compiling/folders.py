"""Where compiled code is kept: beside the source, in the user's cache folder, or for this process alone."""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
from functools import cache
from pathlib import Path


@cache
def cache_folder() -> Path:
    """The folder of this process."""
    return find_cache_folder(Path(__file__).parent, dict(os.environ))


def find_cache_folder(package: Path, environment: dict[str, str]) -> Path:
    """The first folder that can be written to: NUMBA_CACHE_DIR, beside the source, the user's cache, a temporary one.

    A temporary folder is this process's own (nobody else can leave code in it) and is removed when the process ends.
    """
    candidates = [package / "__pycache__"]
    if environment.get("NUMBA_CACHE_DIR"):
        candidates.insert(0, Path(environment["NUMBA_CACHE_DIR"]))
    home = environment.get("XDG_CACHE_HOME") or (environment.get("HOME") and environment["HOME"] + "/.cache")
    if home:
        candidates.append(Path(home) / "mien" / "compiled")
    for folder in candidates:
        if can_write(folder):
            return folder
    temporary = Path(tempfile.mkdtemp(prefix="mien-compiled-"))
    atexit.register(shutil.rmtree, temporary, ignore_errors=True)
    return temporary


def can_write(folder: Path) -> bool:
    """Whether files can be made in a folder, which is made if need be."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False
