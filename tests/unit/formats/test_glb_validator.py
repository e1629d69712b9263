"""What the Khronos validator says of files as a user makes them; ``scripts/check_glb`` installs it and runs this."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

import mien

MODULES = os.environ.get("MIEN_GLTF_VALIDATOR", "")

pytestmark = pytest.mark.skipif(
    shutil.which("node") is None or not (Path(MODULES) / "gltf-validator").is_dir(),
    reason="wants node, and MIEN_GLTF_VALIDATOR=the node_modules with gltf-validator: run scripts/check_glb",
)

JUDGE = """
const validator = require("gltf-validator"), fs = require("fs");
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])), {maxIssues: 20})
  .then(report => console.log(JSON.stringify(report)));
"""


def judge(path: Path) -> dict:
    """The validator's report of a file."""
    done = subprocess.run(
        ["node", "-e", JUDGE, str(path)],
        env={**os.environ, "NODE_PATH": MODULES},
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    )
    return json.loads(done.stdout)


def write(name: str, path: Path) -> None:
    if name == "performance":
        mien.say("Hello.", "head", seed=1).write(path)
    else:
        values, levels = {"pose": ({"head.turn": 20.0, "jaw.rotation": 9.0}, 1), "classic": ({}, 0)}[name]
        mien.make_puppet("head", values, mien.Scene(subdivide=levels)).write(path)


@pytest.mark.parametrize("name", ["pose", "classic", "performance"])
def test_the_validator_has_nothing_to_say(name: str, tmp_path: Path) -> None:
    path = tmp_path / f"{name}.glb"
    write(name, path)
    report = judge(path)
    assert report["issues"]["messages"] == []
    assert report["info"]["hasMorphTargets"]
    assert report["info"]["hasSkins"]
    assert report["info"]["animationCount"] == (name == "performance")


def test_the_validator_is_awake(tmp_path: Path) -> None:
    write("classic", tmp_path / "a.glb")
    content = (tmp_path / "a.glb").read_bytes()
    (tmp_path / "a.glb").write_bytes(content.replace(b'"type":"VEC3"', b'"type":"VEC2"', 1))
    assert judge(tmp_path / "a.glb")["issues"]["numErrors"] > 0
