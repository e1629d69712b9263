"""Folders ``NAME.keypose``: ``keypose.toml``, ``topology.txt`` and a ``.phase`` file for each phase.

Source: Parke 1972, "The animation program" (data files for topology and phases).
"""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from itertools import pairwise
from pathlib import Path

import numpy as np

from mien.core import LoadError, MienError
from mien.core.mesh import Points

from .lines import read_text
from .phase_file import format_phase, read_phase
from .records import UNITS_M, Keypose, KeyposeTopology
from .settings import FORMAT, VERSION, Settings, read_settings
from .topology_file import format_topology, read_topology

__all__ = ["SUFFIX", "read_doc", "read_keypose", "read_phase", "read_topology", "write_keypose"]

SUFFIX = ".keypose"
SETTINGS, TOPOLOGY, PHASE = "keypose.toml", "topology.txt", ".phase"

ON_MIDLINE_M = 0.003
"""A point of the midline that was measured further from x = 0 is no point of the midline."""

INSIDE_OUT = -0.5
"""Share of the surface, weighted by distance from the middle, that faces inwards where polygons go the wrong way."""


def read_keypose(folder: Path) -> Keypose:
    """The measured face in a folder.

    Raises:
        LoadError: with the file and the line that is wrong.
    """
    if not folder.is_dir():
        raise LoadError(folder, "there is no such folder")
    for name in (SETTINGS, TOPOLOGY):
        if not (folder / name).is_file():
            raise LoadError(folder, f"has no {name}", hint="docs/keypose-format.md tells what such a folder holds")
    settings = read_settings(folder / SETTINGS, read_text(folder / SETTINGS))
    topology = read_topology(folder / TOPOLOGY)
    for name in settings.phases:
        if not (folder / f"{name}{PHASE}").is_file():
            raise LoadError(folder / SETTINGS, f"names the phase {name!r}, but there is no {name}{PHASE}")
    places = [read_phase(folder / f"{name}{PHASE}", topology.point_count, settings.unit) for name in settings.phases]
    if settings.mirror:
        _check_half(folder, settings, topology, places)
    keypose = _join(settings, topology, np.stack(places), folder)
    _check_outside(folder, keypose)
    return keypose


def read_doc(folder: Path) -> str:
    """Who the face in a folder is, in a line.

    Raises:
        LoadError: its settings cannot be read.
    """
    return read_settings(folder / SETTINGS, read_text(folder / SETTINGS)).doc


def _join(settings: Settings, topology: KeyposeTopology, places: Points, folder: Path) -> Keypose:
    eyes = settings.eyes
    if eyes is not None and eyes.part not in [part.name for part in topology.parts]:
        raise LoadError(folder / SETTINGS, f"eyes.part: there is no part {eyes.part!r} in {TOPOLOGY}")
    if settings.mirror and topology.midline:
        places = places.copy()
        places[:, np.array(topology.midline) - 1, 0] = 0.0
    name = settings.name or folder.name.removesuffix(SUFFIX)
    return Keypose(
        name,
        topology,
        settings.phases,
        places,
        settings.mirror,
        settings.doc,
        settings.unit,
        settings.stands_for,
        settings.sided,
        settings.pivot,
        eyes,
        settings.neck,
    )


def _check_half(folder: Path, settings: Settings, topology: KeyposeTopology, places: list[Points]) -> None:
    middle = np.zeros(topology.point_count, dtype=np.bool_)
    middle[[point - 1 for point in topology.midline]] = True
    for name, each in zip(settings.phases, places, strict=True):
        off = np.flatnonzero(middle & (np.abs(each[:, 0]) > ON_MIDLINE_M))
        if len(off):
            x = each[off[0], 0] / UNITS_M[settings.unit]
            raise LoadError(
                folder / f"{name}{PHASE}",
                f"point {off[0] + 1} is on the midline, but its x is {x:g} {settings.unit}",
                hint="x = 0 is the plane of symmetry",
            )
    half = places[0][~middle, 0]
    if len(half) and (half < 0.0).mean() > 0.5:
        raise LoadError(
            folder / f"{settings.phases[0]}{PHASE}",
            "is a right half: most of its points have x below 0",
            hint="x goes to the face's own left; change the sign of x, and go around the polygons the other way",
        )
    for polygon in topology.polygons:
        if middle[np.array(polygon.points) - 1].all():
            raise LoadError(folder / TOPOLOGY, "all points of a polygon are on the midline", line=polygon.line)


def _check_outside(folder: Path, keypose: Keypose) -> None:
    """Polygons that go the wrong way around would all be seen from behind, that is not at all."""
    rest = keypose.places[0]
    middle = (rest.min(axis=0) + rest.max(axis=0)) * 0.5
    if keypose.mirror:
        middle[0] = 0.0
    fans = [
        (polygon.points[0], one, other)
        for part in keypose.topology.parts
        for polygon in (part.polygons if not part.material.two_sided else ())
        for one, other in pairwise(polygon.points[1:])
    ]
    a, b, c = (rest[np.array(fans, dtype=np.int64).reshape(-1, 3) - 1] - middle).transpose(1, 0, 2)
    outwards = (np.cross(c - a, b - a) * (a + b + c)).sum(axis=1)
    facing, size = float(outwards.sum()), float(np.abs(outwards).sum())
    if facing < INSIDE_OUT * size:
        raise LoadError(
            folder / TOPOLOGY, "is inside out", hint="go around every polygon clockwise as seen from outside"
        )


def write_keypose(folder: Path | str, keypose: Keypose) -> None:
    """Writes a measured face as a folder; an older one of the same name gives way when the new one is whole.

    Raises:
        MienError: the folder cannot be written, holds something else, or does not end in ``.keypose``; or what would
            be written could not be read again.
    """
    target = Path(folder)
    if target.suffix != SUFFIX:
        raise MienError(f"{target}: folders of measured faces end in {SUFFIX} — name it {target.name}{SUFFIX}")
    if not target.parent.is_dir():
        raise MienError(f"{target}: the folder {str(target.parent)!r} does not exist — make it first")
    if target.exists() and not (target.is_dir() and _is_ours(target)):
        raise MienError(
            f"{target}: holds other things than a measured face and would be replaced — name another folder"
        )
    with ExitStack() as stack:
        try:
            beside = Path(tempfile.mkdtemp(prefix=".mien-", suffix=SUFFIX, dir=target.parent))
            stack.callback(shutil.rmtree, beside, ignore_errors=True)
            new, old = beside / target.name, beside / "old"
            new.mkdir()
            for name, text in _texts(keypose).items():
                (new / name).write_text(text, encoding="utf-8", newline="\n")
            _check_readable(new, target)
            if target.exists():
                target.rename(old)
            try:
                new.rename(target)
            except OSError:
                if old.exists():
                    old.rename(target)
                raise
        except OSError as error:
            raise MienError(f"{target}: cannot be written: {error.strerror} — write somewhere else") from None


def _check_readable(new: Path, target: Path) -> None:
    """Nothing, when what was written can be read; names the places where it will lie."""
    try:
        read_keypose(new)
    except LoadError as error:
        raise MienError(str(error).replace(str(new), str(target))) from None


def _is_ours(folder: Path) -> bool:
    names = [entry.name for entry in folder.iterdir()]
    return all(name in (SETTINGS, TOPOLOGY) or name.endswith(PHASE) for name in names)


def _texts(keypose: Keypose) -> Mapping[str, str]:
    """Text of each file of a folder."""
    phases = {
        f"{name}{PHASE}": format_phase(places, keypose.unit)
        for name, places in zip(keypose.phases, keypose.places, strict=True)
    }
    return {SETTINGS: _settings_text(keypose), TOPOLOGY: format_topology(keypose.topology), **phases}


def _settings_text(keypose: Keypose) -> str:
    def text(value: str) -> str:
        return json.dumps(value, ensure_ascii=False)  # what TOML takes as well

    def place(vector: Iterable[float]) -> str:
        return "[" + ", ".join(repr(round(x / UNITS_M[keypose.unit], 9)) for x in vector) + "]"

    lines = [f'format = "{FORMAT}"', f"version = {VERSION}", f"name = {text(keypose.name)}"]
    lines += [f"doc = {text(keypose.doc)}"] if keypose.doc else []
    lines += [f'unit = "{keypose.unit}"', f"phases = [{', '.join(map(text, keypose.phases))}]"]
    lines.append(f"mirror = {str(keypose.mirror).lower()}")
    lines += [f"sided = [{', '.join(map(text, keypose.sided))}]"] if keypose.sided else []
    lines += [f"pivot = {place(keypose.pivot)}"] if keypose.pivot else []
    lines += [f"neck = {place(keypose.neck)}"] if keypose.neck else []
    if keypose.eyes:
        lines += ["", "[eyes]", f"part = {text(keypose.eyes.part)}", f"center = {place(keypose.eyes.center)}"]
    if keypose.stands_for:
        lines += ["", "[stands_for]", *(f"{text(own)} = {text(name)}" for own, name in keypose.stands_for.items())]
    return "\n".join([*lines, ""])
