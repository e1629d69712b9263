"""Write a smaller copy of a capture project: some of its moments, photographs reduced, clicks with them.

python tools/shrink_capture.py ../vera examples/capture/vera 750 neutral smile open
"""

from __future__ import annotations

import shutil
import sys
from dataclasses import replace
from pathlib import Path

from PIL import Image

from mien.capture.project import read_project
from mien.capture.project_points import format_points, read_points
from mien.capture.project_records import PICTURES, POINTS, PROJECT, REFERENCES, TOPOLOGY
from mien.capture.project_toml import format_project

KEPT = (REFERENCES, TOPOLOGY, "marks.csv")
QUALITY = 88


def shrink(source: Path, out: Path, width_px: int, moments: list[str]) -> None:
    """Write the copy."""
    project = read_project(source)
    (out / PICTURES).mkdir(parents=True)
    photographs, shares = [], {}
    for photograph in (each for each in project.photographs if each.moment in moments):
        share = width_px / photograph.size_px[0]
        size_px = (width_px, round(photograph.size_px[1] * share))
        with Image.open(photograph.path) as picture:
            picture.resize(size_px, Image.Resampling.LANCZOS).save(out / PICTURES / photograph.name, quality=QUALITY)
        photographs.append(replace(photograph, size_px=size_px, path=out / PICTURES / photograph.name))
        shares[photograph.name] = share
    clicks = [
        replace(each, u=round(each.u * share, 2), v=round(each.v * share, 2), sigma_px=round(each.sigma_px * share, 3))
        for each in read_points(source / POINTS, project.photographs)
        if (share := shares.get(each.photo))
    ]
    smaller = replace(project, folder=out, photographs=tuple(photographs))
    (out / PROJECT).write_text(format_project(smaller), encoding="utf-8", newline="\n")
    (out / POINTS).write_text(format_points(clicks), encoding="utf-8", newline="\n")
    for name in KEPT:
        shutil.copyfile(source / name, out / name)


if __name__ == "__main__":
    shrink(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), sys.argv[4:])
