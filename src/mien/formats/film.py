"""MP4: H.264 picture and AAC sound, written frame by frame in bounded memory."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import numpy as np
from av.audio.frame import AudioFrame
from av.video.frame import VideoFrame
from av.video.reformatter import ColorRange, Colorspace
from numpy.typing import NDArray

from mien.core import MienError, Sound

from .atomic import writing
from .rates import check_film, check_rate

Pixels = NDArray[np.uint8]

ENCODER_THREADS = 4
"""Fixed, because what x264 writes depends on it; on fewer cores they share."""

VIDEO_OPTIONS = {"preset": "veryfast", "crf": "18"}
"""crf 18 is where x264's losses stop being visible; veryfast costs half of medium for a tenth more bytes."""

AUDIO_BITS_PER_S = 128_000
AUDIO_BLOCK = 1024
"""Samples of one AAC frame."""

BT709 = 1
"""The code of ITU-R BT.709 for primaries, transfer and matrix. Source: ITU-T H.273, tables 2 to 4."""


def write_film(
    frames: Iterable[Pixels],
    path: Path | str,
    *,
    fps: float,
    size_px: tuple[int, int],
    sound: Sound | None = None,
    notes: Mapping[str, str] | None = None,
) -> None:
    """Writes frames and their sound as a film that starts to play before it is wholly loaded.

    The picture of the last frame stays until the sound ends; a sound that ends first is followed by silence, so both
    streams last as long.

    Args:
        frames: each (H, W, 4) uint8 sRGB; taken one at a time.
        path: where to; the folder exists.
        fps: frames a second, 1..240.
        size_px: (width, height) of every frame, even numbers.
        sound: none makes a film without a sound stream.
        notes: keywords and texts.

    Raises:
        RangeError: the rate or the size does not suit.
        MienError: there is no frame, or the place cannot be written.
    """
    check_film(path, fps, size_px)
    rate = check_rate(fps)
    tags = {key.lower(): value for key, value in (notes or {}).items()}
    options = {"movflags": "+faststart+use_metadata_tags", "fflags": "+bitexact"}
    with writing(path) as temporary, av.open(str(temporary), "w", format="mp4", options=options) as container:
        container.metadata.update(tags)
        picture = _add_picture(container, rate, size_px)
        voice = _Voice(container, sound) if sound is not None else None
        count = 0
        for count, pixels in enumerate(_held(frames, rate, sound), start=1):
            container.mux(picture.encode(_to_frame(pixels, count - 1, rate, size_px)))
            if voice:
                voice.play_until(Fraction(count) / rate)
        if not count:
            raise MienError(f"{path}: a film needs one frame at least, got none")
        container.mux(picture.encode(None))
        if voice:
            voice.finish()


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


def _add_picture(container: Any, rate: Fraction, size_px: tuple[int, int]) -> Any:
    stream = container.add_stream("libx264", rate=rate, options=dict(VIDEO_OPTIONS))
    stream.width, stream.height = size_px
    stream.pix_fmt = "yuv420p"
    context = stream.codec_context
    context.thread_count = ENCODER_THREADS
    context.color_range = ColorRange.MPEG
    context.color_primaries = context.color_trc = context.colorspace = BT709
    return stream


def _to_frame(pixels: Pixels, number: int, rate: Fraction, size_px: tuple[int, int]) -> VideoFrame:
    if pixels.shape != (size_px[1], size_px[0], 4):
        raise MienError(f"frame {number}: want {size_px[0]}x{size_px[1]} pixels RGBA, got an array {pixels.shape}")
    frame = VideoFrame.from_ndarray(np.ascontiguousarray(pixels), format="rgba").reformat(
        format="yuv420p",
        dst_colorspace=Colorspace.ITU709,
        src_color_range=ColorRange.JPEG,
        dst_color_range=ColorRange.MPEG,
    )
    frame.pts, frame.time_base = number, 1 / rate
    return frame


class _Voice:
    """The sound stream, fed in step with the picture so that no packet waits long."""

    def __init__(self, container: Any, sound: Sound) -> None:
        self.container, self.sound = container, sound
        self.stream = container.add_stream("aac", rate=sound.rate_hz, layout="mono")
        self.stream.bit_rate = AUDIO_BITS_PER_S
        self.place, self.end = 0, 0

    def play_until(self, time_s: Fraction) -> None:
        """Encodes whole blocks up to the time that the picture has reached."""
        self.end = max(round(time_s * self.sound.rate_hz), self.end)
        while self.place + AUDIO_BLOCK <= self.end:
            self._encode(AUDIO_BLOCK)

    def finish(self) -> None:
        """Encodes what is left, to the sample."""
        self.end = max(self.end, len(self.sound.samples))
        while self.place < self.end:
            self._encode(min(AUDIO_BLOCK, self.end - self.place))
        self.container.mux(self.stream.encode(None))

    def _encode(self, count: int) -> None:
        samples = np.zeros((1, count), dtype=np.int16)
        given = self.sound.samples[self.place : self.place + count]
        samples[0, : len(given)] = given
        frame = AudioFrame.from_ndarray(samples, format="s16", layout="mono")
        frame.sample_rate = self.sound.rate_hz
        frame.pts, frame.time_base = self.place, Fraction(1, self.sound.rate_hz)
        self.container.mux(self.stream.encode(frame))
        self.place += count
