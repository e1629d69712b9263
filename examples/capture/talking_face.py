"""From photographs of a face to films in which it talks, in one script.

python examples/capture/talking_face.py [-o FOLDER] [--project DIR] [--text TEXT] [--size PIXELS]

Four cameras photographed Vera within a cube of strings, in some expressions; what was clicked lies beside the
photographs. FOLDER gets a report on how exact the points are, a measured face (each expression a phase), a head that is
fitted to the first of them, a film of each, and a picture of each stage.
"""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from PIL import Image

import mien
from mien.capture import read_project, solve_project, write_solution
from mien.capture.fitting import fit_head, write_head
from mien.capture.fitting_files import read_face
from mien.capture.making import make_keypose
from mien.capture.report import write_report

HERE = Path(__file__).parent
TEXT = (HERE.parent / "stone.txt").read_text(encoding="utf-8")


def main(project: Path, out: Path, text: str, size: int) -> None:
    out.mkdir(exist_ok=True)
    folder = out / project.name
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(project, folder)
    scene = mien.Scene(size_px=(size, size)).seen("three-quarter")

    told = read_project(folder)
    solution = solve_project(folder)
    write_solution(folder, solution)
    write_report(solution, out / "report.html", name=told.name, unit=told.unit)
    show_photographs(told, out / "1_photographs.png")

    measured = out / f"{project.name}.keypose"
    make_keypose(folder, measured, name=told.name)
    face = mien.load_face(measured)
    phases = [mien.draw(face, {f"phase.{name}": 1.0}, scene) for name in face.keypose.phases[1:]]
    mien.contact_sheet([mien.draw(face, None, scene), *phases], 3, face.keypose.phases).write(out / "2_phases.png")
    mien.say(text, face, scene=scene).write(out / "measured.mp4")

    points = read_face(folder, sigma_m=0.001)
    fitted = fit_head(points.points, points.covariances)
    write_head(fitted, out / f"{project.name}.face.json", choices={"hair": "bob", "palette": "fair"})
    head = mien.load_face(out / f"{project.name}.face.json")
    expressions = ("neutral", "smile", "surprised")
    pictures = [mien.draw(head, head.neutral.replace(head.presets[name].values), scene) for name in expressions]
    mien.contact_sheet(pictures, 3, expressions).write(out / "3_head.png")
    mien.say(text, head, scene=scene).write(out / "head.mp4")


def show_photographs(project: mien.capture.Project, out: Path) -> None:
    """The photographs of the first moment, side by side."""
    first = project.photographs[0].moment
    pictures = [Image.open(each.path) for each in project.photographs if each.moment == first]
    sheet = Image.new("RGB", (sum(picture.width for picture in pictures), pictures[0].height))
    for number, picture in enumerate(pictures):
        sheet.paste(picture, (number * pictures[0].width, 0))
    sheet.save(out)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--project", type=Path, default=HERE / "vera")
    parser.add_argument("-o", "--out", type=Path, default=Path("talking_face"))
    parser.add_argument("--text", default=TEXT)
    parser.add_argument("--size", type=int, default=512)
    arguments = parser.parse_args()
    main(arguments.project, arguments.out, arguments.text, arguments.size)
