"""``mien keypose``: the animation program of 1972, which asks what it is not told.

Source: Parke 1972, "Implementation": the program asks which phase data files to read in, the number of frames between
phases, the resolution, where to look, where to look from, and for smooth or polygonal shading.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer

from . import options

if TYPE_CHECKING:
    from mien.faces.keypose import KeyposeFace

Answer = TypeVar("Answer")

BETWEEN = 23
"""Frames between two phases: with the next phase itself, a second of film."""

Sources = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="FACE|FILES", help="keypose:NAME or a folder NAME.keypose; or a topology file and its phase files."
    ),
]
Phases = Annotated[
    str | None, typer.Option("--phases", metavar="A,B,…", help="Which, in order, by name or number.  [default: all]")
]
Between = Annotated[
    int | None, typer.Option("--between", metavar="N", help=f"Frames between two phases.  [default: {BETWEEN}]")
]


def keypose(
    sources: Sources = None,
    out: options.OptionalFilm = None,
    phases: Phases = None,
    between: Between = None,
    size: options.Size = None,
    at: options.At = None,
    position: options.From = None,
    shading: options.Shading = None,
    view: options.View = None,
    fov: options.Fov = None,
    fps: options.Fps = None,
    subdivide: options.Subdivide = None,
    background: options.Background = None,
    light: options.Light = None,
    diffuse: options.Diffuse = None,
    cosine_power: options.CosinePower = None,
    threads: options.Threads = None,
    quiet: options.Quiet = False,
) -> None:
    """Film measured phases of a face with cosine interpolation between them: Parke's program of 1972.

    At a terminal it asks for what is not given here, as his did. Nothing is subdivided unless you say so.

    \b
    mien keypose
    mien keypose aircraft.keypose --between 35 --shading polygon --from 0.3,-0.5,0.9 -o aircraft.mp4
    mien keypose ada.keypose --phases neutral,smile,neutral -o smile.mp4
    mien keypose topology.txt neutral.phase smile.phase -o smile.gif
    """
    from mien import api
    from mien.core import MienError
    from mien.formats import DEFAULT_FPS, check_performance

    from . import settings
    from .stages import Stages
    from .writing import write

    ask = Questions(sys.stdin.isatty() and sys.stderr.isatty()).ask
    face = ask("Face, or topology and phase files", None, "\n".join(sources) if sources else None, _load)
    names = ", ".join(f"{number} {name}" for number, name in enumerate(face.keypose.phases, start=1))
    if phases is not None or len(face.keypose.phases) > 1:
        face = ask(f"Phases in order ({names})", "all", phases, lambda text: _order(face, text))
    frames = ask("Frames between phases", str(BETWEEN), None if between is None else str(between), _count)
    scene = api.default_scene(face)
    size = ask("Resolution", "{}x{}".format(*scene.size_px), size, _checked(lambda text: settings.parse_size(text)))
    at = ask("Where to look, x,y,z", _vector(scene.at), at, _checked(lambda text: settings.parse_vector(text, "--at")))
    if view is None:
        usual = _vector(scene.position)
        position = ask(
            "Where to look from, x,y,z", usual, position, _checked(lambda text: settings.parse_vector(text, "--from"))
        )
    shading = ask("Smooth or polygonal shading", "smooth", shading, _shading)
    out = ask("File to write", None, None if out is None else str(out), Path)
    scene = settings.make_scene(
        replace(scene, subdivide=0),
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
    settings.check_threads(threads)
    rate = DEFAULT_FPS if fps is None else settings.parse_rate(fps)
    kind = check_performance(out, fps=rate, scene=scene)
    if len(face.keypose.phases) < 2:
        raise MienError(f"--phases {phases}: a film goes from one phase to another — name two or more")
    performance = api.film_phases(face, frames, fps=rate, scene=scene)
    write(performance, out, kind, Stages(quiet), fps=rate, threads=threads, subtitles=None, variable=False)


@dataclass(frozen=True)
class Questions:
    """How answers are had: what is given; else, at a terminal, asked for until it can be understood; else the usual."""

    at_terminal: bool

    def ask(self, question: str, usual: str | None, given: str | None, read: Callable[[str], Answer]) -> Answer:
        """The answer.

        Raises:
            MienError: what is given cannot be understood, or nothing is and there is nobody to ask.
        """
        from mien.core import MienError

        if given is not None:
            return read(given)
        if not self.at_terminal:
            if usual is None:
                raise MienError(f"{question}: is not given — at a terminal it is asked for; see mien keypose --help")
            return read(usual)
        while True:
            text = str(typer.prompt(question, default=usual, err=True))
            try:
                return read(text)
            except MienError as error:
                typer.echo(str(error), err=True)


def _load(text: str) -> KeyposeFace:
    """A measured face, from an address, or from files a line each or between blanks."""
    import shlex

    from mien import api

    return api.load_phases(text.split("\n") if "\n" in text or Path(text).exists() else shlex.split(text))


def _order(face: KeyposeFace, text: str) -> KeyposeFace:
    from mien import api

    return face if text == "all" else api.order_phases(face, [name.strip() for name in text.split(",")])


def _count(text: str) -> int:
    from mien.core import MienError

    if not text.strip().isdecimal():
        raise MienError(f"{text} frames between phases: want a whole number, as in 23")
    return int(text)


def _shading(text: str) -> str:
    from mien.core import UnknownNameError
    from mien.core.scene import SHADINGS

    name = {"polygonal": "polygon"}.get(text.strip().lower(), text.strip().lower())
    if name not in SHADINGS:
        raise UnknownNameError("shading", text, SHADINGS)
    return name


def _checked(read: Callable[[str], object]) -> Callable[[str], str]:
    """The text itself, once it could be read."""

    def check(text: str) -> str:
        read(text)
        return text

    return check


def _vector(numbers: tuple[float, float, float]) -> str:
    return ",".join(f"{number:g}" for number in numbers)
