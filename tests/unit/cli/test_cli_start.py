"""Starting is quick, because nothing heavy is imported before it is used."""

from __future__ import annotations

import resource
import subprocess
import sys

import pytest

import mien

HEAVY = ("numba", "av", "PIL", "hibari", "onnxruntime", "matplotlib", "rich.progress", "numpy")


def imported_by(statement: str) -> list[str]:
    code = f"{statement}\nimport sys\nprint([name for name in {HEAVY!r} if name in sys.modules])"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return eval(result.stdout.strip().splitlines()[-1])


def least_seconds(*command: str) -> float:
    """Least processor time of some runs: what else the machine does just now is not ours to measure."""

    def once() -> float:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, capture_output=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    return min(once() for _ in range(5))


def test_importing_mien_imports_nothing_heavy() -> None:
    assert imported_by("import mien") == []


def test_help_imports_nothing_heavy() -> None:
    assert imported_by("from mien.cli import main; main(['--help'])") == []


def test_importing_mien_takes_less_than_a_fifth_of_a_second() -> None:
    assert least_seconds(sys.executable, "-c", "import mien") < 0.2


def test_help_takes_less_than_two_fifths_of_a_second() -> None:
    assert least_seconds(sys.executable, "-m", "mien", "--help") < 0.4


@pytest.mark.parametrize("name", mien.__all__)
def test_every_public_name_is_there(name: str) -> None:
    assert getattr(mien, name) is not None
    assert name in dir(mien)


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'sya'"):
        mien.sya  # noqa: B018
