"""The one place where a command line begins and where every failure becomes a few lines and an exit status.

0 done, 2 the user's mistake, 130 interrupted, 1 a fault of ours.
"""

from __future__ import annotations

import errno
import os
import signal
import sys
import threading
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import FrameType

from .streams import open_closed_streams, tell

DONE, FAULT, MISTAKE, INTERRUPTED = 0, 1, 2, 130

SIGNALS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""Ctrl-C, a polite request, the terminal's end (which Windows does not tell)."""


class Interrupted(BaseException):
    """Ctrl-C or a polite request to stop. No KeyboardInterrupt, because libraries have their own ideas about that."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command line; the exit status."""
    from .app import app

    open_closed_streams()
    try:
        with _interruptible():
            app(list(sys.argv[1:] if arguments is None else arguments), prog_name="mien")
        return DONE
    except SystemExit as end:  # how the parser says that it is done, or that it did not understand
        had_enough = isinstance(end.__context__, BrokenPipeError)  # as in mien --help | head -1
        return end.code if isinstance(end.code, int) and not had_enough else DONE
    except (Interrupted, KeyboardInterrupt):
        tell("mien: interrupted; nothing half-finished is left")
        return INTERRUPTED
    except Exception as error:  # noqa: BLE001  the last resort of the program
        return _explain(error)


@contextmanager
def _interruptible() -> Iterator[None]:
    """While inside, the first signal to stop raises; further ones do not disturb the tidying up."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(number: int, frame: FrameType | None) -> None:
        for each in SIGNALS:
            signal.signal(each, signal.SIG_IGN)
        raise Interrupted

    ours = signals()
    before = [signal.signal(each, stop) for each in ours]
    try:
        yield
    finally:
        for each, handler in zip(ours, before, strict=True):
            signal.signal(each, handler)


def signals() -> list[int]:
    """The signals that end a command; under nohup the terminal's end is none of our business."""
    return [each for each in SIGNALS if each == signal.SIGINT or signal.getsignal(each) != signal.SIG_IGN]


def _explain(error: Exception) -> int:
    from mien.core import MienError
    from mien.formats.atomic import full_disk_error, is_full_disk

    if os.environ.get("MIEN_DEBUG") == "1":
        traceback.print_exception(error)
    if isinstance(error, OSError) and is_full_disk(error):
        error = full_disk_error(error.filename or "temporary files")
    if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
        error = MienError(f"{error.filename}: the system takes no such name ({error.strerror}) — give a shorter one")
    if isinstance(error, MemoryError):
        error = MienError(
            "there is not enough memory for this — a smaller --size needs less; a picture takes about 12 bytes a "
            "pixel while it is drawn and written, 3 GB at 16384x16384"
        )
    if isinstance(error, MienError):
        tell(f"mien: {error}")
        return MISTAKE
    tell(_report(error))
    return FAULT


def _report(error: Exception) -> str:
    from importlib.metadata import version

    place = traceback.extract_tb(error.__traceback__)[-1:]
    where = f" (line {place[0].lineno} of {os.path.basename(place[0].filename)})" if place else ""
    return (
        f"mien: {type(error).__name__}: {error}{where}\n"
        "This is a fault in mien, not in what you asked for. Please report it on mien's issue tracker, with the\n"
        f"command and these lines; mien {version('mien')}, Python {sys.version.split()[0]}, {sys.platform}. "
        "MIEN_DEBUG=1 shows where it comes from."
    )
