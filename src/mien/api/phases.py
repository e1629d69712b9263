"""Films through measured phases, as Parke's animation program of 1972 made them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mien.core import Face, MienError, Scene, UnknownNameError
from mien.timeline import Layer, Rate, Timeline, Track
from mien.timeline.rates import exact_rate, time_of

from .faces import default_scene, load_face

if TYPE_CHECKING:
    from mien.faces.keypose import KeyposeFace
    from mien.perform import Performance

MOST_FRAMES = 100_000


def load_phases(sources: Sequence[str]) -> KeyposeFace:
    """The measured face at an address, or of a topology file and its phase files, in millimetres, half a face.

    Args:
        sources: one address; or the name of a topology file and of one or more phase files.

    Raises:
        LoadError, UnknownNameError: a file cannot be understood, or no face has that name.
        MienError: the face is not made of phases.
    """
    from mien.faces.keypose import KeyposeFace
    from mien.faces.keypose.files import read_phase, read_topology
    from mien.faces.keypose.records import Keypose

    if len(sources) == 1:
        return _measured(load_face(sources[0]))
    paths = [Path(source) for source in sources]
    topology = read_topology(paths[0])
    places = np.stack([read_phase(path, topology.point_count) for path in paths[1:]])
    if topology.midline:
        places[:, np.array(topology.midline) - 1, 0] = 0.0
    names = _distinct([path.name.removesuffix(".phase") for path in paths[1:]])
    keypose = Keypose(paths[0].stem, topology, names, places, mirror=bool(topology.midline))
    return KeyposeFace(keypose, str(paths[0]))


def order_phases(face: Face, names: Sequence[str]) -> KeyposeFace:
    """The face with phases in another order, some of them left out, some of them several times.

    Args:
        face: a measured one.
        names: of phases, or their numbers from 1.

    Raises:
        UnknownNameError: it has no such phase.
    """
    measured = _measured(face)
    keypose = measured.keypose
    known = {str(number): name for number, name in enumerate(keypose.phases, start=1)}
    chosen = [known.get(name, name) for name in names]
    for name in chosen:
        if name not in keypose.phases:
            raise UnknownNameError(f"phase of {face.name!r}", name, keypose.phases)
    rows = [keypose.phases.index(name) for name in chosen]
    return replace(
        measured,
        keypose=replace(
            keypose, phases=_distinct(chosen), places=keypose.places[rows], stands_for={}, sided=(), eyes=None
        ),
    )


def film_phases(face: Face, between: int, *, fps: Rate = 24, scene: Scene | None = None) -> Performance:
    """A film from the first phase of a face to its last, with so many frames between each phase and the next.

    Source: Parke 1972, "Animation": every frame has a phase number; the face takes its cosine.

    Raises:
        MienError: there is nothing between the phases of the face, or no such number of frames.
    """
    from mien.perform import Performance

    measured = _measured(face)
    count = len(measured.keypose.phases)
    if count < 2:
        raise MienError(f"{face.name}: has one phase — a film goes from one to another")
    steps = (count - 1) * (between + 1)
    if between < 0 or steps > MOST_FRAMES:
        raise MienError(f"{between} frames between phases: want 0 or more, and at most {MOST_FRAMES} in all")
    end_s, length_s = (float(time_of(frames, exact_rate(fps))) for frames in (steps, steps + 1))
    track = Track.from_keys([0.0, end_s], [1.0, float(count)], "linear", name="phase.number")
    timeline = Timeline(
        (Layer("phases", "replace", {"phase.number": track}),), length_s, fps=float(fps), title=face.name
    )
    return Performance(timeline, measured, scene=scene or default_scene(face))


def _measured(face: Face) -> KeyposeFace:
    from mien.faces.keypose import KeyposeFace

    if not isinstance(face, KeyposeFace):
        raise MienError(f"{face.name}: is not made of measured phases — 'mien faces' lists those that are: keypose:…")
    return face


def _distinct(names: Sequence[str]) -> tuple[str, ...]:
    """The names, with the number of its place after one that was there before."""
    return tuple(f"{name}_{k + 1}" if name in names[:k] else name for k, name in enumerate(names))
