"""Subtitles beside a film: SubRip (.srt) and WebVTT (.vtt)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from .subtitles import Subtitle


def format_srt(subtitles: Sequence[Subtitle]) -> Iterator[str]:
    """Blocks of a SubRip file: a number, the times, the lines."""
    for number, subtitle in enumerate(subtitles, start=1):
        # An arrow in a line would be taken for the line of times.
        text = "\n".join(line.replace("-->", "->") for line in subtitle.lines)
        yield f"{number}\n{_clock(subtitle.start_s, ',')} --> {_clock(subtitle.end_s, ',')}\n{text}\n\n"


def format_vtt(subtitles: Sequence[Subtitle], notes: Mapping[str, str] | None = None) -> Iterator[str]:
    """Blocks of a WebVTT file, with notes as a comment at its head.

    Source: W3C, WebVTT: The Web Video Text Tracks Format, sections 4.1 and 4.2.
    """
    yield "WEBVTT\n\n"
    if notes:
        yield "NOTE\n" + "".join(f"{key}: {_escape(' '.join(text.split()))}\n" for key, text in notes.items()) + "\n"
    for subtitle in subtitles:
        text = "\n".join(_escape(line) for line in subtitle.lines)
        yield f"{_clock(subtitle.start_s, '.')} --> {_clock(subtitle.end_s, '.')}\n{text}\n\n"


def write_subtitles(subtitles: Sequence[Subtitle], path: Path, notes: Mapping[str, str]) -> None:
    """Writes a file right where it is to be; the suffix decides. SubRip has no place for notes."""
    blocks = format_vtt(subtitles, notes) if path.suffix.lower() == ".vtt" else format_srt(subtitles)
    with path.open("w", encoding="utf-8", newline="\n") as file:
        file.writelines(blocks)


def _clock(time_s: float, point: str) -> str:
    """Hours, minutes, seconds and thousandths."""
    whole, thousandths = divmod(round(time_s * 1000.0), 1000)
    return f"{whole // 3600:02d}:{whole // 60 % 60:02d}:{whole % 60:02d}{point}{thousandths:03d}"


def _escape(line: str) -> str:
    return line.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
