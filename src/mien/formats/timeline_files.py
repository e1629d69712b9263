"""Timelines in files: ``.json`` with its sound beside it, ``.csv``, and Parke's specification list, ``.spec``."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from mien.core import Face, LoadError, MienError, Scene, Sound
from mien.timeline import Rate, Timeline
from mien.timeline.csv_form import format_csv, parse_csv
from mien.timeline.json_form import from_json, json_text
from mien.timeline.json_reader import parse_json
from mien.timeline.specification import FILM_FPS, parse_specifications
from mien.vocab.motor_tracks import play_motors, table_with_motors

from .atomic import writing
from .scenes import scene_from_data, scene_to_data
from .table import find_format
from .wav import read_wav, write_wav

DEFAULT_FACE = "head"


@dataclass(frozen=True, eq=False)
class StoredPerformance:
    """What a file tells to play.

    Attributes:
        timeline: what moves.
        face: the one it was made for, or the one asked for.
        sound: if the file names one.
        scene: if the file describes one.
        same_table: whether the face's table is the one it was made with; then frames are the same, bit for bit.
    """

    timeline: Timeline
    face: Face
    sound: Sound | None = None
    scene: Scene | None = None
    same_table: bool = True


def read_timeline(
    path: Path | str, load_face: Callable[[str], Face], address: str | None = None, *, fps: Rate | None = None
) -> StoredPerformance:
    """The timeline in a file, checked against the face that is to play it.

    Args:
        path: ``.json``, ``.csv`` or ``.spec``.
        load_face: gives the face of an address.
        address: the face to play it; None is the file's own, or the head.
        fps: what a column ``frame`` of a CSV file counts in.

    Raises:
        LoadError: the file cannot be read or understood, or does not fit the face; names the line where it can.
        UnknownNameError: the suffix is of no timeline.
    """
    path = Path(path)
    kind = find_format(path, "timeline").name
    text = _read_text(path)
    if kind == "json":
        return _read_json(path, text, load_face, address)
    face = load_face(address or DEFAULT_FACE)
    table = table_with_motors(face)
    if kind == "csv":
        timeline = parse_csv(text, str(path), fps=fps or FILM_FPS, table=table)
    else:
        timeline = parse_specifications(text, str(path)).to_timeline(table)
    return StoredPerformance(play_motors(timeline, face), face)


def write_json(timeline: Timeline, path: Path | str, *, face: Face, scene: Scene, sound: Sound | None = None) -> None:
    """Writes everything needed to play it again: ``x.json``, and its sound as ``x.wav`` beside it.

    Raises:
        MienError: the place cannot be written; then neither file has changed.
    """
    path = Path(path)
    beside = path.with_suffix(".wav")
    pieces = json_text(
        timeline,
        face.parameters,
        face=face.name,
        sound=beside.name if sound is not None else "",
        scene=scene_to_data(scene),
    )
    with ExitStack() as stack:
        # Both are complete before either takes its place; the JSON, which names the sound, does so last.
        _write_pieces(pieces, stack.enter_context(writing(path)))
        if sound is not None:
            temporary = stack.enter_context(writing(beside))
            write_wav(sound, temporary)


def write_csv(timeline: Timeline, path: Path | str, *, face: Face, fps: Rate) -> None:
    """Writes one row a frame with every parameter that something drives.

    Raises:
        MienError: the place cannot be written.
    """
    with writing(path) as temporary:
        _write_pieces((line + "\n" for line in format_csv(timeline, face.parameters, fps)), temporary)


def _write_pieces(pieces: Iterable[str], path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="\n") as file:
        file.writelines(pieces)


def _read_json(path: Path, text: str, load_face: Callable[[str], Face], address: str | None) -> StoredPerformance:
    stored = from_json(parse_json(text, str(path)).value, str(path))
    try:
        face = load_face(address or stored.face or DEFAULT_FACE)
    except MienError as error:
        if address:
            raise
        raise LoadError(path, f"face: {error}", hint="or choose who plays it: --face head") from None
    try:
        stored.timeline.driven(table_with_motors(face))
        timeline = play_motors(stored.timeline, face)
    except MienError as error:
        raise LoadError(path, f"face {face.name!r}: {error}") from None
    scene = scene_from_data(stored.scene, str(path)) if stored.scene else None
    return StoredPerformance(timeline, face, _sound(path, stored.sound), scene, stored.fits(face.parameters))


def _sound(path: Path, name: str) -> Sound | None:
    if not name:
        return None
    if Path(name).name != name:
        raise LoadError(path, f"sound {name!r}: want the name of a file beside this one, without folders")
    try:
        return read_wav(path.parent / name)
    except LoadError as error:
        raise LoadError(path, f"sound {name!r}: {error}", hint="keep both files side by side") from None


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise LoadError(path, f"is not UTF-8 text (byte {error.start})") from None
    except OSError as error:
        raise LoadError(path, f"cannot be read ({error.strerror})") from error
