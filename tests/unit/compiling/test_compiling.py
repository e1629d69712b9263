"""Kernels: what they accept, that they come from the cache without a compiler, and where that cache is."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import mien
from mien.compiling import Kernel
from mien.compiling.folders import can_write, find_cache_folder
from mien.compiling.library import MESSAGE
from mien.compiling.signature import parse_signature

PACKAGE = Path(mien.__file__).parent

SOURCE = """
import sys
import numpy as np
from mien.compiling import kernel

@kernel()
def half(x):
    return x * 0.5

@kernel("f8[:,:], i8[:], f8, i8 -> i8")
def halve_rows(values, rows, offset, first):
    '''Halves.'''
    for k in range(first, len(rows)):
        for c in range(values.shape[1]):
            values[rows[k], c] = half(values[rows[k], c]) + offset
    return len(rows) - first
"""


def run(code: str, **environment: str) -> str:
    """What a fresh interpreter prints."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("NUMBA", "XDG", "HOME"))}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], env={**kept, **environment}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def sample(tmp_path_factory: pytest.TempPathFactory) -> ModuleType:
    return import_source(tmp_path_factory.mktemp("sample") / "mien_sample_kernels.py", SOURCE)


def import_source(path: Path, source: str) -> ModuleType:
    path.write_text(source)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = sys.modules[path.stem] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_kernel_changes_the_arrays_that_it_is_given(sample: ModuleType) -> None:
    values = np.arange(6.0).reshape(3, 2)
    assert sample.halve_rows(values, np.array([1, 2, 0]), 10.0, 1) == 2
    assert values.tolist() == [[10.0, 10.5], [2.0, 3.0], [12.0, 12.5]]
    assert sample.halve_rows(np.empty((0, 2)), np.empty(0, dtype=np.int64), 1.0, 0) == 0


@pytest.mark.parametrize(
    ("values", "rows"),
    [
        (np.zeros((2, 2), dtype=np.float32), np.zeros(1, dtype=np.int64)),
        (np.zeros((2, 3)).T, np.zeros(1, dtype=np.int64)),
        (np.zeros(4), np.zeros(1, dtype=np.int64)),
        (np.zeros((2, 4))[:, ::2], np.zeros(1, dtype=np.int64)),
        (np.zeros((2, 2)), np.zeros(1, dtype=np.int32)),
    ],
)
def test_array_of_another_kind_is_refused_before_anything_runs(
    sample: ModuleType, values: np.ndarray, rows: np.ndarray
) -> None:
    with pytest.raises(TypeError, match=r"halve_rows: argument \d must be a C-contiguous array"):
        sample.halve_rows(values, rows, 1.0, 0)
    assert not values.any()


def test_wrong_number_of_arguments_and_kernels_for_kernels_are_refused(sample: ModuleType) -> None:
    with pytest.raises(TypeError, match="want 4 arguments, got 1"):
        sample.halve_rows(1.0)
    with pytest.raises(TypeError, match="only other kernels"):
        sample.half(1.0)


def test_kernel_that_needs_the_compiler_at_run_time_is_refused(tmp_path: Path) -> None:
    source = (
        'from mien.compiling import kernel\n@kernel("f8[:,:] -> i8")\ndef count(x):\n    return len(x.reshape(-1))\n'
    )
    module = import_source(tmp_path / "mien_sample_reshaping.py", source)
    with pytest.raises(TypeError, match="kernel count calls numba_"):
        module.count(np.zeros((2, 2)))


@pytest.mark.parametrize("text", ["", "f8[3]", "f8[:] -> f8", "f4", "i4, i8", "float64[:]"])
def test_signature_that_cannot_be_read(text: str) -> None:
    with pytest.raises(ValueError, match="signature"):
        parse_signature(text)


def test_second_process_needs_no_compiler_and_a_damaged_file_is_made_anew(tmp_path: Path) -> None:
    (tmp_path / "kernels_here.py").write_text(SOURCE)
    code = (
        f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n"
        "import numpy as np, kernels_here as k\n"
        "values = np.full((1, 1), 8.0); k.halve_rows(values, np.array([0]), 1.0, 0)\n"
        "print(values[0, 0], 'numba' in sys.modules)"
    )
    cache = tmp_path / "cache"
    asked = {"NUMBA_CACHE_DIR": str(cache)}
    assert run(code, **asked).split() == ["5.0", "True"]
    assert run(code, **asked).split() == ["5.0", "False"]
    (file,) = cache.iterdir()
    for damage in (lambda data: data[:-7], lambda data: data[:60] + b"?" + data[61:], lambda data: b""):
        file.write_bytes(damage(file.read_bytes()))
        assert run(code, **asked).split() == ["5.0", "True"]
    assert run(code, **asked, NUMBA_CPU_NAME="generic").split() == ["5.0", "True"]
    assert len(list(cache.iterdir())) == 2, "code for another processor is another file"
    (tmp_path / "kernels_here.py").write_text(SOURCE.replace("0.5", "0.25"))
    assert run(code, **asked).split() == ["3.0", "True"]


def test_importing_loads_no_compiler() -> None:
    out = run("import sys, mien.render, mien.compiling; print('numba' in sys.modules, 'llvmlite' in sys.modules)")
    assert out.split() == ["False", "False"]


def test_reference_needs_no_compiler() -> None:
    code = (
        "import sys; sys.modules['numba'] = sys.modules['llvmlite'] = None\n"
        "import numpy as np; from mien.core import *; from mien.render import draw_mesh\n"
        "mesh = Mesh(build_topology(3, [('a', np.array([[0, 1, 2]]), Material())]), np.eye(3) * 0.05, np.eye(3))\n"
        "print(draw_mesh(mesh, Scene(size_px=(8, 8)), rasteriser='reference').shape)"
    )
    assert run(code).strip() == "(8, 8, 4)"


def test_warmup_loads_every_module_with_kernels() -> None:
    from mien.compiling.listed import KERNELS

    for name in KERNELS:
        importlib.import_module(name)
    modules = [
        path for path in PACKAGE.rglob("*.py") if "@kernel(" in path.read_text() and path.parent.name != "compiling"
    ]
    names = {"mien." + ".".join(path.relative_to(PACKAGE).with_suffix("").parts) for path in modules}
    callable_ones = {
        name
        for name in names
        if any(isinstance(v, Kernel) and v.signature for v in vars(importlib.import_module(name)).values())
    }
    assert set(KERNELS) == callable_ones


@pytest.mark.slow
def test_installation_and_home_that_cannot_be_written_to(tmp_path: Path) -> None:
    copy = tmp_path / "mien"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    # A plain file in the place of a folder stops even the superuser, whom no permission stops.
    (copy / "compiling" / "__pycache__").write_text("in the way")
    (tmp_path / "home").write_text("in the way")
    (tmp_path / "scratch").mkdir()
    few = ["mien.render.bands", "mien.render.placing", "mien.render.refining"]
    code = f"import mien.compiling as it; print(it.__file__); it.on_compile(print); it.load_kernels({few})"
    out = run(
        code,
        PYTHONPATH=str(tmp_path),
        PYTHONDONTWRITEBYTECODE="1",
        HOME=str(tmp_path / "home"),
        TMPDIR=str(tmp_path / "scratch"),
    )
    assert out.splitlines() == [str(copy / "compiling" / "__init__.py"), MESSAGE], "told once, however many modules"
    assert list((tmp_path / "scratch").iterdir()) == [], "the temporary cache must go when the process ends"


def test_cache_is_beside_the_source_then_at_home_then_temporary(tmp_path: Path) -> None:
    package, home = tmp_path / "package", tmp_path / "home"
    package.mkdir()
    home.mkdir()
    asked = {"NUMBA_CACHE_DIR": str(tmp_path / "asked"), "HOME": str(home)}
    assert find_cache_folder(package, asked) == tmp_path / "asked"
    del asked["NUMBA_CACHE_DIR"]
    assert find_cache_folder(package, asked) == package / "__pycache__"
    (package / "__pycache__").rmdir()
    (package / "__pycache__").write_text("in the way")
    assert find_cache_folder(package, asked) == home / ".cache" / "mien" / "compiled"
    elsewhere = {"HOME": str(home), "XDG_CACHE_HOME": str(tmp_path)}
    assert find_cache_folder(package, elsewhere) == tmp_path / "mien" / "compiled"
    last = find_cache_folder(package, {"HOME": str(package / "__pycache__" / "home")})
    assert can_write(last)
    assert last.stat().st_mode & 0o077 == 0, "nobody else may leave code there"
    assert find_cache_folder(package, {}) != last
