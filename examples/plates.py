"""How Parke's figures are set again: one light, his shading, grey levels, a letter under each picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from PIL import Image

import mien

GROUND = (0.03, 0.03, 0.03, 1.0)


def plate_scene(size_px: tuple[int, int], yaw_deg: float, distance_m: float, up_m: float = -0.026) -> mien.Scene:
    """Parke's scene with a broad light at the left of the picture, around a point so far above the eyes' height."""
    light = mien.Light((-0.5, 0.6, 1.2), (1.05, 1.05, 1.05), wrap=0.3)
    ambient = ((0.05, 0.05, 0.05), (0.12, 0.12, 0.12))
    scene = mien.Scene(size_px=size_px, lights=(light,), ambient=ambient, gloss=0.0, background=(GROUND, GROUND))
    return replace(scene, at=(0.0, up_m, 0.0), shading="smooth+").turned(yaw_deg, 1.0, distance_m)


def draw_plate(
    draw: Callable[[int, mien.Scene], mien.Picture],
    scene: mien.Scene,
    columns: int,
    captions: Sequence[str],
    grey: bool = True,
) -> mien.Picture:
    """A lettered plate of what ``draw`` makes for the number of each caption, at twice the size: hairs are fine."""
    width, height = scene.size_px
    large = replace(scene, size_px=(2 * width, 2 * height))
    pictures = [_reduce(draw(number, large), grey) for number in range(len(captions))]
    letters = [f"({letter})  {caption}" for letter, caption in zip("abcdefghijk", captions, strict=False)]
    empty = -len(pictures) % columns
    ground = replace(pictures[0], pixels=np.broadcast_to(pictures[0].pixels[:1, :1], pictures[0].pixels.shape))
    return mien.contact_sheet([*pictures, *[ground] * empty], columns, [*letters, *[""] * empty])


def _reduce(picture: mien.Picture, grey: bool) -> mien.Picture:
    image = Image.fromarray(picture.pixels).reduce(2)
    return replace(picture, pixels=np.asarray(image.convert("L").convert("RGBA") if grey else image))
