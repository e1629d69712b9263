"""Faces by address, voices by name, and poses."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from os import PathLike, fspath
from typing import TYPE_CHECKING

from mien.core import (
    Face,
    Pose,
    RangeError,
    Scene,
    UnknownNameError,
    exaggeration,
    mix_people,
    random_person,
)
from mien.core.scene import FRONT

if TYPE_CHECKING:
    from mien.speech import Voice

DEFAULT_FACE = "head"


def warmup(report: Callable[[str], None] | None = None) -> None:
    """Load, and if need be compile, what would otherwise be compiled at its first use; the report hears of it."""
    from mien.compiling import load_kernels, on_compile
    from mien.compiling.listed import KERNELS

    if report is not None:
        on_compile(report)
    load_kernels(KERNELS)


def default_scene(face: Face | None = None) -> Scene:
    """The scene where none is asked for: a head is seen a little from its left, a drawing from straight before it."""
    drawn = face is not None and face.family == "toon"
    return Scene(position=FRONT) if drawn else Scene().seen("three-quarter")


def face_names() -> list[tuple[str, str]]:
    """(address, what it is) of every face that is installed."""
    from mien.faces.registry import face_names

    return face_names()


def load_face(address: str | PathLike[str] = DEFAULT_FACE) -> Face:
    """The face at an address: ``head``, ``head:NAME``, or a path to a face file.

    Raises:
        UnknownNameError: no face has that name.
        LoadError: the file is missing or not a face.
    """
    from mien.faces.registry import load_face

    return load_face(fspath(address))


def voices() -> Mapping[str, Voice]:
    """The voices that can speak on this machine, by name, the built-in one first."""
    from mien.speech import voices

    return voices()


def find_voice(name: str | None = None) -> Voice:
    """The voice of that name; the built-in one without a name.

    Raises:
        UnknownNameError: there is none of that name.
    """
    from mien.speech import find_voice

    return find_voice(name)


def make_pose(
    face: Face,
    values: Mapping[str, float] | None = None,
    *,
    presets: Mapping[str, float] | Iterable[str] = (),
    units: Mapping[str, float] | None = None,
    mix: Mapping[str, float] | None = None,
    seed: int | None = None,
    caricature: float = 1.0,
) -> Pose:
    """The pose of a face with presets, a later one over an earlier one, action units on top, and values over all.

    Args:
        face: who.
        values: of its parameters; motor codes of ToonFace (``ELU``) move any face that has a table for them.
        presets: names, or names with how much of each, 0..1: so much of the way from what lies beneath.
        units: action units of FACS, 0..1 by name.
        mix: addresses of other people, with the share 0..1 of each in this one.
        seed: of a person drawn by chance, in place of the face's own rest.
        caricature: times the distance of the person from the mean of people, before anything else acts, 0..3.

    Raises:
        UnknownNameError: a preset, a unit, a face or a parameter is unknown.
        RangeError: a value is not finite or out of its range, or there is no such amount of caricature.
        MienError: another person cannot be mixed in.
    """
    from mien.vocab import set_values

    pose = Pose.neutral(face.parameters) if seed is None else random_person(face, seed)
    pose = mix_people(pose, face, [(load_face(address), share) for address, share in (mix or {}).items()])
    pose = exaggeration.caricature(pose, caricature)
    amounts = presets if isinstance(presets, Mapping) else dict.fromkeys(presets, 1.0)
    for name, amount in amounts.items():
        if name not in face.presets:
            raise UnknownNameError(f"preset of {face.name!r}", name, face.presets)
        if not 0.0 <= amount <= 1.0:
            raise RangeError(f"preset {name!r}: {amount:g} is out of range — it goes from 0 to 1")
        pose = pose.blend(pose.replace(face.presets[name].values), amount)
    if units:
        pose = pose_from("facs", units, face, pose)
    return set_values(values or {}, face, pose)


def pose_from(
    vocabulary: str, values: Mapping[str, float], face: Face | str = DEFAULT_FACE, base: Pose | None = None
) -> Pose:
    """The pose of a face from values under other people's names: ``mien.pose_from("arkit", {"jawOpen": 0.4})``.

    Args:
        vocabulary: ``arkit``, ``facs``, ``vrm`` …: one of ``mien vocab``.
        values: by its names or their aliases.
        face: a face or its address.
        base: what the face looks like without the values; None is neutral.

    Raises:
        UnknownNameError: there is no such vocabulary or name.
        RangeError: a value is out of its name's range.
        MienError: the vocabulary has no table for this family of faces.
    """
    from mien.vocab import pose_from as make

    return make(vocabulary, values, load_face(face) if isinstance(face, str) else face, base)


def resolve(face: Face | str, pose: Pose | Mapping[str, float] | None) -> tuple[Face, Pose]:
    """A face by its address and a pose by its values, where they are given so."""
    face = load_face(face) if isinstance(face, str) else face
    return face, pose if isinstance(pose, Pose) else make_pose(face, pose)
