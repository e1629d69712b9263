"""Measured directions in which heads differ: the second set of points of Parke's interpolations of the shape.

``tools/measure_head.py`` makes the data file from seventy-four people.

Source: Parke 1974, section 3.4.1; ICT-FaceKit Light and MakeHuman identities.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.resources import files

import numpy as np

from mien.core.mesh import Points

from .arrays import parse_arrays
from .measured import Kind


@cache
def directions(kind: Kind) -> Mapping[str, Points]:
    """Parameter -> (V, 3) m, what its high end adds to the skin; the low end takes as much away."""
    arrays = parse_arrays(files(__package__).joinpath("data/conformation.arrays").read_bytes())
    names = [str(name) for name in arrays["names"]]
    return dict(zip(names, arrays[kind].astype(np.float64), strict=True))
