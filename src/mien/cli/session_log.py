"""The log of a live face in a file: whole lines, as far as the disk goes; a face does not stop because of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import FileIO
from pathlib import Path

from mien.core import MienError


class SessionLog:
    """Lines on their way into a file; made by ``session_log``.

    Args:
        file: where they go.
        tell: hears it if they cannot.
    """

    def __init__(self, file: FileIO, tell: Callable[[str], object]) -> None:
        self._file, self._tell = file, tell
        self._waiting: list[str] = []
        self._size = 0
        self._full = False

    @property
    def empty(self) -> bool:
        """Whether nothing has come into the file."""
        return not self._size

    def write(self, line: str) -> None:
        """Keep a line until the end of the loop."""
        self._waiting.append(line)

    def flush(self) -> None:
        """Write what waits: all of it once a loop, so that little is lost of a session that is killed."""
        data = "".join(f"{line}\n" for line in self._waiting).encode()
        self._waiting.clear()
        if self._full or not data:
            return
        try:
            left = memoryview(data)
            while left:
                left = left[self._file.write(left) :]
            self._size += len(data)
        except OSError as error:
            self._full = True
            # Half a line would be no log.
            self._file.truncate(self._size)
            self._tell(f"mien: {self._file.name}: the log ends here ({error.strerror}); the face goes on")


@contextmanager
def session_log(path: Path, tell: Callable[[str], object]) -> Iterator[SessionLog]:
    """A log in a new file, which is gone again if nothing comes of the session.

    Raises:
        MienError: the file is there already, or cannot be made.
    """
    try:
        file = FileIO(path, "x")
    except FileExistsError:
        raise MienError(f"{path}: is there already — a log of a session is not replaced; give another name") from None
    except OSError as error:
        raise MienError(f"{path}: cannot be written ({error.strerror})") from None
    log = SessionLog(file, tell)
    with file:
        try:
            yield log
        finally:
            if log.empty:
                path.unlink(missing_ok=True)
            else:
                log.flush()
