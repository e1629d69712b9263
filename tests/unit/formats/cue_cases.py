"""Sheets of cues that several tests share."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import strategies as st

from mien.core import Cue
from mien.formats import CueSheet

MARY = (
    (0.00, "X"),
    (0.25, "B"),
    (0.32, "A"),
    (0.38, "C"),
    (0.51, "B"),
    (0.65, "A"),
    (0.73, "E"),
    (0.86, "A"),
    (1.00, "C"),
    (1.20, "E"),
    (1.55, "X"),
)
"""Where each shape begins in what Rhubarb 1.13 makes of ``mary.wav``, 1.86 s."""


def mary() -> CueSheet:
    edges = [start for start, _ in MARY] + [1.86]
    shapes = tuple(Cue(start, end, shape) for (start, shape), end in zip(MARY, edges[1:], strict=True))
    return CueSheet(1.86, {"shapes": shapes}, sound="mary.wav")


def hello() -> CueSheet:
    """Words with a pause, phones without holes, shapes; text with quotes and letters that ASCII lacks."""
    words = (Cue(0.2, 0.6, "Hello"), Cue(0.75, 1.25, 'né"e'))
    phones = (
        Cue(0.0, 0.2, "SIL"),
        Cue(0.2, 0.3, "HH"),
        Cue(0.3, 0.6, "AH0"),
        Cue(0.6, 0.75, "SIL"),
        Cue(0.75, 0.9, "N"),
        Cue(0.9, 1.25, "EY1"),
        Cue(1.25, 1.5, "SIL"),
    )
    shapes = (Cue(0.0, 0.2, "X"), Cue(0.2, 1.25, "C"), Cue(1.25, 1.5, "X"))
    return CueSheet(1.5, {"words": words, "phones": phones, "shapes": shapes}, "hello.wav", 'Hello, né"e!')


@st.composite
def sheets(draw: st.DrawFn) -> CueSheet:
    """Any sheet: up to three tiers, gaps or none, times that are no round numbers, all kinds of letters."""
    length = draw(st.floats(0.5, 4000.0))
    letters = st.characters(exclude_categories=("Cc", "Cs", "Zs", "Zl", "Zp"))
    names = draw(st.lists(st.text(letters, min_size=1, max_size=8), min_size=1, max_size=3, unique=True))
    tiers = {}
    for name in names:
        shares = sorted(draw(st.lists(st.integers(0, 500), max_size=12, unique=True)))
        times = [share / 500 * length for share in shares]
        cues = []
        for start, end in pairwise(times):
            if draw(st.booleans()):
                cues.append(Cue(start, end, draw(st.text(letters, min_size=1, max_size=6))))
        tiers[name] = tuple(cues)
    return CueSheet(length, tiers, draw(st.text(letters, max_size=8)), draw(st.text(letters, max_size=30)))
