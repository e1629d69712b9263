"""Elementary functions that give the same bits on every x86-64: how exact, and indeed the same."""

import math
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.core import exact

EPSILON = np.finfo(np.float64).eps

# Hashes results and NumPy's idea of the machine; in a process of its own, because NumPy reads the switch on import.
HASH_PROGRAM = """
import hashlib, numpy as np
from mien.core import exact
x = np.linspace(-40.0, 40.0, 20001)
digest = hashlib.sha256()
for function in (exact.sin, exact.cos, exact.exp, exact.round_points):
    digest.update(function(x).tobytes())
print(digest.hexdigest())
"""


@given(st.floats(-100, 100))
def test_sine_and_cosine_agree_with_the_c_library(angle):
    assert exact.sin(angle) == pytest.approx(math.sin(angle), abs=2 * EPSILON)
    assert exact.cos(angle) == pytest.approx(math.cos(angle), abs=2 * EPSILON)


@given(st.floats(-300, 300))
def test_the_exponential_agrees_with_the_c_library(x):
    assert exact.exp(x) == pytest.approx(math.exp(x), rel=4 * EPSILON)


@pytest.mark.parametrize("x", [0.0, 1e-9, 0.3, -1.0, 5.0, -50.0, 1e6])
def test_the_arctangent_agrees_with_the_c_library(x):
    assert exact.arctan(x) == pytest.approx(math.atan(x), abs=1e-15)


@pytest.mark.parametrize(
    ("turns", "sine", "cosine"), [(0, 0, 1), (1, 1, 0), (2, 0, -1), (3, -1, 0), (-1, -1, 0), (4, 0, 1)]
)
def test_quarter_turns(turns, sine, cosine):
    angle = turns * math.pi / 2
    assert exact.sin(angle) == pytest.approx(sine, abs=4 * EPSILON)
    assert exact.cos(angle) == pytest.approx(cosine, abs=4 * EPSILON)


def test_zero_is_exact():
    assert exact.sin(0.0) == 0.0
    assert exact.cos(0.0) == 1.0
    assert exact.exp(0.0) == 1.0


@given(st.floats(-1000, 1000))
def test_sine_is_odd_and_cosine_even_to_the_bit(angle):
    assert exact.sin(-angle) == -exact.sin(angle)
    assert exact.cos(-angle) == exact.cos(angle)


def test_the_exponential_ends_without_overflow_or_warning():
    assert exact.exp([-1e308, -701.0]).tolist() == [0.0, 0.0]
    assert np.isfinite(exact.exp([700.0, 1e308])).all()


def test_any_shape_goes_in_and_comes_out():
    for shape in ((), (3,), (2, 3), (0,)):
        for function in (exact.sin, exact.cos, exact.exp):
            assert function(np.zeros(shape)).shape == shape


def test_points_come_to_lie_on_the_grid():
    points = np.array([[0.0, 0.4 / 2**20, 0.6 / 2**20], [-1.5 / 2**20, 0.1, -0.1]])
    rounded = exact.round_points(points)
    assert (rounded * 2**20 == np.rint(rounded * 2**20)).all()
    assert rounded[0].tolist() == [0.0, 0.0, 2.0**-20]
    assert np.abs(rounded - points).max() <= 2.0**-21
    np.testing.assert_array_equal(exact.round_points(rounded), rounded)


def test_the_same_bits_whatever_numpy_dispatches_to():
    found = np._core._multiarray_umath.__cpu_dispatch__
    switched_off = {"NPY_DISABLE_CPU_FEATURES": " ".join(found)}
    digests = []
    for extra in ({}, switched_off):
        done = subprocess.run(
            [sys.executable, "-W", "ignore", "-c", HASH_PROGRAM],
            env={**os.environ, **extra},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        digests.append(done.stdout.strip())
    assert len(digests[0]) == 64
    assert digests[0] == digests[1]


def test_one_number_gives_the_bits_of_an_array():
    angles = np.linspace(-30.0, 30.0, 4001)
    sine, cosine = exact.sin_cos(angles)
    for number, angle in enumerate(angles):
        assert exact.sin_cos(float(angle)) == (sine[number], cosine[number])


def test_srgb_to_linear_is_the_standards_curve():
    assert exact.srgb_to_linear(0.0) == 0.0
    assert exact.srgb_to_linear(1.0) == pytest.approx(1.0, abs=1e-15)
    for code in range(256):
        share = code / 255.0
        wanted = share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4
        assert exact.srgb_to_linear(share) == pytest.approx(wanted, rel=1e-14)


def test_smoothstep_goes_from_0_to_1_and_stays_there():
    np.testing.assert_array_equal(exact.smoothstep([-1.0, 0.0, 0.25, 0.5, 1.0, 7.0]), [0, 0, 0.15625, 0.5, 1, 1])
