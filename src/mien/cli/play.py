"""``mien play``: a timeline from a file, on any face."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import options


def play(
    timeline: Annotated[
        Path, typer.Argument(metavar="TIMELINE", help="A specification list .spec, a timeline .json, a table .csv.")
    ],
    out: options.OptionalFilm = None,
    face: options.OtherFace = None,
    commands: Annotated[bool, typer.Option("--commands", help="Print Parke's command list.")] = False,
    plot: Annotated[
        Path | None, typer.Option("--plot", metavar="FILE", help="Plot the curves over time: .png .svg .pdf")
    ] = None,
    values: options.Sets = None,
    preset: options.Presets = None,
    units: options.Units = None,
    mix: options.Mix = None,
    person: options.Random = None,
    caricature: options.Caricature = 1.0,
    exaggerate: options.Exaggerate = 1.0,
    size: options.Size = None,
    fps: options.Fps = None,
    view: options.View = None,
    position: options.From = None,
    at: options.At = None,
    fov: options.Fov = None,
    shading: options.Shading = None,
    subdivide: options.Subdivide = None,
    background: options.Background = None,
    light: options.Light = None,
    diffuse: options.Diffuse = None,
    cosine_power: options.CosinePower = None,
    threads: options.Threads = None,
    subtitles: options.Subtitles = None,
    variable: options.Variable = False,
    quiet: options.Quiet = False,
) -> None:
    """Play a timeline on a face, list its commands, plot its curves.

    \b
    mien play nod.spec -o nod.mp4
    mien play nod.spec --commands --plot nod.svg
    mien play hello.json --exaggerate 1.8 -o loud.mp4
    mien play hello.json --face head:ada --view side -o hello.mp4
    """
    from dataclasses import replace

    from mien import api
    from mien.core import MienError
    from mien.formats import DEFAULT_FPS, check_performance
    from mien.formats.atomic import check_file
    from mien.formats.performances import BURN, usual_scene
    from mien.formats.table import find_format
    from mien.perform import exaggerate as exaggerate_performance
    from mien.timeline import with_settings

    from . import settings
    from .listing import show
    from .stages import Stages
    from .writing import write

    if out is None and plot is None and not commands:
        raise MienError(f"{timeline}: nothing to do with it — give -o FILE, --commands or --plot FILE")
    wanted = None if fps is None else settings.parse_rate(fps)
    settings.check_threads(threads)
    if plot is not None:
        find_format(plot, "plot")
        check_file(plot)
    if out is not None:
        check_performance(out, subtitles=None if subtitles == BURN else subtitles, variable=variable)
    elif subtitles is not None:
        raise MienError(f"--subtitles {subtitles}: belong to a film or to pictures — name one with -o")
    stages = Stages(quiet)
    performance = api.play(timeline, face, fps=wanted, report=stages.say)
    scene = settings.make_scene(
        usual_scene(out, performance.scene),
        size=size,
        view=view,
        position=position,
        at=at,
        fov=fov,
        shading=shading,
        subdivide=subdivide,
        background=background,
        light=light,
        diffuse=diffuse,
        cosine_power=cosine_power,
    )
    pose = settings.make_pose(performance.face, values, preset, units, mix, person, caricature)
    performance = replace(performance, scene=scene, timeline=with_settings(performance.timeline, pose))
    performance = exaggerate_performance(performance, exaggerate)
    rate = wanted or performance.timeline.fps or DEFAULT_FPS
    if out is not None:
        kind = check_performance(out, fps=rate, scene=scene, subtitles=subtitles, variable=variable)

    if commands:
        from mien.timeline import command_list, format_commands

        show(format_commands(command_list(performance.timeline, performance.face.parameters, rate)))
    if plot is not None:
        from mien.formats.plot import plot_timeline

        plot_timeline(performance.timeline, performance.face.parameters, plot, fps=float(rate))
        stages.say(str(plot))
    if out is not None:
        write(performance, out, kind, stages, fps=rate, threads=threads, subtitles=subtitles, variable=variable)
