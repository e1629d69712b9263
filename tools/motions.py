"""Build docs/motions.md and its filmstrips: each standard motion on a head and on a drawn face.

python tools/motions.py [--pictures [NAME ...]]
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Mapping
from functools import cache
from io import BytesIO
from pathlib import Path
from types import ModuleType

from PIL import Image

import mien
from mien.core import Face
from mien.live import IDLE_PARTS, Motion, Session, standard_motions

ROOT = Path(__file__).parents[1]
PLACE, PICTURES = ROOT / "docs/motions.md", ROOT / "docs/motions"
FACES = {"head": 0.92, "toon:olav": 1.0}
"""Faces that the strips show, and how near the camera is; a drawn face fills its picture as it is."""

FRAMES, SIZE_PX, COLORS = 6, (112, 124), 96
STILL = dict.fromkeys(IDLE_PARTS, 0.0)
HEADER = """# Standard motions

Made by `python tools/motions.py --pictures` from `src/mien/live/data/motions.json`; a test compares them. Every face
plays all of them: `{"kind": "play", "motion": "smile"}`, `PLAY smile`, `/mien/play smile`; files of one's own have the
same form (`mien live --motions FILE`). A motion takes the place of those that move the same regions of the face, and
joins the others. Below are %(count)d, on the head and on `toon:olav`, at the seconds under the pictures; left and right
are the face's own.

**No two alike.** The distance of two motions is that of their tracks at 60 Hz, each row in shares of its range, root of
the sum over rows, mean over the time of the longer one (`python benchmarks/motions.py`). The nearest two are
%(nearest)s.
Each motion names the one that is most like it.

"""


def benchmark() -> ModuleType:
    """The program that measures how far apart motions are."""
    spec = importlib.util.spec_from_file_location("benchmark_motions", ROOT / "benchmarks" / "motions.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@cache
def nearest() -> Mapping[str, Mapping[str, tuple[str, float]]]:
    """By face and motion, the most similar other motion and how far it is."""
    measure = benchmark()
    return {address: measure.nearest(measure.tracks(mien.load_face(address))) for address in FACES}


# ------------------------------------------------------------------ the page


def page() -> str:
    """The text of the page."""
    motions = standard_motions()
    lines = [" · ".join(f"[{name}](#{name})" for name in motions), ""]
    for name, motion in motions.items():
        like = "; ".join(f"on `{face}` `{best[name][0]}`, {best[name][1]:.3f}" for face, best in nearest().items())
        lines += [
            f"## {name}",
            "",
            f"{motion.doc} {motion.length_s:.2f} s. Most like it: {like}.",
            "",
            f"![{name}](motions/{name}.png)",
            "",
        ]
    told = "; ".join(_least(face) for face in FACES)
    return HEADER % {"count": len(motions), "nearest": told} + "\n".join(lines)


def _least(address: str) -> str:
    best = nearest()[address]
    name = min(best, key=lambda each: best[each][1])
    return f"on `{address}`, `{name}` and `{best[name][0]}`, {best[name][1]:.3f} apart"


# ------------------------------------------------------------------ the pictures


def moments(motion: Motion, count: int = FRAMES) -> list[int]:
    """Telling times in ms: those of the keys; the closest of them left out, or the longest ways halved."""
    times = [0.0, *(key.at_ms for key in motion.keys)]
    while len(times) < count + 2:
        gap = max(range(1, len(times)), key=lambda i: times[i] - times[i - 1])
        times.insert(gap, 0.5 * (times[gap - 1] + times[gap]))
    while len(times) > count + 2:
        del times[min(range(1, len(times) - 1), key=lambda i: times[i + 1] - times[i - 1])]
    return [round(time) for time in times[1:-1]]


def draw_frames(motion: Motion, address: str) -> list[mien.Picture]:
    """A face at the telling times of a motion."""
    face: Face = mien.load_face(address)
    scene = mien.Scene(size_px=SIZE_PX).turned(0, 0, FACES[address])
    session = Session(face, idle=STILL)
    session.handle({"kind": "play", "motion": motion.name})
    poses = [session.step().pose for _ in range(round(60 * motion.length_s))]
    return [mien.draw(face, poses[max(0, round(0.06 * time_ms) - 1)], scene) for time_ms in moments(motion)]


def strip(motion: Motion) -> bytes:
    """PNG of few colours: a row a face."""
    frames = [frame for address in FACES for frame in draw_frames(motion, address)]
    labels = [f"{time_ms / 1000:.2f}" for time_ms in moments(motion)] * len(FACES)
    sheet = Image.fromarray(mien.contact_sheet(frames, FRAMES, labels).pixels).convert("RGB")
    data = BytesIO()
    sheet.quantize(COLORS, dither=Image.Dither.NONE).save(data, "PNG", optimize=True)
    return data.getvalue()


def main(arguments: list[str]) -> None:
    if arguments[:1] == ["--pictures"]:
        PICTURES.mkdir(exist_ok=True)
        for name in arguments[1:] or standard_motions():
            (PICTURES / f"{name}.png").write_bytes(strip(standard_motions()[name]))
    PLACE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
