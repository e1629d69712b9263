"""Filled polygons side by side: ``python benchmarks/fill.py [--rounds 15] [--frames 8]``.

Ours and cairo (pycairo) fill the same 60 polygons at 1024 x 1024, one thread each, in turn, round after round, in the
processor time of that thread; the median round counts. Time goes from outlines in NumPy to finished pixels. pycairo is
given each outline point by point, as it has no other way, and once more with paths that it has made before
(`append_path`), which leaves out what Python costs it. Ours blends in linear light, cairo in sRGB. "With clips" ours
draws half of the polygons inside or outside of regions that they share; it is compared with pycairo without.

Error is that of the share of a pixel that one polygon covers, over all pixels that its outline crosses, against lines
64 times as fine as pixels; a code is 1/255. pycairo is used where it is installed: apt install libcairo2-dev pkg-config
gcc; pip install pycairo.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from dataclasses import replace
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Path, Region, Scene
from mien.render import Renderer, draw_drawing
from mien.render.drawing import coverage

SIDE_PX = 1024
POLYGONS = 60
CORNERS = 160
"""Points of an outline: its curves are flattened as finely as those of a drawn face."""

FINE = 64
LEAST = 0.01
"""A pixel covered by less, 1/255, or by less than all but this, has no edge in it but rounding."""

TARGET = 1.2
BEHIND = (0.8, 0.9, 1.0, 1.0)

Draw = Callable[[], NDArray[np.uint8]]


def make_drawing(seed: int = 1) -> Drawing:
    """Round shapes with waves in their outlines, every third with a hole, from large to small."""
    generator = np.random.default_rng(seed)
    paths = []
    for k in range(POLYGONS):
        middle = generator.uniform(0.1, 0.9, 2) * SIDE_PX
        radius = SIDE_PX * generator.uniform(0.5, 1.0) * (0.3 if k < POLYGONS // 4 else 0.12)
        contours = (_wavy(generator, middle, radius),)
        if k % 3 == 0:
            contours = (*contours, _wavy(generator, middle, 0.45 * radius))
        red, green, blue = generator.random(3).tolist()
        paths.append(Path(f"polygon{k}", contours, (red, green, blue, 1.0), "evenodd" if k % 3 == 0 else "nonzero"))
    return Drawing((float(SIDE_PX), float(SIDE_PX)), tuple(paths), BEHIND)


def _wavy(generator: np.random.Generator, middle: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    """(N, 2) a circle whose radius changes along three waves."""
    angle = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    waves = sum(
        generator.uniform(0.0, 0.12) * np.sin(number * angle + generator.uniform(0.0, 6.3)) for number in (2, 3, 5)
    )
    return middle + (radius * (1.0 + waves))[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def clip_drawing(drawing: Drawing) -> Drawing:
    """The same with every second polygon inside or outside of one of three rings that they share."""
    middle = np.array([SIDE_PX, SIDE_PX]) / 2.0
    regions = [
        Region((_wavy(np.random.default_rng(seed), middle, 0.2 * SIDE_PX * (seed + 1)),), "nonzero")
        for seed in range(3)
    ]
    paths = [
        Path(path.name, path.contours, path.color, path.rule, inside=(regions[k // 4 % 3],))
        if k % 4 == 1
        else Path(path.name, path.contours, path.color, path.rule, outside=(regions[k // 4 % 3],))
        if k % 4 == 3
        else path
        for k, path in enumerate(drawing.paths)
    ]
    return Drawing(drawing.size, tuple(paths), BEHIND)


def _downwards(path: Path) -> list[NDArray[np.float64]]:
    """Contours of a path in pixels from the upper left."""
    return [np.array([0.0, SIDE_PX]) + contour * (1.0, -1.0) for contour in path.contours]


class Cairo:
    """Drawings by pycairo."""

    def __init__(self, cairo: ModuleType) -> None:
        self._cairo = cairo

    def __call__(self, drawing: Drawing, prepared: bool = False) -> Draw:
        """What fills all paths of a drawing without clips, y down as cairo has it; RGBA."""
        cairo = self._cairo
        outlines = [_downwards(path) for path in drawing.paths]
        colors = [path.color[:3] for path in drawing.paths]
        rules = [
            cairo.FILL_RULE_EVEN_ODD if path.rule == "evenodd" else cairo.FILL_RULE_WINDING for path in drawing.paths
        ]
        scratch = cairo.Context(cairo.ImageSurface(cairo.FORMAT_ARGB32, 1, 1))
        made = []
        for contours in outlines if prepared else []:
            scratch.new_path()
            self._trace(scratch, contours)
            made.append(scratch.copy_path())

        def draw() -> NDArray[np.uint8]:
            surface = cairo.ImageSurface(cairo.FORMAT_ARGB32, SIDE_PX, SIDE_PX)
            context = cairo.Context(surface)
            if drawing.background is not None:
                context.set_source_rgb(*drawing.background[:3])
                context.paint()
            for k, color in enumerate(colors):
                context.set_source_rgb(*color)
                context.set_fill_rule(rules[k])
                if prepared:
                    context.append_path(made[k])
                else:
                    self._trace(context, outlines[k])
                context.fill()
            surface.flush()
            return np.frombuffer(surface.get_data(), dtype=np.uint8).reshape(SIDE_PX, SIDE_PX, 4)

        return draw

    @staticmethod
    def _trace(context: object, contours: list[NDArray[np.float64]]) -> None:
        for contour in contours:
            first, *others = contour.tolist()
            context.move_to(*first)  # type: ignore[attr-defined]
            for point in others:
                context.line_to(*point)  # type: ignore[attr-defined]
            context.close_path()  # type: ignore[attr-defined]


def find_cairo() -> ModuleType | None:
    """pycairo, or None after a word."""
    try:
        import cairo
    except ImportError as reason:
        print(f"pycairo is left out: {reason}")
        return None
    print(f"pycairo {cairo.version}, cairo {cairo.cairo_version_string()}")
    return cairo  # type: ignore[no-any-return]


def race(draws: dict[str, Draw], rounds: int, frames: int) -> dict[str, float]:
    """Milliseconds a picture, the median of the rounds."""
    times: dict[str, list[float]] = {name: [] for name in draws}
    for draw in draws.values():
        draw()
    for _ in range(rounds):
        for name, draw in draws.items():
            start = time.thread_time()
            for _ in range(frames):
                draw()
            times[name].append((time.thread_time() - start) * 1000.0 / frames)
    return {name: statistics.median(each) for name, each in times.items()}


def errors(draw_one: Callable[[Drawing], NDArray[np.uint8]], drawing: Drawing, count: int) -> tuple[float, float]:
    """Mean and largest error of what single polygons cover of nothing, 1/255, where their outlines run."""
    wrong = []
    for path in drawing.paths[:count]:
        wanted = 255.0 * coverage(_downwards(path), SIDE_PX, SIDE_PX, path.rule, FINE)
        got = draw_one(Drawing(drawing.size, (path,)))[:, :, 3]
        edge = (wanted > LEAST) & (wanted < 255.0 - LEAST)
        wrong.append(np.abs(got - wanted)[edge])
    every = np.concatenate(wrong)
    return float(every.mean()), float(every.max())


def main() -> None:
    """Measure and say it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--frames", type=int, default=8, help="pictures a round")
    parser.add_argument("--compared", type=int, default=20, help="polygons whose coverage is compared")
    options = parser.parse_args()
    drawing, scene = make_drawing(), Scene(size_px=(SIDE_PX, SIDE_PX))
    clipped = clip_drawing(drawing)
    cairo = find_cairo()
    with Renderer(scene) as renderer:
        draws: dict[str, Draw] = {
            "mien": lambda: renderer.draw_drawing(drawing),
            "mien, with clips": lambda: renderer.draw_drawing(clipped),
        }
        if cairo is not None:
            draws["pycairo"] = Cairo(cairo)(drawing)
            draws["pycairo, paths made before"] = Cairo(cairo)(drawing, prepared=True)
        times = race(draws, options.rounds, options.frames)
    clear = replace(scene, background=((0.0,) * 4,) * 2)
    exactness = {"mien": errors(lambda each: draw_drawing(each, clear), drawing, options.compared)}
    if cairo is not None:
        exactness["pycairo"] = errors(lambda each: Cairo(cairo)(each)(), drawing, options.compared)
    print(f"\n{'':28}{'ms':>8}{'of pycairo':>12}{'of prepared':>12}   error of a pixel on an edge: mean, largest")
    for name, ms in times.items():
        line = f"{name:28}{ms:8.2f}"
        for peer in ("pycairo", "pycairo, paths made before"):
            line += f"{ms / times[peer]:12.2f}" if peer in times else f"{'-':>12}"
        mean, most = exactness.get(name, (None, None))
        print(line + (f"   {mean:.2f} {most:.2f}" if mean is not None else ""))
    if cairo is not None:
        ratio = times["mien"] / times["pycairo"]
        exact_enough = exactness["mien"][0] <= exactness["pycairo"][0]
        print(f"\ntarget {TARGET:g} x pycairo's time: {ratio:.2f}, {'met' if ratio <= TARGET else 'missed'}", end="; ")
        print(f"at least as exact: {'met' if exact_enough else 'missed'}")


if __name__ == "__main__":
    main()
