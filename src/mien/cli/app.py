"""The table of commands."""

from __future__ import annotations

from typing import Annotated

import typer

from . import (
    capture,
    doctor,
    faces,
    fit,
    keypose,
    lipsync,
    live,
    params,
    play,
    presets,
    render,
    replay,
    say,
    toon,
    vocab,
    voices,
    warmup,
)

app = typer.Typer(
    name="mien",
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)

for command in (
    say.say,
    lipsync.lipsync,
    render.render,
    play.play,
    keypose.keypose,
    fit.fit,
    live.live,
    replay.replay,
    faces.faces,
    params.params,
    presets.presets,
    vocab.vocab,
    voices.voices,
):
    app.command()(command)
app.add_typer(toon.app, name="toon")
app.add_typer(capture.app, name="capture")
app.command()(warmup.warmup)
app.command()(doctor.doctor)


def _show_version(wanted: bool) -> None:
    if wanted:
        from mien.formats.notes import software

        typer.echo(software())
        raise typer.Exit


@app.callback()
def root(
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Print the version and end.")
    ] = False,
) -> None:
    """Faces you can play: type a sentence, and a face says it.

    \b
    mien say "Hello there." -o hello.mp4
    mien render head --preset smile -o smile.png
    """
