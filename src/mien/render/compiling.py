"""Where compiled code is kept, and word to the user when there is none yet.

Numba keeps compiled functions beside the source or in the user's cache folder, and refuses to load where it can
write to neither. So a folder that works is chosen here before the rasteriser is imported.
"""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
import threading
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

Report = Callable[[str], None]

MESSAGE = "compiling the rasteriser, once, about ten seconds"


class Compiled(NamedTuple):
    """The modules of compiled functions, by name."""

    lighting: ModuleType
    spans: ModuleType
    refining: ModuleType
    placing: ModuleType


_lock = threading.Lock()
_report: list[Report] = []
_loaded: list[Compiled] = []


def on_compile(report: Report | None) -> None:
    """Have ``report`` called with one line before the rasteriser is compiled for the first time; None: nobody."""
    _report[:] = [] if report is None else [report]


def cache_folder(package: Path | None = None, environment: dict[str, str] | None = None) -> Path:
    """The first folder that can be written to: NUMBA_CACHE_DIR, beside the source, the user's cache, a temporary one.

    A temporary folder is this process's own (nobody else can leave code in it) and is removed when the process ends.
    """
    environment = dict(os.environ) if environment is None else environment
    package = Path(__file__).parent if package is None else package
    candidates = [package / "__pycache__"]
    if environment.get("NUMBA_CACHE_DIR"):
        candidates.insert(0, Path(environment["NUMBA_CACHE_DIR"]))
    home = environment.get("XDG_CACHE_HOME") or (environment.get("HOME") and environment["HOME"] + "/.cache")
    if home:
        candidates.append(Path(home) / "mien" / "numba")
    for folder in candidates:
        if can_write(folder):
            return folder
    temporary = Path(tempfile.mkdtemp(prefix="mien-numba-"))
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


def load() -> Compiled:
    """The compiled modules; the first call imports Numba, and reports if it must compile."""
    with _lock:
        if not _loaded:
            _loaded.append(_import_compiled())
            if _report and any(is_cold(module) for module in _loaded[0]):
                _report[0](MESSAGE)
        return _loaded[0]


def _import_compiled() -> Compiled:
    from numba.core import config as numba_config

    config: Any = numba_config
    folder = cache_folder()
    before = config.CACHE_DIR
    # Numba looks at this when a function is decorated; what others compile later is none of our business.
    config.CACHE_DIR = str(folder)
    try:
        return Compiled(*(import_module(f"mien.render.{name}") for name in Compiled._fields))
    finally:
        config.CACHE_DIR = before


def is_cold(module: ModuleType) -> bool:
    """Whether some compiled function of a module has no index in its cache, or one older than the source."""
    source = Path(module.__file__ or "")
    changed = source.stat().st_mtime
    for name, function in vars(module).items():
        if not hasattr(function, "py_func"):
            continue
        dispatcher: Any = function
        indexes = list(Path(dispatcher.stats.cache_path).glob(f"{source.stem}.{name}-*.nbi"))
        if not any(index.stat().st_mtime >= changed for index in indexes):
            return True
    return False


def timed(work: Callable[[], object]) -> float:
    """Seconds that some work takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start
