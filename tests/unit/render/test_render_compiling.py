"""Loading the compiled rasteriser: late, told, and in folders that cannot be written to."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import mien
from mien.render.compiling import MESSAGE, cache_folder, can_write

PACKAGE = Path(mien.__file__).parent
WARM = "from mien.render import warmup; seconds = warmup(print); assert seconds > 0"


def run(code: str, **environment: str) -> str:
    """What a fresh interpreter prints."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("NUMBA", "XDG", "HOME"))}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], env={**kept, **environment}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_importing_loads_no_compiler() -> None:
    out = run("import sys, mien.render; print('numba' in sys.modules)")
    assert out.strip() == "False"


def test_reference_needs_no_compiler() -> None:
    code = (
        "import sys; sys.modules['numba'] = None\n"
        "import numpy as np; from mien.core import *; from mien.render import draw_mesh\n"
        "mesh = Mesh(build_topology(3, [('a', np.array([[0, 1, 2]]), Material())]), np.eye(3) * 0.05, np.eye(3))\n"
        "print(draw_mesh(mesh, Scene(size_px=(8, 8)), rasteriser='reference').shape)"
    )
    assert run(code).strip() == "(8, 8, 4)"


@pytest.mark.slow
def test_installation_and_home_that_cannot_be_written_to(tmp_path: Path) -> None:
    copy = tmp_path / "mien"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__", "faces", "speech"))
    # A plain file in the place of a folder stops even the superuser, whom no permission stops.
    (copy / "render" / "__pycache__").write_text("in the way")
    (tmp_path / "home").write_text("in the way")
    (tmp_path / "scratch").mkdir()
    out = run(
        "import mien; print(mien.__file__); " + WARM,
        PYTHONPATH=str(tmp_path),
        PYTHONDONTWRITEBYTECODE="1",
        HOME=str(tmp_path / "home"),
        TMPDIR=str(tmp_path / "scratch"),
    )
    assert out.splitlines() == [str(copy / "__init__.py"), MESSAGE]
    assert list((tmp_path / "scratch").iterdir()) == [], "the temporary cache must go when the process ends"


@pytest.mark.slow
def test_compiling_is_told_once(tmp_path: Path) -> None:
    cache = str(tmp_path / "cache")
    assert run(WARM, NUMBA_CACHE_DIR=cache).strip() == MESSAGE
    assert run(WARM, NUMBA_CACHE_DIR=cache) == ""


def test_cache_is_beside_the_source_then_at_home_then_temporary(tmp_path: Path) -> None:
    package, home = tmp_path / "package", tmp_path / "home"
    package.mkdir()
    home.mkdir()
    asked = {"NUMBA_CACHE_DIR": str(tmp_path / "asked"), "HOME": str(home)}
    assert cache_folder(package, asked) == tmp_path / "asked"
    del asked["NUMBA_CACHE_DIR"]
    assert cache_folder(package, asked) == package / "__pycache__"
    (package / "__pycache__").rmdir()
    (package / "__pycache__").write_text("in the way")
    assert cache_folder(package, asked) == home / ".cache" / "mien" / "numba"
    assert cache_folder(package, {"HOME": str(home), "XDG_CACHE_HOME": str(tmp_path)}) == tmp_path / "mien" / "numba"
    last = cache_folder(package, {"HOME": str(package / "__pycache__" / "home")})
    assert can_write(last)
    assert last.stat().st_mode & 0o077 == 0, "nobody else may leave code there"
    assert cache_folder(package, {}) != last
