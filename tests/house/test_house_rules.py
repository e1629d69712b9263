"""Rules of the house that no tool checks: file sizes, strangers' words, machine paths, what a package must contain."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = sorted((ROOT / "src").rglob("*.py"))
TEXT_SUFFIXES = {".py", ".md", ".toml", ".csv", ".json", ".spec", ".txt", ".cff", ".sh", ""}

LONGEST_FILE = 450

# Paths that exist on one machine only, work left undone, and a licence that would be wrong here.
UNWANTED = re.compile(r"(?<![\w.])/(?:home|root|Users|work)/\w|\bTODO\b|\bFIXME\b|\bXXX\b")


def project_files():
    for folder in ("src", "tests", "docs", "examples", "benchmarks", "scripts", "tools", ".ci"):
        for path in (ROOT / folder).rglob("*"):
            if path.is_file() and path.suffix in TEXT_SUFFIXES and "__pycache__" not in path.parts:
                yield path
    yield from (path for path in ROOT.glob("*") if path.is_file() and path.suffix in TEXT_SUFFIXES)


def project_table():
    return tomllib.loads((ROOT / "pyproject.toml").read_text())


def test_files_are_short_enough_to_read():
    long = {
        str(path.relative_to(ROOT)): count
        for path in [*SOURCES, *(ROOT / "tests").rglob("*.py")]
        if (count := len(path.read_text().splitlines())) > LONGEST_FILE
    }
    assert long == {}


def test_nothing_points_to_one_machine_or_is_left_undone():
    found = {}
    for path in project_files():
        match = UNWANTED.search(path.read_text(errors="replace"))
        if match and path != Path(__file__):
            found[str(path.relative_to(ROOT))] = match.group()
    assert found == {}


def test_no_function_of_ours_is_a_stub():
    assert [str(path) for path in SOURCES if "NotImplementedError" in path.read_text()] == []


@pytest.mark.parametrize(
    "text", ["/".join(("", "home", "ann", "x")), "open({!r})".format("/".join(("", "root", "y"))), "# TODO: later"]
)
def test_the_search_for_unwanted_words_finds_them(text):
    assert UNWANTED.search(text)


@pytest.mark.parametrize("text", ["https://x.org/home/page", "the roots of", "/usr/bin/chromium", "/mien/move/jaw"])
def test_the_search_for_unwanted_words_leaves_others_alone(text):
    assert not UNWANTED.search(text)


@pytest.mark.parametrize("name", ["demo", "test", "check", "environment.sh"])
def test_scripts_are_short_and_plain_sh(name):
    path = ROOT / "scripts" / name
    lines = path.read_text().splitlines()
    assert len(lines) < 30
    assert subprocess.run(["sh", "-n", path], check=False).returncode == 0
    if path.suffix != ".sh":
        assert lines[0] == "#!/bin/sh"
        assert path.stat().st_mode & 0o111


def test_ci_runs_the_three_scripts():
    text = (ROOT / ".ci" / "run").read_text()
    assert [text.count(f"stage scripts/{name}") for name in ("check", "demo", "test")] == [1, 1, 1]


def test_import_contracts():
    done = subprocess.run(
        [sys.executable, "-c", "from importlinter.cli import lint_imports_command; lint_imports_command()"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    if "No module named 'importlinter'" in done.stderr:
        pytest.skip("import-linter is not installed here; scripts/check runs it")
    assert done.returncode == 0, done.stdout + done.stderr


def test_importing_mien_loads_nothing_heavy():
    heavy = "numba", "av", "PIL", "hibari", "onnxruntime", "matplotlib", "typer", "rich", "scipy"
    program = f"import mien, sys; print([name for name in {heavy!r} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_every_folder_of_sources_is_a_package():
    folders = {path.parent for path in SOURCES}
    assert [str(folder) for folder in folders if folder != ROOT / "src" and not (folder / "__init__.py").exists()] == []


def test_versions_agree():
    version = project_table()["project"]["version"]
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text()
    assert version in (ROOT / "CHANGELOG.md").read_text()


def test_every_dependency_is_in_the_notices():
    notices = (ROOT / "THIRD_PARTY_NOTICES.md").read_text().lower()
    project = project_table()["project"]
    needed = [*project["dependencies"], *(row for rows in project["optional-dependencies"].values() for row in rows)]
    names = [re.match(r"[\w-]+", row).group().lower() for row in needed]
    assert [name for name in names if name not in notices] == []


def test_every_dependency_has_a_lower_bound():
    project = project_table()["project"]
    needed = [*project["dependencies"], *(row for rows in project["optional-dependencies"].values() for row in rows)]
    assert [row for row in needed if not re.search(r"(>=|==|~=)\d", row)] == []


def test_measured_data_carry_their_licence():
    for folder in {path.parent for path in (ROOT / "src").rglob("data/*.arrays")}:
        licences = [path for path in folder.iterdir() if "licen" in path.name.lower()]
        assert licences, f"{folder.relative_to(ROOT)} has measured data and no licence beside them"
        assert "USC Institute for Creative Technologies" in licences[0].read_text()


def test_a_wheel_takes_the_data_and_the_licences_along():
    project, tool = project_table()["project"], project_table()["tool"]
    assert tool["hatch"]["build"]["targets"]["wheel"]["packages"] == ["src/mien"]
    ignored = (ROOT / ".gitignore").read_text().split()
    for path in (ROOT / "src" / "mien").rglob("data/*"):
        # hatchling leaves out what git ignores, and nothing else.
        assert path.suffix not in {line.removeprefix("*") for line in ignored}, path
    for name in project["license-files"]:
        assert list(ROOT.glob(name)), f"license-files names {name}, which is not there"


def test_decisions_fill_one_page_and_answer_the_four_questions():
    records = sorted((ROOT / "docs" / "adr").glob("*.md"))
    assert len(records) >= 7
    for path in records:
        text = path.read_text()
        assert len(text.splitlines()) <= 70, path.name
        for heading in ("## Question", "## Choice", "## Measured", "## What would change our mind"):
            assert heading in text, f"{path.name} has no '{heading}'"


def test_no_two_files_of_tests_have_one_name():
    """They are imported by their names alone."""
    names = [path.name for path in (ROOT / "tests").rglob("test_*.py")]
    assert sorted({name for name in names if names.count(name) > 1}) == []
