"""Messages: the table, its checks and what is made of it; nothing that is sent ever raises anything else."""

import json
import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mien.core import MienError
from mien.live import IDLE_PARTS, KINDS, LAYERS, check_message, json_schema, parse_batch
from mien.live.messages import markdown, parse_json, refusal
from mien.timeline import STANDARD_LAYERS
from support import ROOT, load_tool

NUMBERS = st.one_of(st.floats(), st.integers(), st.booleans())
JSON = st.recursive(
    st.one_of(st.none(), NUMBERS, st.text()),
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(st.text(), inner, max_size=4)),
    max_leaves=8,
)
FIELDS = sorted({field.name for kind in KINDS.values() for field in kind.fields} | {"id", "kind"})


def complaint(read, *given):
    """What is said against something; nothing but a ``MienError`` may come."""
    try:
        read(*given)
    except MienError as error:
        return str(error)
    return ""


def test_the_messages_of_the_interface_are_understood():
    move = check_message(
        {"kind": "move", "values": {"ELU": 0.2}, "over_ms": 500, "change": "linear", "layer": "direct"}
    )
    assert dict(move["values"]) == {"ELU": 0.2}
    assert move["over_ms"] == 500.0
    assert check_message({"kind": "play", "motion": "smile", "strength": 0.8})["hold"] is False
    assert check_message({"kind": "say", "text": "Hello", "id": "1"}).id == "1"
    assert check_message({"kind": "look", "at": [0.1, 0, 0.5]})["at"] == (0.1, 0.0, 0.5)
    assert check_message({"kind": "stop", "layer": "speech"})["layer"] == "speech"
    assert check_message({"kind": "state"})["names"] is None


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (5, ["object", "got 5"]),
        ([], ["object", "a list"]),
        ({}, ["no 'kind'", "move"]),
        ({"kind": 3}, ["kind", "want a text", "got 3"]),
        ({"kind": "mvoe"}, ["'mvoe'", "did you mean 'move'"]),
        ({"kind": "move"}, ["move", "'values'", "missing"]),
        ({"kind": "move", "value": {"ELU": 1}}, ["'value'", "did you mean 'values'"]),
        ({"kind": "move", "values": []}, ["values", "want an object", "a list"]),
        ({"kind": "move", "values": {}}, ["values", "1 to 100", "got 0"]),
        ({"kind": "move", "values": {"ELU": "0.2"}}, ["ELU", "want a number", "'0.2'"]),
        ({"kind": "move", "values": {"ELU": True}}, ["ELU", "want a number", "True"]),
        ({"kind": "move", "values": {"ELU": math.nan}}, ["ELU", "nan", "not a finite number"]),
        ({"kind": "move", "values": {"ELU": 10**400}}, ["ELU", "many digits", "out of range"]),
        ({"kind": "move", "values": {"ELU": 1}, "over_ms": -1}, ["over_ms", "-1", "0 to 600000 ms"]),
        ({"kind": "move", "values": {"ELU": 1}, "change": "liner"}, ["change", "'liner'", "'linear'"]),
        ({"kind": "move", "values": {"ELU": 1}, "layer": "idle"}, ["layer", "'idle'"]),
        ({"kind": "say", "text": "a" * 10_001}, ["text", "10000 characters"]),
        ({"kind": "say", "text": "\ud800"}, ["text", "half a character"]),
        ({"kind": "look", "at": [0, 0]}, ["at", "[x, y, z]"]),
        ({"kind": "look", "at": [0, 0, 0]}, ["at", "middle of the head"]),
        ({"kind": "look", "at": ""}, ["at", "1 to 200"]),
        ({"kind": "target", "name": "cup", "at": "left"}, ["at", "[x, y, z]", "'left'"]),
        ({"kind": "target", "at": [0, 0, 1]}, ["name", "missing"]),
        ({"kind": "play", "motion": "smile", "hold": 1}, ["hold", "true or false", "got 1"]),
        ({"kind": "say", "text": "a", "phones": [[1, 0, "AA"]]}, ["phones", "cue 0", "end"]),
        ({"kind": "say", "text": "a", "phones": [[0, 1, "AA"], [0.5, 2, "B"]]}, ["cue 1", "before"]),
        ({"kind": "idle", "blinks": 2}, ["blinks", "0 to 1"]),
        ({"kind": "state", "id": 7}, ["id", "want a text"]),
    ],
)
def test_bad_messages_are_refused_with_offender_wanted_and_got(message, words):
    with pytest.raises(MienError) as caught:
        check_message(message)
    for word in words:
        assert word in str(caught.value)
    answer = refusal(caught.value, message)
    assert answer["kind"] == "error"
    json.dumps(answer, allow_nan=False).encode("ascii")


@given(JSON)
@example({"kind": "move", "values": {"": 1}})
@example({"kind": "move", "values": {"x": float("inf")}, "over_ms": None})
def test_any_json_value_is_a_message_or_refused(value):
    assert len(complaint(check_message, value)) < 2000


@given(st.sampled_from(sorted(KINDS)), st.dictionaries(st.sampled_from(FIELDS), JSON, max_size=4))
def test_any_value_in_any_field_is_checked(kind, fields):
    try:
        message = check_message({**fields, "kind": kind})
    except MienError:
        return
    again = check_message(json.loads(json.dumps(message.to_json(), allow_nan=False)))
    assert again.to_json() == message.to_json()
    assert again == message


@given(st.binary())
@example(b"[" * 100_000)
@example(b'{"a":' * 100_000)
@example(b"NaN")
@example(b'{"kind": "move", "values": {"ELU": 1e999}}')
@example(b"9" * 5000)
@example(b"\xff\xfe\x00")
def test_any_bytes_are_messages_or_refused(data):
    assert len(complaint(lambda: [check_message(value) for value in parse_batch(data)])) < 2000


def test_a_batch_is_a_list_of_no_more_than_a_hundred():
    assert parse_batch(b'{"kind": "state"}') == [{"kind": "state"}]
    assert len(parse_batch(json.dumps([{"kind": "state"}] * 100))) == 100
    with pytest.raises(MienError, match="0 to 100 of them, got 101"):
        parse_batch(json.dumps([{"kind": "state"}] * 101))


def test_nan_is_no_json():
    with pytest.raises(MienError, match="NaN"):
        parse_json(b'{"kind": "move", "values": {"ELU": NaN}}')


def test_schema_and_docs_tell_of_every_field():
    schema, text = json_schema(), markdown()
    json.dumps(schema, allow_nan=False)
    by_kind = {each["properties"]["kind"]["const"]: each for each in schema["oneOf"]}
    assert list(by_kind) == list(KINDS)
    for kind in KINDS.values():
        assert f"## {kind.name}\n" in text
        assert {field.name for field in kind.fields} | {"kind", "id"} == set(by_kind[kind.name]["properties"])
        for field in kind.fields:
            assert f"| `{field.name}` |" in text
            assert field.doc.endswith(".")
    assert by_kind["move"]["required"] == ["kind", "values"]


def test_the_schema_in_the_docs_is_up_to_date():
    stored = (ROOT / "docs" / "messages.schema.json").read_text(encoding="utf-8")
    assert stored == load_tool("messages").schema(), "run python tools/messages.py"


def test_defaults_pass_their_own_checks():
    for kind in KINDS.values():
        for field in kind.fields:
            if field.default is not None:
                assert field.check(field.default) == field.default


def test_layers_are_those_of_a_performance():
    assert LAYERS == STANDARD_LAYERS
    assert {field.name for field in KINDS["idle"].fields} == set(IDLE_PARTS)
