"""What a ``.glb`` file loses of a face, in millimetres: ``python benchmarks/glb.py [FACE] [--count N] [--seed N]``.

glTF adds morph targets up; our face does not: lids turn about the eye, the jaw about its axis, lips meet. A single
target is exact. Here are random combinations of several, given to both under the same names, and the frames of a
sentence, whose weights are fitted. Distances are of the points that any target moves, with all joints at rest: joints
turn alike in both. ``whole`` is how far the points move themselves, for comparison.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

import mien
from mien.core import Mesh, fill_rows
from mien.formats.glb_motion import record, resting_pose
from mien.formats.glb_targets import Anatomy, check_face
from mien.formats.performances import PUPPET_SCENE
from mien.timeline import exact_rate
from mien.vocab import pose_from

Floats = NDArray[np.float64]

SENTENCE = "How happy is the little stone that rambles in the road alone."
COMBINED = (1, 2, 4, 8)
WORTH_A_ROW_MM = 1.0
RATE = exact_rate(24)


def read_fields(anatomy: Anatomy) -> Floats:
    """(T, V, 3) m, what each target adds at its fullest."""
    fields = []
    for name in anatomy.names:
        before, after = (anatomy.bring_to_rest(pose)[0] for pose in anatomy.poses_of(name))
        fields.append(after - before)
    return np.array(fields)


def random_values(names: tuple[str, ...], several: int, generator: np.random.Generator) -> dict[str, float]:
    """Values of so many names, 0..1; ``mouthClose`` is nothing without ``jawOpen``, and so no more than that."""
    chosen = generator.choice(len(names), several, replace=False)
    values = {names[k]: float(value) for k, value in zip(chosen, generator.random(several), strict=True)}
    if "mouthClose" in values:
        values["jawOpen"] = max(values.get("jawOpen", 0.0), values["mouthClose"])
    return values


def combined(anatomy: Anatomy, fields: Floats, several: int, count: int, seed: int) -> tuple[Floats, Floats]:
    """(N, V, 3) m of random combinations: what glTF misses, and what our face does."""
    generator = np.random.default_rng(seed)
    base, _ = anatomy.bring_to_rest(anatomy.base)
    missed, whole = [], []
    for _ in range(count):
        values = random_values(anatomy.names, several, generator)
        weights = np.array([values.get(name, 0.0) for name in anatomy.names])
        points, _ = anatomy.bring_to_rest(pose_from("arkit", values, anatomy.face, anatomy.base))
        whole.append(points - base)
        missed.append(np.einsum("t,tva->va", weights, fields) - whole[-1])
    return np.array(missed), np.array(whole)


def spoken(face: mien.Face, text: str) -> tuple[Floats, Floats, int]:
    """(N, V, 3) m of the frames of a sentence: what glTF misses, and what our face does; and how many frames."""
    performance = mien.say(text, face, scene=PUPPET_SCENE)
    timeline = performance.timeline
    anatomy = Anatomy(face, resting_pose(check_face(face), timeline, PUPPET_SCENE, RATE), 1)
    base, _ = anatomy.bring_to_rest(anatomy.base)
    fields = read_fields(anatomy)
    weights = record(anatomy, timeline, PUPPET_SCENE, RATE).weights
    poses = (fill_rows(face, pose, PUPPET_SCENE) for pose in timeline.poses(face.parameters, RATE))
    whole = np.array([anatomy.bring_to_rest(pose)[0] for pose in poses]) - base
    return np.einsum("nt,tva->nva", weights, fields) - whole, whole, len(weights)


def print_row(title: str, missed: Floats, whole: Floats, moved: NDArray[np.bool_]) -> None:
    """RMS and maximum of what is missed beside those of what is done."""
    lost, done = (1000.0 * np.sqrt((values[:, moved] ** 2).sum(axis=2)) for values in (missed, whole))
    each = np.sqrt((lost**2).mean(axis=1))
    print(
        f"{title:34} {np.sqrt((lost**2).mean()):9.3f} {each.max():11.3f} {lost.max():9.2f}"
        f" {np.sqrt((done**2).mean()):9.2f} {done.max():9.1f}"
    )


def print_rows(title: str, mesh: Mesh, missed: Floats, whole: Floats, moved: NDArray[np.bool_]) -> None:
    """A row for everything, and one for each part in which much is missed."""
    print_row(title, missed, whole, moved)
    for part in mesh.topology.parts:
        inside = np.zeros_like(moved)
        inside[mesh.part_vertices(part.name)] = True
        if 1000.0 * np.abs(missed[:, moved & inside]).max(initial=0.0) > WORTH_A_ROW_MM:
            print_row(f"  of it {part.name}", missed, whole, moved & inside)


def print_files(face: mien.Face) -> None:
    """Sizes of files and the time to write them."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "a.glb"
        for levels in (0, 1, 2):
            start = time.perf_counter()
            mien.make_puppet(face, scene=mien.Scene(subdivide=levels)).write(path)
            seconds = time.perf_counter() - start
            print(f"pose, subdivided {levels} times: {path.stat().st_size / 1e6:.2f} MB, {seconds:.1f} s")
        performance = mien.say(SENTENCE, face)
        start = time.perf_counter()
        performance.write(path)
        seconds = time.perf_counter() - start
        frames = performance.timeline.frame_count(RATE)
        print(f"sentence of {frames} frames, subdivided once: {path.stat().st_size / 1e6:.2f} MB, {seconds:.1f} s")


def main() -> None:
    """The tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("face", nargs="?", default="head")
    parser.add_argument("--count", type=int, default=100, help="combinations a row")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    face = mien.load_face(options.face)
    anatomy = Anatomy(face, face.neutral, 1)
    fields = read_fields(anatomy)
    moved = (np.abs(fields).max(axis=(0, 2)) > 1e-6).astype(bool)
    print(f"{'mm':34} {'RMS':>9} {'worst RMS':>11} {'max':>9} {'whole RMS':>9} {'whole max':>9}")
    mesh = face.shape(face.neutral)
    for several in COMBINED:
        print_rows(
            f"{several} random names", mesh, *combined(anatomy, fields, several, options.count, options.seed), moved
        )
    missed, whole, frames = spoken(face, SENTENCE)
    print_rows(f"sentence, {frames} frames", mesh, missed, whole, moved)
    print_files(face)


if __name__ == "__main__":
    main()
