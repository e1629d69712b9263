"""Outputs that appear only when they are complete: written beside their place under a hidden name, then renamed."""

from __future__ import annotations

import errno
import itertools
import os
import re
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from shlex import quote

from mien.core import MienError

_numbers = itertools.count(1)

_NO_ROOM = (errno.ENOSPC, errno.EFBIG, errno.EDQUOT)


def is_full_disk(error: OSError) -> bool:
    """Whether the disk, a quota or a limit on file sizes is used up."""
    return error.errno in _NO_ROOM


def full_disk_error(place: Path | str) -> MienError:
    """What to say when there is no room left."""
    return MienError(
        f"{place}: the disk is full, or a limit on file sizes is reached — free some space or write elsewhere; "
        "what was there before is untouched"
    )


@contextmanager
def writing(path: Path | str) -> Iterator[Path]:
    """A hidden path beside ``path`` to write to, with the same suffix; it takes the place of ``path`` at the end.

    Whatever goes wrong inside, an interruption included, removes it and leaves an existing file as it was.

    Raises:
        MienError: the folder or the file cannot be written, or the disk is full.
    """
    target = _file_place(Path(path))
    temporary = _hidden(target.parent, target.suffix)
    try:
        _touch(temporary, target)
        yield temporary
        _flush(temporary)
        os.replace(temporary, target)
    except OSError as error:
        if is_full_disk(error):
            raise full_disk_error(path) from error
        raise
    finally:
        temporary.unlink(missing_ok=True)


@contextmanager
def writing_folder(path: Path | str, ours: Iterable[str]) -> Iterator[Path]:
    """A hidden folder beside ``path`` to fill; it takes the place of ``path`` at the end.

    Args:
        path: the folder to make; one that exists is replaced if it holds nothing but ``ours``.
        ours: patterns of names (``frame_*.png``) that a folder of this kind consists of.

    Raises:
        MienError: the folder cannot be made, holds other files, or the disk is full.
    """
    target = _folder_place(Path(path), tuple(ours))
    temporary = _hidden(target.parent, "")
    old = _hidden(target.parent, "")
    try:
        _make_folder(temporary, target)
        yield temporary
        if target.exists():
            target.rename(old)
        try:
            temporary.rename(target)
        except OSError:
            if old.exists():
                old.rename(target)
            raise
    except OSError as error:
        if is_full_disk(error):
            raise full_disk_error(path) from error
        raise
    finally:
        if old.exists() and not target.exists():
            old.rename(target)
        shutil.rmtree(temporary, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)


@contextmanager
def writing_series(pattern: Path, names: re.Pattern[str]) -> Iterator[Path]:
    """A hidden folder beside the files of a series; they move to their places at the end, instead of an older series.

    Args:
        pattern: what the files are called, such as ``out/frame_%04d.png``; the folder must exist.
        names: what all names of the series match; files of an older, longer series are removed.
    """
    check_folder(pattern)
    folder = pattern.parent
    temporary = _hidden(folder, "")
    try:
        _make_folder(temporary, pattern)
        yield temporary
        new = sorted(item.name for item in temporary.iterdir())
        for name in new:
            os.replace(temporary / name, folder / name)
        for stale in {item.name for item in folder.iterdir() if names.fullmatch(item.name)} - set(new):
            (folder / stale).unlink()
    except OSError as error:
        if is_full_disk(error):
            raise full_disk_error(pattern) from error
        raise
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def check_file(path: Path | str) -> None:
    """Makes sure that a file could be written there, by making and removing a hidden one beside it.

    Raises:
        MienError: it could not, and why.
    """
    target = _file_place(Path(path))
    temporary = _hidden(target.parent, target.suffix)
    try:
        _touch(temporary, target)
    finally:
        temporary.unlink(missing_ok=True)


def check_new_folder(path: Path | str, ours: Iterable[str]) -> None:
    """Makes sure that a folder of this kind could be made or replaced there.

    Raises:
        MienError: it could not, and why.
    """
    target = _folder_place(Path(path), tuple(ours))
    temporary = _hidden(target.parent, "")
    try:
        _make_folder(temporary, target)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def check_folder(path: Path) -> None:
    """Makes sure that the folder of ``path`` is there.

    Raises:
        MienError: it does not exist or is not a folder.
    """
    folder = path.parent
    try:
        if folder.is_dir():
            return
        there = next(part for part in (folder, *folder.parents) if part.exists())
    except OSError as error:
        raise _refused(path, error) from error
    if there.is_dir():
        raise MienError(
            f"{path}: the folder {str(folder)!r} does not exist — make it first: mkdir -p {quote(str(folder))}"
        )
    raise MienError(f"{path}: {str(there)!r} is a file, not a folder — write somewhere else")


def _file_place(path: Path) -> Path:
    """Where the bytes will lie: links followed, and nothing but a plain file in the way."""
    check_folder(path)
    try:
        target = path.resolve() if path.is_symlink() else path
        there = target.exists()
    except OSError as error:
        raise _refused(path, error) from error
    if target.is_dir():
        raise MienError(f"{path}: there is a folder of that name — give a file name inside it or another one")
    if there and not target.is_file():
        raise MienError(f"{path}: is not a plain file — give the name of a file to make or replace")
    if target is not path:
        check_folder(target)
    return target


def _folder_place(path: Path, ours: tuple[str, ...]) -> Path:
    path = path.resolve() if path.is_symlink() or path.name in ("", "..") else path
    check_folder(path)
    if path.exists() and not path.is_dir():
        raise MienError(f"{path}: there is a file of that name — give another folder")
    if path.is_dir():
        others = sorted(item.name for item in path.iterdir() if not any(item.match(pattern) for pattern in ours))
        if others:
            raise MienError(
                f"{path}: the folder holds other things ({', '.join(others[:3])}{' …' if len(others) > 3 else ''}) "
                f"and would be replaced as a whole — name a new folder, such as {path / 'frames'}"
            )
        if path.resolve() == Path.cwd():
            raise MienError(
                f"{path}: would take the place of the folder that you are in — name a new one, as in frames"
            )
    return path


def _hidden(folder: Path, suffix: str) -> Path:
    # A process that was killed may have left such a name, and its number may have come round again.
    names = (folder / f".mien-{os.getpid()}-{number}.part{suffix}" for number in _numbers)
    return next(name for name in names if not os.path.lexists(name))


def _touch(temporary: Path, target: Path) -> None:
    try:
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    except OSError as error:
        raise _refused(target, error) from error


def _make_folder(temporary: Path, target: Path) -> None:
    try:
        temporary.mkdir()
    except OSError as error:
        raise _refused(target, error) from error


def _refused(target: Path, error: OSError) -> MienError:
    if is_full_disk(error):
        return full_disk_error(target)
    if error.errno in (errno.ENAMETOOLONG, errno.EINVAL):
        return MienError(f"{target}: the system takes no such name ({error.strerror}) — give a shorter one")
    return MienError(
        f"{target}: the folder {str(target.parent)!r} cannot be written to ({error.strerror}) — write somewhere else"
    )


def _flush(path: Path) -> None:
    """On the disk before it takes its name, so that not even a power cut leaves half a file under it."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
