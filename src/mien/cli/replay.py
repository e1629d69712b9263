"""``mien replay``: a logged live session again, as a film."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import options


def replay(
    log: Annotated[Path, typer.Argument(metavar="LOG", help="The log of a live session, JSON lines.")],
    out: options.Film,
    face: options.OtherFace = None,
    size: options.Size = None,
    fps: options.Fps = None,
    view: options.View = None,
    position: options.From = None,
    at: options.At = None,
    fov: options.Fov = None,
    shading: options.Shading = None,
    subdivide: options.Subdivide = None,
    background: options.Background = None,
    threads: options.Threads = None,
    variable: options.Variable = False,
    quiet: options.Quiet = False,
) -> None:
    """Play a logged live session again: the identical frames, at the rate of its loops unless said.

    \b
    mien replay talk.log -o talk.mp4
    mien replay talk.log -o talk.csv
    """
    from dataclasses import replace

    from mien import api
    from mien.formats import DEFAULT_FPS, check_performance
    from mien.formats.performances import usual_scene
    from mien.live import load_log, perform_log

    from . import settings
    from .stages import Stages
    from .writing import write

    wanted = None if fps is None else settings.parse_rate(fps)
    settings.check_threads(threads)
    check_performance(out, variable=variable)
    stages = Stages(quiet)
    with stages.stage("replaying"):
        stored = load_log(log)
        performance = perform_log(stored, api.load_face(face or stored.header.face))
    scene = settings.make_scene(
        usual_scene(out, api.default_scene(performance.face)),
        size=size,
        view=view,
        position=position,
        at=at,
        fov=fov,
        shading=shading,
        subdivide=subdivide,
        background=background,
        light=None,
        diffuse=None,
        cosine_power=None,
    )
    performance = replace(performance, scene=scene)
    rate = wanted or performance.timeline.fps or DEFAULT_FPS
    kind = check_performance(out, fps=rate, scene=scene, variable=variable)
    write(performance, out, kind, stages, fps=rate, threads=threads, subtitles=None, variable=variable)
