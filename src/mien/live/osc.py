"""Messages as OSC packets: ``/mien/move/jaw/rotation 8 500``, ``/mien/play smile``.

Source: Wright 2002, The Open Sound Control 1.0 Specification.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import islice
from types import MappingProxyType
from typing import Any

from mien.core import MienError, UnknownNameError

from .fields import show

Argument = float | int | str | bytes | bool | None | tuple[int, int, int, int]
Call = tuple[str, tuple[Argument, ...]]
"""An address and its arguments."""

PREFIX = "/mien"
BUNDLE = b"#bundle\0"
AT_ONCE = 1
"""The time tag of what is to be done when it comes."""

DEEPEST = 8
MOST_CALLS = 1000

_NUMBERS: Mapping[str, str] = MappingProxyType(
    {"i": ">i", "f": ">f", "h": ">q", "d": ">d", "t": ">Q", "c": ">i", "r": ">I"}
)
_FIXED: Mapping[str, Argument] = MappingProxyType({"T": True, "F": False, "N": None, "I": True})


def decode_packet(data: bytes) -> list[Call]:
    """The calls in a packet, in order; those of bundles act at once, whatever their time.

    Raises:
        MienError: it is no packet; says at which byte.
    """
    calls = list(islice(_decode(data, 0, len(data), 0), MOST_CALLS + 1))
    if len(calls) > MOST_CALLS:
        raise MienError(f"OSC: more than {MOST_CALLS} messages in one packet")
    return calls


def message_from(address: str, arguments: tuple[Argument, ...]) -> dict[str, Any] | None:
    """The message, not yet checked, that a call asks for; None for an address outside ``/mien``.

    Raises:
        MienError: there is no such address, or the arguments do not suit.
    """
    head, *path = address.removeprefix("/").split("/")
    if head != PREFIX[1:]:
        return None
    verb, name = (path[0] if path else ""), ".".join(path[1:])
    if verb not in CALLS:
        raise UnknownNameError("OSC address", address[:100], [f"{PREFIX}/{each}" for each in CALLS])
    try:
        return {"kind": verb} | CALLS[verb](name, *arguments)
    except TypeError:
        raise MienError(f"{address[:100]}: got {len(arguments)} arguments — want {WANTED[verb]}") from None


def encode_call(address: str, *arguments: float | int | str) -> bytes:
    """The packet of one call; whole numbers as i, others as f, texts as s."""
    tags, data = ",", b""
    for argument in arguments:
        if isinstance(argument, str):
            tags, data = tags + "s", data + _padded(argument)
        elif isinstance(argument, int):
            tags, data = tags + "i", data + struct.pack(">i", argument)
        else:
            tags, data = tags + "f", data + struct.pack(">f", argument)
    return _padded(address) + _padded(tags) + data


def encode_bundles(packets: Iterable[bytes], most: int) -> Iterator[bytes]:
    """Bundles of packets, in order, each of so many bytes at most and to be acted on at once.

    A packet that is longer has a bundle of its own.
    """
    head = BUNDLE + struct.pack(">Q", AT_ONCE)
    bundle = head
    for packet in packets:
        if len(bundle) > len(head) and len(bundle) + 4 + len(packet) > most:
            yield bundle
            bundle = head
        bundle += struct.pack(">i", len(packet)) + packet
    if len(bundle) > len(head):
        yield bundle


def _move(name: str, value: Argument, over_ms: Argument = 0, /) -> dict[str, Any]:
    return {"values": {name: value}, "over_ms": over_ms}


def _play(name: str, motion: Argument, strength: Argument = 1.0, /) -> dict[str, Any]:
    return {"motion": motion, "strength": strength}


def _look(name: str, x: Argument, y: Argument = None, z: Argument = None, /) -> dict[str, Any]:
    return {"at": x if isinstance(x, str) else [x, y, z]}


def _target(name: str, target: Argument, x: Argument, y: Argument, z: Argument, /) -> dict[str, Any]:
    return {"name": target, "at": [x, y, z]}


def _stop(name: str, layer: Argument = None, /) -> dict[str, Any]:
    return {"layer": layer}


def _idle(name: str, part: Argument, amount: Argument, /) -> dict[str, Any]:
    return {part if isinstance(part, str) else show(part): amount}


def _state(name: str, *names: Argument) -> dict[str, Any]:
    return {"names": list(names)} if names else {}


CALLS: Mapping[str, Callable[..., dict[str, Any]]] = MappingProxyType(
    {
        "move": _move,
        "play": _play,
        "say": lambda name, text, /: {"text": text},
        "look": _look,
        "target": _target,
        "stop": _stop,
        "interrupt": lambda name, /: {},
        "reset": lambda name, over_ms=300, /: {"over_ms": over_ms},
        "state": _state,
        "idle": _idle,
    }
)
"""What arguments mean behind each address; every kind of message has one."""

WANTED: Mapping[str, str] = MappingProxyType(
    {
        "move": "a value and perhaps milliseconds",
        "play": "a motion and perhaps how much of it",
        "say": "a text",
        "look": "x, y, z, a direction or a target",
        "target": "a name, x, y, z",
        "stop": "a layer or nothing",
        "interrupt": "nothing",
        "reset": "milliseconds or nothing",
        "state": "names or nothing",
        "idle": "a part and how much of it",
    }
)


def _decode(data: bytes, start: int, end: int, depth: int) -> Iterator[Call]:
    if (end - start) % 4 or start == end:
        raise MienError(f"OSC: {end - start} bytes at byte {start} — want a multiple of four, at least one")
    if data[start:end].startswith(BUNDLE):
        yield from _decode_bundle(data, start, end, depth)
    else:
        yield _decode_message(data, start, end)


def _decode_bundle(data: bytes, start: int, end: int, depth: int) -> Iterator[Call]:
    if depth == DEEPEST:
        raise MienError(f"OSC: bundles at byte {start} are nested more than {DEEPEST} deep")
    place = start + len(BUNDLE) + 8
    if place > end:
        raise MienError(f"OSC: the bundle at byte {start} has no time tag")
    while place < end:
        size = struct.unpack_from(">i", data, place)[0]
        place += 4
        if not 0 < size <= end - place:
            raise MienError(f"OSC: an element of {size} bytes at byte {place}, of which {end - place} are there")
        yield from _decode(data, place, place + size, depth + 1)
        place += size


def _decode_message(data: bytes, start: int, end: int) -> Call:
    address, place = _text(data, start, end)
    if not address.startswith("/"):
        raise MienError(f"OSC: {show(address)} at byte {start} is no address — it begins with '/'")
    if place == end:  # older senders leave out the types of no arguments
        return address, ()
    tags, place = _text(data, place, end)
    if not tags.startswith(","):
        raise MienError(f"OSC: {address[:100]} has no type tags — they begin with ','")
    arguments: list[Argument] = []
    for tag in tags[1:]:
        if tag in "[]":
            continue
        argument, place = _argument(tag, data, place, end)
        arguments.append(argument)
    if place != end:
        raise MienError(f"OSC: {end - place} bytes too many behind {address[:100]}")
    return address, tuple(arguments)


def _argument(tag: str, data: bytes, place: int, end: int) -> tuple[Argument, int]:
    if tag in _FIXED:
        return _FIXED[tag], place
    if tag in "sS":
        return _text(data, place, end)
    if tag in _NUMBERS:
        size = struct.calcsize(_NUMBERS[tag])
        _need(size, place, end)
        number = struct.unpack_from(_NUMBERS[tag], data, place)[0]
        # Single precision has seven places; a 0.2 that was sent is meant as 0.2, not as 0.20000000298.
        return float(f"{number:.7g}") if tag == "f" else number, place + size
    if tag == "m":
        _need(4, place, end)
        a, b, c, d = data[place : place + 4]
        return (a, b, c, d), place + 4
    if tag == "b":
        _need(4, place, end)
        size = struct.unpack_from(">i", data, place)[0]
        if size < 0:
            raise MienError(f"OSC: a blob of {size} bytes at byte {place}")
        _need(4 + size + -size % 4, place, end)
        return data[place + 4 : place + 4 + size], place + 4 + size + -size % 4
    raise MienError(f"OSC: type tag {show(tag)} is unknown")


def _need(size: int, place: int, end: int) -> None:
    if place + size > end:
        raise MienError(f"OSC: want {size} bytes at byte {place}, of which {end - place} are there")


def _text(data: bytes, start: int, end: int) -> tuple[str, int]:
    stop = data.find(b"\0", start, end)
    if stop < 0:
        raise MienError(f"OSC: the text at byte {start} has no end")
    place = stop + 4 - (stop - start) % 4
    if place > end:
        raise MienError(f"OSC: the text at byte {start} is not filled up to four bytes")
    try:
        return data[start:stop].decode("utf-8"), place
    except UnicodeDecodeError:
        raise MienError(f"OSC: the text at byte {start} is no UTF-8") from None


def _padded(text: str) -> bytes:
    data = text.encode("utf-8") + b"\0"
    return data + b"\0" * (-len(data) % 4)
