"""How long the idle life of a live face takes in a loop at 60 Hz (processor time): usual, and the longest loop.

``python benchmarks/idle.py [MINUTES]``
"""

from __future__ import annotations

import gc
import sys
from fractions import Fraction
from time import thread_time

import numpy as np

from mien.live.idle import Idle


def measure(minutes: float) -> np.ndarray:
    """(loops,) ms of processor time that each loop took."""
    idle, took = Idle(1, Fraction(60), {}), []
    gc.disable()
    for _ in range(round(minutes * 3600)):
        start = thread_time()
        idle.step()
        took.append(thread_time() - start)
    gc.enable()
    return 1000.0 * np.array(took)


def main() -> None:
    """Prints a line."""
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
    took = measure(minutes)
    p50, p99 = np.percentile(took, [50, 99])
    print(
        f"idle life, {minutes:g} minutes at 60 Hz: median {p50:.3f} ms, p99 {p99:.3f} ms, longest {took.max():.2f} ms"
    )


if __name__ == "__main__":
    main()
