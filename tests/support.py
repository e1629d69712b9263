"""What several tests need: faces, poses of any table, kernels as plain Python, how far a head's lips are apart."""

import importlib.util
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import numpy as np
from hypothesis import strategies as st

from mien.compiling import Kernel
from mien.core import Face, ParameterTable, Pose
from mien.core.mesh import Points
from mien.faces import face_names, load_face
from mien.faces.head.lips import CONTACT_STATIONS
from mien.faces.head.measured import archive

ROOT = Path(__file__).parents[1]
MASK = str(ROOT / "tests/unit/faces/keypose/mask.keypose")
"""Half a face of 44 points in eleven phases."""

FACE_NAMES = (*(name for name, _ in face_names()), MASK)


@cache
def face(name: str) -> Face:
    """An installed face; loaded once a run."""
    return load_face(name)


def load_tool(name: str) -> ModuleType:
    """A program of tools/ as a module."""
    spec = importlib.util.spec_from_file_location(f"tool_{name}", ROOT / "tools" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    # Its records look themselves up by the name of their module.
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@cache
def in_python(kernel: Kernel) -> Callable[..., Any]:
    """A kernel, and those that it calls, as the plain Python that they are written in."""
    function = kernel.function
    named = {name: function.__globals__[name] for name in function.__code__.co_names if name in function.__globals__}
    scope = {name: in_python(value) if isinstance(value, Kernel) else value for name, value in named.items()}
    return FunctionType(function.__code__, scope)


def poses(table: ParameterTable) -> st.SearchStrategy[Pose]:
    """Any pose of a table: some rows moved, or all of them, many to an end of their range."""
    return st.one_of(_some_rows(table), st.integers(0, 2**32 - 1).map(lambda seed: _all_rows(table, seed)))


def lip_gap_mm(skin: Points) -> float:
    """Greatest height between the edges of contact of lips drawn with a head's skin, middle to next but the corner."""
    height = {name: skin[number, 1] for name, number in archive().vertex.items()}
    return 1000.0 * max(height[f"m0_{up}"] - height[f"m0_{low}"] for up, low, *_ in CONTACT_STATIONS[:4])


def _some_rows(table: ParameterTable) -> st.SearchStrategy[Pose]:
    if not len(table):
        return st.just(Pose.neutral(table))
    row = st.sampled_from(table.rows).flatmap(lambda row: st.tuples(st.just(row.name), st.floats(row.low, row.high)))
    return st.lists(row, max_size=6).map(lambda changes: Pose.neutral(table).replace(dict(changes)))


def _all_rows(table: ParameterTable, seed: int) -> Pose:
    generator = np.random.default_rng(seed)
    share = np.clip(generator.uniform(-0.3, 1.3, len(table)), 0.0, 1.0)
    return Pose(table, table.lows * (1.0 - share) + table.highs * share).clamped()
