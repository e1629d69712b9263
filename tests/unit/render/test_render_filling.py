"""The compiled filler: the same bytes as its source run as Python, for any number of threads."""

from __future__ import annotations

import numpy as np

from mien.core import Drawing, Path, Region, Scene
from mien.render import draw_drawing, filling, sweeping
from mien.render.outlines import place_canvas, place_outlines
from mien.render.pixels import ONE, background, srgb_codes, to_samples, to_words
from mien.render.renderer import fill_buffers
from support import in_python


def clipped_drawing(seed: int = 0) -> Drawing:
    """Outlines that wind at random, some cut by regions that they share, on a canvas of 24 x 20."""
    generator = np.random.default_rng(seed)

    def outline() -> tuple[np.ndarray, ...]:
        return tuple(generator.uniform(-4.0, 28.0, (int(generator.integers(3, 9)), 2)) for _ in range(2))

    regions = [Region(outline(), "nonzero"), Region(outline())]
    scribble = generator.uniform(0.0, 24.0, (2 * sweeping.MANY, 2))
    paths = [
        Path("first", regions[1].contours, (0.2, 0.3, 0.4, 0.9)),
        Path("scribble", (scribble,), (0.3, 0.4, 0.2, 0.7)),
    ]
    for k in range(8):
        color = (*generator.random(3).tolist(), 1.0 if k % 2 else 0.6)
        paths.append(
            Path(f"path{k}", outline(), color, "nonzero" if k % 3 else "evenodd",
                 inside=tuple(regions[:1]) if k % 4 == 1 else (), outside=tuple(regions[1:]) if k % 4 > 1 else ())
        )  # fmt: skip
    return Drawing((24.0, 20.0), tuple(paths))


def scene(width: int, height: int) -> Scene:
    return Scene(size_px=(width, height), background=((0.1, 0.2, 0.3, 0.5), (0.4, 0.3, 0.2, 1.0)))


def test_the_compiled_filler_is_its_source() -> None:
    drawing, where = clipped_drawing(), scene(24, 20)
    outlines = place_outlines(drawing, where.size_px)
    picture = np.zeros((20, 24), dtype=np.uint32)
    behind = to_words(to_samples(background(where)))
    buffers = fill_buffers(24, len(outlines.edges), len(outlines.masks))
    with np.errstate(over="ignore"):
        in_python(filling.fill_bands)(0, 1, 8, *vars(outlines).values(), behind, srgb_codes(), *buffers, picture)
    np.testing.assert_array_equal(picture.view(np.uint8).reshape(20, 24, 4), draw_drawing(drawing, where))


def test_the_compiled_edges_are_their_source() -> None:
    drawing = clipped_drawing(3)
    points = np.concatenate([contour for path in drawing.paths for contour in path.contours])
    contours = np.array([0, 5, len(points)])
    results = []
    for place in (sweeping.place_edges, in_python(sweeping.place_edges)):
        out = (np.zeros((len(points), 4)), np.zeros(len(points), dtype=np.int32))
        starts, boxes = np.zeros(3, dtype=np.int64), np.zeros((2, 4), dtype=np.int64)
        canvas = place_canvas(drawing, (77, 50))
        place(points, contours, np.array([0, 1, 2]), *canvas, 77, 50, *out, starts, boxes)
        results.append((*out, starts, boxes))
    for compiled, source in zip(*results, strict=True):
        np.testing.assert_array_equal(compiled, source)


def test_threads_change_no_byte() -> None:
    drawing, where = clipped_drawing(1), scene(240, 200)
    one = draw_drawing(drawing, where)
    for threads in (2, 3, 7):
        np.testing.assert_array_equal(draw_drawing(drawing, where, threads=threads), one)


def test_the_plain_filler_sees_the_same_picture() -> None:
    for seed in range(4):
        drawing, where = clipped_drawing(seed), scene(120, 100)
        fast, plain = (
            draw_drawing(drawing, where, rasteriser=each).astype(int)  # type: ignore[arg-type]
            for each in ("compiled", "reference")
        )
        assert np.median(np.abs(fast - plain)) <= 1
        # The seam of the first path, which fills a hole, is closed by the fast one alone.
        assert (np.abs(fast - plain).max(axis=2) > 12).mean() < 0.02


def test_an_outline_that_is_shared_is_placed_once() -> None:
    region = Region((np.eye(3, 2),))
    paths = [Path(f"path{k}", (np.eye(4, 2),), (0.0, 0.0, 0.0, 1.0), inside=(region,)) for k in range(3)]
    outlines = place_outlines(Drawing((1.0, 1.0), (*paths, Path("hole", region.contours, (0.0,) * 3 + (1.0,)))), (9, 9))
    assert len(outlines.nonzero) == 4
    assert len(outlines.masks) == 1
    assert outlines.clips.tolist() == [[0, filling.INSIDE]] * 3


def test_a_mask_is_worked_out_only_where_someone_needs_it() -> None:
    everywhere = Region((np.array([[0.0, 0], [9, 0], [9, 9], [0, 9]]),))
    small = Path("small", (np.array([[2.0, 3], [4, 3], [4, 7], [2, 7]]),), (0.0, 0.0, 0.0, 0.5), outside=(everywhere,))
    outlines = place_outlines(Drawing((9.0, 9.0), (small,)), (9, 9))
    assert outlines.masks[0, :4].tolist() == [2, 2, 4, 6]
    assert outlines.paths[0, filling.ALPHA] == ONE // 2
