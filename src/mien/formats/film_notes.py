"""Notes in the kinds of film for which FFmpeg writes none."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from xml.sax.saxutils import escape

GIF_END = b"\x3b"


def append_comment(path: Path, notes: Mapping[str, str]) -> None:
    """Adds a comment to a finished GIF, a note a line.

    Source: CompuServe, GIF89a specification, sections 15, 24 and 27.
    """
    text = format_lines(notes).encode()
    parts = [text[start : start + 255] for start in range(0, len(text), 255)]
    comment = b"\x21\xfe" + b"".join(bytes([len(part)]) + part for part in parts) + b"\0"
    with path.open("r+b") as file:
        file.seek(-len(GIF_END), os.SEEK_END)
        file.write(comment + GIF_END)


def format_xmp(notes: Mapping[str, str]) -> bytes:
    """The notes as the lines of one description.

    Source: ISO 16684-1, sections 7 and 8.3.
    """
    return (
        '<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">'
        '<rdf:Description rdf:about="" xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:description><rdf:Alt>'
        f'<rdf:li xml:lang="x-default">{escape(format_lines(notes))}</rdf:li>'
        "</rdf:Alt></dc:description></rdf:Description></rdf:RDF></x:xmpmeta>"
    ).encode()


def format_lines(notes: Mapping[str, str]) -> str:
    """A note a line, such as ``Face: head``."""
    return "\n".join(f"{key}: {value}" for key, value in notes.items())
