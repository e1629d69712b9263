"""The mended weak points beside the trial's, same view, same light: docs/gallery/mended.jpg.

    python tools/before_after.py FOLDER

FOLDER is the trial's, as for tools/pack_head.py, with head2_identities.npz.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import mend_head
import model_mouth
import numpy as np
import pack_head

import mien
from mien.faces.head import residual
from mien.faces.head.arrays import parse_arrays
from mien.faces.head.head import Head
from mien.faces.head.measured import Archive
from mien.faces.head.residual import Residual

ROOT = Path(__file__).parents[1]
SIZE = (380, 330)
VIEWS = (
    ("mouth", {"jaw.rotation": 14}, (0.0, -0.07, 0.07), (20, -4, 0.4)),
    ("front of the ear", {}, (0.08, -0.02, 0.0), (45, 0, 0.36)),
    ("lids of another person, shut", {"eyelid.opening": 0.0}, (0.0, 0.006, 0.07), (0, 0, 0.34)),
)


def trial_mouth(head: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The trial's own crowns, gums and tongue in the layout of the data file."""
    cm = model_mouth.CM
    teeth = head["teeth_v"]
    return {
        "teeth_points": (teeth * cm).astype(np.float32),
        "teeth_quads": head["teeth_q"],
        "teeth_lower": np.arange(len(teeth)) >= int(head["teeth_start"][16]),
        "teeth_shade": np.ones(len(teeth), np.float16),
        "gums_points": (head["gums_v"] * cm).astype(np.float32),
        "gums_quads": head["gums_q"],
        "gums_lower": np.arange(len(head["gums_v"])) >= int(head["gums_upper"]),
        "tongue_points": (head["tongue_v"] * cm).astype(np.float32),
        "tongue_quads": head["tongue_q"],
    }


def old_archive(folder: Path) -> Archive:
    """The data file as it would be without the mending."""
    mend, build = mend_head.mend, model_mouth.build
    mend_head.mend, model_mouth.build = lambda *_: None, trial_mouth
    try:
        with tempfile.TemporaryDirectory() as place:
            pack_head.OUT = Path(place)
            pack_head.main(folder)
            return Archive(parse_arrays((Path(place) / "head.arrays").read_bytes()))
    finally:
        mend_head.mend, model_mouth.build = mend, build


def person(folder: Path, number: int) -> Residual:
    people, head = np.load(folder / "head2_identities.npz"), np.load(folder / "head2.npz")
    cage, surface = (people[kind][number].astype(float) * 0.01 for kind in ("control", "onsurface"))
    scale = float(people["eye_radius"][number] / head["eye_radius"])
    return Residual(cage, surface, people["eye_shift"][number][0].astype(float) * 0.01, scale)


def pictures(someone: Residual) -> list[mien.Picture]:
    out = []
    for number, (_, values, at, camera) in enumerate(VIEWS):
        face = Head(hair="bald", residual=someone if number == 2 else None)
        out.append(mien.draw(face, values, replace(mien.Scene(size_px=SIZE), at=at).turned(*camera)))
    return out


def main(folder: Path) -> None:
    someone = person(folder, 5)
    after = pictures(someone)
    old, fit = old_archive(folder), residual.fit_lids
    Head._archive = property(lambda _: old)  # type: ignore[assignment]
    residual.fit_lids = lambda _points, lids, *_: lids
    before = pictures(someone)
    residual.fit_lids = fit
    labels = [f"{when}: {name}" for when in ("before", "after") for name, *_ in VIEWS]
    mien.contact_sheet(before + after, 3, labels).write(ROOT / "docs/gallery/mended.jpg")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
