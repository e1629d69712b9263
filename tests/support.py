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
    """Any pose of a table; ends of ranges and defaults come up often."""
    share = st.one_of(st.none(), st.sampled_from([0.0, 1.0]), st.floats(0.0, 1.0))
    return st.lists(share, min_size=len(table), max_size=len(table)).map(lambda shares: _pose(table, shares))


def _pose(table: ParameterTable, shares: list[float | None]) -> Pose:
    values = [
        row.default if share is None else row.low * (1.0 - share) + row.high * share
        for row, share in zip(table, shares, strict=True)
    ]
    return Pose(table, np.array(values)).clamped()
