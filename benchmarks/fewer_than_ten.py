"""Parke's "fewer than ten parameters" (1974, section 5.1) put to the test: ``python benchmarks/fewer_than_ten.py``.

What the lips of our head do when speech moves all it can is what sets of parameters are measured against. Each set is
used as well as it can be: in every frame it is fitted to where those lips are (least squares, linear, within the
ranges), and what comes of it is measured on the head.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from passes import read_phones
from scipy.optimize import lsq_linear

from mien.core import Cue, Pose, Sound, subdivide
from mien.faces.head import Head
from mien.faces.head.lips import CONTACT_STATIONS
from mien.faces.head.measured import archive
from mien.perform import parse_style, perform
from mien.speech import Speech
from mien.speech.mouth_table import bare, phone_table

FPS = 24
LIP_ANIMATION = ("jaw.rotation", "mouth.upper_lip", "mouth.width")
EXPRESSION = ("mouth.expression",)
"""Of the six expression parameters of figure 5.1 the one that moves the lips: the others change no number here."""

EARLIER = ("mouth.offset", "mouth.tuck", "mouth.corner.up", "mouth.corner.side")
"""What he had used before and left out of figure 5.1 (section 4.3)."""

SHUT_MM = 1.0
"""Lips at rest touch with edges 0.3 mm apart; pursed ones touch before their edges."""

TUCKED_MM = 4.5
APART_MM = 2.0
RINGS = ("m0", "mh", "m1", "mb")


@dataclass(frozen=True)
class Lips:
    """The lips of a head in every frame of a speech.

    Attributes:
        points: (N, V, 3) mm, the rings of the lips.
        gap_mm: (N,) greatest height between their edges as drawn.
        width_mm: (N,) from corner to corner.
        forward_mm: (N,) how far the middle of the upper lip is forward.
        tuck_mm: (N,) how far the edge of the lower lip is before the upper front teeth.
    """

    points: np.ndarray
    gap_mm: np.ndarray
    width_mm: np.ndarray
    forward_mm: np.ndarray
    tuck_mm: np.ndarray

    @cached_property
    def shape(self) -> np.ndarray:
        """(N, 3) mm: gap, width and forward."""
        return np.stack([self.gap_mm, self.width_mm, self.forward_mm], axis=1)


class Stage:
    """A head, and what is looked at on it."""

    def __init__(self) -> None:
        self.head = Head(hair="bald")
        vertex, mirror = archive().vertex, archive().mirror
        self.rings = np.array([number for name, number in vertex.items() if name.split("_")[0] in RINGS])
        self.corner = (vertex["m0_5"], int(mirror[vertex["m0_5"]]))
        self.edges = [(vertex[f"m0_{up}"], vertex[f"m0_{low}"]) for up, low, *_ in CONTACT_STATIONS[:4]]
        teeth = np.arange(*self.head._layout.span["teeth"].indices(10**9)[:2])
        upper = teeth[~self.head._layout.lower["teeth"]]
        rest = self.head.shape(self.head.neutral).points
        self.front = upper[np.abs(rest[upper, 0]) < 0.008]
        self.lips = vertex["m0_0"], vertex["m0_9"]

    def look(self, rows: Sequence[np.ndarray]) -> Lips:
        """The lips of every row of values."""
        seen = [self._look(row) for row in rows]
        return Lips(np.array([points for points, *_ in seen]), *np.array([numbers for _, *numbers in seen]).T)

    def _look(self, row: np.ndarray) -> tuple[np.ndarray | float, ...]:
        mesh = self.head.shape(Pose(self.head.parameters, row))
        cage, skin = 1000.0 * mesh.points, 1000.0 * subdivide(mesh, 2).points
        upper, lower = self.lips
        return (
            cage[self.rings],
            max(float(skin[up, 1] - skin[low, 1]) for up, low in self.edges),
            float(cage[self.corner[0], 0] - cage[self.corner[1], 0]),
            float(cage[upper, 2]),
            float(cage[lower, 2] - cage[self.front, 2].max()),
        )

    def fit(self, wanted: np.ndarray, names: Sequence[str]) -> list[np.ndarray]:
        """Rows of values in which only these parameters move, to bring the rings to (N, V, 3) mm."""
        table, neutral = self.head.parameters, self.head.neutral
        rest = self._rings(neutral)
        columns, bounds = [], []
        for name in names:
            row = table[table.resolve(name)[0]]
            far = row.low if row.default == row.high else row.default + 0.4 * (row.high - row.default)
            columns.append((self._rings(neutral.replace({name: far})) - rest).ravel() / (far - row.default))
            bounds.append((row.low - row.default, row.high - row.default))
        matrix, limits = np.array(columns).T, np.array(bounds).T
        out = []
        for points in wanted:
            moved = lsq_linear(matrix, (points - rest).ravel(), bounds=limits).x
            ours = (table[table.resolve(name)[0]] for name in names)
            values = {
                name: min(max(row.default + float(by), row.low), row.high)
                for name, row, by in zip(names, ours, moved, strict=True)
            }
            out.append(neutral.replace(values).values)
        return out

    def _rings(self, pose: Pose) -> np.ndarray:
        return 1000.0 * self.head.shape(pose).points[self.rings]


def main() -> None:
    """Print the table."""
    print(table(read_phones()))


def table(phones: tuple[Cue, ...]) -> str:
    """The experiment as a table in Markdown."""
    stage = Stage()
    times, rows, moving = spoken(stage, phones)
    whole = stage.look(rows)
    his = (*LIP_ANIMATION, *EXPRESSION)
    sets: dict[str, tuple[str, ...]] = {f"figure 5.1: {len(his)}": his}
    sets |= {f"without `{left_out}`": tuple(name for name in his if name != left_out) for left_out in his}
    sets[f"figure 5.1 and what he used before: {len(his) + len(EARLIER)}"] = (*his, *EARLIER)
    lines = [
        "| parameters | RMS of the lips | opening | width | p b m shut | f v tucked | vowels apart |",
        "|---|---|---|---|---|---|---|",
        _line(f"all that speech moves: {moving}", whole, whole, phones, times),
    ]
    lines += [
        _line(name, stage.look(stage.fit(whole.points, chosen)), whole, phones, times) for name, chosen in sets.items()
    ]
    return "\n".join(lines) + "\n"


def spoken(stage: Stage, phones: tuple[Cue, ...]) -> tuple[np.ndarray, list[np.ndarray], int]:
    """Times (N,) s of the frames, their values, and how many parameters of the lips move, both sides as one."""
    speech = Speech("", Sound.silence(phones[-1].end_s), (), phones, (), "none")
    timeline = perform(speech, stage.head, style=parse_style("still")).timeline
    times = timeline.frame_times(FPS)
    table = stage.head.parameters
    driven = {name.removesuffix(".left").removesuffix(".right") for name in timeline.driven(table)}
    return times, list(timeline.values(times, table)), len([name for name in driven if not name.startswith("tongue")])


def _line(name: str, lips: Lips, whole: Lips, phones: tuple[Cue, ...], times: np.ndarray) -> str:
    error = float(np.sqrt(((lips.points - whole.points) ** 2).sum(axis=2).mean()))
    cells = [f"{error:.1f} mm", _likeness(lips.gap_mm, whole.gap_mm), _likeness(lips.width_mm, whole.width_mm)]
    cells.append(_share(_least(lips.gap_mm, phones, times, "closure") < SHUT_MM))
    cells.append(_share(_least(lips.tuck_mm, phones, times, "tuck") < TUCKED_MM))
    cells.append(_share(np.array(apart(lips, phones, times)) > APART_MM))
    return f"| {name} | {' | '.join(cells)} |"


def apart(lips: Lips, phones: tuple[Cue, ...], times: np.ndarray) -> list[float]:
    """How far apart the mean shapes of two vowels are, mm, for all pairs."""
    shapes: dict[str, list[np.ndarray]] = {}
    for cue in phones:
        if phone_table()[cue.symbol].is_vowel:
            shapes.setdefault(bare(cue.symbol), []).append(lips.shape[int(np.argmin(np.abs(times - cue.centre_s)))])
    means = [np.mean(rows, axis=0) for rows in shapes.values()]
    return [float(np.linalg.norm(one - other)) for one, other in combinations(means, 2)]


def _least(values: np.ndarray, phones: tuple[Cue, ...], times: np.ndarray, hold: str) -> np.ndarray:
    """The least value in the frames of each phone of a kind, and in those just before and after it."""
    held = [cue for cue in phones if phone_table()[cue.symbol].hold == hold]
    return np.array([values[(times > c.start_s - 0.03) & (times < c.end_s + 0.03)].min() for c in held])


def _likeness(values: np.ndarray, wanted: np.ndarray) -> str:
    return f"r {np.corrcoef(values, wanted)[0, 1]:.2f}" if np.ptp(values) > 1e-6 else "still"


def _share(which: np.ndarray) -> str:
    return f"{100.0 * float(which.mean()):.0f} %"


if __name__ == "__main__":
    main()
