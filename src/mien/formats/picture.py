"""A picture: what drawing gives, and how it becomes PNG or JPEG."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError

from .atomic import writing
from .table import find_format

PNG_LEVEL = 4
"""Compression of a still picture; frames of a series use level 1, which is several times faster."""

JPEG_QUALITY = 92


@dataclass(frozen=True, eq=False)
class Picture:
    """Pixels that can be written, and that show themselves in a notebook.

    Attributes:
        pixels: (H, W, 4) uint8, sRGB with straight alpha.
        notes: text that goes into the file: what made it, which face.
    """

    pixels: NDArray[np.uint8]
    notes: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.pixels.dtype != np.uint8 or self.pixels.ndim != 3 or self.pixels.shape[2] != 4:
            raise MienError(f"a picture is (H, W, 4) uint8, got {self.pixels.shape} {self.pixels.dtype}")

    @property
    def size_px(self) -> tuple[int, int]:
        """(width, height)."""
        return self.pixels.shape[1], self.pixels.shape[0]

    def write(self, path: Path | str) -> None:
        """Writes a PNG or a JPEG; the suffix decides. A JPEG shows what is transparent as white.

        Raises:
            UnknownNameError: the suffix is of neither.
            MienError: the place cannot be written.
        """
        name = find_format(path, "pixels").name
        encoded = self.to_jpeg() if name == "jpeg" else self.to_png()
        with writing(path) as temporary:
            temporary.write_bytes(encoded)

    def to_png(self, level: int = PNG_LEVEL) -> bytes:
        """The bytes of a PNG file; opaque pictures have no alpha channel."""
        from PIL import Image
        from PIL.PngImagePlugin import PngInfo

        info = PngInfo()
        info.add(b"sRGB", b"\0")
        for key, value in self.notes.items():
            info.add_itxt(key, value)
        opaque = bool((self.pixels[:, :, 3] == 255).all())
        image = Image.fromarray(np.ascontiguousarray(self.pixels[:, :, :3]) if opaque else self.pixels)
        return _encode(image, "PNG", compress_level=level, pnginfo=info)

    def to_jpeg(self, quality: int = JPEG_QUALITY) -> bytes:
        """The bytes of a JPEG file, over white."""
        from PIL import Image

        comment = "; ".join(f"{key}: {value}" for key, value in self.notes.items())
        return _encode(
            Image.fromarray(over_white(self.pixels)), "JPEG", quality=quality, subsampling=0, comment=comment.encode()
        )

    def _repr_png_(self) -> bytes:
        return self.to_png()


def over_white(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(H, W, 3) uint8: the picture (H, W, 4) on white paper."""
    alpha = pixels[:, :, 3:].astype(np.uint32)
    mixed = pixels[:, :, :3] * alpha + 255 * (255 - alpha)
    return ((mixed + 127) // 255).astype(np.uint8)


def _encode(image: Any, kind: str, **options: Any) -> bytes:
    stream = io.BytesIO()
    image.save(stream, kind, **options)
    return stream.getvalue()
