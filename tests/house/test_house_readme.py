"""What the README tells people to type works: blocks after ``<!-- mien: test = run -->`` are run in an empty folder.

A block of ``sh`` is run line by line as one script, a block of ``python`` by this Python. Lines that begin with
``scripts/`` are only checked to exist, since they make environments.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MARK = "<!-- mien: test = run -->"
BLOCK = re.compile(re.escape(MARK) + r"\s*```(sh|python)\n(.*?)```", re.DOTALL)


def blocks(text):
    return BLOCK.findall(text)


README = (ROOT / "README.md").read_text()
MARKED = blocks(README)


def test_marked_blocks_are_found():
    text = f"{MARK}\n```sh\nmien faces\n```\n```sh\nnot this\n```\n{MARK}\n\n```python\nimport mien\n```\n"
    assert blocks(text) == [("sh", "mien faces\n"), ("python", "import mien\n")]


def test_every_mark_has_its_block():
    assert README.count(MARK) == len(MARKED)


def test_the_scripts_that_the_readme_names_exist():
    for name in set(re.findall(r"\bscripts/([\w.]+)", README)):
        assert os.access(ROOT / "scripts" / name, os.X_OK), name


def test_the_files_that_the_readme_links_to_exist():
    links = re.findall(r"\]\((?!https?:|#|mailto:)([^)#]+)", README)
    assert [link for link in links if not (ROOT / link).exists()] == []


@pytest.mark.skipif(not MARKED, reason="the README has no block to run yet")
@pytest.mark.parametrize(("language", "code"), MARKED)
def test_readme_commands_run(language, code, tmp_path):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    lines = [line for line in code.splitlines() if not line.startswith("scripts/")]
    commands = {"sh": [shutil.which("sh"), "-eu"], "python": [sys.executable, "-W", "ignore"]}
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    done = subprocess.run(
        [*commands[language], "-c", "\n".join(lines)],
        cwd=tmp_path,
        env={**os.environ, "PATH": path},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
