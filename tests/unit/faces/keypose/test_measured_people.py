"""The people that ship, measured on photographs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import binary_erosion

from mien.core import Mesh, Pose, Scene
from mien.faces.keypose.shipped import keypose_names, shipped_keypose
from mien.faces.keypose.standard import standard_phases
from mien.render import Renderer

PEOPLE = ("hugo", "vera")
MOUTHS = {"smile", "open", "pucker", "brows_up", "brows_down", "blink", "aei", "ou", "fv", "pbm"}
FRONT = Scene(size_px=(160, 160))


def posed(name: str, **weights: float) -> Mesh:
    """A person in a mixture of phases."""
    face = shipped_keypose(name)
    names = {
        each: weight
        for phase, weight in weights.items()
        for each in (f"phase.{phase}", f"phase.{phase}.left", f"phase.{phase}.right")
        if each in face.parameters
    }
    return face.shape(Pose.neutral(face.parameters).replace(names))


def seen_of(mesh: Mesh, part: str) -> int:
    """Pixels from the front that show a part."""
    run = mesh.topology.part(part)
    return int(pixels_of(mesh, np.arange(run.first, run.last)).sum())


def pixels_of(mesh: Mesh, polygons: np.ndarray, seen: Scene = FRONT) -> np.ndarray:
    """(height, width) whether a pixel shows one of the polygons."""
    shown = np.zeros((mesh.topology.polygon_count, 3))
    shown[polygons] = 1.0
    scene = replace(seen, background=((0.0, 0.0, 0.0, 1.0),) * 2, gloss=0.0)
    with Renderer(scene, samples=1) as renderer:
        picture = renderer.draw_mesh(renderer.refine(replace(mesh, colors=shown, by_polygon=True)))
    return np.asarray(picture[..., 0] > 20)


def lining(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Polygons of the mouth's lining, dark and below the nostrils; other skin; points of the lining alone."""
    topology, run = mesh.topology, mesh.topology.part("skin")
    skin = np.arange(run.first, run.last)
    corners = [topology.polygon(polygon) for polygon in skin]
    dark = mesh.colors[skin] @ [0.3, 0.6, 0.1] < 0.1
    dark &= [mesh.points[each, 1].mean() < -0.0455 for each in corners]
    inside, outside = (
        {int(point) for each, mine in zip(corners, dark, strict=True) if mine == which for point in each}
        for which in (True, False)
    )
    return skin[dark], skin[~dark], np.array(sorted(inside - outside))


@pytest.mark.parametrize("view", ["three-quarter", "side"])
@pytest.mark.parametrize("phase", ["open", "aei", "ou", "smile"])
@pytest.mark.parametrize("name", PEOPLE)
def test_the_lining_of_the_mouth_does_not_come_through_the_skin(name, phase, view):
    mouth, skin, inner = lining(posed(name))
    assert len(mouth) > 30
    mesh = posed(name, **{phase: 1.0})
    points = mesh.points.copy()
    middle = points[inner].mean(axis=0) - [0.0, 0.0, 0.02]
    points[inner] = middle + 0.3 * (points[inner] - middle)
    seen = Scene(size_px=(400, 400)).seen(view)
    covered = binary_erosion(pixels_of(replace(mesh, points=points), skin, seen), iterations=9)
    assert int((pixels_of(mesh, mouth, seen) & covered).sum()) <= 3, "hairlines apart"


def test_a_woman_and_a_man_ship():
    assert set(PEOPLE) <= set(keypose_names())


@pytest.mark.parametrize("name", PEOPLE)
def test_they_have_the_phases_that_speech_and_expressions_need(name):
    phases = shipped_keypose(name).keypose.phases
    assert phases[0] == "neutral"
    assert set(phases) >= MOUTHS
    assert set(phases) <= set(standard_phases())


@pytest.mark.parametrize("name", PEOPLE)
def test_a_blink_hides_the_eyes(name):
    rest, shut = seen_of(posed(name), "eyes"), seen_of(posed(name, blink=1.0), "eyes")
    assert rest > 40
    assert shut <= 0.06 * rest


@pytest.mark.parametrize("name", PEOPLE)
def test_teeth_show_in_an_open_mouth_and_not_at_rest(name):
    assert seen_of(posed(name), "teeth") <= 1
    assert seen_of(posed(name, pbm=1.0), "teeth") <= 1
    assert seen_of(posed(name, aei=1.0), "teeth") > 10


@pytest.mark.parametrize("name", PEOPLE)
def test_an_open_mouth_is_no_empty_hole(name):
    rest, wide = posed(name), posed(name, open=1.0)
    assert seen_of(rest, "tongue") == 0
    assert seen_of(wide, "tongue") > 15
    assert seen_of(wide, "teeth") > 2


@pytest.mark.parametrize("name", PEOPLE)
def test_heads_do_not_swim(name):
    face = shipped_keypose(name).keypose
    high = face.places[0][:, 1] > 0.07
    for phase, places in zip(face.phases, face.places, strict=True):
        off_mm = 1000.0 * np.linalg.norm(places[high] - face.places[0][high], axis=1)
        assert np.median(off_mm) < 0.5, phase


@pytest.mark.parametrize("name", PEOPLE)
def test_they_are_as_large_as_people(name):
    face = shipped_keypose(name)
    skin = face.shape(Pose.neutral(face.parameters)).part_vertices("eyes")
    eyes = face.keypose.eyes
    assert eyes is not None
    assert len(skin)
    assert 0.055 < 2.0 * eyes.center[0] < 0.070
