"""Pictures of every kind that cameras, scanners and people make."""

from __future__ import annotations

import io
import struct
import tracemalloc
import zlib
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageCms

from mien.capture.photographs import lens_key, photograph_size, read_gray, read_photograph, read_thumbnail
from mien.core import LoadError

ORIENTATION = 274


def sides() -> np.ndarray:
    """(20, 30, 3): red above, blue below, the upper left corner white."""
    picture = np.zeros((20, 30, 3), np.uint8)
    picture[:10, :, 0], picture[10:, :, 2] = 255, 255
    picture[:5, :5] = 255
    return picture


def saved(path: Path, picture: Image.Image, **options: object) -> Path:
    picture.save(path, **options)
    return path


# What a camera stores when it is held so that the upright picture is ``sides``. Source: Exif 2.32, tag 274.
STORED = {
    1: lambda p: p,
    2: lambda p: p[:, ::-1],
    3: lambda p: p[::-1, ::-1],
    4: lambda p: p[::-1],
    5: lambda p: p.transpose(1, 0, 2),
    6: lambda p: np.rot90(p, 1),
    7: lambda p: np.rot90(p, 2).transpose(1, 0, 2),
    8: lambda p: np.rot90(p, -1),
}


@pytest.mark.parametrize("orientation", STORED)
@pytest.mark.parametrize("suffix", ["jpg", "png", "tif", "webp"])
def test_pictures_stand_upright_however_the_camera_was_held(tmp_path: Path, orientation: int, suffix: str) -> None:
    picture = Image.fromarray(np.ascontiguousarray(STORED[orientation](sides())))
    exif = Image.Exif()
    exif[ORIENTATION] = orientation
    lossless = {"lossless": True} if suffix == "webp" else {"quality": 100, "subsampling": 0} if suffix == "jpg" else {}
    path = saved(tmp_path / f"a.{suffix}", picture, exif=exif, **lossless)
    assert photograph_size(path) == (30, 20)
    found = read_photograph(path)
    assert found.dtype == np.uint8
    np.testing.assert_allclose(found.astype(int), sides(), atol=60 if suffix == "jpg" else 0)
    assert read_thumbnail(path, 15).shape == (10, 15, 3)


def test_an_orientation_that_is_none_is_left_alone(tmp_path: Path) -> None:
    exif = Image.Exif()
    exif[ORIENTATION] = 77
    assert photograph_size(saved(tmp_path / "a.jpg", Image.fromarray(sides()), exif=exif)) == (30, 20)


def test_printers_colours_palettes_and_transparency(tmp_path: Path) -> None:
    red = Image.new("RGB", (8, 8), (255, 0, 0))
    pictures = {
        "cmyk.jpg": red.convert("CMYK"),
        "cmyk.tif": red.convert("CMYK"),
        "palette.png": red.convert("P"),
        "palette.gif": red.convert("P"),
        "clear.png": Image.new("RGBA", (8, 8), (255, 0, 0, 255)),
        "ycc.tif": red.convert("YCbCr"),
    }
    for name, picture in pictures.items():
        pixel = read_photograph(saved(tmp_path / name, picture))[4, 4]
        assert tuple(pixel) == pytest.approx((255, 0, 0), abs=3), name


def test_what_is_transparent_lies_on_white(tmp_path: Path) -> None:
    half = saved(tmp_path / "half.png", Image.new("RGBA", (8, 8), (255, 0, 0, 128)))
    assert tuple(read_photograph(half)[0, 0]) == pytest.approx((255, 127, 127), abs=1)
    clear = Image.new("P", (8, 8), 0)
    clear.putpalette([10, 20, 30])
    assert tuple(read_photograph(saved(tmp_path / "p.png", clear, transparency=0))[0, 0]) == (255, 255, 255)
    assert tuple(read_photograph(saved(tmp_path / "la.png", Image.new("LA", (8, 8), (0, 0))))[0, 0]) == (255, 255, 255)


@pytest.mark.parametrize(("mode", "value"), [("1", 1), ("L", 200), ("LA", (200, 255))])
def test_gray_pictures(tmp_path: Path, mode: str, value: int) -> None:
    path = saved(tmp_path / "a.png", Image.new(mode, (8, 8), value))
    wanted = 255 if mode == "1" else 200
    assert (read_photograph(path) == wanted).all()
    assert (read_gray(path) == wanted).all()
    assert read_gray(path).shape == (8, 8)


@pytest.mark.parametrize("suffix", ["png", "tif"])
def test_sixteen_bits_become_eight(tmp_path: Path, suffix: str) -> None:
    values = np.array([[0, 256, 32896, 65535]], np.uint16)
    path = saved(tmp_path / f"a.{suffix}", Image.fromarray(values))
    assert read_photograph(path)[0, :, 0].tolist() == [0, 0, 128, 255]


def test_sixteen_bits_of_red_green_and_blue(tmp_path: Path) -> None:
    row = np.array([[65535, 32896, 0]] * 2, ">u2").tobytes()
    header = struct.pack(">IIBBBBB", 2, 1, 16, 2, 0, 0, 0)
    chunks = [(b"IHDR", header), (b"IDAT", zlib.compress(b"\0" + row)), (b"IEND", b"")]
    data = b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)) for kind, body in chunks
    )
    path = tmp_path / "a.png"
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + data)
    assert tuple(read_photograph(path)[0, 1]) == (255, 128, 0)


def test_a_profile_of_colours_is_followed_and_a_broken_one_is_not(tmp_path: Path) -> None:
    picture = Image.new("RGB", (8, 8), (120, 130, 140))
    srgb = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    for name, profile in {"srgb.png": srgb, "broken.png": b"nothing like a profile"}.items():
        path = saved(tmp_path / name, picture, icc_profile=profile)
        np.testing.assert_allclose(read_photograph(path)[0, 0].astype(int), (120, 130, 140), atol=1)


def error(path: Path) -> str:
    with pytest.raises(LoadError) as caught:
        read_photograph(path)
    assert str(caught.value).startswith(str(path))
    return str(caught.value)


def test_files_that_cannot_be_used_say_what_to_do(tmp_path: Path) -> None:
    data = {
        "a.heic": (
            b"\0\0\0\x18ftypheic\0\0\0\0mif1heic",
            "is a HEIC picture, which cannot be read here — export it as",
        ),
        "b.jpg": (b"\0\0\0\x18ftypmif1\0\0\0\0mif1heic", "is a HEIC picture"),
        "c.CR2": (b"II*\0", "is a raw picture of a camera — develop it to JPEG"),
        "d.jpg": (b"", "is empty — copy it from the camera again"),
        "e.jpg": (b"photo,point,u,v\n", "is no picture that can be read — want JPEG"),
        "f.png": (b"\x89PNG\r\n\x1a\n", ""),
    }
    for name, (content, wanted) in data.items():
        (tmp_path / name).write_bytes(content)
        assert wanted in error(tmp_path / name)
    assert "there is no such file" in error(tmp_path / "none.jpg")
    assert "cannot be opened" in error(tmp_path)
    saved(tmp_path / "f.tif", Image.new("F", (4, 4), 0.5))
    assert "has floating-point pixels — save it with 8 bits" in error(tmp_path / "f.tif")


@pytest.mark.parametrize("suffix", ["jpg", "png", "webp"])
def test_truncated_pictures_have_a_size_but_no_pixels(tmp_path: Path, suffix: str) -> None:
    noise = np.random.default_rng(1).integers(0, 255, (64, 64, 3), np.uint8)
    whole = io.BytesIO()
    Image.fromarray(noise).save(whole, {"jpg": "JPEG", "png": "PNG", "webp": "WEBP"}[suffix])
    path = tmp_path / f"a.{suffix}"
    path.write_bytes(whole.getvalue()[: len(whole.getvalue()) // 2])
    if suffix == "webp":
        assert "is " in error(path) or "cannot" in error(path)
        return
    assert photograph_size(path) == (64, 64)
    assert "is damaged or not complete" in error(path)
    with pytest.raises(LoadError, match="is damaged or not complete"):
        read_thumbnail(path, 16)


def test_a_hundred_megapixels_without_reading_them_for_their_size(tmp_path: Path) -> None:
    path = saved(tmp_path / "large.png", Image.new("1", (12000, 8400)))
    tracemalloc.start()
    assert photograph_size(path) == (12000, 8400)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 1e6
    assert read_thumbnail(path, 300).shape == (210, 300, 3)


def test_more_than_memory_may_hold_is_refused(tmp_path: Path) -> None:
    path = saved(tmp_path / "huge.png", Image.new("1", (20000, 10000)))
    assert "has more than 178 megapixels — make it smaller" in error(path)


def test_lenses_are_told_apart_by_what_cameras_write(tmp_path: Path) -> None:
    def path(name: str, model: str, size: tuple[int, int] = (30, 20)) -> Path:
        exif = Image.Exif()
        exif[272] = model
        return saved(tmp_path / name, Image.new("RGB", size), exif=exif)

    first = lens_key(path("a.jpg", "X100"))
    assert lens_key(path("b.jpg", "X100")) == first
    assert lens_key(path("c.jpg", "X200")) != first
    assert lens_key(path("d.jpg", "X100", (20, 30))) != first


def test_any_bytes_are_a_picture_or_one_clear_error(tmp_path: Path) -> None:
    whole = io.BytesIO()
    Image.fromarray(sides()).save(whole, "JPEG")
    random, good = np.random.default_rng(2), np.frombuffer(whole.getvalue(), np.uint8)
    for number in range(200):
        broken = good.copy()
        broken[random.integers(0, len(good), 5)] = random.integers(0, 256, 5)
        path = tmp_path / f"{number}.jpg"
        path.write_bytes(broken.tobytes())
        with suppress(LoadError):
            width, height = photograph_size(path)
            if width * height < 1e6:
                assert read_photograph(path).shape == (height, width, 3)
