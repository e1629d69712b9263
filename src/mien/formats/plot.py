"""The curves of a timeline as a printed page: a strip for each parameter, phones and words beneath.

Source: Parke 1974, Appendix B, whose figures this follows: frame numbers across, given values as dots, the phonetic
text beneath; a given value that the curve does not reach is shown hollow (his figure B.18 shows one dashed).
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mien.core import Cue, MienError, Parameter, ParameterTable, UnknownNameError
from mien.timeline import Timeline

from .atomic import writing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]

SUFFIXES = (".png", ".svg", ".pdf")
MOST_DOTS = 300
"""A parameter with more given values than this is drawn without dots: they would be the curve."""

_INK, _CURVE, _DOT, _FAINT, _VOICE = "#1a1a1a", "#1d3f66", "#a8321e", "#8c8c8c", "#f4f1ea"
_SAMPLES_A_FRAME, _MOST_SAMPLES, _CHUNK = 8, 40_000, 4096
_INCHES_A_SECOND, _LEAST_WIDTH, _MOST_WIDTH = 1.0, 7.6, 60.0
_STRIP, _GAP, _CUES, _TOP, _TITLE, _BOTTOM, _LEFT, _RIGHT = 0.78, 0.34, 0.22, 0.68, 0.22, 0.46, 0.66, 0.22  # inches
_MOST_STRIPS = 120
_BREATH_S = 0.05
_TICK_STEPS = (1, 2, 5, 10, 12, 24, 48, 120, 240, 480, 1200, 2400, 4800, 12000, 24000, 48000, 120000)

_STYLE: dict[str, Any] = {
    "font.family": ["DejaVu Serif", "DejaVu Sans"],
    "font.size": 7.5,
    "axes.linewidth": 0.6,
    "axes.edgecolor": _INK,
    "axes.labelcolor": _INK,
    "text.color": _INK,
    "xtick.color": _INK,
    "ytick.color": _INK,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 3.0,
    "ytick.major.size": 2.5,
    "xtick.minor.width": 0.4,
    "xtick.minor.size": 1.6,
    "svg.hashsalt": "mien",
    "path.simplify": True,
}
_NO_CLOCK: dict[str, dict[str, None]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


@dataclass(frozen=True, eq=False)
class Strip:
    """What is drawn of one parameter, or of a left and right that move alike.

    Attributes:
        label: the name to print.
        parameter: its row.
        values: (N,) at the times of the curve.
        covered: (N,) whether a track says something at that time, rather than holding.
        dot_times_s: (K,) s, times of the given values; empty when there are too many.
        dot_values: (K,) the given values.
        reached: (K,) whether the curve passes through them.
    """

    label: str
    parameter: Parameter
    values: Floats
    covered: NDArray[np.bool_]
    dot_times_s: Floats
    dot_values: Floats
    reached: NDArray[np.bool_]


def plot_timeline(
    timeline: Timeline,
    table: ParameterTable,
    path: Path | str,
    parameters: Sequence[str] | None = None,
    fps: float = 24,
) -> None:
    """Writes the curves of a timeline as a picture; the same timeline gives the same bytes.

    Args:
        timeline: what to draw.
        table: of the face that plays it.
        path: ``.png``, ``.svg`` or ``.pdf``; an existing file is replaced when the new one is complete.
        parameters: which to draw, in this order; None is every parameter that some track drives.
        fps: what the frame numbers count in.

    Raises:
        UnknownNameError: an unknown suffix or parameter.
        MienError: nothing to draw, or the place cannot be written.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise UnknownNameError("suffix of a plot", suffix, SUFFIXES)
    times = curve_times(timeline, fps)
    strips = collect_strips(timeline, table, times, parameters)
    if not strips:
        raise MienError(f"{path}: no track drives a parameter, so there is no curve — name parameters to see them held")
    if len(strips) > _MOST_STRIPS:
        raise MienError(
            f"{path}: {len(strips)} curves are too many for a page of {_MOST_STRIPS} — name some parameters"
        )

    # Here and not above: matplotlib takes half a second to load, and only plots need it.
    from matplotlib import style

    with writing(path) as temporary, style.context(["default", _STYLE]), warnings.catch_warnings():
        # A word in a script that the fonts lack is drawn as boxes; that is no reason to have no plot.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure = draw_page(timeline, strips, times, fps)
        figure.savefig(temporary, format=suffix[1:], dpi=160, metadata=_NO_CLOCK[suffix])


def curve_times(timeline: Timeline, fps: float) -> Floats:
    """(N,) s, rising: some moments a frame, fewer in long timelines, and every frame's own when they are few."""
    frames = timeline.frame_count(fps)
    count = min(frames * _SAMPLES_A_FRAME, _MOST_SAMPLES)
    return np.arange(count + 1, dtype=np.float64) * (frames / count) / fps


def collect_strips(
    timeline: Timeline, table: ParameterTable, times_s: Floats, parameters: Sequence[str] | None = None
) -> list[Strip]:
    """The strips of the named parameters, or of all that some track drives.

    Raises:
        UnknownNameError: a name is not in the table.
    """
    if parameters is None:
        names = list(timeline.driven(table))
    else:
        names = list(dict.fromkeys(row for name in parameters for row in table.resolve(name)))
    columns = [table.index[name] for name in names]
    values, covered = np.empty((len(times_s), len(names))), np.empty((len(times_s), len(names)), dtype=np.bool_)
    for first in range(0, len(times_s), _CHUNK):
        part = slice(first, first + _CHUNK)
        all_values, all_covered = timeline.evaluate(times_s[part], table)
        values[part], covered[part] = all_values[:, columns], all_covered[:, columns]
    strips: list[Strip] = []
    left_out: set[str] = set()
    for column, name in enumerate(names):
        if name in left_out:
            continue
        label, twin = name, table[name].mirror
        if twin != name and twin in names and np.array_equal(values[:, column], values[:, names.index(twin)]):
            left_out.add(twin)
            label = name.removesuffix(".left").removesuffix(".right") + " (left and right)"
        dots = _dots(timeline, table, name)
        strips.append(Strip(label, table[name], values[:, column], covered[:, column], *dots))
    return strips


def draw_page(timeline: Timeline, strips: Sequence[Strip], times_s: Floats, fps: float) -> Figure:
    """The page: strips from top to bottom on one time axis, then phones, words and frame numbers."""
    from matplotlib.figure import Figure

    end_s = float(times_s[-1])
    width = min(max(_LEFT + _RIGHT + _INCHES_A_SECOND * end_s, _LEAST_WIDTH), _MOST_WIDTH)
    cue_rows = [cues for cues in (timeline.phones, timeline.words) if cues]
    below = _BOTTOM + _CUES * len(cue_rows) + 0.08
    above = _TOP + (_TITLE if timeline.title else 0.0)
    height = above + len(strips) * (_STRIP + _GAP) - _GAP + below
    figure = Figure(figsize=(width, height))
    figure.patch.set_facecolor("white")

    def add_axes(bottom: float, tall: float) -> Axes:
        box = (_LEFT / width, bottom / height, (width - _LEFT - _RIGHT) / width, tall / height)
        axes = figure.add_axes(box)
        axes.set_xlim(0.0, end_s)
        return axes

    ticks = _tick_frames(end_s * fps, (width - _LEFT - _RIGHT) / 0.5) / fps
    for number, strip in enumerate(strips):
        top = height - above - number * (_STRIP + _GAP)
        _draw_strip(add_axes(top - _STRIP, _STRIP), strip, times_s, ticks, timeline.words or timeline.phones)
    base = below - 0.08
    for row, cues in enumerate(cue_rows):
        _draw_cues(add_axes(base - (row + 1) * _CUES, _CUES), cues, (width - _LEFT - _RIGHT) / end_s)
    frames = add_axes(_BOTTOM, 0.0001)
    _draw_clock(frames, ticks, [f"{frame:.0f}" for frame in ticks * fps], f"frames, {fps:g} a second", "bottom")
    seconds = _tick_seconds(end_s, (width - _LEFT - _RIGHT) / 0.5)
    clock = add_axes(height - above + 0.26, 0.0001)
    _draw_clock(clock, seconds, [f"{time:g}" for time in seconds], "seconds", "top")
    if timeline.title:
        figure.text(_LEFT / width, 1 - 0.08 / height, timeline.title, ha="left", va="top", size=9.5, parse_math=False)
    return figure


def _dots(timeline: Timeline, table: ParameterTable, name: str) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Times, values and whether the curve reaches them, of what was given for a row; none when there are too many."""
    tracks = [
        (layer.blend, track)
        for layer in timeline.layers
        for driven, track in layer.tracks.items()
        if name in table.resolve(driven)
    ]
    nothing = np.empty(0), np.empty(0), np.empty(0, dtype=np.bool_)
    if not tracks or sum(len(track) for _, track in tracks) > MOST_DOTS:
        return nothing
    given = [track.given() for _, track in tracks]
    times = np.concatenate([at for at, _ in given])
    seen = times <= timeline.length_s  # a track may go on after the film ends; the page does not
    times = times[seen]
    row = table.index[name]
    curve = timeline.values(times, table)[:, row]
    if len(tracks) > 1 or tracks[0][0] != "replace":
        # What was given is not what is seen where layers are mixed: the dots then say when, not how much.
        return times, curve, np.ones(len(times), dtype=np.bool_)
    values = np.clip(np.concatenate([numbers for _, numbers in given])[seen], table.lows[row], table.highs[row])
    before = timeline.values(np.nextafter(times, -math.inf), table)[:, row]
    near = 1e-6 * (table.highs[row] - table.lows[row])
    return times, values, (np.abs(values - curve) <= near) | (np.abs(values - before) <= near)


def _draw_strip(axes: Axes, strip: Strip, times_s: Floats, ticks: Floats, voiced: Sequence[Cue]) -> None:
    low, high = _view(strip)
    axes.set_ylim(low, high)
    for start, end in _spans(voiced):
        axes.axvspan(start, end, color=_VOICE, linewidth=0, zorder=0)
    axes.vlines(ticks, low, high, color="#d9d9d9", linewidth=0.35, zorder=1)
    axes.plot(times_s, strip.values, color=_FAINT, linewidth=0.7, zorder=2, clip_on=False)
    said = np.where(strip.covered, strip.values, np.nan)
    axes.plot(times_s, said, color=_CURVE, linewidth=1.15, solid_joinstyle="round", zorder=3, clip_on=False)
    for which, face in ((strip.reached, _DOT), (~strip.reached, "white")):
        axes.plot(
            strip.dot_times_s[which],
            strip.dot_values[which],
            linestyle="none",
            marker="o",
            markersize=3.0,
            markerfacecolor=face,
            markeredgecolor=_DOT,
            markeredgewidth=0.6,
            zorder=4,
            clip_on=False,
        )
    _name_strip(axes, strip)


def _name_strip(axes: Axes, strip: Strip) -> None:
    from matplotlib.ticker import MaxNLocator

    row = strip.parameter
    axes.set_xticks([])
    axes.yaxis.set_major_locator(MaxNLocator(nbins=3, steps=[1, 2, 2.5, 5, 10], min_n_ticks=2))
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}".replace("-", "−"))
    axes.tick_params(axis="y", labelsize=6.5)
    for side in ("top", "right", "bottom"):
        axes.spines[side].set_visible(False)
    title = axes.set_title(strip.label, loc="left", fontsize=8, pad=3, parse_math=False)
    unit = f" {row.unit}" if row.unit else ""
    axes.annotate(
        f"{row.low:g} to {row.high:g}{unit}".replace("-", "−"),
        xy=(1.0, 0.0),
        xycoords=title,
        xytext=(8.0, 0.6),
        textcoords="offset points",
        fontsize=6.5,
        color=_FAINT,
        style="italic",
        va="bottom",
        annotation_clip=False,
    )


def _draw_cues(axes: Axes, cues: Sequence[Cue], inches_a_second: float) -> None:
    """Symbols between thin bounds; one that would not fit is left out, its bounds are not."""
    axes.set_ylim(0, 1)
    axes.axis("off")
    bounds = sorted({bound for cue in cues for bound in (cue.start_s, cue.end_s)})
    axes.vlines(bounds, 0.12, 0.88, color=_FAINT, linewidth=0.45)
    for cue in cues:
        size = 7.0
        room = cue.length_s * inches_a_second * 72.0
        fits = min(size, room / (0.62 * max(len(cue.symbol), 1)))
        if fits >= 3.6:
            axes.text(
                cue.centre_s, 0.5, cue.symbol, ha="center", va="center_baseline", size=fits, clip_on=True,
                parse_math=False,
            )  # fmt: skip


def _draw_clock(axes: Axes, ticks: Floats, labels: Sequence[str], label: str, side: str) -> None:
    axes.set_yticks([])
    for name, spine in axes.spines.items():
        spine.set_visible(name == side)
    axes.xaxis.set_ticks_position("top" if side == "top" else "bottom")
    axes.xaxis.set_label_position("top" if side == "top" else "bottom")
    axes.set_xticks(ticks, labels)
    axes.tick_params(axis="x", labelsize=6.5)
    axes.set_xlabel(label, fontsize=7, style="italic", color=_FAINT, labelpad=2.0, loc="left")


def _view(strip: Strip) -> tuple[float, float]:
    """Lower and upper end of the value axis: the range, or a part of it when little of it is used."""
    row = strip.parameter
    full = (row.high - row.low) or 1.0
    shown = np.concatenate([strip.values, strip.dot_values])
    low, high = float(shown.min()), float(shown.max())
    if high - low >= 0.3 * full:
        return row.low, row.high if row.high > row.low else row.low + full
    spread = max(high - low, 0.02 * full)
    middle = 0.5 * (low + high)
    return max(middle - 0.65 * spread, row.low - 0.01 * full), min(middle + 0.65 * spread, row.high + 0.01 * full)


def _spans(cues: Iterable[Cue]) -> Iterator[tuple[float, float]]:
    """Stretches in which there are cues, joined where hardly anything lies between them."""
    start = end = -math.inf
    for cue in sorted(cues):
        if cue.start_s > end + _BREATH_S:
            if end > start:
                yield start, end
            start = cue.start_s
        end = max(end, cue.end_s)
    if end > start:
        yield start, end


def _tick_frames(frames: float, most: float) -> Floats:
    step = next((step for step in _TICK_STEPS if frames / step <= most), _TICK_STEPS[-1])
    return np.arange(0.0, frames + 0.5, step)


def _tick_seconds(end_s: float, most: float) -> Floats:
    steps = (0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 30, 60, 300, 600, 1800, 3600)
    step = next((step for step in steps if end_s / step <= most), steps[-1])
    return np.arange(math.floor(end_s / step + 1e-9) + 1, dtype=np.float64) * step
