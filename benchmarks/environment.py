"""The environment of Python in which peers are installed, apart from ours."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

WHAT_IS_THERE = (
    "import importlib.metadata as m, json; print(json.dumps({d.name.lower(): d.version for d in m.distributions()}))"
)


def default_folder() -> Path:
    """Where the peers' environment is kept from run to run: the user's cache."""
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "mien" / f"peers-{sys.version_info.major}.{sys.version_info.minor}"


def make_environment(folder: Path, packages: list[str]) -> tuple[Path, dict[str, str]]:
    """The interpreter of an environment with these packages, made if need be, and why some of them are not in it."""
    python = folder / "bin" / "python"
    if not python.exists():
        print(f"making an environment for peers in {folder}", flush=True)
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    missing = {}
    for package in packages:
        if package.lower() not in installed(python):
            print(f"installing {package}", flush=True)
            done = subprocess.run(
                [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", package],
                capture_output=True,
                text=True,
            )
            if done.returncode:
                missing[package] = (done.stderr.strip().splitlines() or ["pip said nothing"])[-1]
    return python, missing


def installed(python: Path) -> dict[str, str]:
    """Version by package of an environment, names in lower case."""
    return json.loads(subprocess.run([python, "-c", WHAT_IS_THERE], capture_output=True, check=True).stdout)
