"""How like measured lips ours move: ``python benchmarks/lips.py CSV TEXTGRID [--rhubarb FILE]``.

The CSV has the columns ``time`` (s), ``aperture``, ``width`` and ``jaw``, in any unit and order; an empty cell was not
measured. The phones of the same recording are in a TextGrid, or in any other file of cues that mien reads. Printed is
the correlation of each column with the drawn head, whose lips are moved by us, and by what others do with the same
phones: jump from target to target, smooth these steps by a Gaussian, or play Rhubarb's nine shapes. With ``--rhubarb``
the shapes are those of Rhubarb's own output for the recording, otherwise those that our rules choose from the phones.
"""

from __future__ import annotations

import argparse
import csv
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from mien.core import Cue, LoadError, MienError
from mien.faces.head import Head
from mien.faces.head.measured import archive
from mien.formats.cue_files import read_cue_file
from mien.perform import cues_for_speech
from mien.speech.mouth import MOUTH_CHANNELS, articulate
from mien.speech.mouth_passes import tidy
from mien.speech.mouth_table import BLENDED, phone_table
from mien.speech.shapes import shapes_of
from mien.vocab import load_remap

COLUMNS = ("aperture", "width", "jaw")
SIGMA_S = 0.04
BLOCK_S = 1.0
DRAWS = 400

Curves = Mapping[str, np.ndarray]
"""(N,) values of each channel."""


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("csv", type=Path, help="time, aperture, width, jaw")
    parser.add_argument("textgrid", type=Path, help="the phones")
    parser.add_argument("--rhubarb", type=Path, help="Rhubarb's output for the same recording: TSV, XML or JSON")
    arguments = parser.parse_args()
    try:
        times, measured = read_measured(arguments.csv)
        phones = cues_for_speech(read_cue_file(arguments.textgrid))[1]
        theirs = None if arguments.rhubarb is None else read_cue_file(arguments.rhubarb).tier("shapes")
        print(table(times, measured, phones, theirs or shapes_of(phones, "rhubarb")))
    except MienError as error:
        parser.error(str(error))


def read_measured(path: Path) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Times (N,) s and the measured columns (N,), NaN where nothing was measured.

    Raises:
        LoadError: a column is missing, a cell is no number, or times do not rise.
    """
    with path.open(encoding="utf-8-sig", newline="") as file:
        reader = csv.DictReader(file)
        missing = [name for name in ("time", *COLUMNS) if name not in (reader.fieldnames or ())]
        if missing:
            raise LoadError(path, f"has no column {', '.join(missing)}", line=1, hint="want time,aperture,width,jaw")
        rows = [[_number(path, reader.line_num, name, row[name]) for name in ("time", *COLUMNS)] for row in reader]
    numbers = np.array(rows).reshape(-1, 1 + len(COLUMNS))
    times = numbers[:, 0]
    if len(times) < 3 or not np.all(np.diff(times) > 0.0):
        raise LoadError(path, "want three rows or more, whose times rise")
    return times, dict(zip(COLUMNS, numbers[:, 1:].T, strict=True))


def table(times_s: np.ndarray, measured: Mapping[str, np.ndarray], phones: Sequence[Cue], shapes: Sequence[Cue]) -> str:
    """Correlations with 95 % intervals as a table in Markdown."""
    lines = ["| moved by | aperture | width | jaw |", "|---|---|---|---|"]
    for name, curves in drivers(times_s, phones, shapes).items():
        ours = look(curves)
        cells = [_say(*correlate(times_s, measured[column], ours[column])) for column in COLUMNS]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def drivers(times_s: np.ndarray, phones: Sequence[Cue], shapes: Sequence[Cue]) -> dict[str, Curves]:
    """What the channels of the mouth do at times (N,) s, by who moves it."""
    tracks = articulate(phones)
    fine = np.arange(times_s[0] - 5.0 * SIGMA_S, times_s[-1] + 5.0 * SIGMA_S, 0.005)
    stepped = steps(fine, tidy(phones))
    return {
        "mien": {name: track.evaluate(times_s)[0] for name, track in tracks.items()},
        "steps": steps(times_s, tidy(phones)),
        f"Gaussian of {1000.0 * SIGMA_S:.0f} ms": {
            name: np.interp(times_s, fine, smooth(curve, SIGMA_S / 0.005)) for name, curve in stepped.items()
        },
        "Rhubarb's shapes": play_shapes(times_s, shapes),
    }


def steps(times_s: np.ndarray, phones: Sequence[Cue]) -> Curves:
    """Each phone's targets for as long as it lasts; lips shut or tucked while p b m or f v last."""
    rows = [phone_table()[cue.symbol] for cue in phones]
    held = [[float(row.hold == "closure"), float(row.hold == "tuck"), *row.targets] for row in rows]
    place = np.searchsorted([cue.start_s for cue in phones], times_s, side="right") - 1
    values = np.array(held)[np.maximum(place, 0)]
    return dict(zip(("closure", "tuck", *BLENDED), values.T, strict=True))


def smooth(curve: np.ndarray, sigma: float) -> np.ndarray:
    """A curve (N,) smoothed by a Gaussian of sigma samples; its ends go on."""
    reach = math.ceil(4.0 * sigma)
    weight = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    return np.convolve(np.pad(curve, reach, mode="edge"), weight / weight.sum(), mode="valid")


def play_shapes(times_s: np.ndarray, shapes: Sequence[Cue]) -> Curves:
    """Each shape for as long as it lasts, and rest where there is none."""
    remap = load_remap("rhubarb", "channels")
    curves = {name: np.zeros(len(times_s)) for name in MOUTH_CHANNELS}
    for cue in shapes:
        inside = (times_s >= cue.start_s) & (times_s < cue.end_s)
        for name, value in remap.apply({cue.symbol: 1.0}).items():
            curves[name][inside] = value
    return curves


def look(curves: Curves) -> dict[str, np.ndarray]:
    """Aperture mm, width mm and jaw deg of the head at each of the times."""
    head, remap = Head(hair="bald"), load_remap("channels", "head")
    vertex = archive().vertex
    corner, upper, lower = vertex["m0_5"], vertex["m0_0"], vertex["m0_9"]
    other = int(archive().mirror[corner])
    seen = []
    for number in range(len(next(iter(curves.values())))):
        values = {name: float(curve[number]) for name, curve in curves.items()}
        added, scale = remap.apply(values), remap.scale(values)
        table = head.parameters
        moved = {
            name: (table[name].default + added.get(name, 0.0)) * scale.get(name, 1.0) for name in {**added, **scale}
        }
        inside = {name: min(max(value, table[name].low), table[name].high) for name, value in moved.items()}
        pose = head.neutral.replace(inside)
        points = 1000.0 * head.shape(pose).points
        seen.append((points[upper, 1] - points[lower, 1], points[corner, 0] - points[other, 0], pose["jaw.rotation"]))
    return dict(zip(COLUMNS, np.array(seen).T, strict=True))


def correlate(times_s: np.ndarray, measured: np.ndarray, ours: np.ndarray) -> tuple[float, float, float]:
    """Pearson's correlation where both are known, with the ends of its 95 % interval.

    The interval is a bootstrap over blocks of a second, because neighbouring moments are not independent.
    """
    known = np.isfinite(measured)
    blocks = np.floor((times_s[known] - times_s[0]) / BLOCK_S).astype(int)
    pairs = np.stack([measured[known], ours[known]])
    parts = [pairs[:, blocks == block] for block in np.unique(blocks)]
    r = _pearson(pairs)
    if math.isnan(r):
        return r, r, r
    generator = np.random.default_rng(0)
    drawn = [
        _pearson(np.concatenate([parts[i] for i in generator.integers(0, len(parts), len(parts))], axis=1))
        for _ in range(DRAWS)
    ]
    return r, *(float(end) for end in np.nanpercentile(drawn, [2.5, 97.5]))


def _pearson(pairs: np.ndarray) -> float:
    if pairs.shape[1] < 3 or np.any(np.ptp(pairs, axis=1) == 0.0):
        return math.nan
    return float(np.corrcoef(pairs)[0, 1])


def _say(r: float, low: float, high: float) -> str:
    return "none" if math.isnan(r) else f"{r:.2f} ({low:.2f} … {high:.2f})"


def _number(path: Path, line: int, name: str, text: str | None) -> float:
    if not (text or "").strip() and name != "time":
        return math.nan
    try:
        number = float(text or "")
    except ValueError:
        raise LoadError(path, f"{name}: {text!r} is not a number", line=line) from None
    if not math.isfinite(number):
        raise LoadError(path, f"{name}: {text} is not finite", line=line)
    return number


if __name__ == "__main__":
    main()
