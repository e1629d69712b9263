"""Notes in the kinds of film for which FFmpeg writes none."""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from xml.sax.saxutils import escape


def append_notes(path: Path, container: str, notes: Mapping[str, str]) -> None:
    """Adds notes to a GIF or an animated PNG; leaves others alone.

    Args:
        path: a finished file; changed in place.
        container: FFmpeg's name of its format.
        notes: keywords and texts.
    """
    if container not in _FORMS or not notes:
        return
    end, form = _FORMS[container]
    with path.open("r+b") as file:
        file.seek(-len(end), os.SEEK_END)
        file.write(form(notes) + end)


def format_xmp(notes: Mapping[str, str]) -> bytes:
    """The notes as the lines of one description.

    Source: ISO 16684-1, sections 7 and 8.3.
    """
    return (
        '<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">'
        '<rdf:Description rdf:about="" xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:description><rdf:Alt>'
        f'<rdf:li xml:lang="x-default">{escape(_lines(notes))}</rdf:li>'
        "</rdf:Alt></dc:description></rdf:Description></rdf:RDF></x:xmpmeta>"
    ).encode()


def _lines(notes: Mapping[str, str]) -> str:
    return "\n".join(f"{key}: {value}" for key, value in notes.items())


def _comment(notes: Mapping[str, str]) -> bytes:
    """One comment, a note a line. Source: CompuServe, GIF89a specification, sections 15 and 24."""
    text = _lines(notes).encode()
    parts = [text[start : start + 255] for start in range(0, len(text), 255)]
    return b"\x21\xfe" + b"".join(bytes([len(part)]) + part for part in parts) + b"\0"


def _texts(notes: Mapping[str, str]) -> bytes:
    """A chunk of UTF-8 text a note. Source: W3C, PNG specification (third edition), section 11.3.3.4."""
    return b"".join(_png_chunk(b"iTXt", key.encode() + bytes(5) + value.encode()) for key, value in notes.items())


def _png_chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


_FORMS: dict[str, tuple[bytes, Callable[[Mapping[str, str]], bytes]]] = {
    "gif": (b"\x3b", _comment),
    "apng": (_png_chunk(b"IEND", b""), _texts),
}
"""Container -> how its files end, and the notes as what may stand before."""
