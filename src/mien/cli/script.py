"""``mien say --script``: several speakers from a file, in a film each, or in one film that cuts to whoever speaks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from .stages import Stages
from .writing import write

if TYPE_CHECKING:
    from mien.core import Face, Pose, Scene
    from mien.formats.cuts import Cut
    from mien.perform import Script, Style
    from mien.perform.dialogue import Dialogue, Turn
    from mien.timeline import Rate

SPEAKER = "%s"
"""In the name of OUT, the name of the speaker; without it there is one film."""


@dataclass(frozen=True, eq=False)
class Job:
    """What is asked for besides the script.

    Attributes:
        out: a file, or a pattern with ``SPEAKER``.
        subtitles: a file, a pattern or ``burn``.
        face: of speakers without one.
        voice: likewise.
        emotion: that all begin with, as in a script; empty for none.
        pose: of a face while nothing moves it.
        exaggerate: times the distance from rest of all that expresses something.
    """

    out: Path
    scene: Scene
    fps: Rate
    threads: int | None
    subtitles: str | None
    variable: bool
    face: str
    voice: str | None
    emotion: str
    seed: int
    style: Style
    pose: Callable[[Face], Pose]
    exaggerate: float


def say_script(path: Path, job: Job, stages: Stages) -> None:
    """Lets the speakers of a script say their lines.

    Raises:
        MienError: something in the script or the options does not suit; nothing is written then.
    """
    from mien.perform import exaggerate, read_script
    from mien.perform.dialogue import converse
    from mien.timeline import with_settings

    script = _begin_with(job.emotion, read_script(path))
    kinds = {name: _check_out(job, name) for name in _names(script, job)}
    faces = _load_faces(script, job)
    poses = {name: job.pose(face) for name, face in faces.items()}
    turns = list(_speak(script, job, stages))
    with stages.stage("moving the faces"):
        dialogue = converse(turns, faces, seed=job.seed, style=job.style)
        parts = {
            name: exaggerate(
                replace(part, timeline=with_settings(part.timeline, poses[name]), scene=job.scene), job.exaggerate
            )
            for name, part in dialogue.parts.items()
        }
    dialogue = replace(dialogue, parts=parts, heard=replace(dialogue.heard, scene=job.scene))
    for name, kind in kinds.items():
        _write(dialogue, name, kind, job, stages)


def _names(script: Script, job: Job) -> tuple[str, ...]:
    """The speakers whose films are wanted; one without a name where all are in one film."""
    return script.speakers if SPEAKER in job.out.name else ("",)


def _begin_with(emotion: str, script: Script) -> Script:
    """The script whose speakers begin with an emotion unless they have one of their own."""
    first = {line.speaker: line for line in reversed(script.lines)}
    return replace(
        script,
        lines=tuple(
            replace(line, emotion=line.emotion or emotion) if line is first[line.speaker] else line
            for line in script.lines
        ),
    )


def _check_out(job: Job, name: str) -> str:
    """The format of a speaker's film, after making sure that it can be written."""
    from mien.core import MienError
    from mien.formats import check_performance
    from mien.formats.performances import DRAWN, HEARD

    if name in (".", "..") or any(sign in name for sign in '/\\:*?"<>|%\0'):
        raise MienError(f"speaker {name!r}: makes no name of a file — take another, or one film for all: {job.out}")
    if job.subtitles not in (None, "burn") and name and SPEAKER not in str(job.subtitles):
        raise MienError(f"--subtitles {job.subtitles}: every film needs its own — write {SPEAKER} in its name too")
    kind = check_performance(
        _fill(job.out, name), fps=job.fps, scene=job.scene, subtitles=_subtitles(job, name), variable=job.variable
    )
    if not name and kind not in (*DRAWN, *HEARD):
        raise MienError(
            f"{job.out}: is of one face only — write {SPEAKER} for the speaker's name in it, as in talk_{SPEAKER}.json"
        )
    return kind


def _fill(out: Path, name: str) -> Path:
    return out.with_name(out.name.replace(SPEAKER, name))


def _subtitles(job: Job, name: str) -> str | None:
    return job.subtitles if job.subtitles is None else job.subtitles.replace(SPEAKER, name)


def _load_faces(script: Script, job: Job) -> Mapping[str, Face]:
    """Faces by speaker, after making sure that each can do what is asked of it, and that there are the voices."""
    from mien import api
    from mien.core import MienError
    from mien.perform import check_marks, parse_marks

    faces: dict[str, Face] = {}
    api.find_voice(job.voice)
    for line in script.lines:
        name, column = line.speaker, "face"
        try:
            if name not in faces:
                faces[name] = api.load_face(script.faces.get(name, job.face))
                column = "voice"
                api.find_voice(script.voices.get(name, job.voice))
            column = "line"
            check_marks(parse_marks(line.text), faces[name])
            column = "emotion"
            check_marks(parse_marks(line.script), faces[name])
        except MienError as error:
            raise script.mistake(line.row, column, error) from None
    return faces


def _speak(script: Script, job: Job, stages: Stages) -> Iterator[Turn]:
    from mien import api
    from mien.core import MienError
    from mien.perform.dialogue import Turn

    total = sum(len(line.script) for line in script.lines)
    done = 0
    with stages.progress("speaking") as report:
        for line in script.lines:
            before = done

            def tell(part: int, whole: int, doing: str, before: int = before) -> None:
                report(before + part, total)

            try:
                speech = api.speak(line.script, script.voices.get(line.speaker, job.voice), report=tell)
            except MienError as error:
                raise script.mistake(line.row, "line", error) from None
            if speech.skipped:
                stages.say(
                    f"{script.path}:{line.row}: not spoken, because the voice {speech.voice!r} cannot: "
                    f"{' '.join(speech.skipped)}"
                )
            done += len(line.script)
            yield Turn(line.speaker, speech)


def _write(dialogue: Dialogue, name: str, kind: str, job: Job, stages: Stages) -> None:
    from mien.formats.cuts import Cut

    cuts: tuple[Cut, ...] = ()
    if not name:
        cuts = tuple(
            Cut(start_s, dialogue.parts[who].timeline, dialogue.parts[who].face) for start_s, who in dialogue.turns
        )
    write(
        dialogue.parts[name] if name else dialogue.heard,
        _fill(job.out, name),
        kind,
        stages,
        fps=job.fps,
        threads=job.threads,
        subtitles=_subtitles(job, name),
        variable=job.variable,
        cuts=cuts,
    )
