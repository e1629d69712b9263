"""Speech, and faces that say or play something."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from mien.core import (
    Face,
    Pose,
    Scene,
)
from mien.timeline import Rate, with_settings

from .faces import DEFAULT_FACE, default_scene, load_face

if TYPE_CHECKING:
    from mien.perform import Performance, Style
    from mien.speech import Speech
    from mien.speech.speaking import Report


def speak(text: str, voice: str | None = None, *, report: Report | None = None) -> Speech:
    """The text said by a voice: sound, words and phones with their times, and what could not be said.

    Marks such as ``[smile]`` and ``<break time="500ms"/>`` are not said but kept for ``perform``.

    Raises:
        MienError: there is nothing to say, or a mark cannot be understood.
        UnknownNameError: there is no such voice.
    """
    from mien.perform import parse_marks
    from mien.speech import speak

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
    from mien.formats.sound_files import read_sound
    from mien.perform import parse_marks
    from mien.speech import hear

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
        scene: where it is seen from; None is ``default_scene``.
    """
    from mien.perform import load_style
    from mien.perform import perform as make

    face = load_face(face) if isinstance(face, str) else face
    manner = load_style(style or "") if style is None or isinstance(style, str) else style
    performance = make(speech, face, seed=seed, style=manner, emotion=emotion, emotion_amount=emotion_amount)
    timeline = performance.timeline if pose is None else with_settings(performance.timeline, pose)
    return replace(performance, timeline=timeline, scene=scene or default_scene(face))


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
    from mien.perform import check_emotion, check_marks, load_style, parse_marks

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
    from mien.formats.timeline_files import read_timeline
    from mien.perform import Performance

    def find(address: str) -> Face:
        return face if face is not None and not isinstance(face, str) else load_face(address)

    stored = read_timeline(path, find, face if isinstance(face, str) else None, fps=fps)
    if report and face is None and not stored.same_table:
        report(f"{path}: made with another version of {stored.face.name!r}; frames may differ from those of then")
    return Performance(stored.timeline, stored.face, stored.sound, stored.scene or default_scene(stored.face))
