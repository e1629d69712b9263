"""From a face, a pose and a scene to a picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from types import TracebackType
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Face, Mesh, MienError, Pose, RangeError, Scene, UnknownNameError, fill_rows, subdivide
from mien.core.sparse import SparseMatrix
from mien.core.subdivision import apply_to_each

from . import bands, filling, lighting, placing, reference, refining, spans
from .camera import FAR_OUT, NEAR_M, SUBPIXELS, Camera
from .drawing import draw_plainly
from .outlines import place_outlines
from .pixels import ONE, WHOLE, Samples, background, encode, srgb_codes, to_samples, to_words
from .plan import Plan
from .shade import Shades, own_normals
from .surface import light_surface
from .triangles import Placed, Triangles, make_triangles
from .values import corner_values, every_corner, seen_colors_of_polygons

Picture = NDArray[np.uint8]
Rasteriser = Literal["compiled", "reference"]

RASTERISERS: tuple[Rasteriser, ...] = ("compiled", "reference")

BAND_ROWS = 32
"""Rows of pixels in a band. Their samples, 12 bytes each, still fit a processor core's own cache."""

WORTH_SHARING = 8192
"""Fewer points or triangles are done faster by one thread than handed out: that costs some 50 microseconds."""

SPARE = 4
"""Samples behind the last one, into which whole steps of spans reach."""


class Renderer:
    """Draws frame after frame of one scene and keeps its threads and buffers in between: one frame at a time.

    Attributes:
        scene: what is drawn.
        threads: how many share the bands out; the picture does not depend on it.
        samples: 1, or 4 where the border of something runs through a pixel, averaged in linear light.
    """

    def __init__(
        self, scene: Scene, threads: int = 1, *, samples: int = 4, rasteriser: Rasteriser = "compiled"
    ) -> None:
        if samples not in (1, 4):
            raise RangeError(f"{samples} samples a pixel cannot be had — it is 1 or 4")
        if not 1 <= threads <= 256:
            raise RangeError(f"{threads} threads cannot be had — it is 1 to 256")
        if rasteriser not in RASTERISERS:
            raise UnknownNameError("rasteriser", str(rasteriser), RASTERISERS)
        self.scene, self.threads, self.samples = scene, threads, samples
        self._rasteriser = rasteriser
        self._camera = Camera.of(scene)
        self._behind = to_samples(background(scene))
        self._behind_words = to_words(self._behind), encode(self._behind).view(np.uint32).reshape(-1)
        self._light_settings = _light_settings(scene, self._camera)
        self._pool = ThreadPoolExecutor(threads - 1) if threads > 1 else None
        self._room = _Room(0, 0)
        self._buffers: list[tuple[NDArray[np.generic], ...]] = []

    def __enter__(self) -> Renderer:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Let the threads go. A closed renderer draws on with one thread."""
        if self._pool is not None:
            self._pool.shutdown()
        self._pool, self.threads = None, 1

    def draw(self, face: Face, pose: Pose) -> Picture:
        """(H, W, 4) sRGB picture, straight alpha, of a face in a pose; rows the pose leaves at rest take the scene."""
        pose = fill_rows(face, pose, self.scene)
        shape = (face if self.scene.subdivide else face.unsubdivided).shape(pose)
        if isinstance(shape, Drawing):
            return self.draw_drawing(shape)
        return self.draw_mesh(self.refine(shape))

    def refine(self, mesh: Mesh) -> Mesh:
        """The mesh subdivided as the scene asks, by compiled code on all threads; ``core.subdivide`` to the bit."""
        plain = self._rasteriser == "reference"
        return subdivide(mesh, self.scene.subdivide, apply_to_each if plain else self._multiply)

    def draw_mesh(self, mesh: Mesh) -> Picture:
        """(H, W, 4) sRGB picture, straight alpha, of a mesh as it is."""
        if not (np.isfinite(mesh.points).all() and np.isfinite(mesh.colors).all()):
            raise MienError("a mesh to be drawn has a point or a colour that is not a finite number")
        if self._rasteriser == "compiled":
            light = corner_values if self.scene.shading == "smooth+" else self._light
            return self._rasterise(make_triangles(mesh, self.scene, self._camera, light, self._place))
        triangles = make_triangles(mesh, self.scene, self._camera)

        def light_samples(groups: Samples, depth: NDArray[np.float32], offset: tuple[int, int]) -> Samples:
            several = len(groups) > 1
            return light_surface(groups, depth, offset, self._camera, self.scene) if several else groups[0]

        return encode(reference.rasterise(triangles, self._camera, self._behind, light_samples, self.samples == 4))

    def draw_drawing(self, drawing: Drawing) -> Picture:
        """(H, W, 4) sRGB picture, straight alpha: the canvas, as large as its size allows, on its lower edge."""
        if self._rasteriser == "reference":
            return draw_plainly(drawing, self.scene)
        width, height = self.scene.size_px
        outlines = place_outlines(drawing, self.scene.size_px)
        behind = to_words(to_samples(background(self.scene, drawing.background)))
        picture = np.empty((height, width), dtype=np.uint32)
        frame = (*vars(outlines).values(), behind, srgb_codes())
        sizes = (width, len(outlines.edges), len(outlines.masks))
        self._share(
            filling.fill_bands,
            [(k, self.threads, BAND_ROWS, *frame, *fill_buffers(*sizes), picture) for k in range(self.threads)],
        )
        return picture.view(np.uint8).reshape(height, width, 4)

    def _light(
        self, mesh: Mesh, points: NDArray[np.float64], plan: Plan, scene: Scene, triangles: NDArray[np.int64]
    ) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """What ``values.corner_values`` says, by compiled code on all threads; shades that no corner has stay empty."""
        topology, (lamps, ambient) = mesh.topology, self._light_settings[1:]
        polygons, nodes, shades = topology.polygon_count, len(plan.vertex), len(plan.lit)
        normals, facing = np.empty((polygons, 3)), np.empty(polygons, dtype=np.bool_)
        places = (points, topology.corners, topology.starts)
        viewer = np.array([*scene.position, scene.gloss])
        self._share(lighting.sum_normals, [(*places, a, b, normals, facing, viewer) for a, b in self._parts(polygons)])
        shade_of, needed = np.empty((len(triangles), 3), dtype=np.int32), np.zeros(shades, dtype=np.uint8)
        sides = (triangles, topology.polygon_of_triangle, facing, plan.triangle_front, plan.triangle_back)
        self._share(lighting.choose_shades, [(*sides, a, b, shade_of, needed) for a, b in self._parts(len(triangles))])
        own = own_normals(mesh) if len(plan.round) else normals
        settings = (own, lamps, ambient, viewer, scene.cosine_power, *plan.columns)
        sums = (plan.normal_sum.starts, plan.normal_sum.columns)
        diffuse, highlight = np.empty((shades, 3)), np.empty((shades, 3))
        self._share(
            lighting.light_nodes,
            [(*places, normals, *settings, *sums, needed, a, b, diffuse, highlight) for a, b in self._parts(nodes)],
        )
        if mesh.colored_by_polygon:
            lit = Shades(diffuse, highlight, facing)
            return seen_colors_of_polygons(mesh, lit, shade_of, triangles), every_corner(triangles)
        values = np.zeros((shades, 3))
        constant = (mesh.colors, topology.corners, topology.starts, *plan.columns[:3], needed)
        self._share(lighting.tint_nodes, [(*constant, a, b, diffuse, highlight, values) for a, b in self._parts(nodes)])
        return values, shade_of

    def _place(self, points: NDArray[np.float64], plan: Plan, camera: Camera) -> Placed:
        """What ``triangles.place_mesh`` says, by compiled code."""
        count, triangles = len(points), plan.triangles.shape[1]
        rounded, view, inverse = np.empty((count, 3)), np.empty((count, 3)), np.empty(count)
        codes, places = np.empty(count, dtype=np.uint8), np.empty((count, 2), dtype=np.int32)
        axes = np.array([camera.right, camera.up, camera.forward])
        settings = np.array([camera.scale, camera.width, camera.height, NEAR_M, SUBPIXELS, FAR_OUT])
        constant = (np.ascontiguousarray(points), axes, np.array(camera.position), settings)
        filled = (rounded, view, codes, places, inverse)
        self._share(placing.place_points, [(*constant, a, b, *filled) for a, b in self._parts(count)])
        sides, borders = np.empty(triangles, dtype=np.uint8), np.empty(triangles, dtype=np.uint8)
        seen_by = (plan.triangles, codes, places, plan.triangle_two_sided)
        self._share(placing.see_sides, [(*seen_by, a, b, sides) for a, b in self._parts(triangles)])
        whole, cut = np.empty(triangles, dtype=np.int64), np.empty(triangles, dtype=np.int64)
        corners, counts = np.empty((triangles, 3), dtype=np.int32), np.empty(2, dtype=np.int64)
        placing.sort_out(plan.triangles, plan.neighbours, sides, whole, cut, corners, borders, counts)
        seen, crossing = counts.tolist()
        drawn = np.concatenate([whole[:seen], cut[:crossing]])
        return Placed(rounded, view, places, inverse, drawn, corners[:seen], borders[:seen])

    def _multiply(self, matrix: SparseMatrix, values: Sequence[NDArray[np.float64]]) -> Sequence[NDArray[np.float64]]:
        """What ``SparseMatrix.apply`` says of one or two values (C, 3)."""
        rows, columns = matrix.shape
        outs = [np.empty((rows, 3)) for _ in values]
        for each, out in zip(values, outs, strict=True):
            out[:columns] = each[:rows]
        kernel = refining.multiply_rows if len(outs) == 1 else refining.multiply_rows_by_two
        entries = (*matrix.mixed, *(np.ascontiguousarray(each) for each in values))
        self._share(kernel, [(*entries, a, b, *outs) for a, b in self._parts(len(matrix.mixed[0]))])
        return outs

    def _parts(self, count: int) -> list[tuple[int, int]]:
        """0:count in as many runs as there are threads, or one where handing them out would take longer."""
        runs = self.threads if count >= WORTH_SHARING else 1
        return list(pairwise(count * k // runs for k in range(runs + 1)))

    def _rasterise(self, triangles: Triangles) -> Picture:
        width, height = self.scene.size_px
        count, columns = len(triangles.corners), triangles.values.shape[1]
        smooth = self.samples == 4
        apron = 1 if smooth else 0
        if len(self._room.shapes) < count or self._room.planes.shape[1] != 3 * columns:
            # Some more than asked: the number of triangles that face the viewer changes from frame to frame.
            self._room = _Room(count + count // 8, columns)
        room = (self._room.shapes[:count], self._room.frames[:count], self._room.planes[:count])
        soup = (triangles.places, triangles.inverse, triangles.corners, triangles.values, triangles.value_of)
        self._share(spans.set_up, [(*soup, a, b, *room) for a, b in self._parts(count)])
        counts = np.zeros(-(-height // BAND_ROWS) + 1, dtype=np.int64)
        spans.count_bands(room[1], height, BAND_ROWS, apron, counts)
        members = np.empty(int(counts[-1]), dtype=np.int32)
        spans.sort_bands(room[1], height, BAND_ROWS, apron, counts.copy(), members)

        groups = columns // 3
        if not self._buffers or len(self._buffers[0][1]) != groups:
            self._buffers = [_buffers(width, groups, smooth) for _ in range(self.threads)]
        picture = np.empty((height, width), dtype=np.uint32)
        limits = np.array([ONE, *[WHOLE] * (groups - 1)], dtype=np.float32)
        mesh = (triangles.places, triangles.inverse, triangles.corners, triangles.borders)
        frame = (*mesh, *room, counts, members, limits)
        behind = (*self._behind_words, *self._light_settings, srgb_codes())
        self._share(
            bands.draw_bands,
            [
                (k, self.threads, BAND_ROWS, apron, *frame, *behind, *self._buffers[k], picture)
                for k in range(self.threads)
            ],
        )
        return picture.view(np.uint8).reshape(height, width, 4)

    def _share(self, work: Callable[..., object], arguments: list[tuple[object, ...]]) -> None:
        """Do some compiled work once for each tuple, the first here and the others on the threads."""
        others = [self._pool.submit(work, *rest) for rest in arguments[1:]] if self._pool is not None else []
        work(*arguments[0])
        for other in others:
            other.result()


class _Room:
    """What is kept of triangles, for up to ``count`` of them with values of some ``columns``."""

    def __init__(self, count: int, columns: int) -> None:
        self.shapes = np.empty((count, spans.SHAPE_COLUMNS))
        self.frames = np.empty((count, spans.FRAME_COLUMNS), dtype=np.int32)
        self.planes = np.empty((count, 3 * columns), dtype=np.float32)


def _buffers(width: int, groups: int, smooth: bool) -> tuple[NDArray[np.generic], ...]:
    """What a thread needs for itself: depth and groups of samples of a band; marks, their places, samples of those."""
    rows = BAND_ROWS if smooth else 0
    size = (BAND_ROWS + 2) * width + SPARE
    return (
        np.empty(size, dtype=np.float32),
        np.empty((groups, size), dtype=np.uint64),
        np.zeros((rows, width), dtype=np.uint8),
        np.empty((rows, width + 1), dtype=np.int32),
        np.empty(rows * width, dtype=np.int32),
        np.empty((rows * width, 4), dtype=np.float32),
        np.empty((groups, rows * width, 4), dtype=np.uint64),
    )


def fill_buffers(width: int, edges: int, masks: int) -> tuple[NDArray[np.generic], ...]:
    """What a thread needs for itself to fill paths, as ``filling.fill_bands`` takes it."""
    return (
        np.empty((BAND_ROWS, width), dtype=np.uint64),
        np.zeros(width + 2),
        np.empty((edges, 2), dtype=np.int32),
        np.empty(BAND_ROWS, dtype=np.int32),
        np.empty(edges, dtype=np.int32),
        np.empty(edges, dtype=np.int32),
        np.empty((edges, 2)),
        np.empty(edges, dtype=np.int32),
        np.empty(width, dtype=np.uint16),
        np.empty((masks, BAND_ROWS, width), dtype=np.uint16),
        np.empty(masks, dtype=np.uint8),
    )


def _light_settings(scene: Scene, camera: Camera) -> tuple[NDArray[np.float64], ...]:
    """Viewer, lamps and ambient light as ``per_pixel.light_sample`` takes them."""
    axes = (*camera.right, *camera.up, *camera.forward)
    raster = (camera.scale, camera.width * 0.5, camera.height * 0.5)
    lamps = [[*lamp.position, *lamp.color, lamp.wrap, 1.0 / (1.0 + lamp.wrap)] for lamp in scene.lamps]
    return (
        np.array([*camera.position, *axes, *raster, scene.gloss, scene.cosine_power]),
        np.array(lamps).reshape(-1, 8),
        np.array(scene.ambient),
    )


def draw(face: Face, pose: Pose, scene: Scene, *, threads: int = 1, samples: int = 4) -> Picture:
    """(H, W, 4) sRGB picture, straight alpha, of a face in a pose."""
    with Renderer(scene, threads, samples=samples) as renderer:
        return renderer.draw(face, pose)


def draw_mesh(
    mesh: Mesh, scene: Scene, *, threads: int = 1, samples: int = 4, rasteriser: Rasteriser = "compiled"
) -> Picture:
    """(H, W, 4) sRGB picture, straight alpha, of a mesh as it is; the reference rasteriser is slow and equal."""
    with Renderer(scene, threads, samples=samples, rasteriser=rasteriser) as renderer:
        return renderer.draw_mesh(mesh)


def draw_drawing(drawing: Drawing, scene: Scene, *, threads: int = 1, rasteriser: Rasteriser = "compiled") -> Picture:
    """(H, W, 4) sRGB picture, straight alpha, of a drawing as it is; the reference is slow and less exact."""
    with Renderer(scene, threads, rasteriser=rasteriser) as renderer:
        return renderer.draw_drawing(drawing)
