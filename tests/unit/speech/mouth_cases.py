"""Cue lists for the tests of the mouth: the poem with typical durations, so that no voice is needed."""

from __future__ import annotations

from mien.core import Cue

POEM = """
SIL:250 HH:70 AW1:170 HH:60 AE1:110 P:80 IY0:90 IH1:60 Z:60 DH:40 AH0:45 L:60 IH1:70 T:40 AH0:50 L:70 S:110
T:60 OW1:180 N:110 SIL:300 DH:50 AE1:90 T:60 R:60 AE1:120 M:70 B:45 AH0:55 L:65 Z:70 IH0:60 N:55 DH:35 AH0:45
R:70 OW1:140 D:60 AH0:50 L:75 OW1:210 N:130 SIL:320 AH0:60 N:55 D:40 D:45 AH1:90 Z:60 AH0:40 N:60 T:50 K:80
EH1:90 R:70 AH0:60 B:65 AW1:150 T:70 K:85 ER0:90 IH1:85 R:80 Z:90 SIL:200 AH0:60 N:50 D:45 EH1:80 K:70 S:60
IH0:55 JH:75 AH0:50 N:50 S:80 IY0:80 Z:65 N:70 EH1:90 V:45 ER0:70 F:90 IH1:100 R:80 Z:100 SIL:150 HH:60
UW1:110 Z:70 K:90 OW1:130 T:70 AH0:40 V:35 EH2:90 L:60 AH0:45 M:60 EH1:80 N:60 T:60 AH0:40 L:50 B:70 R:55
AW1:180 N:110 SIL:100 AH0:50 P:75 AE1:130 S:95 IH0:50 NG:60 Y:60 UW1:90 N:55 AH0:45 V:50 ER1:110 S:80 P:70
UH1:70 T:60 AA1:130 N:110 SIL:400
"""


def cues(text: str) -> tuple[Cue, ...]:
    """Cues of words like ``AE1:120``: a phone and its milliseconds."""
    out, time = [], 0
    for word in text.split():
        symbol, length = word.split(":")
        out.append(Cue(time / 1000.0, (time + int(length)) / 1000.0, symbol))
        time += int(length)
    return tuple(out)


def poem() -> tuple[Cue, ...]:
    """Emily Dickinson's "How happy is the little stone", the first stanza as Parke's actor may have said it."""
    return cues(POEM)
