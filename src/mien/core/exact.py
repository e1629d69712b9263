"""Elementary functions made of additions and multiplications only, so that every x86-64 machine gives the same bits.

NumPy's and the C library's own versions differ in the last place between instruction sets; IEEE 754 fixes
``+ - * /``, ``sqrt`` and rounding exactly, so these do not. Errors are a few units in the last place for the
arguments faces meet (angles of some turns, exponents of some hundreds).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Taylor coefficients; on |x| <= pi/4 (ln 2 / 2 for exp) the first term left out is below 1e-17;
# so it is for the logarithm on 0.7..1.4.
_SIN = [(-1.0) ** k / math.factorial(2 * k + 1) for k in range(9)]
_COS = [(-1.0) ** k / math.factorial(2 * k) for k in range(10)]
_ARTANH = [1.0 / (2 * k + 1) for k in range(11)]
_EXP = [1.0 / math.factorial(k) for k in range(15)]

# pi/2 and ln 2 in two parts, the first with trailing zero bits, so that n times it is exact (Cody and Waite).
_HALF_PI_HIGH, _HALF_PI_LOW = 1.5707963267341256, 6.077100506506192e-11
_LN2_HIGH, _LN2_LOW = 0.6931471803691238, 1.9082149292705877e-10

GRID_M = 2.0**-20
"""The grid that points are rounded to before they are drawn, metres (about a micrometre)."""


def _polynomial(coefficients: list[float], x: NDArray[np.float64]) -> NDArray[np.float64]:
    total = np.full_like(x, coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        total = total * x + coefficient
    return total


def sin_cos(angle: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Sine and cosine of angles in radians, any shape."""
    if np.ndim(angle) == 0:
        one = _sin_cos_of_one(float(angle))  # type: ignore[arg-type]
        return np.asarray(one[0]), np.asarray(one[1])
    x = np.asarray(angle, dtype=np.float64)
    turns = np.rint(x * (2.0 / math.pi))
    rest = (x - turns * _HALF_PI_HIGH) - turns * _HALF_PI_LOW
    square = rest * rest
    sine, cosine = _polynomial(_SIN, square) * rest, _polynomial(_COS, square)
    quadrant = turns.astype(np.int64) & 3
    swap = (quadrant & 1) == 1
    s, c = np.where(swap, cosine, sine), np.where(swap, sine, cosine)
    return np.where(quadrant >= 2, -s, s), np.where((quadrant == 1) | (quadrant == 2), -c, c)


def _sin_cos_of_one(x: float) -> tuple[float, float]:
    """The same steps in plain floats: to the bit what the arrays give, and several times faster for one number."""
    turns = float(round(x * (2.0 / math.pi)))
    rest = (x - turns * _HALF_PI_HIGH) - turns * _HALF_PI_LOW
    square = rest * rest
    sine, cosine = _SIN[-1], _COS[-1]
    for coefficient in _SIN[-2::-1]:
        sine = sine * square + coefficient
    for coefficient in _COS[-2::-1]:
        cosine = cosine * square + coefficient
    sine *= rest
    quadrant = int(turns) & 3
    s, c = (cosine, sine) if quadrant & 1 else (sine, cosine)
    return -s if quadrant >= 2 else s, -c if quadrant in (1, 2) else c


def sin(angle: ArrayLike) -> NDArray[np.float64]:
    """Sine of angles in radians, any shape."""
    return sin_cos(angle)[0]


def cos(angle: ArrayLike) -> NDArray[np.float64]:
    """Cosine of angles in radians, any shape."""
    return sin_cos(angle)[1]


def arctan(x: float) -> float:
    """The angle in radians, between -pi/2 and pi/2, whose tangent is x."""
    for _ in range(4):  # Half the angle each time; after four times its tangent is below 0.1.
        x = x / (1.0 + math.sqrt(1.0 + x * x))
    square, total = x * x, 0.0
    for k in range(10, -1, -1):
        total = total * -square + 1.0 / (2 * k + 1)
    return 16.0 * x * total


def exp(x: ArrayLike) -> NDArray[np.float64]:
    """e to the power x, any shape; below -700 it is 0."""
    x = np.asarray(x, dtype=np.float64)
    bounded = np.clip(x, -700.0, 700.0)
    powers = np.rint(bounded * (1.0 / math.log(2.0)))
    rest = (bounded - powers * _LN2_HIGH) - powers * _LN2_LOW
    value = np.ldexp(_polynomial(_EXP, rest), powers.astype(np.int32))
    return np.where(x < -700.0, 0.0, value)


def log(x: ArrayLike) -> NDArray[np.float64]:
    """Natural logarithm of positive numbers, any shape."""
    fraction, powers = np.frexp(np.asarray(x, dtype=np.float64))
    low = fraction < math.sqrt(0.5)
    fraction, powers = np.where(low, 2.0 * fraction, fraction), np.where(low, powers - 1, powers)
    # ln f = 2 artanh((f - 1) / (f + 1)), and |(f - 1) / (f + 1)| < 0.172.
    part = (fraction - 1.0) / (fraction + 1.0)
    rest = 2.0 * part * _polynomial(_ARTANH, part * part)
    return (rest + powers * _LN2_LOW) + powers * _LN2_HIGH


def power(x: ArrayLike, exponent: float) -> NDArray[np.float64]:
    """x to a positive exponent, any shape; 0 where x is 0 or less."""
    base = np.asarray(x, dtype=np.float64)
    return np.where(base > 0.0, exp(exponent * log(np.where(base > 0.0, base, 1.0))), 0.0)


def smoothstep(x: ArrayLike) -> NDArray[np.float64]:
    """0 below 0, 1 above 1, and 3x^2 - 2x^3 between, any shape."""
    bounded = np.clip(np.asarray(x, dtype=np.float64), 0.0, 1.0)
    return bounded * bounded * (3.0 - 2.0 * bounded)


def srgb_to_linear(share: float) -> float:
    """Linear light 0..1 of an sRGB value 0..1.

    Source: IEC 61966-2-1 (sRGB).
    """
    if share <= 0.04045:
        return share / 12.92
    base = (share + 0.055) / 1.055
    square = base * base
    # base ** 2.4 as its square times the fifth root of that square, by Newton's method.
    root = base
    for _ in range(60):
        power = root * root * root * root
        root = (4.0 * root + square / power) / 5.0
    return square * root


def round_points(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points on the grid of 2^-20 m, so that a last-place difference upstream cannot reach a picture."""
    return np.rint(points * (1.0 / GRID_M)) * GRID_M
