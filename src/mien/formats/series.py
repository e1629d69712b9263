"""Numbered PNG frames: a folder of them with the sound, or a pattern such as ``frame_%04d.png``."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError, Sound

from .atomic import check_file, check_new_folder, writing_folder, writing_series
from .picture import Picture
from .pipeline import at_once
from .wav import write_samples

FRAME_PATTERN = "frame_%04d.png"
SOUND_NAME = "sound.wav"
OURS = ("frame_*.png", SOUND_NAME)
"""Names that a folder written here consists of."""

SERIES_LEVEL = 2
"""PNG compression of frames: several times faster than a still picture's, a third more bytes."""

_ENCODERS = 2
_NUMBER = re.compile(r"%(?:0\d)?d")


def check_series(path: Path | str) -> None:
    """Makes sure that frames can be written there.

    Raises:
        MienError: the pattern numbers nothing, or the place cannot be written.
    """
    path = Path(path)
    if str(path) == "-":
        raise MienError("-: nothing is written to standard output — name a file or a folder, such as hello.mp4")
    if path.suffix.lower() != ".png":
        check_new_folder(path, OURS)
        return
    if len(_NUMBER.findall(path.name)) != 1 or path.name.count("%") != 1:
        raise MienError(
            f"{path}: one picture cannot hold many frames — number them, as in {_plain(path.stem)}_%04d.png, name a "
            "folder without a suffix, or write a film: .mp4"
        )
    check_file(path.with_name(path.name % 0))


def write_series(
    frames: Iterable[NDArray[np.uint8]],
    path: Path | str,
    *,
    sound: Sound | None = None,
    notes: Mapping[str, str] | None = None,
) -> None:
    """Writes each frame as a PNG, the first with number 0; a folder gets the sound too, as ``sound.wav``.

    Args:
        frames: each (H, W, 4) uint8 sRGB; taken a few at a time.
        path: a folder to make, or a pattern with one ``%04d`` in an existing folder.
        sound: left out for a pattern.
        notes: keywords and texts for each picture.

    Raises:
        MienError: the place cannot be written.
    """
    path = Path(path)
    check_series(path)
    if path.suffix.lower() == ".png":
        with writing_series(path, _matching(path.name)) as temporary:
            _write_frames(frames, temporary, path.name, notes or {})
        return
    with writing_folder(path, OURS) as temporary:
        _write_frames(frames, temporary, FRAME_PATTERN, notes or {})
        if sound is not None:
            write_samples(sound, temporary / SOUND_NAME)


def _write_frames(frames: Iterable[NDArray[np.uint8]], folder: Path, pattern: str, notes: Mapping[str, str]) -> None:
    def write(pixels: NDArray[np.uint8], name: str) -> None:
        (folder / name).write_bytes(Picture(pixels, notes).to_png(SERIES_LEVEL))

    with ThreadPoolExecutor(_ENCODERS) as pool:
        waiting: deque[Future[None]] = deque()
        for number, pixels in enumerate(frames):
            waiting.append(pool.submit(write, pixels, pattern % number))
            if len(waiting) > at_once((pixels.shape[1], pixels.shape[0]), 2 * _ENCODERS):
                waiting.popleft().result()
        for each in waiting:
            each.result()


def _plain(stem: str) -> str:
    """The stem without what should have been a number, so that a suggestion made of it is one."""
    return re.sub(r"_?%.*", "", stem) or "frame"


def _matching(pattern: str) -> re.Pattern[str]:
    before, after = _NUMBER.split(pattern)[0], _NUMBER.split(pattern)[-1]
    return re.compile(re.escape(before) + r"\d+" + re.escape(after))
