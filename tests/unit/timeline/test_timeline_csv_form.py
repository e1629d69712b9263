import pytest

from mien.core import LoadError, Parameter, ParameterTable, UnknownNameError, both_sides
from mien.timeline import Layer, Timeline, Track, format_csv, parse_csv

TABLE = ParameterTable(
    (
        Parameter("jaw.rotation", 0, 20, 0, "deg"),
        Parameter("mouth.width", 0.5, 1.5, 1),
        *both_sides(Parameter("lid", 0, 1)),
    )
)


def test_seconds_straight_lines_and_empty_cells():
    timeline = parse_csv("time_s,jaw.rotation,mouth.width\n0,0,\n0.5,10,1.2\n\n1.0,20,\n")
    assert timeline.values([0, 0.25, 0.5, 1, 9], TABLE)[:, :2].tolist() == [
        [0, 1],
        [5, 1],
        [10, 1.2],
        [20, 1.2],
        [20, 1.2],
    ]
    assert (timeline.length_s, timeline.fps) == (1.5, None)
    assert timeline.layer("direct").blend == "replace"


def test_frames():
    timeline = parse_csv("frame, lid\r\n0,0\r\n24,1\r\n25,1\r\n", fps=24)
    assert timeline.values([0.5], TABLE)[0].tolist() == [0, 1, 0.5, 0.5]
    assert (timeline.frame_count(24), timeline.fps) == (26, 24)


def test_written_table_reads_back_as_the_same_values_and_frames():
    tracks = {"jaw.rotation": Track.from_keys([0.1, 9.7], [1 / 3, 17], "cosine"), "lid": Track.from_keys([3], [0.1])}
    timeline = Timeline((Layer("speech", "replace", tracks),), 12.0)
    text = "\n".join(format_csv(timeline, TABLE, 30))
    assert text.splitlines()[0] == "time_s,jaw.rotation,lid.left,lid.right"
    assert len(text.splitlines()) == 361
    back = parse_csv(text, table=TABLE)
    assert back.frame_count(30) == 360
    times = timeline.frame_times(30)
    assert back.values(times, TABLE).tobytes() == timeline.values(times, TABLE).tobytes()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "x.csv:1: want 'time_s' or 'frame' as the first column, got nothing"),
        ("jaw.rotation\n1", "x.csv:1: want 'time_s' or 'frame' as the first column, got 'jaw.rotation'"),
        ("frame,lid,lid\n", "x.csv:1: column 'lid' is there twice"),
        ("frame;lid\n0;1", "got 'frame;lid' — put commas between the columns"),
        ("frame,lid\n-1,0", "x.csv:2: frame -1 is before 0 — times are counted from 0"),
        ('frame,"lid\n0,1', "is no comma-separated table (unexpected end of data)"),
        ("frame,,lid\n", "x.csv:1: column 2 has no name"),
        ("frame,lit\n0,1", "x.csv:1: unknown parameter 'lit' — did you mean 'lid'"),
        ("frame,lid\n", "x.csv: there is no row in it"),
        ("frame,lid\n0,1\n1", "x.csv:3: want 2 cells, got 1"),
        ("frame,lid\n0,1\n0,1", "x.csv:3: frame 0 does not come after the row before"),
        ("frame,lid\nnow,1", "x.csv:2: frame: 'now' is not a number"),
        ("frame,lid\n0,nan", "x.csv:2: lid: nan is not a finite number"),
        ("frame,lid\n0,1e99", "x.csv:2: lid: 1e99 is not a finite number"),
        ("frame,lid\n0," + "9" * 200_000, "x.csv:2: is no comma-separated table (field larger"),
        ("frame,lid\n0,2", "x.csv:2: lid.left: 2 is out of range — it goes from 0 to 1"),
    ],
)
def test_wrong_tables_are_refused_with_their_line(text, message):
    with pytest.raises(LoadError) as caught:
        parse_csv(text, "x.csv", table=TABLE)
    assert message in str(caught.value)


def test_unknown_parameter_is_refused_when_no_table_was_at_hand():
    with pytest.raises(UnknownNameError):
        parse_csv("frame,lit\n0,1").values([0.0], TABLE)
