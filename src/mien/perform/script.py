"""A script: who says what, as a table ``speaker,line`` in CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from mien.core import LoadError, MienError

from .marks import Expression
from .marks_reader import parse_marks

REQUIRED = ("speaker", "line")
OPTIONAL = ("face", "voice", "emotion")


@dataclass(frozen=True)
class Line:
    """One turn of a speaker.

    Attributes:
        speaker: who.
        text: what is said, with its marks.
        row: line of the file where it begins.
        emotion: an expression from its beginning on, as in a mark; empty for the one of before.
    """

    speaker: str
    text: str
    row: int
    emotion: str = ""

    @property
    def script(self) -> str:
        """The text with a mark for the emotion."""
        return f"[{self.emotion}] {self.text}" if self.emotion else self.text


@dataclass(frozen=True)
class Script:
    """Lines in order, and what is said of the speakers.

    Attributes:
        path: of the file, for messages.
        lines: one after the other.
        faces: addresses of the faces of those speakers that have one of their own.
        voices: names of their voices, likewise.
    """

    path: Path
    lines: tuple[Line, ...]
    faces: Mapping[str, str]
    voices: Mapping[str, str]

    @property
    def speakers(self) -> tuple[str, ...]:
        """Names in the order in which they first speak."""
        return tuple(dict.fromkeys(line.speaker for line in self.lines))

    def mistake(self, row: int, column: str, error: MienError) -> LoadError:
        """The error, with the place that it has in the file."""
        return LoadError(self.path, f"column {column!r}: {error}", line=row)


def read_script(path: Path | str) -> Script:
    """The script in a CSV file: columns ``speaker`` and ``line``; ``face``, ``voice`` and ``emotion`` if you like.

    The first row names the columns. Rows without anything in them, and those that begin with ``#``, are left out. A
    face or voice is said once for each speaker; an emotion (``smile`` or ``smile=0.6``) stays until the next.

    Raises:
        LoadError: the file cannot be read, or what is wrong with it, in which line and column.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise LoadError(path, f"is not UTF-8 text (byte {error.start})", hint="save it as CSV in UTF-8") from None
    except OSError as error:
        raise LoadError(path, f"cannot be read ({error.strerror})", hint="want a table speaker,line") from None
    rows = _rows(path, text)
    first, names = next(rows, (1, []))
    columns = _check_columns(path, first, names)
    lines: list[Line] = []
    faces: dict[str, str] = {}
    voices: dict[str, str] = {}
    script = Script(path, (), faces, voices)
    for row, cells in rows:
        if len(cells) != len(columns):
            raise LoadError(
                path,
                f"want {len(columns)} columns ({', '.join(columns)}), got {len(cells)}",
                line=row,
                hint="a line with commas is written in double quotes",
            )
        values = dict(zip(columns, cells, strict=True))
        for column in REQUIRED:
            if not values[column]:
                raise LoadError(path, f"column {column!r} is empty", line=row)
        speaker = values["speaker"]
        _note(script, faces, row, "face", speaker, values.get("face", ""))
        _note(script, voices, row, "voice", speaker, values.get("voice", ""))
        emotion = values.get("emotion", "")
        _check_emotion(script, row, emotion)
        try:
            parse_marks(values["line"])
        except MienError as error:
            raise script.mistake(row, "line", error) from None
        lines.append(Line(speaker, values["line"], row, emotion))
    if not lines:
        raise LoadError(path, "nobody says anything in it", hint="want rows such as anna,Hello there.")
    return Script(path, tuple(lines), faces, voices)


def _rows(path: Path, text: str) -> Iterator[tuple[int, list[str]]]:
    """Line where each row begins, and its cells; empty rows and comments are left out."""
    reader = csv.reader(io.StringIO(text, newline=""), strict=True, skipinitialspace=True)
    row = 1
    while True:
        try:
            cells = [cell.strip() for cell in next(reader)]
        except StopIteration:
            return
        except csv.Error as error:
            raise LoadError(path, f"is not CSV: {error}", line=row, hint='want "" for a quote within quotes') from None
        if any(cells) and not cells[0].startswith("#"):
            yield row, cells
        row = reader.line_num + 1


def _check_columns(path: Path, row: int, names: list[str]) -> list[str]:
    for number, name in enumerate(names, start=1):
        if name not in (*REQUIRED, *OPTIONAL):
            raise LoadError(
                path,
                f"column {number}: there is no column {name!r}",
                line=row,
                hint=f"the first row names them: {', '.join(REQUIRED)}, and {', '.join(OPTIONAL)} if you like",
            )
        if name in names[: number - 1]:
            raise LoadError(path, f"column {number}: there are two columns {name!r}", line=row)
    missing = [name for name in REQUIRED if name not in names]
    if missing:
        raise LoadError(path, f"there is no column {missing[0]!r}", line=row, hint="want a first row speaker,line")
    return names


def _note(script: Script, known: dict[str, str], row: int, column: str, speaker: str, value: str) -> None:
    if value and known.setdefault(speaker, value) != value:
        raise script.mistake(
            row, column, MienError(f"{speaker} has the {column} {known[speaker]!r} already, here {value!r}")
        )


def _check_emotion(script: Script, row: int, text: str) -> None:
    if not text:
        return
    try:
        acts = [mark.act for mark in parse_marks(f"[{text}]").marks]
    except MienError as error:
        raise script.mistake(row, "emotion", error) from None
    if len(acts) != 1 or not isinstance(acts[0], Expression):
        raise script.mistake(row, "emotion", MienError(f"{text!r} is no expression — want for example smile=0.6"))
