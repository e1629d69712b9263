"""A performance written as a film, frames, sound or data; the suffix decides."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mien.core import Face, MienError, Scene, Sound
from mien.timeline import Timeline

from .atomic import check_file
from .notes import notes
from .pipeline import run_ahead
from .table import find_format

DEFAULT_FPS = 24.0

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


def check_performance(path: Path | str, *, fps: float = DEFAULT_FPS, scene: Scene | None = None) -> str:
    """Name of the format that ``path`` asks for, after making sure that it can be written there.

    Raises:
        MienError: the suffix is unknown, the place cannot be written, or rate, size or background do not suit.
    """
    # The film module brings a megabyte of codecs, which frames, sound and data need not.
    from .rates import check_film, check_rate
    from .series import check_series

    path, scene = Path(path), scene or Scene()
    kind = (
        "series" if path.suffix.lower() == ".png" and not os.path.isdir(path) else find_format(path, "performance").name
    )
    check_rate(fps)
    if kind in ("series", "folder"):
        check_series(path)
        return kind
    check_file(path)
    if kind == "film":
        check_film(path, fps, scene.size_px, transparent=min(color[3] for color in scene.background) < 1.0)
    if kind == "json":
        check_file(path.with_suffix(".wav"))
    return kind


def write_performance(
    performance: Performance,
    path: Path | str,
    *,
    fps: float | None = None,
    scene: Scene | None = None,
    threads: int | None = None,
    report: Report | None = None,
) -> None:
    """Writes the performance: ``.mp4``, a folder, ``frame_%04d.png``, ``.wav``, ``.json`` or ``.csv``.

    Args:
        performance: what to write.
        path: where to; the folder of it exists.
        fps: frames a second, 1..240; None is the rate the timeline was made for, or 24.
        scene: None is the performance's own.
        threads: that draw; None is one a core, four at most. Pictures are equal for any number.
        report: told after every frame.

    Raises:
        MienError: something does not suit, or the place cannot be written; an existing file stays as it was.
    """
    path, face, timeline, sound = Path(path), performance.face, performance.timeline, performance.sound
    fps = (timeline.fps or DEFAULT_FPS) if fps is None else fps
    scene = scene or performance.scene
    kind = check_performance(path, fps=fps, scene=scene)
    marks = notes(face.name, timeline.title)
    if kind in ("film", "folder", "series"):
        drawn = run_ahead(draw_frames(timeline, face, scene, fps, threads))
        with closing(drawn), closing(_told(drawn, timeline.frame_count(fps), report)) as frames:
            if kind == "film":
                from .film import write_film

                write_film(frames, path, fps=fps, size_px=scene.size_px, sound=sound, notes=marks)
            else:
                from .series import write_series

                write_series(frames, path, sound=sound, notes=marks)
    elif kind == "wav":
        from .wav import write_wav

        if sound is None:
            raise MienError(f"{path}: there is no sound in this timeline — write .mp4, .json or .csv")
        write_wav(sound, path)
    elif kind == "json":
        from .timeline_files import write_json

        write_json(with_rate(timeline, fps), path, face=face, scene=scene, sound=sound)
    else:
        from .timeline_files import write_csv

        write_csv(timeline, path, face=face, fps=fps)


def with_rate(timeline: Timeline, fps: float) -> Timeline:
    """The timeline, marked as made for a rate, so that playing it later gives the same frames."""
    from dataclasses import replace

    return replace(timeline, fps=float(fps))


def _told(frames: Iterator[NDArray[np.uint8]], total: int, report: Report | None) -> Frames:
    """The frames; after each the report hears of it, on the thread of whoever takes them."""
    for number, pixels in enumerate(frames, start=1):
        yield pixels
        if report:
            report(number, total)


def draw_frames(timeline: Timeline, face: Face, scene: Scene, fps: float, threads: int | None = None) -> Frames:
    """Each frame (H, W, 4) uint8, sRGB with straight alpha, in order; frame k shows the moment k / fps."""
    from mien.render import Renderer

    with Renderer(scene, threads or default_threads()) as renderer:
        for pose in timeline.poses(face.parameters, fps):
            yield renderer.draw(face, pose)


def default_threads() -> int:
    """One a core, four at most."""
    return min(4, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
