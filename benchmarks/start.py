"""Cold starts side by side, as whole processes: ``python benchmarks/start.py [--rounds 7] [--no-peers]``.

The commands run in turn; the median of the rounds counts. Code is compiled and files are in memory before the clock
starts. Ours poses, subdivides and draws the head with four samples a pixel; VTK is given 50,000 finished triangles and
draws them with one. Then: what takes how long in one start of ours, step by step and import by import.
"""

from __future__ import annotations

import argparse
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from environment import default_folder, make_environment
from headlike import make_form
from workers import FOLDER, SOFTWARE

DRAW = "import mien; face = mien.load_face('head'); mien.draw(face)"


def time_process(command: list[object], environment: dict[str, str]) -> tuple[float, float]:
    """Milliseconds of the clock, and of work on all cores, of a whole process."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, cwd=FOLDER, env=environment, check=True, capture_output=True)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1000.0 * wall, 1000.0 * (after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)


def print_imports(command: list[object]) -> None:
    """Print milliseconds spent in importing, by top-level package, without what it imports itself."""
    done = subprocess.run([sys.executable, "-X", "importtime", *command], capture_output=True, text=True, check=True)
    own: Counter[str] = Counter()
    for us, name in re.findall(r"import time:\s+(\d+) \|\s+\d+ \|\s+(\S+)", done.stderr):
        package = name.split(".")[0]
        own["Python's own" if package in sys.stdlib_module_names else package] += int(us)
    print("\n| imports of `mien render head` | ms |\n|---|---|")
    for package, us in own.most_common(8):
        print(f"| {package} | {us / 1000.0:.1f} |")
    print(f"| all | {own.total() / 1000.0:.1f} |")


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--peers", type=Path, default=default_folder(), help="their environment, made if need be")
    parser.add_argument("--no-peers", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="mien-start-") as name:
        folder, own = Path(name), sys.executable
        render: list[object] = ["-m", "mien", "render", "head", "--quiet", "-o", folder / "a.png"]
        commands: dict[str, list[object]] = {
            "Python alone": [own, "-c", "pass"],
            "import numpy": [own, "-c", "import numpy"],
            "mien: first picture": [own, "-c", DRAW],
            "mien render head -o a.png": [own, *render],
        }
        if not arguments.no_peers:
            python, missing = make_environment(arguments.peers, ["vtk"])
            form = folder / "form.npz"
            make_form(50_000).write(form)
            start = [python, "-m", "peers.start_vtk", form]
            if missing:
                print(f"VTK is left out: {missing['vtk']}")
            else:
                commands |= {"VTK: first picture": start, "VTK: first picture, PNG": [*start, folder / "b.png"]}
        print_race(commands, arguments.rounds)
        print_imports(render)
    subprocess.run([own, FOLDER / "first_steps.py"], check=True)


def print_race(commands: dict[str, list[object]], rounds: int) -> None:
    """Print the median of the rounds of every command that runs at all."""
    environment = {**os.environ, **SOFTWARE}
    times: dict[str, list[tuple[float, float]]] = {}
    for label, command in commands.items():
        try:
            time_process(command, environment)
        except subprocess.CalledProcessError as error:
            lines = error.stderr.decode(errors="replace").strip().splitlines()
            print(f"{label} is left out: {lines[-1] if lines else error}")
            continue
        times[label] = []
    for _ in range(rounds):
        for label, rows in times.items():
            rows.append(time_process(commands[label], environment))
    print(f"\n| whole process, median of {rounds} | wall ms | CPU ms | least wall ms |\n|---|---|---|---|")
    for label, rows in times.items():
        wall, work = zip(*rows, strict=True)
        print(f"| {label} | {statistics.median(wall):.0f} | {statistics.median(work):.0f} | {min(wall):.0f} |")


if __name__ == "__main__":
    main()
