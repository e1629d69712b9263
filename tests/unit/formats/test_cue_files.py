"""Files of cues: every one is read back; Rhubarb's are Rhubarb's to the byte; nothing is left half-written."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from cue_cases import MARY, hello, mary, sheets
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from small_face import opening_jaw

from mien.core import Cue, LoadError, MienError, RangeError, UnknownNameError
from mien.formats import CueSheet, check_cue_file, read_cue_file, write_cue_file, write_performance
from mien.formats.cue_files import LAYOUTS, READERS, WRITERS
from mien.formats.table import FORMATS
from mien.timeline import Timeline

RHUBARB_TSV = "".join(f"{start:.2f}\t{shape}\n" for start, shape in MARY) + "1.86\tX\n"

RHUBARB_JSON = """{
  "metadata": {
    "soundFile": "a&b'<\\u00e9>\\"\\\\.wav",
    "duration": 0.65
  },
  "mouthCues": [
    { "start": 0.00, "end": 0.25, "value": "X" },
    { "start": 0.25, "end": 0.65, "value": "B" }
  ]
}
"""

RHUBARB_XML = """<?xml version="1.0" encoding="utf-8"?>
<rhubarbResult>
  <metadata>
    <soundFile>a&amp;b&apos;&lt;é&gt;&quot;\\.wav</soundFile>
    <duration>0.65</duration>
  </metadata>
  <mouthCues>
    <mouthCue start="0.00" end="0.25">X</mouthCue>
    <mouthCue start="0.25" end="0.65">B</mouthCue>
  </mouthCues>
</rhubarbResult>
"""

RHUBARB_DAT = """MohoSwitch1
1 X
7 B
8 A
10 C
13 B
16 A
18 E
21 A
25 C
29 E
38 X
45 X
"""
"""All as the Linux program of 1.13 wrote them, of ``mary.wav`` and of a file with a name of special characters."""


def special() -> CueSheet:
    shapes = (Cue(0.0, 0.25, "X"), Cue(0.25, 0.65, "B"))
    return CueSheet(0.65, {"shapes": shapes}, sound="a&b'<é>\"\\.wav")


def written(folder: Path, sheet: CueSheet, name: str, **options: object) -> str:
    write_cue_file(sheet, folder / name, **options)  # type: ignore[arg-type]
    return (folder / name).read_bytes().decode()


def test_the_table_of_files_and_that_of_formats_agree() -> None:
    named = {suffix for row in FORMATS for suffix in row.suffixes if "cues" in row.holds}
    assert {suffix for suffix, _ in WRITERS} == named
    assert set(READERS) == {suffix for row in FORMATS for suffix in row.suffixes if "timing" in row.holds}
    assert {layout for _, layout in WRITERS} == set(LAYOUTS)


@pytest.mark.parametrize(
    ("name", "sheet", "text"),
    [
        ("a.tsv", mary(), RHUBARB_TSV),
        ("a.dat", mary(), RHUBARB_DAT),
        ("a.json", special(), RHUBARB_JSON),
        ("a.xml", special(), RHUBARB_XML),
    ],
)
def test_the_layout_of_rhubarb_is_what_it_writes_and_reads_back(
    tmp_path: Path, name: str, sheet: CueSheet, text: str
) -> None:
    assert written(tmp_path, sheet, name, layout="rhubarb") == text
    read = read_cue_file(tmp_path / name)
    if name != "a.dat":
        assert read.tiers == sheet.tiers
    if name in ("a.json", "a.xml"):
        assert read == sheet


def test_rhubarb_joins_equal_shapes_fills_gaps_and_leaves_out_what_no_hundredth_holds(tmp_path: Path) -> None:
    shapes = (Cue(0.1, 0.2, "B"), Cue(0.2, 0.3, "B"), Cue(0.3, 0.304, "A"), Cue(0.304, 0.4, "C"), Cue(0.6, 0.7, "D"))
    sheet = CueSheet(0.8, {"shapes": shapes})
    assert written(tmp_path, sheet, "a.tsv", layout="rhubarb") == (
        "0.00\tX\n0.10\tB\n0.30\tC\n0.40\tX\n0.60\tD\n0.70\tX\n0.80\tX\n"
    )


def test_the_rest_of_another_set_of_shapes_is_its_own(tmp_path: Path) -> None:
    sheet = CueSheet(0.5, {"shapes": (Cue(0.0, 0.1, "sil"), Cue(0.1, 0.4, "aa"))})
    assert written(tmp_path, sheet, "a.tsv", layout="rhubarb") == "0.00\tsil\n0.10\taa\n0.40\tsil\n0.50\tsil\n"


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(sheet=sheets())
@pytest.mark.parametrize("suffix", [".json", ".tsv", ".TextGrid"])
def test_any_sheet_reads_back_to_the_last_bit(tmp_path: Path, suffix: str, sheet: CueSheet) -> None:
    path = tmp_path / f"a{suffix}"
    write_cue_file(sheet, path)
    read = read_cue_file(path)
    assert (read.length_s, dict(read.tiers)) == (sheet.length_s, dict(sheet.tiers))
    if suffix == ".json":
        assert (read.sound, read.text) == (sheet.sound, sheet.text)


def test_a_table_is_a_row_a_cue(tmp_path: Path) -> None:
    assert written(tmp_path, hello(), "a.tsv").splitlines()[:4] == [
        "tier\tstart_s\tend_s\tsymbol",
        "words\t0.2\t0.6\tHello",
        'words\t0.75\t1.25\tné"e',
        "words\t1.25\t1.5\t",
    ]


@pytest.mark.parametrize("name", ["a.tsv", "a.json", "a.TextGrid"])
def test_line_ends_of_other_scripts_end_no_row(tmp_path: Path, name: str) -> None:
    sheet = CueSheet(1.0, {"words": (Cue(0.0, 0.5, "a\u2028b"), Cue(0.5, 1.0, "c\x85d"))})
    write_cue_file(sheet, tmp_path / name)
    assert read_cue_file(tmp_path / name).tiers == sheet.tiers


def test_a_tab_has_no_place_in_a_table(tmp_path: Path) -> None:
    with pytest.raises(MienError, match=r"tier 'words', interval 1: 'a\\tb' holds a tab"):
        write_cue_file(CueSheet(1.0, {"words": (Cue(0.0, 1.0, "a\tb"),)}), tmp_path / "a.tsv")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("suffix", [".srt", ".vtt"])
def test_subtitles_are_sentences_or_a_cue_each(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    write_cue_file(hello(), path)
    assert [cue.symbol for cue in read_cue_file(path).tier("lines")] == ['Hello, né"e!']
    write_cue_file(hello(), path, tier="words")
    assert read_cue_file(path).tiers == {"words": hello().tiers["words"]}
    write_cue_file(read_cue_file(path), path, tier="words")
    assert read_cue_file(path).tiers == {"words": hello().tiers["words"]}


def test_lines_that_were_read_are_written_as_they_are(tmp_path: Path) -> None:
    lines = CueSheet(3.0, {"lines": (Cue(0.5, 1.0, "Oh no."), Cue(1.5, 3.0, "a < b & c"))})
    for name in ("a.srt", "a.vtt"):
        write_cue_file(lines, tmp_path / name)
        assert read_cue_file(tmp_path / name).tiers == lines.tiers


def test_subtitles_of_other_programs_are_read(tmp_path: Path) -> None:
    path = tmp_path / "a.vtt"
    path.write_text(
        "WEBVTT - a title\n\nNOTE\nof the maker\n\nSTYLE\n::cue { color: red }\n\nintro\n"
        "00:01.000 --> 00:02.500 align:start\n<v Ada>Hello <i>there</i>,\nfriend\n\n"
        "01:00:03.000 --> 01:00:04.000\n&lt;end&gt;\n"
    )
    sheet = read_cue_file(path)
    assert sheet.tiers == {"lines": (Cue(1.0, 2.5, "Hello there, friend"), Cue(3603.0, 3604.0, "<end>"))}
    assert sheet.length_s == 3604.0
    assert sheet.text == "Hello there, friend <end>"


def test_what_only_looks_like_a_mark_stays_in_subrip(tmp_path: Path) -> None:
    path = tmp_path / "a.srt"
    path.write_text("1\n00:00:01,000 --> 00:00:02,000\n{\\an8}<i>AT&amp;T</i> <x> <font color=red>no</font>\n")
    assert read_cue_file(path).text == "AT&amp;T <x> no"


def test_a_line_break_in_a_cue_breaks_no_block(tmp_path: Path) -> None:
    for name in ("a.srt", "a.vtt"):
        write_cue_file(CueSheet(1.0, {"lines": (Cue(0.0, 1.0, "one\n\ntwo"),)}), tmp_path / name)
        assert read_cue_file(tmp_path / name).tiers == {"lines": (Cue(0.0, 1.0, "one two"),)}


def test_a_dat_of_ours_loses_no_closed_mouth_and_has_the_names_of_preston_blair(tmp_path: Path) -> None:
    shapes = (Cue(0.0, 0.5, "B"), Cue(0.5, 0.52, "A"), Cue(0.52, 0.9, "D"), Cue(0.9, 0.91, "C"), Cue(0.91, 1.0, "X"))
    sheet = CueSheet(1.0, {"shapes": shapes})
    assert written(tmp_path, sheet, "a.dat", fps=12) == "MohoSwitch1\n1 etc\n7 MBP\n8 AI\n12 rest\n13 rest\n"
    late = CueSheet(1.0, {"shapes": (Cue(0.0, 0.51, "B"), Cue(0.51, 0.53, "A"), Cue(0.53, 1.0, "D"))})
    assert written(tmp_path, late, "a.dat", fps=12) == "MohoSwitch1\n1 etc\n7 MBP\n8 AI\n13 X\n".replace("X", "rest")


def test_a_dat_counts_in_frames_of_its_rate(tmp_path: Path) -> None:
    text = written(tmp_path, mary(), "a.dat", fps=23.976)
    assert text.splitlines()[-1] == "46 rest"  # 1.86 s are 44.6 frames
    read = read_cue_file(tmp_path / "a.dat", fps=23.976)
    assert read.length_s == 45 * 1001 / 24000
    assert [cue.symbol for cue in read.tier("shapes")] == [
        {"X": "rest", "B": "etc", "A": "MBP", "C": "E", "E": "O"}[shape] for _, shape in MARY
    ]
    with pytest.raises(RangeError, match="fps 0 is out of range"):
        write_cue_file(mary(), tmp_path / "b.dat", fps=0)


def test_names_that_are_not_rhubarbs_stay_in_a_dat(tmp_path: Path) -> None:
    sheet = CueSheet(1.0, {"shapes": (Cue(0.0, 0.5, "sil"), Cue(0.5, 1.0, "E"))})
    assert written(tmp_path, sheet, "a.dat") == "MohoSwitch1\n1 sil\n13 E\n25 sil\n"
    words = CueSheet(1.0, {"words": (Cue(0.0, 0.5, "A"), Cue(0.5, 1.0, "stone"))})
    assert written(tmp_path, words, "a.dat", tier="words") == "MohoSwitch1\n1 A\n13 stone\n25 X\n"


@pytest.mark.parametrize("name", ["a.dat", "a.xml"])
def test_one_tier_is_the_shapes_unless_another_is_asked_for(tmp_path: Path, name: str) -> None:
    words = CueSheet(1.0, {"words": (Cue(0.0, 1.0, "Oh"),)})
    with pytest.raises(UnknownNameError, match="unknown tier 'shapes' — there is words"):
        write_cue_file(words, tmp_path / name)
    assert not list(tmp_path.iterdir())
    assert "Oh" in written(tmp_path, words, name, tier="words")
    with pytest.raises(UnknownNameError, match="did you mean 'words'"):
        write_cue_file(words, tmp_path / "a.TextGrid", tier="word")


def test_a_layout_that_is_not_there_is_refused_before_and_while_writing(tmp_path: Path) -> None:
    check_cue_file(tmp_path / "a.xml")  # the only one there is
    for name, layout, said in [
        ("a.TextGrid", "rhubarb", r"no layout 'rhubarb' of such a file — it writes \.json, \.tsv, \.xml, \.dat"),
        ("a.json", "rubarb", "did you mean 'rhubarb'"),
        ("a.textgird", "mien", r"did you mean '\.textgrid'"),
        ("none/a.json", "mien", "does not exist"),
    ]:
        for act in (
            lambda: check_cue_file(tmp_path / name, layout),  # noqa: B023 - called at once
            lambda: write_cue_file(mary(), tmp_path / name, layout=layout),  # noqa: B023 - called at once
        ):
            with pytest.raises(MienError, match=said):
                act()
    assert not list(tmp_path.iterdir())


def test_what_is_said_becomes_a_textgrid(tmp_path: Path) -> None:
    sheet = hello()
    timeline = Timeline((), 1.5, words=sheet.tiers["words"], phones=sheet.tiers["phones"])
    write_performance(replace(opening_jaw(), timeline=timeline), tmp_path / "a.TextGrid")
    assert read_cue_file(tmp_path / "a.TextGrid").tiers == {
        name: cues for name, cues in sheet.tiers.items() if name != "shapes"
    }


def test_a_timeline_has_cues_too(tmp_path: Path) -> None:
    sheet = hello()
    timeline = Timeline((), 1.5, words=sheet.tiers["words"], phones=sheet.tiers["phones"], text=sheet.text)
    write_performance(replace(opening_jaw(), timeline=timeline), tmp_path / "a.json")
    read = read_cue_file(tmp_path / "a.json")
    assert (read.text, read.length_s) == (sheet.text, 1.5)
    assert read.tiers == {"words": sheet.tiers["words"], "phones": sheet.tiers["phones"]}


FAULTS = [
    ("a.json", "", "is empty"),
    ("a.tsv", "  \n", "is empty"),
    ("a.json", "{", r"a\.json:1: is not JSON"),
    ("a.json", "[" * 100_000, "nested too deeply|is not JSON"),
    ("a.json", "[]", "want an object"),
    ("a.json", '{"format": "mien-face", "version": 1}', 'want "format": "mien-cues"'),
    ("a.json", '{"format": "mien-timeline", "version": 1, "length_s": 1, "layers": []}', "no word is said"),
    ("a.json", '{"format": "mien-timeline", "version": 1}', "'length_s' is missing"),
    ("a.json", '{"format": "mien-cues", "version": 2, "length_s": 1, "tiers": {}}', "version: want version 1, got 2"),
    ("a.json", '{"format": "mien-cues", "version": 1, "length_s": 1}', "'tiers' is missing"),
    ("a.json", '{"format": "mien-cues", "version": 1, "length_s": 1, "tiers": {}}', "there is no tier"),
    (
        "a.json",
        '{"format": "mien-cues", "version": 1, "length_s": 1, "tiers": {"w": [[0, 0.5, "a"], [0.4, 1, "b"]]}}',
        "tier 'w', interval 2: 'b' from 0.4 to 1 s begins before the one before it ends",
    ),
    (
        "a.json",
        '{"format": "mien-cues", "version": 1, "length_s": 1, "tiers": {"w": [[0, NaN, "a"]]}}',
        r"tiers\.w\[0\]\[1\]: want a finite number",
    ),
    (
        "a.json",
        '{"format": "mien-cues", "version": 1, "length_s": 1, "tiers": {"w": [[0, "a"]]}}',
        r"tiers\.w\[0\]: want a list of 3, got one of 2",
    ),
    ("a.json", '{"metadata": {"soundFile": "", "duration": 1}, "mouthCues": [{"start": 0}]}', "'end' is missing"),
    ("a.json", RHUBARB_JSON.replace('0.25, "end"', '0.20, "end"'), "tier 'shapes', interval 2: .* begins before"),
    ("a.xml", RHUBARB_XML[:200], r"a\.xml:\d+: is not XML: .* is it cut off"),
    ("a.xml", RHUBARB_XML.replace("mouthCues", "cues"), "want a rhubarbResult"),
    ("a.xml", RHUBARB_XML.replace('start="0.25"', 'start="x"'), "mouthCue 2, start: want a number, got 'x'"),
    ("a.xml", RHUBARB_XML.replace('start="0.25" ', ""), "mouthCue 2, start: want a number, got ''"),
    ("a.xml", '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><rhubarbResult/>', "declares a document type"),
    ("a.tsv", "0.00\tX\n", "has no end"),
    ("a.tsv", "0.00\tX\n0.50\tB\n0.40\tX\n", r"a\.tsv:2: tier 'shapes', interval 2: .* does not end after"),
    ("a.tsv", "0.00 X\n0.50 B\n", r"a\.tsv:1: want a time, a tab and a shape"),
    ("a.tsv", "0.00\tX\nhalf\tB\n", r"a\.tsv:2: shape 2: want a number, got 'half'"),
    ("a.tsv", "tier\tstart_s\tend_s\tsymbol\n", "there is no cue in it"),
    ("a.tsv", "tier\tstart_s\tend_s\tsymbol\nw\t0\t1\n", r"a\.tsv:2: want 4 cells"),
    ("a.tsv", "tier\tstart_s\tend_s\tsymbol\nw\t0\t-1\ta\n", r"a\.tsv:2: tier 'w', interval 1: .* does not end"),
    ("a.tsv", "tier\tstart_s\tend_s\tsymbol\nw\t0\tinf\ta\n", "no finite number"),
    ("a.srt", "1\n00:00:01,000 -> 00:00:02,000\nHello\n", r"a\.srt:1: subtitle 1: want"),
    ("a.srt", "1\n00:00:01,000 --> 00:00:02\nHello\n", r"a\.srt:2: want a time such as 00:00:01,000, got '00:00:02'"),
    (
        "a.srt",
        "1\n00:00:01,000 --> 00:00:02,000\nHello\n\n2\n00:00:01,500 --> 00:00:03,000\nyou\n",
        r"a\.srt:6: subtitle 2: 'you' from 1.5 to 3 s begins before",
    ),
    ("a.vtt", "WEBVTT\n", "there is no subtitle in it"),
    ("a.dat", "MohoSwitch2\n1 X\n", r"a\.dat:1: want 'MohoSwitch1', got 'MohoSwitch2'"),
    ("a.dat", "MohoSwitch1\n", "has no end"),
    ("a.dat", "MohoSwitch1\n1 X\nB 3\n", r"a\.dat:3: shape 2: want a number, got 'B'"),
    ("a.dat", "MohoSwitch1\n1 X\n5 A\n4 X\n", r"a\.dat:3: tier 'shapes', interval 2"),
    ("a.dat", "MohoSwitch1\n0 X\n5 A\n", "begins before 0"),
    ("a.csv", "frame\n", r"unknown suffix of 'a\.csv'"),
]


@pytest.mark.parametrize(("name", "text", "said"), FAULTS, ids=[f"{name}-{said[:20]}" for name, _, said in FAULTS])
def test_what_is_wrong_is_said_once_with_its_place(tmp_path: Path, name: str, text: str, said: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(MienError, match=said):
        read_cue_file(tmp_path / name)


def test_bytes_that_are_no_text_are_refused(tmp_path: Path) -> None:
    for data, said in [
        ("né".encode("latin-1") * 3, r"is no UTF-8 text \(byte 1\)"),
        (b"\xff\xfea\0b", "is no UTF-16 text"),
        (b"{\0\x00\xd8", "is no UTF-16-LE text"),
    ]:
        (tmp_path / "a.json").write_bytes(data)
        with pytest.raises(LoadError, match=said):
            read_cue_file(tmp_path / "a.json")
    with pytest.raises(LoadError, match="cannot be read"):
        read_cue_file(tmp_path / "none.json")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@pytest.mark.parametrize(("suffix", "layout"), [key for key in WRITERS if key[0] in READERS])
@given(data=st.data())
def test_any_bytes_in_the_middle_are_read_or_refused_but_no_fault_of_ours(
    tmp_path: Path, suffix: str, layout: str, data: st.DataObject
) -> None:
    path = tmp_path / f"a{suffix}"
    write_cue_file(hello(), path, layout=layout)
    whole = path.read_bytes()
    first, last = sorted(data.draw(st.tuples(st.integers(0, len(whole)), st.integers(0, len(whole)))))
    odd = st.sampled_from(
        [b"nan", b"1e999", b"-1", b'"', b"\0", b"\xff", b"\n", b"\t", b"9" * 400, b"<", b"&", b"[", b"--> "]
    )
    path.write_bytes(whole[:first] + data.draw(odd | st.binary(max_size=4)) + whole[last:])
    try:
        write_cue_file(read_cue_file(path), tmp_path / "b.json")
    except MienError:
        return
    read_cue_file(tmp_path / "b.json")


@pytest.mark.parametrize("name", ["a.json", "a.tsv", "a.xml", "a.srt", "a.vtt", "a.dat"])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_file_cut_off_anywhere_is_refused_or_shorter_but_never_a_fault_of_ours(
    tmp_path: Path, name: str, layout: str
) -> None:
    path = tmp_path / name
    if (path.suffix, layout) not in WRITERS:
        layout = LAYOUTS[0]
    write_cue_file(hello(), path, layout=layout)
    data = path.read_bytes()
    for end in range(len(data) - 1):
        path.write_bytes(data[:end])
        try:
            read = read_cue_file(path)
        except MienError:
            continue
        assert path.suffix not in (".json", ".xml")
        assert sum(map(len, read.tiers.values())) <= sum(map(len, hello().tiers.values()))
