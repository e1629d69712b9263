import math
from pathlib import Path

import pytest

from mien.core import Cue, LoadError, MienError, Parameter, ParameterTable, both_sides
from mien.timeline import (
    Mark,
    Specification,
    Specifications,
    command_list,
    format_commands,
    format_specifications,
    parse_specifications,
)

EXAMPLE = Path(__file__).parents[3] / "examples" / "jaw.spec"
TABLE = ParameterTable(
    (
        Parameter("jaw.rotation", 0, 20, 0, "deg"),
        Parameter("mouth.width", 0.5, 1.5, 1),
        *both_sides(Parameter("eyelid.opening", 0, 1, 0.7)),
        *both_sides(Parameter("eyebrow.arch", 0, 1, 0.7)),
    ),
    aliases={"ELU": "eyelid.opening.left"},
)


def at_frames(text, name, *frames, fps=24):
    timeline = parse_specifications(text).to_timeline(TABLE)
    return timeline.values([frame / fps for frame in frames], TABLE)[:, TABLE.index[name]].tolist()


def test_values_at_frames_by_hand():
    text = "jaw.rotation 10 14 2 10 cosine\njaw.rotation 20 24 10 2 ease-in\njaw.rotation 30 34 0 4 ease-out"
    root = math.sqrt(0.5)
    assert at_frames(text, "jaw.rotation", 10, 11, 12, 14) == pytest.approx([2, 6 - 4 * root, 6, 10])
    assert at_frames(text, "jaw.rotation", 22) == pytest.approx([10 - 8 * (1 - root)])
    assert at_frames(text, "jaw.rotation", 32) == pytest.approx([4 * root])


def test_default_before_hold_between_later_line_wins():
    text = """
        eyelid.opening 4 8 0 1 linear
        eyelid.opening 6 6 0.25 0.5 linear   # only one frame
    """
    assert at_frames(text, "eyelid.opening.right", 0, 3, 4, 5, 6, 7, 8, 99) == pytest.approx(
        [0.7, 0.7, 0, 0.25, 0.5, 0.75, 1, 1]
    )


def test_later_line_wins_between_symmetric_name_side_and_alias():
    text = "ELU 0 10 0 1 linear\neyelid.opening 4 6 0.25 0.25 linear\neyelid.opening.left 5 5 0 0 linear"
    assert at_frames(text, "eyelid.opening.left", 3, 4, 5, 6, 7) == pytest.approx([0.3, 0.25, 0, 0.25, 0.7])
    assert at_frames(text, "eyelid.opening.right", 3, 4, 7) == [0.7, 0.25, 0.25]


def test_heading_units_marks_and_comments():
    text = """\ufeff# a comment
        title  Nod # 2    # the second try
        unit seconds
        fps 25
        length 3.5
        word 0.5 1 well, then
        phone 0.5 0.75 W
        jaw.rotation 0 1 0 8 cosine# not a comment here is part of the name
    """
    with pytest.raises(LoadError, match=r"unknown change function 'cosine#'|got 15: "):
        parse_specifications(text)
    specifications = parse_specifications(text.replace("cosine#", "cosine #"))
    assert specifications.title == "Nod"
    assert (specifications.fps, specifications.unit, specifications.length) == (25.0, "seconds", 3.5)
    assert specifications.words == (Mark(0.5, 1.0, "well, then"),)
    timeline = specifications.to_timeline()
    assert timeline.length_s == 3.5
    assert timeline.phones == (Cue(0.5, 0.75, "W"),)
    assert timeline.layer("direct").tracks["jaw.rotation"].length_s == 1.0


def test_length_is_to_the_end_of_the_last_frame_or_mark():
    assert parse_specifications("jaw.rotation 0 12 0 8 cosine").to_timeline().frame_count(24) == 13
    assert parse_specifications("word 0 48 hi\njaw.rotation 0 12 0 8 cosine").to_timeline().frame_count(24) == 48
    assert parse_specifications("unit seconds\njaw.rotation 0 2 0 8 cosine").to_timeline().frame_count(24) == 48
    assert parse_specifications("length 5\njaw.rotation 0 12 0 8 cosine").to_timeline().frame_count(24) == 5


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (
            "jaw.rotation 0 12 0 8",
            r"x.spec:2: want 6 fields \(parameter, .*got 5: 'jaw.rotation 0 12 0 8' — a field is",
        ),
        ("jaw.rotation 0 12 0 8 cosine 1", r"x.spec:2: want 6 fields .*got 7"),
        ("titel Hello there", r"x.spec:2: .* — did you mean 'title'"),
        ("jaw.rotation 0 12 0 8 cosin", r"x.spec:2: unknown change function 'cosin' — did you mean 'cosine'"),
        ("jaw.rotation 12 0 0 8 cosine", r"x.spec:2: the end, 0, is before the start, 12 — exchange them\?"),
        ("jaw.rotation 0 zwölf 0 8 cosine", r"x.spec:2: end 'zwölf' is not a number"),
        ("jaw.rotation 0 12 0 nan cosine", r"x.spec:2: last value nan is not a finite number"),
        ("jaw.rotation 0 12 -inf 8 cosine", r"x.spec:2: first value -inf is not a finite number"),
        ("jaw.rotation 0 1e99 0 8 cosine", r"x.spec:2: end 1e99 is not a finite number within ±1e\+09"),
        ("jaw.rotation -1 12 0 8 cosine", r"x.spec:2: start -1 is before 0"),
        ("fps 0", r"x.spec:2: fps 0 is not above 0"),
        ("fps fast", r"x.spec:2: fps 'fast' is not a number"),
        ("unit frame", r"x.spec:2: unknown unit 'frame' — did you mean 'frames'"),
        ("title", r"x.spec:2: 'title' says nothing"),
        ("title twice", r"x.spec:2: a second 'title'"),
        ("word 0 hello", r"x.spec:2: want 'word START END text', got 'word 0 hello'"),
        ("word 3 2 hello", r"x.spec:2: the end, 2, is before the start, 3"),
    ],
)
def test_malformed_lines_are_refused_with_line_and_reason(line, message):
    text = ("title once\n" if line == "title twice" else "\n") + line + "\njaw.rotation 0 1 0 1 linear"
    with pytest.raises(LoadError, match=message) as caught:
        parse_specifications(text, "x.spec")
    assert caught.value.line == 2


def test_a_list_without_specification_is_refused():
    with pytest.raises(LoadError, match=r"x.spec: there is no specification in it — a line is: parameter"):
        parse_specifications("# nothing\nfps 24\n", "x.spec")


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("jaw.rotatoin 0 1 0 1 linear", r"x.spec:3: unknown parameter 'jaw.rotatoin' — did you mean 'jaw.rotation'"),
        ("jaw.rotation 0 1 0 21 linear", r"x.spec:3: jaw.rotation: 21 is out of range — it goes from 0 to 20 deg"),
        ("eyelid.opening 0 1 -0.1 1 linear", r"x.spec:3: eyelid.opening.left: -0.1 is out of range"),
    ],
)
def test_what_a_face_cannot_do_is_refused_with_its_line(line, message):
    specifications = parse_specifications(f"# faces\njaw.rotation 0 1 0 1 linear\n{line}", "x.spec")
    for use in (
        specifications.check,
        specifications.to_timeline,
        lambda table: list(command_list(specifications, table, 24)),
    ):
        with pytest.raises(LoadError, match=message):
            use(TABLE)


def test_example_parses_plays_and_comes_back():
    specifications = parse_specifications(EXAMPLE.read_text(), "jaw.spec")
    assert parse_specifications(format_specifications(specifications)) == specifications
    timeline = specifications.to_timeline(TABLE)
    assert timeline.frame_count(24) == 60
    jaw = timeline.values(timeline.frame_times(24), TABLE)[:, 0]
    for frame in range(14, 19):  # the second m
        assert jaw[frame] == 0.0
    assert jaw[11] == 8.0


def test_what_a_line_cannot_hold_is_not_written():
    row = Specification("jaw.rotation", 0, 1, 0, 1)
    for symbol in ("", "two\nlines", "a #b", "#", " a"):
        with pytest.raises(MienError, match="cannot be written"):
            format_specifications(Specifications((row,), phones=(Mark(0, 1, symbol),)))


def test_command_list_names_what_is_covered_frame_by_frame():
    text = "mouth.width 1 2 1 1.2 linear\njaw.rotation 2 4 0 8 linear\neyelid.opening 6 6 0.7 0 linear\nlength 8"
    commands = list(command_list(parse_specifications(text), TABLE, 24))
    assert commands == [
        (0, []),
        (1, [("mouth.width", 1.0)]),
        (2, [("jaw.rotation", 0.0), ("mouth.width", 1.2)]),
        (3, [("jaw.rotation", pytest.approx(4.0))]),
        (4, [("jaw.rotation", 8.0)]),
        (5, []),
        (6, [("eyelid.opening.left", 0.0), ("eyelid.opening.right", 0.0)]),
        (7, []),
    ]
    lines = list(format_commands(commands))
    assert [line.split() for line in lines[:3]] == [
        ["1", "mouth.width", "1"],
        ["2", "jaw.rotation", "0"],
        ["2", "mouth.width", "1.2"],
    ]
    assert len(lines) == 7


def test_command_list_at_another_rate_and_over_chunk_borders():
    specifications = parse_specifications("jaw.rotation 0 480 0 20 linear")
    commands = list(command_list(specifications.to_timeline(), TABLE, 48))
    assert [frame for frame, _ in commands] == list(range(962))
    assert commands[300][1] == [("jaw.rotation", pytest.approx(20 * 300 / 960))]
    assert commands[961][1] == []
