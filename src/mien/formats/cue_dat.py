"""Mouth shapes for Moho and OpenToonz: frames, counted from 1, on which the mouth changes."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

from mien.core import LoadError
from mien.timeline.rates import time_of

from .cue_frames import choose_shapes
from .cue_rhubarb import find_steps, set_of, sheet_of_steps
from .cue_shapes import shape_sets
from .cue_sheet import SHAPES, CueSheet
from .cue_text import parse_number
from .cue_tsv import check_plain

HEAD = "MohoSwitch1"


def format_dat(sheet: CueSheet, rate: Fraction, tier: str = SHAPES) -> Iterator[str]:
    """Lines of a frame and the shape from there on; no closed or tucked mouth is lost, however short.

    Rhubarb's letters become the names of Preston Blair's mouths, which are those of Moho's and OpenToonz's own faces;
    other names stay.

    Source: Rhubarb Lip Sync 1.13, option ``--datUsePrestonBlair``, has the same mouths.
    """
    names = set_of(sheet, tier)
    shapes = choose_shapes(sheet.tier(tier), sheet.length_s, rate, names)
    changes = [(frame, after) for frame, (before, after) in enumerate(pairwise(["", *shapes]), 1) if after != before]
    renamed = _rename if names.name == "rhubarb" and names.mouths.keys() >= set(shapes) else str
    return _lines([(frame, renamed(shape)) for frame, shape in [*changes, (len(shapes) + 1, names.rest)]])


def _rename(letter: str) -> str:
    sets = shape_sets()
    return sets["preston-blair"].name_of(sets["rhubarb"].mouths[letter])


def format_rhubarb_dat(sheet: CueSheet, rate: Fraction, tier: str = SHAPES) -> Iterator[str]:
    """Lines as Rhubarb writes them: on a frame where several shapes begin, the first of them."""
    frames: dict[int, str] = {}
    for cue in find_steps(sheet, tier):
        frames.setdefault(1 + int(float(rate) * cue.start_s), cue.symbol)
    end = 1 + int(float(rate) * round(sheet.length_s, 2))
    return _lines([*frames.items(), (end + (end in frames), set_of(sheet, tier).rest)])


def _lines(changes: list[tuple[int, str]]) -> Iterator[str]:
    yield f"{HEAD}\n"
    for frame, shape in changes:
        yield f"{frame} {check_plain(shape, f'frame {frame}')}\n"


def parse_dat(text: str, source: str, rate: Fraction) -> CueSheet:
    """The shapes of a file that counts frames at a rate; the last line is the end.

    Raises:
        LoadError: a line is something else, or frames do not rise.
    """
    lines = text.split("\n")
    if lines[0].strip() != HEAD:
        raise LoadError(source, f"want {HEAD!r}, got {lines[0]!r}", line=1)
    steps: list[tuple[int, float, str]] = []
    for line, row in enumerate(lines[1:], start=2):
        if not row.strip():
            continue
        frame, _, shape = row.strip().partition(" ")
        number = parse_number(source, frame, f"shape {len(steps) + 1}", line)
        steps.append((line, time_of(number - 1.0, rate), shape))
    return sheet_of_steps(source, steps)
