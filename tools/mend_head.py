"""Corrections of the measured cage."""

from __future__ import annotations

import numpy as np


def mend(head: dict[str, np.ndarray]) -> None:
    """Change the arrays of the trial in place; nothing yet."""
