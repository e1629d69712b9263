"""From a face, a pose and a scene to a picture."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from types import TracebackType
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Face, Mesh, MienError, Pose, RangeError, Scene, UnknownNameError, fill_rows, subdivide
from mien.core.sparse import SparseMatrix

from . import lighting, placing, reference, refining, spans
from .camera import FAR_OUT, NEAR_M, SUBPIXELS, Camera
from .drawing import draw_drawing
from .pixels import background_rows, resolve, srgb_tables, straight
from .plan import Plan
from .shade import Shades, own_normals
from .triangles import Placed, Triangles, make_triangles

Picture = NDArray[np.uint8]
Rasteriser = Literal["compiled", "reference"]

RASTERISERS: tuple[Rasteriser, ...] = ("compiled", "reference")

BAND_ROWS = 16
"""Rows of samples in a band. Four planes of 16 x 2048 numbers, 512 KB, still fit a processor core's own cache."""


class Renderer:
    """Draws frame after frame of one scene and keeps its threads and buffers in between: one frame at a time.

    Attributes:
        scene: what is drawn.
        threads: how many share the bands out; the picture does not depend on it.
        samples: 1, or 4 samples a pixel, averaged in linear light.
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
        self._oversampling = 2 if samples == 4 else 1
        self._camera = Camera.of(scene, self._oversampling)
        self._behind = background_rows(scene)
        self._pool = ThreadPoolExecutor(threads - 1) if threads > 1 else None
        self._rows: list[NDArray[np.float32]] = []
        self._edges, self._planes = np.empty((0, 10), dtype=np.int64), np.empty((0, 5, 3))

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
            return draw_drawing(shape, self.scene)
        return self.draw_mesh(self.refine(shape))

    def refine(self, mesh: Mesh) -> Mesh:
        """The mesh subdivided as the scene asks, by compiled code on all threads; ``core.subdivide`` to the bit."""
        plain = self._rasteriser == "reference"
        return subdivide(mesh, self.scene.subdivide, SparseMatrix.apply if plain else self._multiply)

    def draw_mesh(self, mesh: Mesh) -> Picture:
        """(H, W, 4) sRGB picture, straight alpha, of a mesh as it is."""
        if not (np.isfinite(mesh.points).all() and np.isfinite(mesh.colors).all()):
            raise MienError("a mesh to be drawn has a point or a colour that is not a finite number")
        if self._rasteriser == "reference":
            triangles = make_triangles(mesh, self.scene, self._camera)
            samples, covered = reference.rasterise(triangles, self._camera.width, self._camera.height)
            return resolve(samples, covered, self._behind, self._oversampling)
        return self._rasterise(make_triangles(mesh, self.scene, self._camera, self._light, self._place))

    def _light(self, mesh: Mesh, points: NDArray[np.float64], plan: Plan, scene: Scene) -> Shades:
        """What ``shade.light_mesh`` says, by compiled code on all threads."""
        topology = mesh.topology
        polygons, nodes, shades = topology.polygon_count, len(plan.vertex), len(plan.lit)
        normals, facing = np.empty((polygons, 3)), np.empty(polygons, dtype=np.bool_)
        places = (points, topology.corners, topology.starts)
        viewer = np.array([*scene.position, scene.gloss])
        self._share(lighting.sum_normals, [(*places, a, b, normals, facing, viewer) for a, b in self._parts(polygons)])
        own = own_normals(mesh) if len(plan.round) else normals
        lamps = np.array([[*lamp.position, *lamp.color, lamp.wrap] for lamp in scene.lamps]).reshape(-1, 7)
        settings = (own, lamps, np.array(scene.ambient), viewer, scene.cosine_power, *plan.columns)
        sums = (plan.normal_sum.starts, plan.normal_sum.columns)
        diffuse, highlight = np.empty((shades, 3)), np.empty((shades, 3))
        self._share(
            lighting.light_nodes,
            [(*places, normals, *settings, *sums, a, b, diffuse, highlight) for a, b in self._parts(nodes)],
        )
        return Shades(diffuse, highlight, facing)

    def _place(self, points: NDArray[np.float64], plan: Plan, camera: Camera) -> Placed:
        """What ``triangles.place_mesh`` says, by compiled code."""
        count, triangles = len(points), plan.triangles.shape[1]
        view, inverse = np.empty((count, 3)), np.empty(count)
        codes, places = np.empty(count, dtype=np.uint8), np.empty((count, 2), dtype=np.int32)
        axes = np.array([camera.right, camera.up, camera.forward])
        settings = np.array([camera.scale, camera.width, camera.height, NEAR_M, SUBPIXELS, FAR_OUT])
        constant = (points, axes, np.array(camera.position), settings)
        self._share(
            placing.place_points, [(*constant, a, b, view, codes, places, inverse) for a, b in self._parts(count)]
        )
        whole, cut = np.empty(triangles, dtype=np.int64), np.empty(triangles, dtype=np.int64)
        corners = np.empty((triangles, 3), dtype=np.int32)
        counts = np.empty(2, dtype=np.int64)
        placing.sort_out(plan.triangles, codes, places, plan.triangle_two_sided, whole, corners, cut, counts)
        seen, crossing = counts
        return Placed(view, places, inverse, whole[:seen], corners[:seen], cut[:crossing])

    def _multiply(self, matrix: SparseMatrix, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """What ``SparseMatrix.apply`` says of values (C, 3)."""
        rows, _ = matrix.shape
        out = np.empty((rows, 3))
        entries = (matrix.starts, matrix.columns, matrix.weights, np.ascontiguousarray(values))
        self._share(refining.multiply_rows, [(*entries, a, b, out) for a, b in self._parts(rows)])
        return out

    def _parts(self, count: int) -> list[tuple[int, int]]:
        """0:count in as many runs as there are threads."""
        ends = [count * k // self.threads for k in range(self.threads + 1)]
        return list(pairwise(ends))

    def _rasterise(self, triangles: Triangles) -> Picture:
        width, height = self.scene.size_px
        raster_height, n = self._camera.height, self._oversampling
        count = len(triangles.corners)
        if len(self._edges) < count:
            # Some more than asked: the number of triangles that face the viewer changes from frame to frame.
            room = count + count // 8
            self._edges, self._planes = np.empty((room, 10), dtype=np.int64), np.empty((room, 5, 3))
        edges, planes = self._edges[:count], self._planes[:count]
        soup = (triangles.places, triangles.inverse, triangles.corners, triangles.colors, triangles.color_of)
        self._share(spans.set_up, [(*soup, a, b, edges, planes) for a, b in self._parts(count)])
        counts = np.zeros(-(-raster_height // BAND_ROWS) + 1, dtype=np.int64)
        spans.count_bands(edges, raster_height, BAND_ROWS, counts)
        members = np.empty(int(counts[-1]), dtype=np.int64)
        spans.sort_bands(edges, raster_height, BAND_ROWS, counts.copy(), members)

        if not self._rows:
            self._rows = [np.empty((4, BAND_ROWS * width * n), dtype=np.float32) for _ in range(self.threads)]
        picture = np.empty((height, width), dtype=np.uint32)
        plain = straight(self._behind).view(np.uint32).reshape(-1)
        frame = (edges, planes, counts, members)
        self._share(
            spans.draw_bands,
            [
                (
                    k,
                    self.threads,
                    BAND_ROWS,
                    n,
                    *frame,
                    self._rows[k],
                    np.empty((4, width), dtype=np.float32),
                    np.empty((4, width), dtype=np.uint8),
                    self._behind,
                    plain,
                    *srgb_tables(),
                    picture,
                )
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
