"""Memory does not grow with the length of a film: a process of its own writes two and says what the longer one took."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from film_cases import KINDS

PROGRAM = """
import resource, sys
from pathlib import Path
import numpy as np
from mien.formats.film import write_film

def noise(count, side=96):
    generator = np.random.default_rng(1)
    for number in range(count):
        pixels = generator.integers(0, 256, (side, side, 4), dtype=np.uint8)
        pixels[..., 3] = 255
        yield pixels

path = Path(sys.argv[1])
def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024

write_film(noise(50), path, fps=24, size_px=(96, 96))
before = peak()
write_film(noise(300), path, fps=24, size_px=(96, 96))
sys.stdout.write(f"{peak() - before} {path.stat().st_size // 1024**2}")
"""


@pytest.mark.parametrize("suffix", KINDS)
def test_six_times_as_many_frames_take_no_more(tmp_path: Path, suffix: str) -> None:
    command = [sys.executable, "-c", PROGRAM, str(tmp_path / f"a{suffix}")]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    grown_mib, file_mib = map(int, result.stdout.split())
    assert file_mib >= 1
    assert grown_mib <= 3
