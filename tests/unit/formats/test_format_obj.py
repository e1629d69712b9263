"""Meshes as OBJ, read back by a reader of a dozen lines."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from small_face import SmallFace

import mien
from mien.core import Drawing, Material, Mesh, MienError, build_topology
from mien.formats.notes import notes
from mien.formats.obj import Model


def read_obj(text: str) -> tuple[np.ndarray, np.ndarray, dict[str, list[list[tuple[int, int]]]]]:
    """Points with colours (V, 6), normals (N, 3), and polygons by group as (point, normal) numbers from 0."""
    points, normals, groups = [], [], {}
    for line in text.splitlines():
        key, *rest = line.split()
        if key == "v":
            points.append([float(number) for number in rest])
        elif key == "vn":
            normals.append([float(number) for number in rest])
        elif key == "g":
            polygons = groups.setdefault(rest[0], [])
        elif key == "f":
            polygons.append([tuple(int(number) - 1 for number in corner.split("//")) for corner in rest])
        else:
            assert key == "#"
    return np.array(points), np.array(normals), groups


def two_squares(colors: np.ndarray, **more: object) -> Mesh:
    """Two squares that share an edge, the second folded back by a right angle."""
    points = np.array([[0.0, 0, 0], [0.1, 0, 0], [0.1, 0.1, 0], [0, 0.1, 0], [0.1, 0, -0.1], [0.1, 0.1, -0.1]])
    corners = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
    return Mesh(build_topology(6, [("skin", corners, Material(**more))]), points, colors)  # type: ignore[arg-type]


def test_a_head_comes_back_within_a_micrometre() -> None:
    model = mien.make_model("head", {"jaw.rotation": 8.0}, mien.Scene(subdivide=0))
    points, normals, groups = read_obj(model.to_obj())
    mesh = model.mesh
    topology = mesh.topology
    assert list(groups) == [part.name for part in topology.parts]
    for part in topology.parts:
        polygons = groups[part.name]
        assert len(polygons) == part.last - part.first
        for number, polygon in enumerate(polygons, start=part.first):
            want = mesh.points[topology.polygon(number)]
            np.testing.assert_allclose(points[[corner for corner, _ in polygon], :3], want, atol=0.51e-6)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=2e-4)


def test_normals_point_out_of_the_front() -> None:
    points, normals, groups = read_obj(mien.make_model("head", scene=mien.Scene(subdivide=0)).to_obj())
    skin = groups["skin"]
    facing = []
    for polygon in skin:
        a, b, c = (points[corner, :3] for corner, _ in polygon[:3])
        facing.append(np.dot(np.cross(b - a, c - a), sum(normals[normal] for _, normal in polygon)) > 0)
    assert np.mean(facing) > 0.99


def test_colours_of_points_are_srgb() -> None:
    half = np.full((6, 3), 0.5)
    points, _, _ = read_obj(Model(two_squares(half)).to_obj())
    np.testing.assert_allclose(points[:, 3:], 188 / 255, atol=1e-4)


def test_polygons_of_two_colours_do_not_bleed_into_one_another() -> None:
    points, _, groups = read_obj(Model(two_squares(np.array([[1.0, 0, 0], [0, 0, 1.0]]))).to_obj())
    assert len(points) == 8  # the two shared points come in both colours
    for polygon, want in zip(groups["skin"], ([1, 0, 0], [0, 0, 1]), strict=True):
        assert [points[corner, 3:].tolist() for corner, _ in polygon] == [want] * 4


def test_smooth_parts_share_normals_and_flat_ones_do_not() -> None:
    _, smooth, groups = read_obj(Model(two_squares(np.zeros((6, 3)))).to_obj())
    fold = next(normal for corner, normal in groups["skin"][0] if corner == 1)
    np.testing.assert_allclose(smooth[fold], [np.sqrt(0.5), 0, np.sqrt(0.5)], atol=1e-4)
    _, flat, groups = read_obj(Model(two_squares(np.zeros((6, 3)), flat=True)).to_obj())
    first, second = (flat[polygon[0][1]] for polygon in groups["skin"])
    np.testing.assert_allclose([first, second], [[0, 0, 1], [1, 0, 0]], atol=1e-4)


def test_round_parts_bring_their_own_normals() -> None:
    mesh = two_squares(np.zeros((6, 3)), round=True)
    mesh = Mesh(mesh.topology, mesh.points, mesh.colors, np.tile([0.0, 1.0, 0.0], (6, 1)))
    _, normals, groups = read_obj(Model(mesh).to_obj())
    assert all(normals[normal].tolist() == [0, 1, 0] for polygon in groups["skin"] for _, normal in polygon)


def test_polygons_without_area_have_a_normal_nonetheless() -> None:
    mesh = two_squares(np.zeros((6, 3))).moved(np.zeros((6, 3)))
    _, normals, _ = read_obj(Model(mesh).to_obj())
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)


def test_the_file_says_what_made_it(tmp_path: Path) -> None:
    Model(two_squares(np.zeros((6, 3))), notes("head")).write(tmp_path / "a.obj")
    head = [line for line in (tmp_path / "a.obj").read_text().splitlines() if line.startswith("#")]
    assert "# Face: head" in head
    assert any("Synthetic" in line for line in head)
    assert any("Metres" in line and "sRGB" in line for line in head)


def test_numbers_that_are_not_finite_are_refused_and_nothing_written(tmp_path: Path) -> None:
    with pytest.raises(MienError, match="not a finite number"):
        Model(two_squares(np.full((6, 3), np.nan))).write(tmp_path / "a.obj")
    assert list(tmp_path.iterdir()) == []


class FlatFace(SmallFace):
    def shape(self, pose: object) -> Drawing:
        return Drawing((1.0, 1.0), ())


def test_a_flat_face_has_no_mesh() -> None:
    with pytest.raises(MienError, match=r"flat drawing and has no mesh — write it as \.svg"):
        mien.make_model(FlatFace())


def test_a_flat_face_becomes_paths_without_seams() -> None:
    picture = mien.draw_paths(FlatFace(), scene=mien.Scene(size_px=(8, 8)))
    assert not picture.polygons
    assert picture.drawing.paths == ()
