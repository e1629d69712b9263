"""The options that commands share, each written once."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

FILM_HELP = (
    "Film: .mp4 .webm .mov .gif .apng .webp; frames: a folder or f_%04d.png; .wav .srt .vtt; .json .csv; puppet: .glb"
)

FaceName = Annotated[str, typer.Argument(metavar="FACE", help="A face: a name from 'mien faces', or a face file.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]

Face = Annotated[str, typer.Option("--face", metavar="FACE", help="Who: a name from 'mien faces', or a face file.")]
OtherFace = Annotated[
    str | None, typer.Option("--face", metavar="FACE", help="Who plays it; the file's own face unless said.")
]
Sets = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="Set a parameter ('mien params FACE'); may be repeated."),
]
Presets = Annotated[
    list[str] | None,
    typer.Option(
        "--preset",
        metavar="NAME[=N]",
        help="Start from a preset ('mien presets FACE'), or 0..1 of it; may be repeated.",
    ),
]
Units = Annotated[
    list[str] | None,
    typer.Option(
        "--au", metavar="N=X,…", help="Action units over presets: 12=0.8,6=0.5 or 1+2+5B ('mien vocab facs')."
    ),
]

Mix = Annotated[
    list[str] | None,
    typer.Option("--mix", metavar="FACE=N", help="Take 0..1 of another person, as in head:ada=0.3; may be repeated."),
]
Random = Annotated[
    int | None, typer.Option("--random", metavar="SEED", help="A person drawn by chance; the same for the same seed.")
]
Exaggerate = Annotated[
    float, typer.Option("--exaggerate", metavar="N", help="Expression times N, 0 to 3: louder, or softer.")
]
Caricature = Annotated[
    float, typer.Option("--caricature", metavar="N", help="The person N times, 0 to 3, as far from the average.")
]

Phase = Annotated[
    float | None, typer.Option("--phase", metavar="N", help="Of a measured face: 2.5 is half way from phase 2 to 3.")
]

Out = Annotated[Path, typer.Option("-o", "--out", metavar="OUT", help="File to write; the suffix picks the format.")]
Film = Annotated[Path, typer.Option("-o", "--out", metavar="OUT", help=FILM_HELP)]
OptionalFilm = Annotated[Path | None, typer.Option("-o", "--out", metavar="OUT", help=FILM_HELP)]
Subtitles = Annotated[
    str | None, typer.Option("--subtitles", metavar="FILE|burn", help="Beside it as .srt or .vtt, or in the picture.")
]
Variable = Annotated[bool, typer.Option("--variable", help="Equal pictures of a film become one that stays longer.")]

Transcript = Annotated[
    str | None,
    typer.Option("--text", metavar="T|@FILE|-", help="What the recording says; without it, words are recognised."),
]
Language = Annotated[
    str | None,
    typer.Option("--language", metavar="TAG", help="Spoken: en (default), de, fr, es, it, nl, pt, pt-BR …"),
]
Cues = Annotated[
    Path | None,
    typer.Option("--cues", metavar="FILE", help="Words and phones corrected by hand, such as .TextGrid; they win."),
]

Size = Annotated[str | None, typer.Option("--size", metavar="WxH", help="Pixels: 1024 or 1280x720.  [default: 1024]")]
Fps = Annotated[
    str | None,
    typer.Option("--fps", metavar="N", help="Frames a second, 1 to 240; also 29.97, 30000/1001.  [default: 24]"),
]
View = Annotated[
    str | None,
    typer.Option(
        "--view", metavar="NAME", help="front, three-quarter or side.  [default: three-quarter; of a drawing, front]"
    ),
]
From = Annotated[
    str | None, typer.Option("--from", metavar="X,Y,Z", help="Where the camera stands, metres, instead of --view.")
]
At = Annotated[str | None, typer.Option("--at", metavar="X,Y,Z", help="What the camera looks at, metres.")]
Fov = Annotated[float | None, typer.Option("--fov", metavar="DEG", help="Field of view, degrees.")]
Shading = Annotated[
    str | None, typer.Option("--shading", metavar="NAME", help="smooth, smooth+, polygon or wire.  [default: smooth]")
]
Subdivide = Annotated[
    int | None, typer.Option("--subdivide", metavar="N", help="Rounding of the skin: 0, 1 or 2.  [default: 2]")
]
Sheet = Annotated[
    str | None,
    typer.Option(
        "--sheet", metavar="KIND", help="A labelled page instead: presets, parameters, views, or a vocabulary (facs …)."
    ),
]
Background = Annotated[
    str | None,
    typer.Option(
        "--background", metavar="COLOR", help="white, #336699, transparent, or bottom:top, as in navy:skyblue."
    ),
]
Light = Annotated[
    str | None,
    typer.Option("--light", metavar="NAME", help="studio, or parke: one light, grey ground.  [default: studio]"),
]
Diffuse = Annotated[
    float | None,
    typer.Option(
        "--diffuse", metavar="X", help="Parke's diffuse factor, 0..1: how bright shadows are.  [default: 0.3]"
    ),
]
CosinePower = Annotated[
    int | None,
    typer.Option(
        "--cosine-power", metavar="N", help="Parke's cosine power, 1 to 64: shade grows harder.  [default: 1]"
    ),
]
Threads = Annotated[
    int | None, typer.Option("--threads", metavar="N", help="Threads that draw; the picture does not depend on it.")
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but mistakes.")]
