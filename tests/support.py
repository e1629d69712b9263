"""What several tests need: every installed face, and poses drawn from any table."""

from functools import cache

import numpy as np
from hypothesis import strategies as st

from mien.core import Face, ParameterTable, Pose
from mien.faces import face_names, load_face

FACE_NAMES = tuple(name for name, _ in face_names())


@cache
def face(name: str) -> Face:
    """An installed face; loaded once a run."""
    return load_face(name)


def poses(table: ParameterTable) -> st.SearchStrategy[Pose]:
    """Any pose of a table: some rows moved, or all of them, many to an end of their range."""
    return st.one_of(_some_rows(table), st.integers(0, 2**32 - 1).map(lambda seed: _all_rows(table, seed)))


def _some_rows(table: ParameterTable) -> st.SearchStrategy[Pose]:
    if not len(table):
        return st.just(Pose.neutral(table))
    row = st.sampled_from(table.rows).flatmap(lambda row: st.tuples(st.just(row.name), st.floats(row.low, row.high)))
    return st.lists(row, max_size=6).map(lambda changes: Pose.neutral(table).replace(dict(changes)))


def _all_rows(table: ParameterTable, seed: int) -> Pose:
    generator = np.random.default_rng(seed)
    share = np.clip(generator.uniform(-0.3, 1.3, len(table)), 0.0, 1.0)
    return Pose(table, table.lows * (1.0 - share) + table.highs * share).clamped()
