"""What errors say: offender, place, wanted, got, what to try."""

import pytest

from mien.core import Cue, LoadError, MienError, RangeError, Sound, UnknownNameError


@pytest.mark.parametrize("kind", [UnknownNameError, RangeError, LoadError])
def test_they_are_one_family(kind):
    assert issubclass(kind, MienError)


def test_a_load_error_names_file_line_and_hint():
    error = LoadError("smile.phase", "point 912 is not in 1..202", line=41, hint="measured on another topology?")
    assert str(error) == "smile.phase:41: point 912 is not in 1..202 — measured on another topology?"
    assert (error.path, error.line) == ("smile.phase", 41)


def test_a_load_error_without_a_line():
    assert str(LoadError("smile.phase", "it is empty")) == "smile.phase: it is empty"


@pytest.mark.parametrize(
    ("name", "known", "hint"),
    [
        ("smlie", ["smile", "sad"], "did you mean 'smile'?"),
        ("SMILE", ["smile", "sad"], "did you mean 'smile'?"),
        ("jaw", ["lower.jaw.rotation", "nose"], "did you mean 'lower.jaw.rotation'?"),
        ("xyz", ["smile", "sad"], "there is smile, sad"),
        ("xyz", [], "there is none"),
        ("", ["smile", "sad"], "there is smile, sad"),
        ("xyz", [f"name{n}" for n in range(20)], "there are 20, from 'name0' to 'name19'"),
    ],
)
def test_an_unknown_name_says_what_to_try(name, known, hint):
    assert str(UnknownNameError("preset", name, known)) == f"unknown preset {name!r} — {hint}"


def test_at_most_three_near_matches():
    text = str(UnknownNameError("preset", "smile", [f"smile{n}" for n in range(9)]))
    assert text.count(" or ") == 2


def test_cues_know_their_length_and_centre_and_sort_by_time():
    late, early = Cue(1.0, 1.5, "AH"), Cue(0.25, 1.0, "M")
    assert early.length_s == 0.75
    assert late.centre_s == 1.25
    assert sorted([late, early]) == [early, late]


def test_silence_has_the_length_asked_for():
    sound = Sound.silence(0.5, 16000)
    assert sound.length_s == 0.5
    assert len(sound.samples) == 8000
    assert not sound.samples.any()
