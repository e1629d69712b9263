"""Small films for tests, and how to read any of them back."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
from PIL import Image

from mien.core import Sound

SIZE = (64, 48)

PLAYED = (".mp4", ".webm", ".mov")
"""With sound, read by FFmpeg."""

REPEATED = (".gif", ".apng", ".webp")
"""Without, read by Pillow."""

KINDS = (*PLAYED, *REPEATED)

CLEAR = (".webm", ".mov", *REPEATED)


def frames(count: int, size: tuple[int, int] = SIZE) -> Iterator[np.ndarray]:
    """Magenta that grows lighter, twelve frames in a row."""
    for number in range(count):
        pixels = np.full((size[1], size[0], 4), 255, dtype=np.uint8)
        pixels[:, :, 1] = 20 * (number % 12)
        yield pixels


def tone(length_s: float, rate_hz: int = 24000) -> Sound:
    t = np.arange(round(length_s * rate_hz)) / rate_hz
    return Sound(np.rint(8000 * np.sin(2 * np.pi * 440 * t)).astype(np.int16), rate_hz)


def pictures(path: Path) -> list[np.ndarray]:
    """Every picture, (H, W, 4)."""
    return [pixels for pixels, _, _ in shown(path)]


def shown(path: Path) -> list[tuple[np.ndarray, float, float]]:
    """Every picture with the time that it begins at and how long it stays, in seconds."""
    return _read_repeated(path) if path.suffix in REPEATED else list(_read_played(path))


def samples(path: Path) -> np.ndarray:
    """The sound, -1..1, from the moment when the film begins."""
    with av.open(str(path)) as film:
        blocks = [frame.to_ndarray()[0] for frame in film.decode(audio=0)] if film.streams.audio else []
    if not blocks:
        return np.zeros(0)
    joined = np.concatenate(blocks)
    return joined / 32768 if joined.dtype == np.int16 else joined


def lengths_s(path: Path) -> list[float]:
    """How long each stream is, pictures first."""
    with av.open(str(path)) as film:
        if path.suffix != ".webm":
            return [float(stream.duration * stream.time_base) for stream in film.streams]
        # WebM knows the length of the whole, with what is put before the first sample; its writer notes the others.
        hours, minutes, seconds = film.streams.video[0].metadata["DURATION"].split(":")
        picture_s = 3600 * int(hours) + 60 * int(minutes) + float(seconds)
        both = len(film.streams) == 2
    return [picture_s, len(samples(path)) / 48000] if both else [picture_s]


def _read_repeated(path: Path) -> list[tuple[np.ndarray, float, float]]:
    found, time_s = [], 0.0
    with Image.open(path) as image:
        for number in range(image.n_frames):
            image.seek(number)
            image.load()
            stays_s = image.info["duration"] / 1000
            found.append((np.asarray(image.convert("RGBA")), time_s, stays_s))
            time_s += stays_s
    return found


def _read_played(path: Path) -> Iterator[tuple[np.ndarray, float, float]]:
    with av.open(str(path)) as film:
        stream = film.streams.video[0]
        # FFmpeg's own decoder of VP9 knows no alpha.
        decoder = av.CodecContext.create("libvpx-vp9", "r") if path.suffix == ".webm" else stream
        for packet in film.demux(stream):
            for frame in decoder.decode(packet):
                base = Fraction(frame.time_base or packet.time_base)
                yield to_rgba(frame), float(frame.pts * base), float((frame.duration or 0) * base)


def to_rgba(frame: av.VideoFrame) -> np.ndarray:
    """(H, W, 4) of luma and chroma in BT.709, narrow range; chroma is repeated, not blended, where it has fewer pixels.

    FFmpeg's own conversion to RGB is 1 code too dark, and wrong in the last columns of small pictures.
    """
    bits = max(component.bits for component in frame.format.components)
    scale, repeat = 1 << (bits - 8), 2 if "420" in frame.format.name else 1
    planes = [_plane(plane, bits) / scale for plane in frame.planes]
    blue, red = (np.repeat(np.repeat(plane - 128, repeat, 0), repeat, 1) * (255 / 224) for plane in planes[1:3])
    luma = (planes[0] - 16) * (255 / 219)
    color = [
        luma + 1.5748 * red,
        luma - (0.0722 * 1.8556 * blue + 0.2126 * 1.5748 * red) / 0.7152,
        luma + 1.8556 * blue,
    ]
    alpha = planes[3] * scale * 255 / ((1 << bits) - 1) if len(planes) == 4 else np.full_like(luma, 255)
    return np.clip(np.rint(np.stack([*color, alpha], axis=2)), 0, 255).astype(np.uint8)


def _plane(plane: av.video.plane.VideoPlane, bits: int) -> np.ndarray:
    codes = np.frombuffer(memoryview(plane), np.uint8 if bits == 8 else np.uint16).reshape(plane.height, -1)
    return codes[:, : plane.width].astype(np.float64)
