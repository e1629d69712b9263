"""The elements of an SVG file: read by the standard library's expat, with nothing fetched, expanded or executed.

Expat fetches nothing by itself; what is left to refuse are declarations of entities, which can grow without bound.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from mien.core import LoadError

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"

LARGEST_BYTES = 16 << 20
DEEPEST = 100
MOST_ELEMENTS = 20_000

GZIP = b"\x1f\x8b"

EXECUTABLE = ("script", "handler", "listener")
"""Elements that hold programs. Source: SVG 1.1 chapter 18, SVG Tiny 1.2 chapter 15."""


@dataclass(frozen=True, eq=False)
class Element:
    """One element.

    Attributes:
        name: its tag, without the namespace; elements of other namespaces are left out.
        attributes: their values by name; ``href`` is that of XLink too, ``label`` is Inkscape's name of a layer.
        line: where it begins.
        children: the elements in it.
        texts: pieces of text in it.
    """

    name: str
    attributes: Mapping[str, str]
    line: int
    children: list[Element] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)

    def __iter__(self) -> Iterator[Element]:
        """Itself and all that is in it, in the order of the file."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting.extend(reversed(element.children))


class Remarks:
    """What of a file is not shown as it was meant, each matter once."""

    def __init__(self, path: Path | str) -> None:
        self.path = path
        self._lines: dict[str, list[int]] = {}

    def add(self, line: int, matter: str) -> None:
        """Notes a matter, and where."""
        self._lines.setdefault(matter, []).append(line)

    def texts(self) -> tuple[str, ...]:
        """A line each, with the place where it is first met."""
        return tuple(
            f"{self.path}:{lines[0]}: {matter}" + (f" ({len(lines)} times)" if len(lines) > 1 else "")
            for matter, lines in self._lines.items()
        )


def read_elements(path: Path, remarks: Remarks) -> Element:
    """The root of an SVG file; programs are left out, with a remark.

    Raises:
        LoadError: it cannot be read, is too large or too deep, declares entities, is no XML or no SVG.
    """
    parser = expat.ParserCreate(namespace_separator=" ")
    builder = _Builder(path, parser, remarks)
    try:
        parser.Parse(_read(path), True)
    except expat.ExpatError as error:
        raise LoadError(
            path, f"is no well-formed XML: {expat.errors.messages[error.code]}", line=error.lineno
        ) from None
    except (LookupError, ValueError) as error:  # an encoding that Python does not have
        raise LoadError(path, f"is in an encoding that cannot be read: {error}", hint="save it as UTF-8") from None
    if builder.root is None or builder.root.name != "svg":
        raise LoadError(
            path, "is XML but no SVG: its root is no <svg>", hint=f'want <svg xmlns="{SVG}"> as the outermost element'
        )
    return builder.root


def _read(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_BYTES + 1)
    except OSError as error:
        raise LoadError(path, f"cannot be read ({error.strerror})") from error
    if len(content) > LARGEST_BYTES:
        raise LoadError(
            path,
            f"is larger than {LARGEST_BYTES >> 20} MB",
            hint="a face of flat shapes has some kilobytes; is there a photograph in it?",
        )
    if content.startswith(GZIP):
        raise LoadError(path, "is compressed (SVGZ)", hint="unpack it: gunzip -c drawing.svgz > drawing.svg")
    if not content.strip():
        raise LoadError(path, "is empty")
    return content


class _Builder:
    """Hears expat and puts the elements together."""

    def __init__(self, path: Path, parser: expat.XMLParserType, remarks: Remarks) -> None:
        self.root: Element | None = None
        self._path, self._parser, self._remarks = path, parser, remarks
        self._open: list[Element | None] = []
        self._count = 0
        parser.StartDoctypeDeclHandler = self._doctype
        parser.EntityDeclHandler = self._entity
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text

    def _fail(self, message: str, hint: str) -> LoadError:
        return LoadError(self._path, message, line=self._parser.CurrentLineNumber, hint=hint)

    def _doctype(self, name: str, system: str | None, public: str | None, has_declarations: int) -> None:
        if has_declarations:
            raise self._fail(
                "the DOCTYPE holds declarations, and entities could grow without bound",
                "save it as plain SVG, or delete everything from <!DOCTYPE to ]>",
            )

    def _entity(self, name: str, *rest: object) -> None:
        raise self._fail(f"declares the entity {name!r}", "save it as plain SVG; entities are not read")

    def _start(self, tag: str, given: dict[str, str]) -> None:
        line = self._parser.CurrentLineNumber
        self._count += 1
        if self._count > MOST_ELEMENTS:
            raise self._fail(f"has more than {MOST_ELEMENTS:,} elements", "simplify the drawing first")
        if len(self._open) >= DEEPEST:
            raise self._fail(f"elements lie more than {DEEPEST} deep in one another", "ungroup them")
        space, _, name = tag.rpartition(" ")
        inside = not self._open or self._open[-1] is not None
        if not inside or space not in ("", SVG):
            self._open.append(None)
            return
        if name in EXECUTABLE:
            self._remarks.add(line, f"<{name}> is left out: nothing in a drawing is executed")
            self._open.append(None)
            return
        element = Element(name, self._attributes(name, line, given), line)
        if self.root is None:
            self.root = element
        elif (around := self._open[-1]) is not None:
            around.children.append(element)
        self._open.append(element)

    def _attributes(self, name: str, line: int, given: dict[str, str]) -> dict[str, str]:
        kept = {}
        for key, value in given.items():
            space, _, attribute = key.rpartition(" ")
            if not space and attribute.lower().startswith("on"):
                self._remarks.add(line, f"{attribute}=… of <{name}> is left out: nothing in a drawing is executed")
            elif not space or (space, attribute) == (INKSCAPE, "label"):
                kept[attribute] = value
            elif (space, attribute) == (XLINK, "href"):
                kept.setdefault("href", value)
        return kept

    def _end(self, tag: str) -> None:
        self._open.pop()

    def _text(self, text: str) -> None:
        if self._open and self._open[-1] is not None:
            self._open[-1].texts.append(text)
