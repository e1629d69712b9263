"""``mien lipsync``: a recording in, the times of its words, phones and mouth shapes out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options

if TYPE_CHECKING:
    from mien.speech import Heard


def lipsync(
    audio: Annotated[
        Path, typer.Argument(metavar="AUDIO", help="A recording: WAV, MP3, OGG, FLAC, M4A, or a film with sound.")
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--out",
            metavar="OUT",
            help="Times of words, phones and shapes: .TextGrid .json .tsv .xml .srt .vtt .dat; a sheet: .csv .html",
        ),
    ] = None,
    text: options.Transcript = None,
    language: options.Language = None,
    cues: options.Cues = None,
    shapes: Annotated[
        str, typer.Option("--shapes", metavar="SET", help="Mouth shapes: rhubarb, oculus, sapi or preston-blair.")
    ] = "rhubarb",
    layout: Annotated[
        str, typer.Option("--layout", metavar="NAME", help="mien, or rhubarb: files as Rhubarb Lip Sync writes them.")
    ] = "mien",
    fps: options.Fps = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the words as JSON, and how sure each is.")] = False,
    quiet: options.Quiet = False,
) -> None:
    """Find the words, phones and mouth shapes of a recording.

    \b
    mien lipsync line.wav --text "Call me at noon." -o line.TextGrid
    mien lipsync podcast.mp3 --text @podcast.txt -o podcast.json
    mien lipsync interview.mp4 -o interview.tsv --shapes oculus
    mien lipsync line.wav --text @line.txt --layout rhubarb -o line.xml
    mien lipsync zeile.wav --text "Schöne Grüße!" --language de -o zeile.TextGrid
    mien lipsync line.wav --cues corrected.TextGrid --shapes preston-blair -o line.dat
    mien lipsync line.wav --json
    """
    from mien.core import MienError
    from mien.formats import DEFAULT_FPS
    from mien.formats.cue_files import check_cue_file, write_cue_file
    from mien.formats.cue_sheet import PHONES, SHAPES, WORDS, CueSheet
    from mien.speech.shapes import shapes_of
    from mien.speech.shapes_table import shape_table

    from . import settings
    from .hearing import hear_file
    from .listing import show
    from .stages import Stages, format_time

    if out is None and not as_json:
        raise MienError(f"{audio}: nothing to do with it — give -o FILE or --json")
    rate = DEFAULT_FPS if fps is None else settings.parse_rate(fps)
    shape_table(shapes)
    if out is not None:
        check_cue_file(out, layout)
    transcript = None if text is None else settings.read_text(text)
    stages = Stages(quiet)
    heard = hear_file(audio, transcript, language, cues, stages)
    if out is not None:
        speech = heard.speech
        tiers = {WORDS: speech.words, PHONES: speech.phones, SHAPES: shapes_of(speech.phones, shapes)}
        sheet = CueSheet(speech.sound.length_s, tiers, sound=audio.name, text=speech.text)
        write_cue_file(sheet, out, layout=layout, fps=rate)
        stages.say(
            f"{out}: {len(speech.words)} words in {speech.sound.length_s:.1f} s; "
            f"done in {format_time(stages.elapsed_s)}"
        )
    if as_json:
        show([json.dumps(describe(heard, audio), ensure_ascii=False, indent=1)])


def describe(heard: Heard, audio: Path) -> dict[str, object]:
    """What was heard, for programs."""
    speech = heard.speech
    return {
        "sound": str(audio),
        "length_s": round(speech.sound.length_s, 3),
        "text": speech.text,
        "words": [
            {
                "start_s": round(word.start_s, 3),
                "end_s": round(word.end_s, 3),
                "word": word.symbol,
                "sure": round(sure, 2),
            }
            for word, sure in zip(speech.words, heard.sure, strict=True)
        ],
        "skipped": list(speech.skipped),
        "notices": list(heard.notices),
    }
