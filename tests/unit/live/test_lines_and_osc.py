"""Text lines and OSC packets: the same messages as in JSON."""

import struct

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mien.core import MienError
from mien.live import KINDS, check_message
from mien.live.lines import FORMS, parse_line
from mien.live.osc import CALLS, DEEPEST, MOST_CALLS, WANTED, decode_packet, encode_call, message_from


def complaint(read, *given):
    """What is said against something; nothing but a ``MienError`` may come."""
    try:
        read(*given)
    except MienError as error:
        return str(error)
    return ""


def from_osc(*call):
    ((address, arguments),) = decode_packet(encode_call(*call))
    return check_message(message_from(address, arguments))


MOVE = check_message({"kind": "move", "values": {"ELU": 0.2}, "over_ms": 500})
PLAY = check_message({"kind": "play", "motion": "smile"})
SAY = check_message({"kind": "say", "text": "Hello there"})
LOOK = check_message({"kind": "look", "at": [0.1, 0, 0.5]})


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (b"MOVE ELU 0.2 500\r\n", MOVE),
        (b"ELU 0.2 500", MOVE),
        (b"  move  ELU  0.2   500 ", MOVE),
        (b"PLAY smile", PLAY),
        (b"play smile 1", PLAY),
        (b"SAY Hello there", SAY),
        (b"LOOK 0.1 0 0.5", LOOK),
        (b"LOOK left", check_message({"kind": "look", "at": "left"})),
        (b"target cup 0.1 0 0.5", check_message({"kind": "target", "name": "cup", "at": [0.1, 0, 0.5]})),
        (b"STATE", check_message({"kind": "state"})),
        (b"STATE ELU MB", check_message({"kind": "state", "names": ["ELU", "MB"]})),
        (b"STOP speech", check_message({"kind": "stop", "layer": "speech"})),
        (b"STOP", check_message({"kind": "stop"})),
        (b"INTERRUPT", check_message({"kind": "interrupt"})),
        (b"RESET", check_message({"kind": "reset"})),
        (b"IDLE blinks 0", check_message({"kind": "idle", "blinks": 0})),
        (b"jaw.rotation 8", check_message({"kind": "move", "values": {"jaw.rotation": 8}})),
        (b'{"kind": "play", "motion": "smile"}', PLAY),
    ],
)
def test_lines_say_the_same(line, message):
    assert check_message(parse_line(line)) == message


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (b"MOVE ELU", "NAME VALUE"),
        (b"MOVE ELU x", "want a number, got 'x'"),
        (b"MOVE ELU nan", "not a finite number"),
        (b"STAET", "did you mean 'STATE'"),
        (b"LOOK 1 2", "X Y Z"),
        (b"RESET now", "nothing is wanted"),
        (b"\xff", "no UTF-8"),
        (b"SAY " + b"a" * 13_000, "at most"),
        (b"[1]", "unknown command"),
        (b"{", "is no JSON"),
        (b"SAY \x00\x01", None),
        (b"IDLE kind 1", "kind"),
    ],
)
def test_bad_lines_are_refused(line, words):
    if words is None:
        assert check_message(parse_line(line)).kind == "say"
        return
    with pytest.raises(MienError, match=words):
        check_message(parse_line(line))


def test_an_empty_line_is_none():
    assert parse_line(b"\r\n") is None


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (("/mien/move/ELU", 0.2, 500), MOVE),
        (("/mien/move/jaw/rotation", 8.0), check_message({"kind": "move", "values": {"jaw.rotation": 8}})),
        (("/mien/play", "smile"), PLAY),
        (("/mien/play", "smile", 0.8), check_message({"kind": "play", "motion": "smile", "strength": 0.8})),
        (("/mien/say", "Hello there"), SAY),
        (("/mien/look", 0.1, 0.0, 0.5), LOOK),
        (("/mien/look", "left"), check_message({"kind": "look", "at": "left"})),
        (("/mien/target", "cup", 0.1, 0.0, 0.5), check_message({"kind": "target", "name": "cup", "at": [0.1, 0, 0.5]})),
        (("/mien/stop", "speech"), check_message({"kind": "stop", "layer": "speech"})),
        (("/mien/stop",), check_message({"kind": "stop"})),
        (("/mien/interrupt",), check_message({"kind": "interrupt"})),
        (("/mien/reset",), check_message({"kind": "reset"})),
        (("/mien/state",), check_message({"kind": "state"})),
        (("/mien/idle", "blinks", 0), check_message({"kind": "idle", "blinks": 0})),
    ],
)
def test_osc_says_the_same(call, message):
    assert from_osc(*call) == message


def test_every_kind_has_a_line_and_an_address():
    about_faces = {name for name, kind in KINDS.items() if not kind.connection}
    assert set(FORMS) == about_faces | {"subscribe"}
    assert set(CALLS) == set(WANTED) == about_faces


def test_a_packet_of_the_specification():
    """Source: Open Sound Control 1.0, the two example messages."""
    first = b"/oscillator/4/frequency\0,f\0\0" + bytes([0x43, 0xDC, 0, 0])
    assert decode_packet(first) == [("/oscillator/4/frequency", (440.0,))]
    numbers = struct.pack(">iiff", 1000, -1, 1.234, 5.678)
    second = b"/foo\0\0\0\0,iisff\0\0" + numbers[:8] + b"hello\0\0\0" + numbers[8:]
    assert decode_packet(second) == [("/foo", (1000, -1, "hello", 1.234, 5.678))]
    assert encode_call("/oscillator/4/frequency", 440.0) == first


def bundle(*elements):
    return b"#bundle\0" + bytes(7) + b"\1" + b"".join(struct.pack(">i", len(each)) + each for each in elements)


def test_bundles_keep_the_order_of_their_messages():
    one, two, three = (encode_call(f"/mien/move/m{number}", number) for number in (1, 2, 3))
    calls = decode_packet(bundle(one, bundle(two), three))
    assert [address for address, _ in calls] == ["/mien/move/m1", "/mien/move/m2", "/mien/move/m3"]
    assert decode_packet(bundle()) == []


def test_all_type_tags_are_read():
    data = b"/a\0\0" + b",hdTFNI[b]mctS\0\0"
    data += struct.pack(">qd", -(2**40), 0.5) + struct.pack(">i", 3) + b"xyz\0" + bytes([1, 2, 3, 4])
    data += struct.pack(">iQ", 65, 7) + b"ab\0\0"
    assert decode_packet(data) == [("/a", (-(2**40), 0.5, True, False, None, True, b"xyz", (1, 2, 3, 4), 65, 7, "ab"))]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "0 bytes"),
        (b"/a\0", "3 bytes"),
        (b"abc\0", "no address"),
        (b"/abc", "no end"),
        (b"/a\0\0,f\0\0", "want 4 bytes"),
        (b"/a\0\0,q\0\0", "'q' is unknown"),
        (b"/a\0\0,\0\0\0abcd", "4 bytes too many"),
        (b"/a\0\0,b\0\0\xff\xff\xff\xff", "blob of -1"),
        (b"/\xff\0\0,\0\0\0", "no UTF-8"),
        (b"#bundle\0", "no time tag"),
        (bundle(b"")[:16] + b"\xff\xff\xff\xff", "element of -1"),
        (bundle(encode_call("/a"))[:-4], "of which"),
    ],
)
def test_bad_packets_are_refused(data, words):
    with pytest.raises(MienError, match=words):
        decode_packet(data)


def test_bundles_that_are_nested_too_deeply_are_refused():
    data = encode_call("/a")
    for _ in range(DEEPEST + 1):
        data = bundle(data)
    with pytest.raises(MienError, match="nested"):
        decode_packet(data)


def test_packets_of_too_many_messages_are_refused():
    most = [encode_call("/a")] * MOST_CALLS
    assert len(decode_packet(bundle(*most))) == MOST_CALLS
    with pytest.raises(MienError, match=f"more than {MOST_CALLS}"):
        decode_packet(bundle(*most, most[0], b"what stands behind is not even looked at"))


def test_addresses_of_others_are_none_of_ours_and_wrong_ones_are_named():
    assert message_from("/VMC/Ext/Blend/Val", ("Joy", 1.0)) is None
    with pytest.raises(MienError, match="did you mean '/mien/move'"):
        message_from("/mien/mvoe/ELU", (1.0,))
    with pytest.raises(MienError, match="got 0 arguments — want a value"):
        message_from("/mien/move/ELU", ())
    with pytest.raises(MienError, match="want a number"):
        check_message(message_from("/mien/move/ELU", ("x",)))


@given(st.binary(max_size=300))
@example(b"ELU 1e999 0")
@example(b"MOVE \xc3\xa4 1")
def test_any_line_is_a_message_or_refused(data):
    value = None
    said = complaint(parse_line, data)
    if not said:
        value = parse_line(data)
    assert len(said) < 2000
    assert value is None or len(complaint(check_message, value)) < 2000


PIECES = st.sampled_from(
    [b"/mien/move/a\0\0\0\0", b",f\0\0", b",sb\0", b"#bundle\0", bytes(8), b"\0\0\0\x10", b"abc\0"]
)


@given(st.one_of(st.binary(max_size=200), st.lists(PIECES, max_size=12).map(b"".join)))
def test_any_packet_is_messages_or_refused(data):
    said = complaint(decode_packet, data)
    assert len(said) < 2000
    for call in [] if said else decode_packet(data):
        assert len(complaint(lambda: check_message(message_from(*call)))) < 2000  # noqa: B023


ARGUMENTS = st.one_of(st.floats(), st.integers(), st.text(max_size=9), st.binary(max_size=5), st.none(), st.booleans())


@given(st.sampled_from(sorted(CALLS)), st.lists(ARGUMENTS, max_size=4))
def test_any_arguments_are_a_message_or_refused(verb, arguments):
    try:
        check_message(message_from(f"/mien/{verb}/jaw/rotation", tuple(arguments)))
    except MienError:
        return
