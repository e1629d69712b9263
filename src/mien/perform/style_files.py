"""Styles in files: an object of amounts in JSON, or a text with ``name=value`` on each line."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from pathlib import Path

from mien.core import LoadError, MienError

from .style import Style, Wish, parse_style


def load_style(text: str) -> Style:
    """The style in a file, for ``@FILE`` or a name that ends in ``.json``, or else in the text itself.

    Raises:
        MienError: as ``parse_style`` and ``read_style``.
    """
    if text.startswith("@") or text.lower().endswith(".json"):
        return read_style(text.removeprefix("@"))
    return parse_style(text)


def read_style(path: Path | str) -> Style:
    """The style in a file, JSON by its suffix or a text.

    A JSON file names the style that it starts from as ``"style": "mumbling"``, a text by its name alone. In a text
    commas stand for new lines, and ``#`` begins a comment.

    Raises:
        LoadError: the file cannot be read, or what is wrong with it and where.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise LoadError(path, f"is not UTF-8 text (byte {error.start})") from None
    except OSError as error:
        raise LoadError(path, f"cannot be read ({error.strerror})", hint="want a style file") from None
    wish = Wish()
    for line, part in _members(path, text) if path.suffix.lower() == ".json" else _lines(text):
        try:
            wish = wish.add(part)
        except MienError as error:
            raise LoadError(path, str(error), line=line) from None
    return wish.style()


def _lines(text: str) -> Iterable[tuple[int, str]]:
    for number, line in enumerate(text.splitlines(), start=1):
        for part in line.partition("#")[0].split(","):
            yield number, part


def _members(path: Path, text: str) -> Iterable[tuple[int | None, str]]:
    try:
        members = json.loads(text, object_pairs_hook=tuple)
    except json.JSONDecodeError as error:
        raise LoadError(path, f"column {error.colno}: {error.msg}", line=error.lineno, hint="want JSON") from None
    if not isinstance(members, tuple):
        raise LoadError(path, 'want an object of amounts, like {"jaw": 0.5, "blinks": "off"}')
    for name, value in members:
        line = _line_of(name, text)
        shown = "an object" if isinstance(value, tuple) else json.dumps(value)
        if not isinstance(value, bool | int | float | str):
            raise LoadError(path, f"{name}: want a number, true, false or a text, got {shown}", line=line)
        yield line, str(value) if name == "style" else f"{name}={value}"


def _line_of(name: str, text: str) -> int | None:
    """The last line that sets a member; one given twice is wrong there."""
    places = list(re.finditer(rf"{re.escape(json.dumps(name, ensure_ascii=False))}\s*:", text))
    return text.count("\n", 0, places[-1].start()) + 1 if places else None
