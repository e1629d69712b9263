"""Pictures, models and pages of faces."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from mien.core import (
    Drawing,
    Face,
    Mesh,
    MienError,
    Pose,
    Scene,
    fill_rows,
    subdivide,
)
from mien.formats.notes import notes
from mien.formats.performances import PUPPET_SCENE, default_threads

from .faces import DEFAULT_FACE, default_scene, resolve

if TYPE_CHECKING:
    from mien.formats.glb import Puppet
    from mien.formats.obj import Model
    from mien.formats.picture import Picture
    from mien.formats.svg import VectorPicture


def draw(
    face: Face | str = DEFAULT_FACE,
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
    *,
    without: Collection[str] = (),
    threads: int | None = None,
) -> Picture:
    """A picture of a face: it can be written, and shows itself in a notebook.

    Args:
        face: a face or its address.
        pose: a pose of it, or the values that differ from neutral.
        scene: where it is seen from, light, size; None is ``default_scene``.
        without: parts to leave out, as ``hair`` or ``eye.left``.
        threads: None is one a core; the picture does not depend on it.

    Raises:
        UnknownNameError: a part to be left out is not there.
    """
    from mien.formats.picture import Picture
    from mien.render import draw as draw_pixels
    from mien.render import draw_mesh

    face, pose = resolve(face, pose)
    scene, threads = scene or default_scene(face), threads or default_threads()
    if without:
        mesh = _posed_mesh(face, pose, scene)
        return Picture(draw_mesh(mesh.without(without), scene, threads=threads), notes(face.name))
    return Picture(draw_pixels(face, pose, scene, threads=threads), notes(face.name))


def draw_paths(
    face: Face | str = DEFAULT_FACE,
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
) -> VectorPicture:
    """A picture made of filled paths, one shade a polygon: written as SVG it is sharp at every size.

    Args:
        face: a face or its address.
        pose: a pose of it, or the values that differ from neutral.
        scene: as for ``draw``; None is ``default_scene`` with one step of subdivision.
    """
    from mien.formats.svg import VectorPicture
    from mien.render.painting import paint_mesh

    face, pose = resolve(face, pose)
    scene = scene or replace(default_scene(face), subdivide=1)
    shape = _posed(face, pose, scene)
    if isinstance(shape, Drawing):
        return VectorPicture(shape, scene, notes=notes(face.name))
    return VectorPicture(paint_mesh(shape, scene), scene, polygons=True, notes=notes(face.name))


def make_model(
    face: Face | str = DEFAULT_FACE,
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
) -> Model:
    """The posed mesh of a face, to be written as OBJ.

    Args:
        face: a face or its address.
        pose: a pose of it, or the values that differ from neutral.
        scene: says how often the mesh is subdivided, and where the eyes look; None as for ``draw``.

    Raises:
        MienError: the face is a flat drawing and has no mesh.
    """
    from mien.formats.obj import Model

    face, pose = resolve(face, pose)
    return Model(_posed_mesh(face, pose, scene or default_scene(face)), notes(face.name))


def make_puppet(
    face: Face | str = DEFAULT_FACE,
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
) -> Puppet:
    """A face that other programs can play, to be written as ``.glb``: its mesh, morph targets and joints.

    Args:
        face: a face or its address.
        pose: what it looks like while no target acts, or the values that differ from neutral.
        scene: says how often the mesh is subdivided, and where the eyes look; None is once, and ahead.

    Raises:
        MienError: the face is a flat drawing, has no joints, or no table for the names of the targets.
    """
    from mien.formats.glb import Puppet
    from mien.formats.glb_targets import Anatomy, check_face

    face, pose = resolve(face, pose)
    scene = scene or PUPPET_SCENE
    check_face(face)
    return Puppet(Anatomy(face, fill_rows(face, pose, scene), scene.subdivide), notes(face.name))


def sheet(
    face: Face | str = DEFAULT_FACE,
    kind: str = "presets",
    pose: Pose | Mapping[str, float] | None = None,
    scene: Scene | None = None,
    *,
    threads: int | None = None,
    report: Callable[[int, int], None] | None = None,
) -> Picture:
    """A page of labelled pictures of a face, made from its own tables.

    Args:
        face: a face or its address.
        kind: ``presets``, ``parameters`` at the ends of their ranges, ``views``, or a vocabulary such as ``facs``.
        pose: what every picture starts from, or the values that differ from neutral.
        scene: light, shading, size of one picture, where it is seen from; None is a near view, 256 pixels wide.
        threads: None is one a core; the picture does not depend on it.
        report: told (done, total) pictures.

    Raises:
        UnknownNameError: there is no such kind.
        MienError: there is nothing to show, or the page would be too large.
    """
    from mien.formats.face_sheets import make_sheet

    face, pose = resolve(face, pose)
    return make_sheet(face, kind, pose, scene, threads=threads or default_threads(), report=report)


def _posed(face: Face, pose: Pose, scene: Scene) -> Mesh | Drawing:
    """What a scene shows of a face: rows at rest filled from the scene, subdivided as it asks."""
    shape = (face if scene.subdivide else face.unsubdivided).shape(fill_rows(face, pose, scene))
    return shape if isinstance(shape, Drawing) else subdivide(shape, scene.subdivide)


def _posed_mesh(face: Face, pose: Pose, scene: Scene) -> Mesh:
    shape = _posed(face, pose, scene)
    if isinstance(shape, Drawing):
        raise MienError(f"{face.name}: is a flat drawing and has no mesh — write it as .svg")
    return shape
