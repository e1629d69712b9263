"""Pictures as cameras and scanners write them: upright, eight bits, red green blue."""

from __future__ import annotations

import io
import struct
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mien.core import LoadError

if TYPE_CHECKING:
    from PIL.Image import Image

Pixels = NDArray[np.uint8]

MEGAPIXELS = 178
"""The largest picture that is opened, as Pillow has it: beyond, a small file may be made to fill the memory."""

TURNED = (5, 6, 7, 8)
"""Orientations that stand a picture on its side. Source: Exif 2.32, tag 274."""

ORIENTATION = 274

_TURNS: Mapping[int, Callable[[Pixels], Pixels]] = MappingProxyType(
    {
        2: lambda pixels: pixels[:, ::-1],
        3: lambda pixels: pixels[::-1, ::-1],
        4: lambda pixels: pixels[::-1],
        5: lambda pixels: pixels.swapaxes(0, 1),
        6: lambda pixels: np.rot90(pixels, -1),
        7: lambda pixels: pixels[::-1, ::-1].swapaxes(0, 1),
        8: lambda pixels: np.rot90(pixels, 1),
    }
)
"""What sets stored pixels upright, by orientation."""

RAW = frozenset(
    {
        ".3fr", ".arw", ".cr2", ".cr3", ".crw", ".dng", ".erf", ".iiq", ".kdc", ".mef", ".mrw",
        ".nef", ".nrw", ".orf", ".pef", ".raf", ".raw", ".rw2", ".rwl", ".sr2", ".srw", ".x3f",
    }
)  # fmt: skip
"""Suffixes of what sensors saw before it was developed; Pillow would open the small preview in some of them."""

HEIF_BRANDS = (b"heic", b"heix", b"hevc", b"heim", b"heis", b"mif1", b"msf1")
"""What files of HEIC begin with, at byte 8. Source: ISO/IEC 23008-12, 10.2."""

_FAULTS = (OSError, SyntaxError, ValueError, EOFError, struct.error, KeyError, TypeError, IndexError, ZeroDivisionError)
"""What Pillow raises on files that are broken in one way or another."""


def photograph_size(path: Path) -> tuple[int, int]:
    """(width, height) of a picture when it stands upright; its pixels are not read.

    Raises:
        LoadError: it is no picture that can be used.
    """
    with _opened(path) as image:
        width, height = image.size
        # Pillow tells the upright size of a TIFF by itself.
        return (height, width) if image.format != "TIFF" and _orientation(image) in TURNED else (width, height)


def read_photograph(path: Path) -> Pixels:
    """The picture (H, W, 3) upright, 0..255 in sRGB; what is transparent lies on white.

    Raises:
        LoadError: it is no picture that can be used, or it is truncated.
    """
    with _opened(path) as image:
        return _upright(path, image, "RGB")


def read_gray(path: Path) -> Pixels:
    """The brightness (H, W) of a picture upright, 0..255.

    Raises:
        LoadError: as ``read_photograph``.
    """
    with _opened(path) as image:
        image.draft("L", image.size)  # of JPEG, colours need not be decoded
        return _upright(path, image, "L")


def read_thumbnail(path: Path, longest_px: int) -> Pixels:
    """The picture (H, W, 3) upright, made so small that no side is longer than that; one that is smaller stays.

    Raises:
        LoadError: as ``read_photograph``.
    """
    with _opened(path) as image:
        image.draft("RGB", (longest_px * 2, longest_px * 2))  # JPEG is decoded at a fraction where that is enough
        return _upright(path, image, "RGB", longest_px)


def lens_key(path: Path) -> tuple[object, ...]:
    """What tells lenses apart: size of the picture, and what the camera wrote about itself.

    Raises:
        LoadError: as ``photograph_size``.
    """
    with _opened(path) as image:
        try:
            exif = image.getexif()
            about = [exif.get(tag) for tag in (271, 272)]  # make, model
            details = exif.get_ifd(0x8769)
            about += [details.get(tag) for tag in (37386, 42033, 42037)]  # focal length, numbers of body and lens
        except _FAULTS:
            about = []
        return (image.size, _orientation(image) in TURNED, *map(str, about))


@contextmanager
def _opened(path: Path) -> Iterator[Image]:
    from PIL import Image, UnidentifiedImageError

    if path.suffix.lower() in RAW:
        raise LoadError(path, "is a raw picture of a camera", hint="develop it to JPEG, PNG or TIFF, at its full size")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of large pictures, and of odd metadata
            image = Image.open(path)
    except Image.DecompressionBombError:
        raise LoadError(
            path, f"has more than {MEGAPIXELS} megapixels", hint="make it smaller, all pictures of its camera alike"
        ) from None
    except UnidentifiedImageError:
        raise _not_a_picture(path) from None
    except FileNotFoundError:
        raise LoadError(path, "there is no such file") from None
    except _FAULTS as error:
        raise LoadError(path, f"cannot be opened as a picture ({error})") from None
    with image:
        yield image


def _not_a_picture(path: Path) -> LoadError:
    with path.open("rb") as file:
        begin = file.read(32)
    if not begin:
        return LoadError(path, "is empty", hint="copy it from the camera again")
    if (begin[4:8] == b"ftyp" and begin[8:12] in HEIF_BRANDS) or path.suffix.lower() in (".heic", ".heif"):
        return LoadError(
            path,
            "is a HEIC picture, which cannot be read here",
            hint="export it as JPEG at its full size; on an iPhone: Settings, Camera, Formats, Most Compatible",
        )
    return LoadError(path, "is no picture that can be read", hint="want JPEG, PNG, TIFF or WebP, 8 bits a channel")


def _orientation(image: Image) -> int:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return int(image.getexif().get(ORIENTATION, 1))
    except _FAULTS:
        return 1


def _upright(path: Path, image: Image, mode: str, longest_px: int | None = None) -> Pixels:
    """Its pixels in the mode ``RGB`` or ``L``, and made smaller if it is longer than that; the image is closed."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            image.load()
    except _FAULTS as error:
        raise LoadError(path, f"is damaged or not complete ({error})", hint="copy it from the camera again") from None
    orientation = _orientation(image)
    plain = _in_srgb(path, image)
    plain = plain if plain.mode == mode else plain.convert(mode)
    if longest_px is not None:
        plain.thumbnail((longest_px, longest_px))
    pixels = np.asarray(plain)
    image.close()  # a picture of a hundred megapixels need not be there twice
    return np.ascontiguousarray(_TURNS[orientation](pixels)) if orientation in _TURNS else pixels


def _in_srgb(path: Path, image: Image) -> Image:
    """The picture with eight bits a channel, without transparency, in the colours of sRGB."""
    from PIL.Image import alpha_composite, fromarray, new

    if image.mode.startswith("I"):
        return fromarray(_eight_bits(np.asarray(image)))
    if image.mode == "F":
        raise LoadError(path, "has floating-point pixels", hint="save it with 8 bits a channel")
    if image.mode in ("RGBA", "LA", "PA", "La", "RGBa") or "transparency" in image.info:
        clear = image.convert("RGBA")
        white = new("RGBA", clear.size, "white")
        return alpha_composite(white, clear)
    return _converted(image)


def _eight_bits(values: NDArray[np.generic]) -> Pixels:
    """16-bit brightness as 8 bits; some files of 32-bit numbers hold 8 or 16 of them."""
    whole = values.astype(np.int64)
    top = int(whole.max(initial=0))
    return np.clip(whole if values.dtype.itemsize > 2 and top < 256 else whole // 257, 0, 255).astype(np.uint8)


def _converted(image: Image) -> Image:
    """The picture by its colour profile, if it has one that can be used."""
    from PIL import ImageCms

    profile = image.info.get("icc_profile")
    if not profile or image.mode not in ("RGB", "CMYK"):
        return image
    try:
        seen = ImageCms.profileToProfile(image, io.BytesIO(profile), ImageCms.createProfile("sRGB"), outputMode="RGB")
    except (ImageCms.PyCMSError, *_FAULTS):
        return image
    return image if seen is None else seen
