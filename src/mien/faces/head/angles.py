"""Sines, cosines and soft steps for kernels: to the bit what ``core.exact`` gives for arrays."""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

import math

import numpy as np

from mien.compiling import kernel

SINE = tuple((-1.0) ** k / math.factorial(2 * k + 1) for k in range(9))
COSINE = tuple((-1.0) ** k / math.factorial(2 * k) for k in range(10))
"""Taylor coefficients, and below pi/2 in two parts: see ``core.exact``."""

QUARTER_HIGH, QUARTER_LOW = 1.5707963267341256, 6.077100506506192e-11
QUARTERS_A_RADIAN = 2.0 / math.pi


@kernel()
def sin_cos(angle):
    """Sine and cosine of an angle in radians."""
    turns = np.rint(angle * QUARTERS_A_RADIAN)
    rest = (angle - turns * QUARTER_HIGH) - turns * QUARTER_LOW
    square = rest * rest
    sine, cosine = SINE[8], COSINE[9]
    for k in range(7, -1, -1):
        sine = sine * square + SINE[k]
    for k in range(8, -1, -1):
        cosine = cosine * square + COSINE[k]
    sine *= rest
    quadrant = int(turns) & 3
    if quadrant & 1:
        sine, cosine = cosine, sine
    if quadrant >= 2:
        sine = -sine
    if quadrant == 1 or quadrant == 2:
        cosine = -cosine
    return sine, cosine


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
