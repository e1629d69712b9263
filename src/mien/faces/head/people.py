"""Heads by name, and heads from files."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from mien.core import LoadError, MienError, UnknownNameError

from .hair import hair_styles
from .head import Head
from .jaw import SHARES
from .measured import archive
from .palettes import palette_presets
from .residual import Residual, read_residual
from .shipped import shipped_text
from .wear import NONE, beard_styles, glasses_styles

FORMAT, VERSION = "mien-face", 1
KEYS = {"format", "version", "name", "hair", "palette", "jaw", "values", "doc", "residual", "beard", "glasses"}


@cache
def people() -> Mapping[str, Mapping[str, str]]:
    """Rows of ``data/people.json``: name -> hair, beard, glasses, palette, jaw, doc."""
    rows: dict[str, dict[str, str]] = json.loads(shipped_text("people.json"))
    return rows


@cache
def shapes() -> Mapping[str, Mapping[str, float]]:
    """Rows of ``data/shapes.json``: name of a person -> values of the shape that are not at rest."""
    rows: dict[str, dict[str, float]] = json.loads(shipped_text("shapes.json"))
    return rows


def address(name: str) -> str:
    """How a shipped person is called for: ``head``, ``head:ada``."""
    return name if name == "head" else f"head:{name}"


@cache
def shipped_head(name: str) -> Head:
    """A person who ships with mien.

    Raises:
        UnknownNameError: there is nobody of that name.
    """
    if name not in people():
        raise UnknownNameError("head", name, people())
    row = people()[name]
    return make_head(address(name), {**DEFAULTS, **row}, shapes().get(name, {}))


def make_head(
    name: str, choices: Mapping[str, str], values: Mapping[str, float], residual: Residual | None = None
) -> Head:
    """A head from choices by name; ``values`` win over the palette. Mistakes show here, not in the first picture.

    ``choices`` are hair, beard, glasses, palette, jaw and doc.

    Raises:
        UnknownNameError, RangeError: a choice or value is not there or does not fit.
    """
    palettes = palette_presets()
    known = {
        "hair": ("hair style", hair_styles()),
        "beard": ("beard", beard_styles()),
        "glasses": ("glasses", glasses_styles()),
        "palette": ("palette", palettes),
        "jaw": ("jaw", SHARES),
    }
    for key, (kind, names) in known.items():
        if choices[key] not in names:
            raise UnknownNameError(kind, choices[key], names)
    head = Head(
        name,
        choices["hair"],
        {**palettes[choices["palette"]].values, **values},
        jaw=next(jaw for jaw in SHARES if jaw == choices["jaw"]),
        doc=choices["doc"],
        residual=residual,
        beard=choices["beard"],
        glasses=choices["glasses"],
    )
    _ = head.parameters
    return head


def read_head(path: Path) -> Head:
    """The head that a ``*.face.json`` describes: hair, palette, jaw and values of its own.

    Raises:
        LoadError: the file is not such a file, with the key that is wrong.
    """
    try:
        record = json.loads(path.read_text(encoding="utf-8-sig"))
    except json.JSONDecodeError as error:
        raise LoadError(path, f"not JSON: {error.msg}", line=error.lineno) from None
    except UnicodeDecodeError:
        raise LoadError(path, "not a text file in UTF-8") from None
    except OSError as error:
        raise LoadError(path, f"cannot be read: {error.strerror}") from None
    if not isinstance(record, dict) or record.get("format") != FORMAT:
        raise LoadError(path, f'want {{"format": "{FORMAT}", "version": {VERSION}, …}}', hint="is this a face file?")
    if record.get("version") != VERSION:
        raise LoadError(path, f"version {record.get('version')!r}, wanted {VERSION}", hint="another mien made it")
    try:
        for key in record:
            if key not in KEYS:
                raise UnknownNameError("key", key, sorted(KEYS))
        texts = {key: _text(record, key, default) for key, default in DEFAULTS.items()}
        beside = _text(record, "residual", "")
        residual = read_residual(path.parent / beside, len(archive().mirror)) if beside else None
        return make_head(str(path), texts, _values(record), residual)
    except LoadError:
        raise
    except MienError as error:
        raise LoadError(path, str(error)) from None


DEFAULTS = {
    "name": "",
    "hair": "side_part",
    "beard": NONE,
    "glasses": NONE,
    "palette": "beige",
    "jaw": "fitted",
    "doc": "",
}


def _text(record: Mapping[str, object], key: str, default: str) -> str:
    value = record.get(key, default)
    if not isinstance(value, str):
        raise MienError(f"{key}: want a text, got {value!r}")
    return value


def _values(record: Mapping[str, object]) -> dict[str, float]:
    values = record.get("values", {})
    if not isinstance(values, dict):
        raise MienError(f"values: want {{name: number, …}}, got {values!r}")
    out = {}
    for name, value in values.items():
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise MienError(f"values[{name!r}]: want a number, got {value!r}")
        out[str(name)] = float(value)
    return out
