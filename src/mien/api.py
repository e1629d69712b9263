"""What a program calls: load a face, draw it, let it speak."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING

from .core import (
    Drawing,
    Face,
    Mesh,
    MienError,
    Pose,
    RangeError,
    Scene,
    UnknownNameError,
    exaggeration,
    fill_rows,
    mix_people,
    random_person,
    subdivide,
)
from .formats.notes import notes
from .formats.performances import PUPPET_SCENE, default_threads
from .timeline import Rate, with_settings

if TYPE_CHECKING:
    from .formats.glb import Puppet
    from .formats.obj import Model
    from .formats.picture import Picture
    from .formats.svg import VectorPicture
    from .perform import Performance, Style
    from .speech import Speech, Voice
    from .speech.speaking import Report

DEFAULT_FACE = "head"


def warmup(report: Callable[[str], None] | None = None) -> None:
    """Load, and if need be compile, what would otherwise be compiled at its first use; the report hears of it."""
    from .compiling import load_kernels, on_compile
    from .compiling.listed import KERNELS

    if report is not None:
        on_compile(report)
    load_kernels(KERNELS)


def default_scene() -> Scene:
    """The scene where none is asked for: seen a little from its left."""
    return Scene().seen("three-quarter")


def face_names() -> list[tuple[str, str]]:
    """(address, what it is) of every face that is installed."""
    from .faces.registry import face_names

    return face_names()


def load_face(address: str | PathLike[str] = DEFAULT_FACE) -> Face:
    """The face at an address: ``head``, ``head:NAME``, or a path to a face file.

    Raises:
        UnknownNameError: no face has that name.
        LoadError: the file is missing or not a face.
    """
    from .faces.registry import load_face

    return load_face(fspath(address))


def voices() -> Mapping[str, Voice]:
    """The voices that can speak on this machine, by name, the built-in one first."""
    from .speech import voices

    return voices()


def find_voice(name: str | None = None) -> Voice:
    """The voice of that name; the built-in one without a name.

    Raises:
        UnknownNameError: there is none of that name.
    """
    from .speech import find_voice

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
    from .vocab import set_values

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
    from .vocab import pose_from as make

    return make(vocabulary, values, load_face(face) if isinstance(face, str) else face, base)


def draw(
    face: Face | str = DEFAULT_FACE,
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
    *,
    without: Collection[str] = (),
    threads: int | None = None,
) -> Picture:
    """A picture of a face: it can be written, and shows itself in a notebook.

    Args:
        face: a face or its address.
        pose: a pose of it, or the values that differ from neutral.
        scene: where it is seen from, light, size; None is a slight three-quarter view.
        without: parts to leave out, as ``hair`` or ``eye.left``.
        threads: None is one a core; the picture does not depend on it.

    Raises:
        UnknownNameError: a part to be left out is not there.
    """
    from .formats.picture import Picture
    from .render import draw as draw_pixels
    from .render import draw_mesh

    face, pose = _resolve(face, pose)
    scene, threads = scene or default_scene(), threads or default_threads()
    if without:
        mesh = _posed_mesh(face, pose, scene)
        return Picture(draw_mesh(mesh.without(without), scene, threads=threads), notes(face.name))
    return Picture(draw_pixels(face, pose, scene, threads=threads), notes(face.name))


def draw_paths(
    face: Face | str = DEFAULT_FACE,
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
) -> VectorPicture:
    """A picture made of filled paths, one shade a polygon: written as SVG it is sharp at every size.

    Args:
        face: a face or its address.
        pose: a pose of it, or the values that differ from neutral.
        scene: as for ``draw``; None is a slight three-quarter view with one step of subdivision.
    """
    from .formats.svg import VectorPicture
    from .render.painting import paint_mesh

    face, pose = _resolve(face, pose)
    scene = scene or replace(default_scene(), subdivide=1)
    shape = _posed(face, pose, scene)
    if isinstance(shape, Drawing):
        return VectorPicture(shape, scene, notes=notes(face.name))
    return VectorPicture(paint_mesh(shape, scene), scene, polygons=True, notes=notes(face.name))


def make_model(
    face: Face | str = DEFAULT_FACE,
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
) -> Model:
    """The posed mesh of a face, to be written as OBJ.

    Args:
        face: a face or its address.
        pose: a pose of it, or the values that differ from neutral.
        scene: says how often the mesh is subdivided, and where the eyes look; None as for ``draw``.

    Raises:
        MienError: the face is a flat drawing and has no mesh.
    """
    from .formats.obj import Model

    face, pose = _resolve(face, pose)
    return Model(_posed_mesh(face, pose, scene or default_scene()), notes(face.name))


def make_puppet(
    face: Face | str = DEFAULT_FACE,
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
) -> Puppet:
    """A face that other programs can play, to be written as ``.glb``: its mesh, morph targets and joints.

    Args:
        face: a face or its address.
        pose: what it looks like while no target acts, or the values that differ from neutral.
        scene: says how often the mesh is subdivided, and where the eyes look; None is once, and ahead.

    Raises:
        MienError: the face is a flat drawing, has no joints, or no table for the names of the targets.
    """
    from .formats.glb import Puppet
    from .formats.glb_targets import Anatomy, check_face

    face, pose = _resolve(face, pose)
    scene = scene or PUPPET_SCENE
    check_face(face)
    return Puppet(Anatomy(face, fill_rows(face, pose, scene), scene.subdivide), notes(face.name))


def sheet(
    face: Face | str = DEFAULT_FACE,
    kind: str = "presets",
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
    *,
    threads: int | None = None,
    report: Callable[[int, int], None] | None = None,
) -> Picture:
    """A page of labelled pictures of a face, made from its own tables.

    Args:
        face: a face or its address.
        kind: ``presets``, ``parameters`` at the ends of their ranges, ``views``, or a vocabulary such as ``facs``.
        pose: what every picture starts from, or the values that differ from neutral.
        scene: light, shading, size of one picture, where it is seen from; None is a near view, 256 pixels wide.
        threads: None is one a core; the picture does not depend on it.
        report: told (done, total) pictures.

    Raises:
        UnknownNameError: there is no such kind.
        MienError: there is nothing to show, or the page would be too large.
    """
    from .formats.face_sheets import make_sheet

    face, pose = _resolve(face, pose)
    return make_sheet(face, kind, pose, scene, threads=threads or default_threads(), report=report)


def speak(text: str, voice: str | None = None, *, report: Report | None = None) -> Speech:
    """The text said by a voice: sound, words and phones with their times, and what could not be said.

    Marks such as ``[smile]`` and ``<break time="500ms"/>`` are not said but kept for ``perform``.

    Raises:
        MienError: there is nothing to say, or a mark cannot be understood.
        UnknownNameError: there is no such voice.
    """
    from .perform import parse_marks
    from .speech import speak

    marked = parse_marks(text)
    return replace(speak(marked.text, voice, pauses=marked.pauses, report=report), script=text)


def hear(path: Path | str, text: str | None = None, *, language: str = "en", report: Report | None = None) -> Speech:
    """What is said in a recording or film: its sound, words and phones with their times.

    ``mien.speech.hear`` tells besides how sure each word is, and where text and sound differ.

    Args:
        path: WAV, MP3, OGG, FLAC, M4A, a film.
        text: what is said, with marks if you like; without it the words are recognised, less surely; only in English.
        language: in which it is said: ``de``, ``pt-BR``; all but English need ``pip install 'mien[espeak]'``.
        report: told (seconds done, seconds in all, what is being done).

    Raises:
        LoadError: the file holds no sound that can be read.
        MienError: no word is heard, or another text than the given one.
    """
    from .formats.sound_files import read_sound
    from .perform import parse_marks
    from .speech import hear

    sound = read_sound(path)
    if text is None:
        return hear(sound, language=language, report=report).speech
    return replace(hear(sound, parse_marks(text).text, language=language, report=report).speech, script=text)


def perform(
    speech: Speech,
    face: Face | str = DEFAULT_FACE,
    *,
    seed: int = 0,
    style: Style | str | None = None,
    emotion: str | None = None,
    emotion_amount: float = 1.0,
    pose: Pose | None = None,
    scene: Scene | None = None,
) -> Performance:
    """What a face does while it says something, with the sound; ``write`` makes a film of it.

    Args:
        speech: what ``speak`` gave.
        face: a face or its address.
        seed: of blinks, small movements and brows.
        style: how lively: amounts, or a text as after ``--style``; None is the usual.
        emotion: a preset of the face that shows through.
        emotion_amount: how much of it, 0..1.
        pose: what the face looks like while nothing moves it; None is neutral.
        scene: where it is seen from; None is a slight three-quarter view.
    """
    from .perform import load_style
    from .perform import perform as make

    face = load_face(face) if isinstance(face, str) else face
    manner = load_style(style or "") if style is None or isinstance(style, str) else style
    performance = make(speech, face, seed=seed, style=manner, emotion=emotion, emotion_amount=emotion_amount)
    timeline = performance.timeline if pose is None else with_settings(performance.timeline, pose)
    return replace(performance, timeline=timeline, scene=scene or default_scene())


def say(
    text: str,
    face: Face | str = DEFAULT_FACE,
    *,
    voice: str | None = None,
    seed: int = 0,
    style: Style | str | None = None,
    emotion: str | None = None,
    emotion_amount: float = 1.0,
    pose: Pose | None = None,
    scene: Scene | None = None,
) -> Performance:
    """A face that says a text: ``mien.say("Hello there. [smile] How *are* you?").write("hello.mp4")``.

    The guide lists the marks that a text can have.
    """
    from .perform import check_emotion, check_marks, load_style, parse_marks

    face = load_face(face) if isinstance(face, str) else face
    style = load_style(style) if isinstance(style, str) else style
    if emotion is not None:
        check_emotion(face, emotion, emotion_amount)
    check_marks(parse_marks(text), face)
    speech = speak(text, voice)
    return perform(
        speech, face, seed=seed, style=style, emotion=emotion, emotion_amount=emotion_amount, pose=pose, scene=scene
    )


def play(
    path: Path | str,
    face: Face | str | None = None,
    *,
    fps: Rate | None = None,
    report: Callable[[str], None] | None = None,
) -> Performance:
    """The performance in a ``.json``, ``.csv`` or ``.spec`` file, with its sound if it has one.

    Args:
        path: the file.
        face: who plays it; None is the face it was made for, or the head.
        fps: what a column ``frame`` of a CSV file counts in.
        report: told when the face is no longer the one that the file was made with.

    Raises:
        LoadError: the file cannot be understood, or does not fit the face.
    """
    from .formats.timeline_files import read_timeline
    from .perform import Performance

    def find(address: str) -> Face:
        return face if face is not None and not isinstance(face, str) else load_face(address)

    stored = read_timeline(path, find, face if isinstance(face, str) else None, fps=fps)
    if report and face is None and not stored.same_table:
        report(f"{path}: made with another version of {stored.face.name!r}; frames may differ from those of then")
    return Performance(stored.timeline, stored.face, stored.sound, stored.scene or default_scene())


def _resolve(face: Face | str, pose: Pose | Mapping[str, float] | None) -> tuple[Face, Pose]:
    face = load_face(face) if isinstance(face, str) else face
    return face, pose if isinstance(pose, Pose) else make_pose(face, pose)


def _posed(face: Face, pose: Pose, scene: Scene) -> Mesh | Drawing:
    """What a scene shows of a face: rows at rest filled from the scene, subdivided as it asks."""
    shape = (face if scene.subdivide else face.unsubdivided).shape(fill_rows(face, pose, scene))
    return shape if isinstance(shape, Drawing) else subdivide(shape, scene.subdivide)


def _posed_mesh(face: Face, pose: Pose, scene: Scene) -> Mesh:
    shape = _posed(face, pose, scene)
    if isinstance(shape, Drawing):
        raise MienError(f"{face.name}: is a flat drawing and has no mesh — write it as .svg")
    return shape
