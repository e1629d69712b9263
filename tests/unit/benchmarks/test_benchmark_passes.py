"""Each pass off changes the measure that it exists for; the page shows the tables as they are."""

from pathlib import Path

import pytest

from mien.speech.articulation import USUAL, Articulation, amounts

ROOT = Path(__file__).parents[3]

LESS = ("targets", "stress", "diphthongs", "brief", "pauses", "anticipation", "lag", "rounding")
STILL = ("jaw", "lips", "tongue")


@pytest.fixture
def passes(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    import passes

    return passes


def test_every_pass_has_a_measure(passes):
    assert list(passes.MEASURES) == [name for name, row in amounts().items() if row.measure]


def usual_and_without(passes, name):
    measure, _ = passes.MEASURES[name]
    phones = passes.read_phones()
    return (measure(passes.Said(phones, style)) for style in (USUAL, Articulation(**{name: 0.0})))


@pytest.mark.parametrize("name", [*LESS, *STILL])
def test_a_pass_that_is_off_takes_what_it_gives(passes, name):
    usual, without = usual_and_without(passes, name)
    assert without < (0.92 if name in LESS else 0.01) * usual


@pytest.mark.parametrize("name", ["dominance", "closures"])
def test_a_pass_that_is_off_lets_go_what_it_holds(passes, name):
    usual, without = usual_and_without(passes, name)
    assert without > usual + 10.0


def test_no_closure_and_no_tuck_is_missed(passes):
    assert passes.missed_holds(passes.Said(passes.read_phones())) == 0.0


def test_the_page_shows_the_tables_as_they_are(passes):
    page = (ROOT / "docs/passes.md").read_text(encoding="utf-8")
    assert passes.fill(page) == page, "run python benchmarks/passes.py --write"
