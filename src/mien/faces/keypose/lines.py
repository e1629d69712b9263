"""Lines of words with comments: what topology and phase files are made of."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from mien.core import LoadError

MOST_BYTES = 20_000_000
"""More than any face needs; less than what stops a machine."""


def read_text(path: Path) -> str:
    """The text of a file.

    Raises:
        LoadError: it cannot be read.
    """
    try:
        if path.stat().st_size > MOST_BYTES:
            raise LoadError(path, f"is larger than {MOST_BYTES // 1_000_000} MB")
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise LoadError(path, error.strerror or str(error)) from None
    except UnicodeDecodeError:
        raise LoadError(path, "is not a text in UTF-8") from None


def read_lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Number from 1, and words, of every line that says something; ``#`` alone begins a comment (#e0ac96 does not).

    Raises:
        LoadError: the file cannot be read.
    """
    for number, line in enumerate(read_text(path).split("\n"), start=1):
        words = line.split()
        if "#" in words:
            words = words[: words.index("#")]
        if words:
            yield number, words
