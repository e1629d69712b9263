"""Work that runs ahead: frames are drawn on one thread while the one before is encoded on another; and runs of frames.

Source: Parke 1972, "Implementation": two machines with two buffers between them, the next frame begun while the last
is scanned out.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Generator, Iterable, Iterator
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Item = TypeVar("Item")

DEPTH = 3
"""Items that wait at most: enough that neither side idles, few enough that memory does not grow with the film."""

AHEAD_BYTES = 1 << 28
"""Of pixels that wait at most, where more than one picture of them is too much."""

LOOK_S = 0.1
"""How often a waiting worker looks whether anybody still wants its items."""


def run_ahead(items: Iterator[Item], depth: int = DEPTH) -> Generator[Item, None, None]:
    """The same items in the same order, made on a thread of their own, at most ``depth`` before they are asked for.

    What making an item raises is raised here, in its place. Close the iterator (``contextlib.closing``) to stop the
    thread before the end; it is gone when this returns.
    """
    ready: queue.Queue[tuple[Item | None, BaseException | None, bool]] = queue.Queue(depth)
    unwanted = threading.Event()

    def put(item: Item | None, error: BaseException | None = None, last: bool = False) -> None:
        while not unwanted.is_set():
            try:
                ready.put((item, error, last), timeout=LOOK_S)
            except queue.Full:
                continue
            return

    def work() -> None:
        try:
            for item in items:
                put(item)
                if unwanted.is_set():
                    break
            put(None, last=True)
        except BaseException as error:  # noqa: BLE001 - handed over, not swallowed
            put(None, error)
        finally:
            close = getattr(items, "close", None)
            if close is not None:
                close()

    worker = threading.Thread(target=work, name="mien-frames", daemon=True)
    worker.start()
    try:
        while True:
            item, error, last = ready.get()
            if error is not None:
                raise error
            if last:
                return
            yield item  # type: ignore[misc]
    finally:
        unwanted.set()
        worker.join()


def at_once(size_px: tuple[int, int], most: int = DEPTH) -> int:
    """How many pictures of a size may wait: ``most``, fewer where they are huge, and one at least."""
    return max(1, min(most, AHEAD_BYTES // (4 * size_px[0] * size_px[1])))


def runs(frames: Iterable[NDArray[np.uint8]]) -> Generator[tuple[NDArray[np.uint8], int], None, None]:
    """Each frame that differs from the one before, with the number of frame times that it stays; none is left out."""
    shown: NDArray[np.uint8] | None = None
    count = 0
    for pixels in frames:
        if shown is not None and (pixels is shown or np.array_equal(pixels, shown)):
            count += 1
            continue
        if shown is not None:
            yield shown, count
        shown, count = pixels, 1
    if shown is not None:
        yield shown, count
