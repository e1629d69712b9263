"""Errors that a user can mend: each names offender, place, wanted, got and what to try."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path


class MienError(Exception):
    """A mistake in what was asked for. The command line shows its text and ends with status 2."""


class UnknownNameError(MienError):
    """A name that nothing answers to; the text lists near matches."""

    def __init__(self, kind: str, name: str, known: Iterable[str]) -> None:
        known = list(known)
        lowered = {candidate.lower(): candidate for candidate in known}
        near = [lowered[match] for match in difflib.get_close_matches(name.lower(), lowered, n=3, cutoff=0.5)]
        if not near:
            near = [candidate for candidate in known if name and name.lower() in candidate.lower()][:3]
        if near:
            hint = "did you mean " + " or ".join(repr(match) for match in near) + "?"
        elif len(known) <= 12:
            hint = "there is " + (", ".join(known) or "none")
        else:
            hint = f"there are {len(known)}, from {known[0]!r} to {known[-1]!r}"
        super().__init__(f"unknown {kind} {name!r} — {hint}")
        self.kind, self.name = kind, name


class RangeError(MienError):
    """A number that is not finite or lies outside its range."""


class LoadError(MienError):
    """A file that cannot be understood, with the place where it goes wrong."""

    def __init__(self, path: Path | str, message: str, *, line: int | None = None, hint: str = "") -> None:
        place = f"{path}:{line}" if line is not None else f"{path}"
        super().__init__(f"{place}: {message}" + (f" — {hint}" if hint else ""))
        self.path, self.line = path, line
