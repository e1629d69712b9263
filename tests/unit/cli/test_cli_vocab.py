"""``mien vocab``, and action units wherever a face is taken."""

from __future__ import annotations

import json

import pytest

import mien
from mien.cli import main
from mien.cli.settings import make_pose, parse_emotion, parse_presets
from mien.core import MienError, RangeError
from mien.vocab import vocabularies, vocabulary


def output(capfd: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(arguments) == 0
    out, err = capfd.readouterr()
    assert err == ""
    return out


def test_vocabularies_one_a_line_name_first(capfd: pytest.CaptureFixture[str]) -> None:
    assert [line.split()[0] for line in output(capfd, "vocab").splitlines()[1:]] == list(vocabularies())
    rows = json.loads(output(capfd, "vocab", "--json"))["vocabularies"]
    assert [row["name"] for row in rows] == list(vocabularies())
    assert next(row for row in rows if row["name"] == "arkit")["names"] == 52


def test_names_of_a_vocabulary_with_their_aliases(capfd: pytest.CaptureFixture[str]) -> None:
    lines = output(capfd, "vocab", "facs").splitlines()
    assert [line.split()[0] for line in lines[1:]] == list(vocabulary("facs").names)
    assert next(line for line in lines if line.startswith("AU12.left")).split()[1] == "AU12L"
    row = json.loads(output(capfd, "vocab", "arkit", "--json"))["names"][0]
    assert (row["name"], row["aliases"]) == ("eyeBlinkLeft", ["EyeBlinkLeft", "eyeBlink_L"])
    assert row["doc"]
    assert row["source"]


def test_loss_on_a_face_and_to_another_vocabulary(capfd: pytest.CaptureFixture[str]) -> None:
    lines = output(capfd, "vocab", "--loss", "arkit", "head").splitlines()
    assert next(line for line in lines if line.startswith("jawOpen")).split()[1] == "near"
    data = json.loads(output(capfd, "vocab", "--loss", "facs", "arkit", "--json"))
    assert (data["from"], data["to"]) == ("facs", "arkit")
    row = next(row for row in data["names"] if row["name"] == "AU61")
    assert (row["fit"], set(row["nearest"])) == ("exact", {"eyeLookOutLeft", "eyeLookInRight"})


def test_loss_on_a_drawn_face_says_what_stands_in(capfd: pytest.CaptureFixture[str]) -> None:
    lines = output(capfd, "vocab", "--loss", "facs", "toon:gus").splitlines()
    heading = lines.index("What toon:gus cannot show of facs, and what stands in for it:")
    assert lines[0].split()[2] == "px"
    lost = {line.split()[0]: line for line in lines[heading + 2 :]}
    assert lost["AU55"].endswith("nothing")
    assert "mouth.bottom ×0" in lost["AU17"]
    assert "eyelid.lower.left +0.4" in lost["AU6.left"]
    rows = json.loads(output(capfd, "vocab", "--loss", "facs", "toon:gus", "--json"))["names"]
    row = next(row for row in rows if row["name"] == "AU6.left")
    assert row["longest_px"] > 5.0
    assert row["stand_ins"][0]["parameter"] == "eyelid.lower.left"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["vocab", "fasc"], "did you mean 'facs'"),
        (["vocab", "--loss", "fasc", "head"], "did you mean 'facs'"),
        (["vocab", "--loss", "facs", "hed"], "did you mean 'head'"),
        (["render", "head", "--au", "12x", "-o", "a.png"], "--au 12x: '12x' is not an action unit"),
        (["render", "head", "--au", "3", "-o", "a.png"], "unknown action unit 'AU3'"),
        (["render", "head", "--preset", "smile=2", "-o", "a.png"], "from 0 to 1"),
        (["render", "head", "--preset", "smile=much", "-o", "a.png"], "'much' is not a number"),
        (["vocab", "facs", "--loss", "arkit", "head"], "leave 'facs' out"),
        (["render", "head", "--mix", "head:ada", "-o", "a.png"], "want FACE=SHARE"),
        (["render", "head", "--mix", "head:ada=0.1", "--mix", "head:ada=0.2", "-o", "a.png"], "mixed in already"),
    ],
)
def test_mistakes_are_explained(arguments: list[str], message: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == 2
    assert message in capfd.readouterr().err


def test_presets_then_units_then_settings() -> None:
    face = mien.load_face("head")
    smile = make_pose(face, None, ["smile"], None)
    both = make_pose(face, ["mouth.dimple.left=0"], ["smile"], ["14,1=0.5", "4R"])
    assert both["mouth.dimple.left"] == 0.0
    assert both["mouth.dimple.right"] == 1.0
    assert both["eyebrow.inner_raise.left"] == 0.5
    assert both["eyebrow.lower.right"] == 1.0
    assert both["cheek.raise.left"] == smile["cheek.raise.left"]


def test_a_preset_in_part_is_part_of_the_way() -> None:
    face = mien.load_face("head")
    whole = make_pose(face, None, ["angry"], None)
    half = make_pose(face, None, ["angry=0.5"], None)
    assert half["eyebrow.lower.left"] == pytest.approx(0.5 * whole["eyebrow.lower.left"])
    assert half["eyelid.opening.left"] == pytest.approx(0.5 * (0.75 + whole["eyelid.opening.left"]))
    assert make_pose(face, None, ["angry=0"], None) == face.neutral
    assert parse_presets(["smile", "sad=0.25"]) == {"smile": 1.0, "sad": 0.25}


def test_an_emotion_in_part() -> None:
    assert parse_emotion(None) == (None, 1.0)
    assert parse_emotion("sad") == ("sad", 1.0)
    assert parse_emotion("sad=0.5") == ("sad", 0.5)
    with pytest.raises(MienError, match="--emotion sad=much"):
        parse_emotion("sad=much")


def test_a_pose_from_other_peoples_names() -> None:
    pose = mien.pose_from("arkit", {"jawOpen": 0.5})
    assert pose.changed() == {"jaw.rotation": 10.0}
    assert mien.pose_from("facs", {"AU12L": 0.5}, "head:ada")["mouth.expression.left"] == 0.5
    with pytest.raises(RangeError):
        mien.pose_from("facs", {"AU12": 1.5})
    with pytest.raises(MienError, match="vocabulary"):
        mien.pose_from("arkti", {})
