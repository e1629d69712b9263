"""What each pass of the mouth is there for, and what is lost without it: ``python benchmarks/passes.py [--write]``.

``--write`` brings the tables of ``docs/passes.md`` up to date.
The phones are those of Parke's poem and of some sentences full of labials, as the built-in voice says them
(``phones.csv``), so that the numbers are the same on every machine.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from mien.core import Cue
from mien.perform import named_styles, style_table
from mien.speech.articulation import USUAL, Articulation, amounts
from mien.speech.mouth import articulate
from mien.speech.mouth_table import GROUPS, bare, phone_table, stress

PHONES = Path(__file__).with_name("phones.csv")
PAGE = Path(__file__).parents[1] / "docs/passes.md"
STEP_S = 0.001
JAW_MM = 20.0
"""Between the front teeth at a full jaw channel. Source: vocab/data/channels.head.csv."""
SHAPE = ("jaw", "round", "spread")
ROUNDED = ("W", "UW", "OW")
SEEN = {"closure": 1.0, "tuck": 1.0}


@dataclass(frozen=True)
class Said:
    """Phones and what the mouth does to them in some style."""

    phones: tuple[Cue, ...]
    style: Articulation = USUAL

    @cached_property
    def times_s(self) -> np.ndarray:
        """(N,) s, a millisecond apart."""
        return np.arange(0.0, self.phones[-1].end_s, STEP_S)

    @cached_property
    def curves(self) -> dict[str, np.ndarray]:
        """(N,) of every channel at those times."""
        return {name: track.evaluate(self.times_s)[0] for name, track in articulate(self.phones, self.style).items()}

    def at(self, channel: str, times_s: float | np.ndarray) -> np.ndarray:
        """Values of a channel at any times."""
        return np.interp(times_s, self.times_s, self.curves[channel])

    def named(self, *symbols: str) -> list[Cue]:
        """The phones of these names, whatever their stress."""
        return [cue for cue in self.phones if bare(cue.symbol) in symbols]

    def vowels(self) -> list[Cue]:
        """The vowels."""
        return [cue for cue in self.phones if phone_table()[cue.symbol].is_vowel]


def spread_of_vowels(said: Said) -> float:
    """Largest minus least mean of jaw, rounding and spreading over the vowels, % of the range."""
    shapes: dict[str, list[list[float]]] = {}
    for cue in said.vowels():
        shapes.setdefault(bare(cue.symbol), []).append([float(said.at(name, cue.centre_s)) for name in SHAPE])
    means = np.array([np.mean(rows, axis=0) for rows in shapes.values()])
    return 100.0 * float(np.ptp(means, axis=0).mean())


def opening_by_stress(said: Said) -> float:
    """Mean of the jaw in stressed vowels over that in unstressed ones."""
    jaw = {digit: [said.at("jaw", c.centre_s) for c in said.vowels() if stress(c.symbol) == digit] for digit in (0, 1)}
    return float(np.mean(jaw[1]) / np.mean(jaw[0]))


def movement_in_diphthongs(said: Said) -> float:
    """Change of jaw, rounding and spreading between a fifth and the end of diphthongs, summed, % of the range."""
    second = [cue for cue in said.vowels() if bare(cue.symbol) + "+" in phone_table().index]
    moves = [
        abs(said.at(name, c.start_s + 0.2 * c.length_s) - said.at(name, c.end_s)) for c in second for name in SHAPE
    ]
    return 100.0 * len(SHAPE) * float(np.mean(moves))


def opening_in_brief(said: Said) -> float:
    """The jaw in t, d, n, k and g under 100 ms between two vowels, over that in the vowels, mean in %."""
    kept = []
    for before, cue, after in zip(said.phones, said.phones[1:], said.phones[2:], strict=False):
        between = phone_table()[before.symbol].is_vowel and phone_table()[after.symbol].is_vowel
        if between and cue.length_s < 0.1 and cue.symbol in ("T", "D", "N", "K", "G"):
            beside = 0.5 * (said.at("jaw", before.centre_s) + said.at("jaw", after.centre_s))
            kept.append(float(said.at("jaw", cue.centre_s) / beside))
    return 100.0 * float(np.mean(kept)) if kept else 0.0


def opening_in_pauses(said: Said) -> float:
    """How far the jaw is open in the middle of the pauses up to 350 ms, mean in mm."""
    short = [cue.centre_s for cue in said.named("SIL")[1:-1] if cue.length_s <= 0.35]
    return JAW_MM * float(np.mean(said.at("jaw", np.array(short))))


def lead_of_rounding(said: Said) -> float:
    """How long before oo, oh and w the lips are half as round as in the middle of it, median in ms."""
    leads = []
    for before, cue in zip(said.phones, said.phones[1:], strict=False):
        if bare(cue.symbol) in ROUNDED and bare(before.symbol) not in (*ROUNDED, "SIL"):
            back = np.arange(cue.centre_s, cue.start_s - 0.3, -STEP_S)
            below = said.at("round", back) < 0.5 * said.at("round", cue.centre_s)
            leads.append(1000.0 * (cue.start_s - back[int(np.argmax(below))]))
    return float(np.median(leads))


def delay_of_jaw(said: Said) -> float:
    """How much later than the lower lip the jaw is fastest on its way to a stressed vowel, median in ms."""
    delays = []
    for cue in said.vowels():
        if stress(cue.symbol) == 1:
            way = np.arange(cue.centre_s - 0.15, cue.centre_s + 0.02, STEP_S)
            fastest = [int(np.argmax(np.diff(said.at(channel, way)))) for channel in ("lower_lip", "jaw")]
            delays.append(1000.0 * STEP_S * (fastest[1] - fastest[0]))
    return float(np.median(delays))


def speed_of_jaw(said: Said) -> float:
    """Greatest speed of the jaw, mm/s."""
    return JAW_MM * float(np.max(np.abs(np.diff(said.curves["jaw"])))) / STEP_S


def least_roundness(said: Said) -> float:
    """Rounding in the frame nearest to oo, oh or w in films of 12 frames a second, mean of the worst frames, %."""
    shifts = np.arange(0.0, 1.0 / 12.0, 0.005)
    seen = [min(float(said.at("round", _nearest_frame(c.centre_s, s))) for s in shifts) for c in said.named(*ROUNDED)]
    return 100.0 * float(np.mean(seen))


def travel_of_jaw(said: Said) -> float:
    """Way of the jaw, mm/s."""
    return JAW_MM * _travel(said, "jaw", 0.0, said.phones[-1].end_s) / said.phones[-1].end_s


def travel_of_lips(said: Said) -> float:
    """Way of all channels of the lips, ranges a second."""
    return sum(_travel(said, name, 0.0, said.phones[-1].end_s) for name in GROUPS["lips"]) / said.phones[-1].end_s


def height_of_tongue(said: Said) -> float:
    """Tongue up in the middle of l, t, d and n, and out in that of th, mean in % of the range."""
    up = [said.at("tongue_up", cue.centre_s) for cue in said.named("L", "T", "D", "N")]
    out = [said.at("tongue_out", cue.centre_s) for cue in said.named("TH", "DH")]
    return 100.0 * float(np.mean(up + out))


def missed_holds(said: Said) -> float:
    """Closures and tucks that films of 12 frames a second do not show, %."""
    missed = []
    for cue in said.named("P", "B", "M", "F", "V"):
        hold = phone_table()[cue.symbol].hold
        for shift in np.arange(0.0, 1.0 / 12.0, 0.005):
            times = np.arange(0.0, said.phones[-1].end_s, 1.0 / 12.0) + shift
            near = times[(times > cue.start_s - 0.075) & (times < cue.end_s + 0.06)]
            missed.append(float(np.max(said.at(hold, near), initial=0.0)) < SEEN[hold] - 1e-6)
    return 100.0 * float(np.mean(missed))


MEASURES: dict[str, tuple[Callable[[Said], float], str]] = {
    "targets": (spread_of_vowels, "%"),
    "stress": (opening_by_stress, "times"),
    "diphthongs": (movement_in_diphthongs, "%"),
    "brief": (opening_in_brief, "%"),
    "pauses": (opening_in_pauses, "mm"),
    "anticipation": (lead_of_rounding, "ms"),
    "lag": (delay_of_jaw, "ms"),
    "dominance": (speed_of_jaw, "mm/s"),
    "rounding": (least_roundness, "%"),
    "jaw": (travel_of_jaw, "mm/s"),
    "lips": (travel_of_lips, "/s"),
    "tongue": (height_of_tongue, "%"),
    "closures": (missed_holds, "%"),
}
"""Measure of each pass and its unit."""


def read_phones(path: Path = PHONES) -> tuple[Cue, ...]:
    """The phones of a table of names and lengths, one after another from 0 s on."""
    out, edge = [], 0
    with path.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            length = int(row["length_ms"])
            out.append(Cue(edge / 1000.0, (edge + length) / 1000.0, row["phone"]))
            edge += length
    return tuple(out)


def ablation(phones: Sequence[Cue]) -> str:
    """Each measure with its pass as usual, off and at its greatest amount, as a table in Markdown."""
    usual = Said(tuple(phones))
    lines = ["| pass | measured by | usual | off | at 2 |", "|---|---|---|---|---|"]
    for name, (measure, unit) in MEASURES.items():
        row = amounts()[name]
        cells = [measure(usual), measure(Said(usual.phones, Articulation(**{name: 0.0})))]
        cells += [measure(Said(usual.phones, Articulation(**{name: row.high})))] if row.high > 1.0 else []
        shown = [f"{value:.{0 if abs(value) >= 20 else 1}f} {unit}" for value in cells]
        lines.append(f"| `{name}` | {row.measure} | {' | '.join([*shown, '—'][:3])} |")
    return "\n".join(lines)


def rows() -> str:
    """What a style can set, as a table in Markdown."""
    lines = ["| amount | what it does | range | source |", "|---|---|---|---|"]
    return "\n".join(
        lines + [f"| `{row.name}` | {row.doc} | 0 to {row.high:g} | {row.source} |" for row in style_table().values()]
    )


def styles() -> str:
    """The styles that have a name, as a table in Markdown."""
    lines = ["| style | amounts | what it is like |", "|---|---|---|"]
    for style in named_styles().values():
        given = " ".join(f"{name}={value:g}" for name, value in style.amounts.items())
        lines.append(f"| `{style.name}` | {given} | {style.doc} |")
    return "\n".join(lines)


def fill(page: str) -> str:
    """The page with its tables as they are now; each lies between ``<!-- NAME -->`` and ``<!-- end -->``."""
    tables = {"amounts": rows(), "styles": styles(), "ablation": ablation(read_phones())}
    for name, table in tables.items():
        before, mark, rest = page.partition(f"<!-- {name} -->\n")
        page = before + mark + table + "\n" + rest[rest.index("<!-- end -->") :]
    return page


def _nearest_frame(time_s: float, shift_s: float) -> float:
    return round((time_s - shift_s) * 12.0) / 12.0 + shift_s


def _travel(said: Said, channel: str, start_s: float, end_s: float) -> float:
    inside = (said.times_s >= start_s) & (said.times_s <= end_s)
    return float(np.abs(np.diff(said.curves[channel][inside])).sum())


def main() -> None:
    """Print the ablation, or write the tables of the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="bring docs/passes.md up to date")
    if parser.parse_args().write:
        PAGE.write_text(fill(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    else:
        print(ablation(read_phones()))


if __name__ == "__main__":
    main()
