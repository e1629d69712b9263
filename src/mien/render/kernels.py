"""How compiled functions are compiled. Imports Numba: only ``compiling.load`` may load the modules that use this."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba


def compiled(function: Callable[..., Any]) -> Any:
    """The function, compiled when first called and kept in the cache; it runs beside other threads.

    No ``fastmath``: it would let the processor decide the last bit of a picture.
    """
    return numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=False)(function)
