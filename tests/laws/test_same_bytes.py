"""Meshes, tracks made from cues, and pictures have the same bits whatever NumPy and Numba find in the processor."""

import os
import subprocess
import sys

import numpy as np
import pytest

from support import MASK

PROGRAM = """
import hashlib
import sys
from dataclasses import replace
import numpy as np
from mien.core import Cue, Drawing, Path, Region, Scene, Sound
from mien.faces import load_face
from mien.faces.head.head import Head
from mien.faces.head.measured import archive
from mien.faces.head.residual import Residual
from mien.perform import perform
from mien.render import draw, draw_drawing
from mien.speech import Speech
from mien.timeline import json_text

def show(name, *arrays):
    print(name, hashlib.sha256(b"".join(np.ascontiguousarray(array).tobytes() for array in arrays)).hexdigest())

head = load_face("head")
pose = head.neutral.replace({"jaw.rotation": 7, "mouth.closure": 0.3, "eyelid.opening": 0.2, "head.turn": 20,
                             "eye.turn": 11, "mouth.corner.up": 9, "target.x": 0.3, "mouth.tuck": -5})
for face in (head, head.unsubdivided):
    mesh = face.shape(pose)
    show("mesh", mesh.points, mesh.colors, mesh.normals)
points = archive().floats("cage")
swell = 0.02 * points * (points[:, 2:] > 0)
someone = Head(hair="crop", residual=Residual(swell, swell, np.array([0.0004, 0.0, 0.0005]), 1.02))
show("someone", someone.shape(someone.neutral.replace({"eyelid.opening": 0.0})).points)

symbols = "SIL HH AH0 L OW1 SIL HH AW1 HH AE1 P IY0 IH0 Z DH AH0 F AO1 R M SIL".split()
phones = tuple(Cue(0.09 * k, 0.09 * (k + 1), symbol) for k, symbol in enumerate(symbols))
words = (Cue(0.09, 0.45, "Hello"), Cue(0.54, 1.0, "happy"), Cue(1.2, 1.8, "form"))
speech = Speech("", Sound.silence(phones[-1].end_s), words, phones, (), "none")
timeline = perform(speech, head, seed=4, emotion="laugh").timeline
show("tracks", np.frombuffer("".join(json_text(timeline)).encode(), np.uint8))
show("values", *(timeline.values(timeline.frame_times(fps), head.parameters) for fps in (24, 29.97, 60)))
threads = int(sys.argv[1])
plain = Scene(size_px=(96, 96)).seen("three-quarter")
show("front", draw(head, pose, Scene(size_px=(160, 90)), threads=threads))
show("side", draw(head, pose, replace(plain, shading="smooth+").seen("side"), threads=threads))
show("polygons", draw(head, pose, replace(plain, shading="polygon", subdivide=0), threads=threads))
show("lines", draw(head, pose, replace(plain, shading="wire", subdivide=1), threads=threads))
ways = np.arange(800).reshape(20, 20, 2) * 7919 % 997 / 10.0
region = Region(tuple(ways[18:]))
paths = [Path("p", tuple(ways[k:k + 2]), (0.01 * k, 0.5, 0.9, 0.8), "nonzero", outside=(region,)) for k in range(18)]
show("drawing", draw_drawing(Drawing((100.0, 80.0), tuple(paths)), plain, threads=threads))
toon = load_face("toon:olav")
drawn = toon.neutral.replace({"MB": 0.6, "MLH": 0.9, "MRV": 0.2, "ELU": 0.3, "BLC": 1.0, "HH": 17.0,
                              "HT": 5.0, "PRH": 9.0})
show("outlines", *(contour for path in toon.shape(drawn).paths for contour in path.contours))
show("toon", draw(toon, drawn, plain, threads=threads))
egg = load_face("toon:miso+egg")
show("egg", draw(egg, egg.neutral.replace({"solid.turn": 40.0, "MB": 0.5}), plain, threads=threads))
measured = load_face(sys.argv[2])
mixed = measured.neutral.replace({"phase": 2.4, "phase.ou": 0.7, "phase.blink.left": 0.9, "head.turn": 12,
                                  "eye.nod": 7})
for face in (measured, measured.unsubdivided):
    show("phases", face.shape(mixed).points)
show("measured", draw(measured, mixed, plain, threads=threads))
show("clear", draw(someone, someone.neutral, replace(plain, background=((0.1, 0.2, 0.3, 0.4),) * 2), threads=threads))
"""


def digests(threads, **environment):
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM, str(threads), MASK],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@pytest.mark.slow
def test_the_processor_and_the_number_of_threads_decide_no_bit(tmp_path):
    features = " ".join(np._core._multiarray_umath.__cpu_dispatch__)
    here = digests(1)
    assert len(here) == 17
    others = {
        "a processor of another kind": (3, {"NUMBA_CPU_NAME": "generic", "NUMBA_CACHE_DIR": str(tmp_path)}),
        "NumPy without its fast paths": (2, {"NPY_DISABLE_CPU_FEATURES": features, "OPENBLAS_CORETYPE": "Prescott"}),
    }
    for name, (threads, environment) in others.items():
        assert digests(threads, **environment) == here, name
