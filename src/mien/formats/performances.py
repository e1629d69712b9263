"""A performance written as a film, frames, sound or data; the suffix decides."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from mien.core import Face, MienError, Scene, Sound, UnknownNameError
from mien.timeline import Rate, Timeline, exact_rate
from mien.timeline.rates import time_of

from .atomic import check_file, writing
from .cuts import Cut, cut_poses
from .notes import notes
from .pipeline import at_once, run_ahead
from .rates import DEFAULT_FPS, check_film, check_rate
from .subtitle_files import write_subtitles
from .subtitles import Subtitle, make_subtitles
from .table import find_format

if TYPE_CHECKING:
    from .burning import Burner

BURN = "burn"
"""In the place of a subtitle file's name: subtitles are drawn into the pictures."""

DRAWN = ("film", "folder", "series")
"""Formats that consist of pictures."""

HEARD = ("wav", "subtitles", "textgrid")
"""Formats that need nothing but what is heard."""

PUPPET_SCENE = Scene(subdivide=1)
"""Of a ``.glb``, which others see with cameras of their own: the eyes look ahead."""

BESIDE = ("json", "glb")
"""Formats that name a file with the sound, which lies beside them."""

Frames = Generator[NDArray[np.uint8], None, None]

Report = Callable[[int, int], None]
"""Told how many frames of how many are done."""


class Performance(Protocol):
    """A timeline with the face that plays it, its sound, and how it is looked at."""

    @property
    def timeline(self) -> Timeline: ...  # noqa: D102
    @property
    def face(self) -> Face: ...  # noqa: D102
    @property
    def sound(self) -> Sound | None: ...  # noqa: D102
    @property
    def scene(self) -> Scene: ...  # noqa: D102


def check_performance(
    path: Path | str,
    *,
    fps: Rate = DEFAULT_FPS,
    scene: Scene | None = None,
    subtitles: Path | str | None = None,
    variable: bool = False,
) -> str:
    """Name of the format that ``path`` asks for, after making sure that it can be written there.

    Raises:
        MienError: the suffix is unknown, a place cannot be written, or rate, size, background or subtitles do not suit.
    """
    from .series import check_series

    path, scene = Path(path), scene or Scene()
    kind = (
        "series" if path.suffix.lower() == ".png" and not os.path.isdir(path) else find_format(path, "performance").name
    )
    check_rate(fps)
    if variable and kind != "film":
        raise MienError(f"{path}: only the pictures of a film can stay for different times — write .mp4 or .webm")
    if kind in ("series", "folder"):
        check_series(path)
    else:
        check_file(path)
    if kind == "film":
        check_film(path, fps, scene.size_px, is_transparent(scene))
    if kind in BESIDE:
        check_file(path.with_suffix(".wav"))
    if subtitles is not None:
        _check_subtitles(subtitles, path, kind, scene)
    return kind


def _check_subtitles(subtitles: Path | str, path: Path, kind: str, scene: Scene) -> None:
    from .burning import check_size

    if str(subtitles) != BURN:
        if not Path(subtitles).suffix:
            raise UnknownNameError("subtitles", str(subtitles), [BURN, "FILE.srt", "FILE.vtt"])
        find_format(subtitles, "subtitles")
        if Path(subtitles) == path:
            raise MienError(f"{path}: is asked for twice — leave the subtitles out, it is them already")
        check_file(subtitles)
    elif kind in DRAWN:
        check_size(scene.size_px)
    else:
        raise MienError(
            f"{path}: has no pictures to draw subtitles into — write them beside it, to a file .srt or .vtt"
        )


def usual_scene(path: Path | None, scene: Scene) -> Scene:
    """The scene of a file where none is asked for: the given one, but of a ``.glb`` ``PUPPET_SCENE``."""
    return PUPPET_SCENE if path is not None and path.suffix.lower() == ".glb" else scene


def is_transparent(scene: Scene) -> bool:
    """Whether something of what is behind a picture shows through."""
    return min(color[3] for color in scene.behind()) < 1.0


def write_performance(
    performance: Performance,
    path: Path | str,
    *,
    fps: Rate | None = None,
    scene: Scene | None = None,
    threads: int | None = None,
    subtitles: Path | str | None = None,
    variable: bool = False,
    cuts: Sequence[Cut] = (),
    report: Report | None = None,
) -> None:
    """Writes the performance as a film, pictures, sound, subtitles or data; the suffix decides.

    Args:
        performance: what to write.
        path: where to; the folder of it exists. Films are those of the table ``codecs``; pictures come as a folder or
            as ``frame_%04d.png``; ``.wav``, ``.srt``, ``.vtt`` and ``.TextGrid`` are what is heard, ``.json`` and
            ``.csv`` data, ``.glb`` a puppet for other programs.
        fps: frames a second, 1..240; 23.976 is 24000/1001. None is the rate the timeline was made for, or 24.
        scene: None is the performance's own; of a ``.glb``, ``PUPPET_SCENE``.
        threads: that draw; None is one a core, four at most. Pictures are equal for any number.
        subtitles: a file ``.srt`` or ``.vtt`` to write them to as well, or ``burn`` to draw them into the pictures.
        variable: whether equal pictures of a film in a row become one that stays longer.
        cuts: who is seen instead of the performance's face, and from when on; in pictures alone.
        report: told after every frame.

    Raises:
        MienError: something does not suit, or a place cannot be written; existing files stay as they were.
    """
    path, timeline = Path(path), performance.timeline
    rate = check_rate((timeline.fps or DEFAULT_FPS) if fps is None else fps)
    scene = scene or usual_scene(path, performance.scene)
    kind = check_performance(path, fps=rate, scene=scene, subtitles=subtitles, variable=variable)
    job = _Job(path, kind, rate, timeline, performance.face, performance.sound, scene)
    shown = _find_subtitles(timeline, path) if kind == "subtitles" or subtitles is not None else ()
    burned = str(subtitles) == BURN
    with ExitStack() as stack:
        # Complete before the film is begun, and in its place once the film is complete too.
        if subtitles is not None and not burned:
            write_subtitles(shown, stack.enter_context(writing(subtitles)), job.notes)
        if kind in DRAWN:
            _write_frames(job, shown if burned else (), threads, variable, cuts, report)
        else:
            _write_data(job, shown)


@dataclass(frozen=True)
class _Job:
    """What is to be written, and where to."""

    path: Path
    kind: str
    rate: Fraction
    timeline: Timeline
    face: Face
    sound: Sound | None
    scene: Scene

    @property
    def notes(self) -> Mapping[str, str]:
        return notes(self.face.name, self.timeline.title, self.timeline.seed)


def _write_frames(
    job: _Job,
    burned: Sequence[Subtitle],
    threads: int | None,
    variable: bool,
    cuts: Sequence[Cut],
    report: Report | None,
) -> None:
    from .burning import Burner

    burner = Burner(burned, job.scene.size_px) if burned else None
    drawn = run_ahead(
        draw_frames(job.timeline, job.face, job.scene, job.rate, threads, burner, cuts), at_once(job.scene.size_px)
    )
    with closing(drawn), closing(_told(drawn, job.timeline.frame_count(job.rate), report)) as frames:
        if job.kind == "film":
            from .film import write_film

            write_film(
                frames,
                job.path,
                fps=job.rate,
                size_px=job.scene.size_px,
                sound=job.sound,
                notes=job.notes,
                transparent=is_transparent(job.scene),
                variable=variable,
            )
        else:
            from .series import write_series

            write_series(frames, job.path, sound=job.sound, notes=job.notes)


def _write_data(job: _Job, subtitles: Sequence[Subtitle]) -> None:
    if job.kind == "subtitles":
        with writing(job.path) as temporary:
            write_subtitles(subtitles, temporary, job.notes)
    elif job.kind == "textgrid":
        from .cue_files import write_cue_file
        from .cue_sheet import sheet_of

        write_cue_file(sheet_of(job.timeline), job.path)
    elif job.kind == "wav":
        from .wav import write_wav

        if job.sound is None:
            raise MienError(f"{job.path}: there is no sound in this timeline — write a film, .json or .csv")
        write_wav(job.sound, job.path)
    elif job.kind == "json":
        from .timeline_files import write_json

        write_json(with_rate(job.timeline, job.rate), job.path, face=job.face, scene=job.scene, sound=job.sound)
    elif job.kind == "glb":
        from .glb import write_glb

        write_glb(
            job.timeline, job.path, face=job.face, scene=job.scene, rate=job.rate, sound=job.sound, notes=job.notes
        )
    else:
        from .timeline_files import write_csv

        write_csv(job.timeline, job.path, face=job.face, fps=job.rate)


def _find_subtitles(timeline: Timeline, path: Path) -> tuple[Subtitle, ...]:
    shown = make_subtitles(timeline)
    if not shown:
        raise MienError(f"{path}: no word is said in this timeline, so there are no subtitles — leave them out")
    return shown


def with_rate(timeline: Timeline, fps: Rate) -> Timeline:
    """The timeline, marked as made for a rate, so that playing it later gives the same frames."""
    return replace(timeline, fps=float(fps))


def _told(frames: Iterator[NDArray[np.uint8]], total: int, report: Report | None) -> Frames:
    """The frames; after each the report hears of it, on the thread of whoever takes them."""
    for number, pixels in enumerate(frames, start=1):
        yield pixels
        if report:
            report(number, total)


def draw_frames(
    timeline: Timeline,
    face: Face,
    scene: Scene,
    fps: Rate,
    threads: int | None = None,
    burner: Burner | None = None,
    cuts: Sequence[Cut] = (),
) -> Frames:
    """Each frame (H, W, 4) uint8, sRGB with straight alpha, in order; frame k shows the moment k / fps.

    A frame in which nothing differs from the one before is the same array, not drawn again.
    """
    from mien.render import Renderer

    rate = exact_rate(fps)
    number: int | None = None
    drawn: tuple[Face, NDArray[np.float64]] | None = None
    played = cut_poses(cuts or (Cut(0.0, timeline, face),), timeline.frame_count(rate), rate)
    with Renderer(scene, threads or default_threads()) as renderer:
        for frame, (seen, pose) in enumerate(played):
            before, number = number, None if burner is None else burner.at(time_of(float(frame), rate))
            if drawn is None or number != before or drawn[0] is not seen or not np.array_equal(pose.values, drawn[1]):
                shown, drawn = renderer.draw(seen, pose), (seen, pose.values)
                if burner is not None and number is not None:
                    burner.burn(shown)
            yield shown


def default_threads() -> int:
    """One a core, four at most."""
    return min(4, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
