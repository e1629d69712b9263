"""Sound of any file that holds some: WAV, MP3, OGG, FLAC, M4A, films; read a block at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import LoadError, Sound, SoundStore

LOW_HZ, HIGH_HZ = 8000, 48000
"""Samples a second: fewer are no speech that can be understood, more are made fewer, because nobody hears them."""

CUT_OFF_S, CUT_OFF_SHARE = 0.3, 0.02
"""Missing at the end, seconds and share of the length that a file says it has, from which on it counts as cut off."""

HEAD_BYTES = 1 << 16
"""Where the number of frames of an MP3 file stands, if anywhere."""

UNKNOWN_LENGTH = 0xFFFFF000
"""What a WAV header holds, or a little less than it, when the sound was written to a pipe."""

Report = Callable[[int, int], None]


def read_sound(path: Path | str, *, folder: Path | str | None = None, report: Report | None = None) -> Sound:
    """The sound in a file, all channels as one; long sound is a memory map of a temporary file.

    Args:
        path: a sound file or a film.
        folder: where long sound is kept until it is no longer used; the system's temporary folder by default.
        report: told (seconds read, seconds in all).

    Raises:
        LoadError: the file is absent, empty, cut off or damaged, holds no sound, or samples that are no numbers.
    """
    import av

    path = Path(path)
    try:
        if not path.stat().st_size:
            raise LoadError(path, "is empty: 0 bytes", hint="was it copied to the end?")
        container = av.open(str(path))
    except OSError as error:  # PyAV's own errors of damaged files are ValueErrors
        raise LoadError(path, f"cannot be read ({error.strerror})") from None
    except av.error.FFmpegError:
        raise LoadError(
            path, "is no sound that can be read, or is cut off", hint="want WAV, MP3, OGG, FLAC, M4A or a film"
        ) from None
    with container:
        stream: Any = container.streams.best("audio")
        if stream is None:
            raise LoadError(path, "holds no sound", hint="is it the right file?")
        rate_hz = stream.codec_context.sample_rate
        if rate_hz < LOW_HZ:
            raise LoadError(path, f"want {LOW_HZ} samples a second or more, got {rate_hz}")
        length_s = _declared_length_s(path, container, stream)
        store = SoundStore(min(rate_hz, HIGH_HZ), folder)
        try:
            for samples in _decode(path, container, stream, min(rate_hz, HIGH_HZ)):
                store.write(samples)
                if report is not None:
                    report(int(store.length_s), max(int(length_s), int(store.length_s)))
            missing_s = length_s - store.length_s
            if missing_s > max(CUT_OFF_S, CUT_OFF_SHARE * length_s):
                raise LoadError(
                    path,
                    f"ends after {store.length_s:.2f} s and says it lasts {length_s:.2f} s",
                    hint="it is cut off or damaged; copy it again",
                )
            if not store.length_s:
                raise LoadError(path, "holds no sound: it lasts 0 s", hint="is it cut off?")
            return store.sound()
        finally:
            store.close()


def _declared_length_s(path: Path, container: Any, stream: Any) -> float:
    """How long the file says that its sound is; 0 where it only lets one guess.

    A file of MPEG frames states their number in the first of them, or not at all. The length of a WAV file as FFmpeg
    tells it follows from the size of the file, so its header is asked.
    """
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
    if container.format.name in {"mp3", "aac"} and b"Xing" not in head and b"Info" not in head:
        return 0.0
    if container.format.name == "wav":
        return _wav_length_s(head)
    if stream.duration:
        return float(stream.duration * stream.time_base)
    return container.duration / 1e6 if container.duration else 0.0


def _wav_length_s(head: bytes) -> float:
    """The length in the header of a WAV file, seconds; 0 where its writer did not know it yet."""
    place, bytes_per_s = 12, 0
    while place + 8 <= len(head):
        name, length = head[place : place + 4], int.from_bytes(head[place + 4 : place + 8], "little")
        if name == b"fmt ":
            bytes_per_s = int.from_bytes(head[place + 16 : place + 20], "little")
        if name == b"data":
            return length / bytes_per_s if bytes_per_s and length < UNKNOWN_LENGTH else 0.0
        place += 8 + length + (length & 1)
    return 0.0


def _decode(path: Path, container: Any, stream: Any, rate_hz: int) -> Iterator[NDArray[np.int16]]:
    """Mono samples in order; silence first where the sound of a film begins after its picture."""
    import av

    resampler = av.AudioResampler(format="s16", layout="mono", rate=rate_hz)
    begin_s = (container.start_time or 0) / av.time_base
    first = True
    for packet in container.demux(stream):
        try:
            frames = packet.decode()
        except av.error.InvalidDataError:
            continue  # what is missing in the end is told then
        for frame in frames:
            if frame.format.name.startswith(("flt", "dbl")) and not np.isfinite(frame.to_ndarray()).all():
                raise LoadError(
                    path,
                    f"has samples that are no numbers (NaN or infinite) at {frame.time or 0.0:.2f} s",
                    hint="write the sound again",
                )
            if first:
                yield np.zeros(max(0, round(((frame.time or begin_s) - begin_s) * rate_hz)), np.int16)
                first = False
            yield from _to_samples(resampler.resample(frame))
    if not first:
        yield from _to_samples(resampler.resample(None))


def _to_samples(frames: list[Any]) -> Iterator[NDArray[np.int16]]:
    for frame in frames:
        yield frame.to_ndarray()[0]
