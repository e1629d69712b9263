"""What people who label speech write, as segments with the phones in them."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from mien.core import SILENCE, Cue
from mien.perform.corrected import find_alphabet
from mien.speech.phones import STOPS

ASPIRATION = "H"
"""At the end of a label of a stop, in the EMU databases."""


@dataclass(frozen=True)
class Segment:
    """A labelled stretch of time: its phones in order; none where the label tells nothing of the mouth."""

    start_s: float
    end_s: float
    phones: tuple[str, ...]
    label: str = ""

    @property
    def is_pause(self) -> bool:
        """Whether nothing is said."""
        return self.phones == (SILENCE,)


@dataclass(frozen=True)
class Meaning:
    """Phones of a label, and whether it is one phone with the ``next`` or the ``former`` label."""

    phones: tuple[str, ...]
    joins: str = ""


def segments_of(labels: Iterable[Cue]) -> tuple[list[Segment], str, set[str]]:
    """Segments of a file's labels, the alphabet they are in, and the labels that it does not know."""
    cues = list(labels)
    spelled = [cue.symbol.strip() for cue in cues]
    alphabet = find_alphabet([label for label in spelled if label])
    name = "emu" if alphabet.name == "sampa" and {"H", "H#"} & set(spelled) else alphabet.name
    out: list[Segment] = []
    closure: Segment | None = None
    strange = set()
    for cue, label in zip(cues, spelled, strict=True):
        meaning = _own_labels(name).get(label.lower() if name == "arpabet" else label)
        if meaning is None:
            stop = label.removesuffix(ASPIRATION) if name == "emu" else label
            read = alphabet.read(stop) if label else None
            meaning = Meaning(read.phones if read else () if label else (SILENCE,))
            strange |= {label} if label and read is None else set()
        segment = Segment(cue.start_s, cue.end_s, meaning.phones, label)
        if closure is not None:
            if meaning.phones and _is_release(closure.phones[-1], meaning.phones[0]):
                segment = replace(segment, start_s=closure.start_s, label=closure.label + label)
            else:
                out.append(closure)
            closure = None
        if meaning.joins == "next":
            closure = segment
        elif meaning.joins == "former" and out and out[-1].phones and out[-1].phones[-1] in STOPS:
            out[-1] = replace(out[-1], end_s=cue.end_s, label=out[-1].label + label)
        elif out and segment.is_pause and out[-1].is_pause:
            out[-1] = replace(out[-1], end_s=cue.end_s)
        else:
            out.append(segment)
    return out + ([closure] if closure else []), name, strange


def _is_release(closure: str, phone: str) -> bool:
    return phone == closure or (closure, phone) in {("T", "CH"), ("D", "JH")}


@cache
def _own_labels(name: str) -> Mapping[str, Meaning]:
    """Labels that only a measurement reads in this way, ``labels.csv``."""
    with (Path(__file__).parent / "labels.csv").open(encoding="utf-8") as file:
        return {
            row["label"]: Meaning(tuple(row["phones"].split()), row["joins"])
            for row in csv.DictReader(file)
            if row["alphabet"] == name
        }
