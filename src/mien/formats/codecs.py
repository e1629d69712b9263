"""The table of films: of each suffix its container, its codecs and what they can hold.

Nothing is imported here, so that what a film can be is known before any codec is loaded.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

from mien.core import UnknownNameError

LEVEL_PIXELS = 139_264 * 256
"""Pixels of the largest picture that any level allows, the same for H.264 and VP9; decoders refuse more.

Source: ITU-T H.264 (2021), table A-1, level 6.2; WebM project, VP9 levels, level 6.2.
"""


@dataclass(frozen=True)
class Codec:
    """One row.

    Attributes:
        suffix: lower case.
        doc: what is in the file.
        container: name of the file format; FFmpeg's, but for those that are written here.
        container_options: of what writes it.
        picture: FFmpeg's name of the encoder of pictures.
        pixels: FFmpeg's name of the layout of opaque pixels that it is given.
        clear_pixels: the same for pictures with a transparent background; empty where a film has none.
        options: of the encoder of pictures.
        clear_options: besides ``options``, for pictures with a transparent background.
        voice: FFmpeg's name of the encoder of sound; empty where a film has none.
        voice_rates_hz: samples a second that it takes; others are resampled to the highest. Empty: any.
        voice_bits_per_s: how much it may write; 0 where that is not a choice.
        even: whether odd sides are made even, by showing the last row or column twice.
        spaced: whether every picture says for how long it stays, so that equal ones are always written once.
        ticks_per_s: in which its times go; 0 where one tick is one frame.
        least_side_px: shortest side.
        most_side_px: longest side.
        most_pixels: width times height.
        fps_high: greatest rate.
    """

    suffix: str
    doc: str
    container: str
    picture: str
    pixels: str
    clear_pixels: str = ""
    container_options: Mapping[str, str] = field(default_factory=dict)
    options: Mapping[str, str] = field(default_factory=dict)
    clear_options: Mapping[str, str] = field(default_factory=dict)
    voice: str = ""
    voice_rates_hz: tuple[int, ...] = ()
    voice_bits_per_s: int = 0
    even: bool = False
    spaced: bool = False
    ticks_per_s: int = 0
    least_side_px: int = 1
    most_side_px: int = 16384
    most_pixels: int = 16384 * 16384
    fps_high: float = 240.0

    @property
    def alpha(self) -> bool:
        """Whether its pictures can be transparent."""
        return bool(self.clear_pixels)

    @property
    def sound(self) -> bool:
        """Whether it has a sound stream."""
        return bool(self.voice)


@dataclass(frozen=True)
class FilmPlan:
    """What is known of a film before its first frame.

    Attributes:
        codec: its row.
        rate: frames a second.
        size_px: (width, height) of a frame.
        transparent: whether there are pixels that are not opaque.
    """

    codec: Codec
    rate: Fraction
    size_px: tuple[int, int]
    transparent: bool

    @property
    def layout(self) -> str:
        """FFmpeg's name of the layout of pixels that the encoder is given."""
        return self.codec.clear_pixels if self.transparent else self.codec.pixels

    @property
    def options(self) -> dict[str, str]:
        """Of the encoder of pictures."""
        return {**self.codec.options, **(self.codec.clear_options if self.transparent else {})}

    def ticks(self, number: int) -> int:
        """When a frame begins, in the ticks of the container."""
        return round(number * self.codec.ticks_per_s / self.rate) if self.codec.ticks_per_s else number


_MOVIE = {"movflags": "+faststart+use_metadata_tags"}
"""The index comes first, so that a film plays while it loads; notes of any name are kept."""

CODECS: tuple[Codec, ...] = (
    Codec(
        ".mp4",
        "H.264 picture, AAC sound",
        container="mp4",
        picture="libx264",
        pixels="yuv420p",
        container_options=_MOVIE,
        options={"preset": "superfast", "crf": "23"},
        voice="aac",
        voice_rates_hz=(7350, 8000, 11025, 12000, 16000, 22050, 24000, 32000, 44100, 48000),
        voice_bits_per_s=128_000,
        even=True,
        most_pixels=LEVEL_PIXELS,
    ),
    Codec(
        ".webm",
        "VP9 picture, with transparency, Opus sound",
        container="webm",
        picture="libvpx-vp9",
        pixels="yuv420p",
        clear_pixels="yuva420p",
        options={"deadline": "realtime", "cpu-used": "6", "crf": "15", "b": "0", "tile-columns": "2"},
        clear_options={"auto-alt-ref": "0"},
        voice="libopus",
        voice_rates_hz=(48000,),
        voice_bits_per_s=96_000,
        even=True,
        most_pixels=LEVEL_PIXELS,
    ),
    Codec(
        ".mov",
        "ProRes 4444 picture, with transparency, plain sound; for editing",
        container="mov",
        picture="prores_ks",
        pixels="yuv444p10le",
        clear_pixels="yuva444p10le",
        container_options=_MOVIE,
        options={"profile": "4444"},
        voice="pcm_s16le",
        most_pixels=LEVEL_PIXELS,
    ),
    Codec(
        ".gif",
        "GIF, 256 colours a frame, with hard-edged transparency, no sound",
        container="gif",
        picture="gif",
        pixels="pal8",
        clear_pixels="pal8",
        container_options={"loop": "0"},
        # Its cutting off of what is clear takes single pixels at the lower edge with it.
        clear_options={"gifflags": "-offsetting"},
        spaced=True,
        ticks_per_s=100,
        fps_high=50.0,
    ),
    Codec(
        ".apng",
        "animated PNG, lossless, with transparency, no sound",
        container="apng",
        picture="png",
        pixels="rgb24",
        clear_pixels="rgba",
        options={"pred": "mixed", "compression_level": "5"},
        spaced=True,
    ),
    Codec(
        ".webp",
        "animated WebP, with transparency, no sound",
        container="webp",
        picture="libwebp",
        pixels="bgra",
        clear_pixels="bgra",
        options={"quality": "90", "compression_level": "2"},
        spaced=True,
        ticks_per_s=1000,
        most_side_px=16383,
    ),
)


def find_codec(path: Path | str) -> Codec:
    """The row for a film's name; the suffix decides, in either case.

    Raises:
        UnknownNameError: no row has the suffix; the text lists near ones.
    """
    suffix = Path(path).suffix.lower()
    for row in CODECS:
        if row.suffix == suffix:
            return row
    raise UnknownNameError(f"suffix of {Path(path).name!r}:", suffix, [row.suffix for row in CODECS])
