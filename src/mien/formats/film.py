"""Films, written frame by frame in bounded memory; ``codecs`` says what each kind holds."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any, Protocol

import av
import numpy as np
from av.video.frame import VideoFrame
from av.video.reformatter import ColorRange
from numpy.typing import NDArray

from mien.core import MienError, Sound

from .atomic import full_disk_error, is_full_disk, writing
from .codecs import Codec, FilmPlan, find_codec
from .film_apng import ApngFilm
from .film_frames import make_frame, make_frame_in_colors
from .film_notes import append_comment
from .film_sound import SoundStream
from .film_webp import WebpFilm
from .palette import Quantiser
from .pipeline import runs
from .rates import check_film, check_rate

Pixels = NDArray[np.uint8]

ENCODER_THREADS = 4
"""Fixed, because what x264 writes depends on it; on fewer cores they share."""

BT709 = 1
"""The code of ITU-R BT.709 for primaries, transfer and matrix. Source: ITU-T H.273, tables 2 to 4."""

Shown = tuple[Pixels, int, int]
"""A picture, the number of the frame that it begins with, and for how many frames it stays."""


class Film(Protocol):
    """A file that is being written."""

    def show(self, pixels: Pixels, start: int, count: int) -> None:
        """Adds a picture that stays for ``count`` frames from frame ``start`` on."""

    def finish(self) -> None:
        """Writes what is still held back."""


def write_film(
    frames: Iterable[Pixels],
    path: Path | str,
    *,
    fps: float | Fraction,
    size_px: tuple[int, int],
    sound: Sound | None = None,
    notes: Mapping[str, str] | None = None,
    transparent: bool = False,
    variable: bool = False,
) -> None:
    """Writes frames and their sound as a film; the suffix picks the kind.

    The picture of the last frame stays until the sound ends; a sound that ends first is followed by silence, so both
    streams last as long. Kinds without sound leave it out. Where a kind needs even sides, the last row or column is
    shown twice.

    Args:
        frames: each (H, W, 4) uint8 sRGB, straight alpha; taken one at a time.
        path: where to; the folder exists.
        fps: frames a second, 1..240.
        size_px: (width, height) of every frame.
        sound: none makes a film without a sound stream.
        notes: keywords and texts.
        transparent: whether there are pixels that are not opaque.
        variable: whether equal frames in a row are written as one that stays for longer.

    Raises:
        RangeError: the rate or the size does not suit.
        MienError: there is no frame, the encoder fails, or the place cannot be written.
    """
    check_film(path, fps, size_px, transparent=transparent)
    plan, notes = FilmPlan(find_codec(path), check_rate(fps), size_px, transparent), notes or {}
    voice = sound if plan.codec.sound else None
    held = _held(_checked(frames, size_px), plan.rate, voice)
    shown = _numbered(runs(held) if variable or plan.codec.spaced else ((pixels, 1) for pixels in held))
    with writing(path) as temporary:
        with _encoder_errors(path, plan.codec), _open(temporary, plan, voice, notes) as film:
            count = 0
            for pixels, start, count in shown:
                film.show(pixels, start, count)
            if not count:
                raise MienError(f"{path}: a film needs one frame at least, got none")
            film.finish()
        if notes and plan.codec.container == "gif":
            append_comment(temporary, notes)


def _checked(frames: Iterable[Pixels], size_px: tuple[int, int]) -> Iterator[Pixels]:
    for number, pixels in enumerate(frames):
        if pixels.shape != (size_px[1], size_px[0], 4) or pixels.dtype != np.uint8:
            raise MienError(
                f"frame {number}: want {size_px[0]}x{size_px[1]} pixels RGBA of 8 bits, "
                f"got an array {pixels.shape} of {pixels.dtype}"
            )
        yield pixels


def _held(frames: Iterable[Pixels], rate: Fraction, sound: Sound | None) -> Iterator[Pixels]:
    """The frames, then the last one again until the sound is over."""
    count, pixels = 0, None
    for pixels in frames:
        count += 1
        yield pixels
    if sound is not None and pixels is not None:
        wanted = math.ceil(Fraction(len(sound.samples), sound.rate_hz) * rate)
        for _ in range(count, wanted):
            yield pixels


def _numbered(stays: Iterable[tuple[Pixels, int]]) -> Iterator[Shown]:
    start = 0
    for pixels, count in stays:
        yield pixels, start, count
        start += count


@contextmanager
def _encoder_errors(path: Path | str, codec: Codec) -> Iterator[None]:
    """FFmpeg's errors in words."""
    try:
        yield
    except av.FFmpegError as error:
        if isinstance(error, OSError) and is_full_disk(error):
            raise full_disk_error(path) from error
        raise MienError(
            f"{path}: the encoder {codec.picture} gave up ({error.strerror}) — try another size or another format"
        ) from error


@contextmanager
def _open(path: Path, plan: FilmPlan, sound: Sound | None, notes: Mapping[str, str]) -> Iterator[Film]:
    kind = plan.codec.container
    if kind in _OWN:
        with path.open("r+b") as file:
            yield _OWN[kind](file, plan, notes)
        return
    options = {**plan.codec.container_options, "fflags": "+bitexact"}
    with av.open(str(path), "w", format=kind, options=options) as container:
        container.metadata.update({key.lower(): value for key, value in notes.items()})
        yield _ContainerFilm(container, plan, sound)


_OWN: dict[str, type[ApngFilm] | type[WebpFilm]] = {"apng": ApngFilm, "webp": WebpFilm}
"""Containers that are not left to FFmpeg."""


class _ContainerFilm:
    """A film in one of FFmpeg's containers."""

    def __init__(self, container: Any, plan: FilmPlan, sound: Sound | None) -> None:
        self._container, self._plan = container, plan
        self._quantiser = Quantiser(plan.transparent) if plan.layout == "pal8" else None
        self._tick = 1 / Fraction(plan.codec.ticks_per_s or plan.rate)
        self._stream = _add_pictures(container, plan)
        self._voice = SoundStream(container, sound, plan.codec) if sound is not None else None
        self._last: tuple[Pixels, VideoFrame] | None = None

    def show(self, pixels: Pixels, start: int, count: int) -> None:
        frame = self._make(pixels)
        frame.pts, frame.time_base = self._plan.ticks(start), self._tick
        frame.duration = self._plan.ticks(start + count) - frame.pts
        self._container.mux(self._stream.encode(frame))
        if self._voice:
            self._voice.play_until((start + count) / self._plan.rate)

    def finish(self) -> None:
        self._container.mux(self._stream.encode(None))
        if self._voice:
            self._voice.finish()

    def _make(self, pixels: Pixels) -> VideoFrame:
        """The frame of a picture; that of the one before again, if that is what is shown."""
        if self._last is None or self._last[0] is not pixels:
            if self._quantiser:
                frame = make_frame_in_colors(pixels, self._quantiser)
            else:
                frame = make_frame(pixels, self._plan.layout)
            self._last = pixels, frame
        return self._last[1]


def _add_pictures(container: Any, plan: FilmPlan) -> Any:
    options = {**plan.options, "flags": "+bitexact+frame_duration"}
    stream = container.add_stream(plan.codec.picture, rate=plan.rate, options=options)
    stream.width, stream.height = ((side + side % 2 if plan.codec.even else side) for side in plan.size_px)
    stream.pix_fmt = plan.layout
    context = stream.codec_context
    context.thread_count = ENCODER_THREADS
    if stream.pix_fmt.startswith("yuv"):
        context.color_range = ColorRange.MPEG
        context.color_primaries = context.color_trc = context.colorspace = BT709
    return stream
