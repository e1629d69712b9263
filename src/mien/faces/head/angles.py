"""Sines, cosines and soft steps for kernels: to the bit what ``core.exact`` gives for arrays."""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

import math

import numpy as np

from mien.compiling import kernel

S0, S1, S2, S3, S4, S5, S6, S7, S8 = ((-1.0) ** k / math.factorial(2 * k + 1) for k in range(9))
C0, C1, C2, C3, C4, C5, C6, C7, C8, C9 = ((-1.0) ** k / math.factorial(2 * k) for k in range(10))
"""Taylor coefficients, and below pi/2 in two parts: see ``core.exact``."""

QUARTER_HIGH, QUARTER_LOW = 1.5707963267341256, 6.077100506506192e-11
QUARTERS_A_RADIAN = 2.0 / math.pi


@kernel()
def sin_cos(angle):
    """Sine and cosine of an angle in radians; without branches, so that a loop over angles takes several at once."""
    turns = np.rint(angle * QUARTERS_A_RADIAN)
    rest = (angle - turns * QUARTER_HIGH) - turns * QUARTER_LOW
    x = rest * rest
    sine = ((((((((S8 * x + S7) * x + S6) * x + S5) * x + S4) * x + S3) * x + S2) * x + S1) * x + S0) * rest
    cosine = ((((((((C9 * x + C8) * x + C7) * x + C6) * x + C5) * x + C4) * x + C3) * x + C2) * x + C1) * x + C0
    quadrant = turns - 4.0 * np.floor(turns * 0.25)
    odd = (quadrant == 1.0) | (quadrant == 3.0)
    height = cosine if odd else sine
    width = sine if odd else cosine
    return -height if quadrant >= 2.0 else height, -width if (quadrant == 1.0) | (quadrant == 2.0) else width


@kernel()
def turn(a, b, angle):
    """Two coordinates turned by an angle from the first axis towards the second."""
    sine, cosine = sin_cos(angle)
    return a * cosine - b * sine, a * sine + b * cosine


@kernel()
def share(x):
    """A number brought into 0..1."""
    return min(max(x, 0.0), 1.0)


@kernel()
def soft_step(x):
    """0 below 0, 1 above 1, and 3x^2 - 2x^3 between."""
    x = share(x)
    return x * x * (3.0 - 2.0 * x)
