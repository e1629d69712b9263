"""Texts that arrive in parts, as a language model writes them: what of them is complete."""

from __future__ import annotations

from dataclasses import dataclass

from mien.core import MienError
from mien.perform.marks_reader import parse_marks
from mien.speech.text import find_complete

MOST_STREAMS = 16
"""Texts that can be open at one time."""

SILENCE_S = 1.0
"""What waits for its sentence to be completed is said when no more has come for so long."""

LONGEST_MARKS = 1_000
"""Characters in which what a mark has opened must be closed."""

Identity = str | None


@dataclass
class _Stream:
    """The text that waits, and when something came last."""

    text: str = ""
    heard_s: float = 0.0


class Streams:
    """Open texts by the ``id`` of their messages; those without one are one text."""

    def __init__(self) -> None:
        self._streams: dict[Identity, _Stream] = {}

    def __contains__(self, identity: Identity) -> bool:
        return identity in self._streams

    @property
    def open(self) -> list[Identity]:
        """Those of which more is to come."""
        return list(self._streams)

    @property
    def characters(self) -> int:
        """How many wait."""
        return sum(len(stream.text) for stream in self._streams.values())

    def add(self, identity: Identity, text: str, language: str, now_s: float) -> str:
        """What is complete with this part of a text, marks and all; empty where nothing is.

        Raises:
            MienError: too many texts are open, or a mark is not closed for too long; what waited is dropped then.
        """
        stream = self._streams.get(identity) or self._open(identity)
        stream.text, stream.heard_s = (stream.text + text).replace("\r\n", "\n"), now_s
        ends = find_complete(stream.text, language)
        for end in reversed(ends):
            try:
                parse_marks(stream.text[:end])
            except MienError:
                if end > ends[0] or len(stream.text) <= LONGEST_MARKS:
                    continue
                stream.text = ""
                raise
            complete, stream.text = stream.text[:end], stream.text[end:]
            return complete
        return ""

    def end(self, identity: Identity) -> str:
        """What waits of a text that ends."""
        return self._streams.pop(identity).text

    def take_silent(self, now_s: float) -> list[tuple[Identity, str]]:
        """What waits of texts of which nothing has come for a while; they stay open."""
        found = []
        for identity, stream in self._streams.items():
            if stream.text.strip() and now_s - stream.heard_s >= SILENCE_S:
                found.append((identity, stream.text))
                stream.text = ""
        return found

    def clear(self) -> None:
        """Forget them all."""
        self._streams.clear()

    def _open(self, identity: Identity) -> _Stream:
        if len(self._streams) >= MOST_STREAMS:
            idle = [known for known, stream in self._streams.items() if not stream.text.strip()]
            if not idle:
                raise MienError(f"say: {MOST_STREAMS} texts are open — end one of them with 'more': false")
            # Whoever went away without ending a text blocks nobody.
            del self._streams[min(idle, key=lambda known: self._streams[known].heard_s)]
        stream = self._streams[identity] = _Stream()
        return stream
