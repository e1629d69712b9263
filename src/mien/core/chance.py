"""Random numbers that are the same on every machine: uniform ones and sums of them, never NumPy's other shapes."""

from __future__ import annotations

import zlib

import numpy as np


def stream(seed: int, name: str) -> np.random.Generator:
    """A generator of its own for each thing that chance decides, so that switching one off changes no other.

    Only ``random()`` is to be drawn from it: NumPy promises its bits, and makes them without transcendental functions.
    """
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed % 2**64, zlib.crc32(name.encode())])))


def between(chance: np.random.Generator, low: float, high: float) -> float:
    """A number between two bounds, all equally likely."""
    return low + (high - low) * chance.random()


def around(chance: np.random.Generator, middle: float, reach: float) -> float:
    """A number within ``reach`` of the middle, near it most often: the mean of three uniform ones."""
    return middle + reach * (2.0 * (chance.random() + chance.random() + chance.random()) / 3.0 - 1.0)
