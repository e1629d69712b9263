"""Files that are no faces at all, or far too much of one: a clear word with the place, and soon."""

import copy
import json
import random
from pathlib import Path
from time import process_time

import numpy as np
import pytest

from mien.core import LoadError
from mien.faces.toon.checks import DEEPEST, check_bytes, check_file
from mien.faces.toon.checks_places import find_depth, find_places
from mien.faces.toon.reader import MOST_BYTES, parse_toon
from mien.faces.toon.starters import starter_text

ODD = [None, True, 0, -1, 2.5, 1e9, "", "x", "M", "M0 0", "#fff", "skin", "BRL", [], [1], [1, 2], [[0, 0]] * 3, {}]
ODD += [float("nan"), -0.0, 100_000, {"min": 0, "max": 0}, {"feature": "M"}, {"move": [1e5, 1e5]}, "M0 0 L9 0 L0 9 Z"]
START = starter_text("kim")


def only(report):
    (fault,) = report.faults
    assert report.face is None
    assert fault.grave
    return fault


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 1, "the file is empty"),
        ("{", 1, "the file ends too early"),
        ('{"a": 1,\n\n  // a comment\n "b": 2}', 3, "column 3: Expecting property name"),
        ('{"a": 1,\n "b": 2,\n}', None, "remove th"),
        ('{"a": [1,\n 2,]}', None, "remove th"),
        ('{"a": 1\n "b": 2}', 2, "put a comma"),
        ("{'a': 1}", 1, "between double quotes"),
        ('{"a": "b\n"}', 1, "control character"),
        ("<svg></svg>", 1, "column 1"),
    ],
)
def test_what_is_no_json_is_told_with_line_and_column(text, line, words):
    fault = only(check_bytes(text.encode()))
    assert fault.rule == "json"
    assert line is None or fault.line == line
    assert words in fault.text()
    assert fault.what.startswith("column ")


@pytest.mark.parametrize("text", ["7", "null", '"face"', "[1, 2]", "true"])
def test_other_json_is_no_face(text):
    fault = only(check_bytes(text.encode()))
    assert (fault.rule, fault.line, fault.got) == ("type", 1, text)


def test_bytes_that_are_no_text():
    fault = only(check_bytes(b'{"name":\n "\xff\xfe"}'))
    assert (fault.rule, fault.line) == ("file", 2)
    assert "byte 11" in fault.text()
    assert only(check_bytes(START.encode("utf-16"))).rule == "file"


def test_a_byte_order_mark_and_other_line_ends_are_fine():
    assert check_bytes(b"\xef\xbb\xbf" + START.replace("\n", "\r\n").encode(), 0).faults == ()


def test_keys_that_stand_twice():
    text = START.replace('"size": [400, 440]', '"size": [400, 440],\n "size": [400, 441]')
    text = text.replace('"id": "nose"', '"id": "nose", "id": "nase"')
    faults = check_bytes(text.encode(), 0).faults
    assert [(fault.rule, fault.place[-1]) for fault in faults] == [("repeated", "size"), ("repeated", "id")]
    assert [fault.line for fault in faults] == [
        number for number, line in enumerate(text.splitlines(), 1) if "441" in line or "nase" in line
    ]


def test_files_that_are_none(tmp_path):
    assert "Is a directory" in only(check_file(tmp_path)).text()
    assert "No such file" in only(check_file(tmp_path / "no.toon.json")).text()
    large = tmp_path / "large.toon.json"
    with large.open("wb") as file:
        file.truncate(50_000_000)
    assert MOST_BYTES < 50_000_000
    assert "is larger than" in only(check_file(large)).text()
    assert "is larger than" in only(check_file(Path("/dev/zero"))).text()


@pytest.mark.parametrize(("opening", "line"), [("[", 1), ('{"a":', 1), ("[\n", DEEPEST + 1)])
def test_ten_thousand_levels(opening, line):
    fault = only(check_bytes((opening * 10_000).encode()))
    assert (fault.rule, fault.line) == ("depth", line)
    assert only(check_bytes(b"[" * 10_000 + b"]" * 10_000)).rule == "depth"


def test_a_number_of_five_thousand_digits():
    text = START.replace("[400, 440]", f"[400, {'9' * 5000}]")
    faults = check_bytes(text.encode(), 0).faults
    assert [(fault.rule, fault.place) for fault in faults] == [("range", ("size", 1))]
    with pytest.raises(LoadError, match="digits"):
        parse_toon(text, "x")


ANGLES = np.linspace(0.0, 2.0 * np.pi, 100_001)
CIRCLE = np.round(200.0 + 90.0 * np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1), 4).tolist()


@pytest.mark.parametrize(
    ("path", "rule", "count"),
    [
        (CIRCLE[:20_001], "large", 1),
        (CIRCLE, "large", 1),
        ([["x", "y"]] * 5_000, "type", 1000),
        ("M" * 200_000, "path", 1),
    ],
    ids=("many", "too many", "wrong", "letters"),
)
def test_a_hundred_thousand_points_take_seconds(path, rule, count):
    document = json.loads(START)
    document["polygons"].append({"id": "new", "kind": "free", "fill": "skin", "path": path})
    data = json.dumps(document).encode()
    start = process_time()
    faults = check_bytes(data, 0).faults
    assert process_time() - start < 20.0
    assert (len(faults), {fault.rule for fault in faults}) == (count, {rule})


def test_long_texts_are_shown_in_short():
    document = json.loads(START)
    document["polygons"][0]["fill"] = "s" * 100_000
    document["x" * 100_000] = 1
    for fault in check_bytes(json.dumps(document).encode(), 0).faults:
        assert len(fault.text()) < 400


def test_places_of_every_value():
    places = find_places('{"a": [1,\n {"b]": "}{",\n "c": []}],\n "": {"a": null}}')
    assert places.lines == {
        (): 1,
        ("a",): 1,
        ("a", 0): 1,
        ("a", 1): 2,
        ("a", 1, "b]"): 2,
        ("a", 1, "c"): 3,
        ("",): 4,
        ("", "a"): 4,
    }
    assert places.line(("a", 1, "c", 7, "z")) == 3
    assert places.repeated == ()


def test_brackets_in_texts_are_no_depth():
    assert find_depth('["[[[[", "\\"[[["]', 1) is None
    assert find_depth("[\n[\n[", 2) == 3
    assert find_depth('"' + "\\" * 1_000_001 + "[" * 9, 2) is None


def places_of(value, place=()):
    yield place
    for key, member in (
        value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    ):
        yield from places_of(member, (*place, key))


@pytest.mark.parametrize("seed", range(40))
def test_whatever_is_changed_the_verdict_is_that_of_the_reader(seed):
    generator = random.Random(seed)
    document = json.loads(starter_text("kim", "strict" if seed % 4 == 0 else "extended"))
    for _ in range(1 + seed % 3):
        *way, last = generator.choice([place for place in places_of(document) if place])
        here = document
        for key in way:
            here = here[key]
        if generator.random() < 0.3:
            del here[last]
        else:
            here[last] = copy.deepcopy(generator.choice(ODD))
    report = check_bytes(json.dumps(document).encode(), 3)
    assert all(fault.text() for fault in report.faults)
    assert not any(fault.rule == "type" and not fault.place for fault in report.faults)
    try:
        parse_toon(json.dumps(document), "document")
    except LoadError:
        assert report.errors
