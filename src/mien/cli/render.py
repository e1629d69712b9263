"""``mien render``: a picture of one pose, its mesh, or a labelled page of many."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from . import options

if TYPE_CHECKING:
    from pathlib import Path

    from mien.core import Face, Pose, Scene

    from .stages import Stages

MESHES = ("obj", "glb")
"""Formats that are no pictures."""


def render(
    face: options.FaceName,
    out: options.Out,
    phase: options.Phase = None,
    values: options.Sets = None,
    preset: options.Presets = None,
    units: options.Units = None,
    mix: options.Mix = None,
    person: options.Random = None,
    caricature: options.Caricature = 1.0,
    exaggerate: options.Exaggerate = 1.0,
    sheet: options.Sheet = None,
    size: options.Size = None,
    view: options.View = None,
    position: options.From = None,
    at: options.At = None,
    fov: options.Fov = None,
    shading: options.Shading = None,
    subdivide: options.Subdivide = None,
    background: options.Background = None,
    light: options.Light = None,
    diffuse: options.Diffuse = None,
    cosine_power: options.CosinePower = None,
    threads: options.Threads = None,
    quiet: options.Quiet = False,
) -> None:
    """Draw one pose of a face: .png, .jpg, .svg (one shade a polygon), its mesh: .obj, or a puppet: .glb.

    An SVG and a puppet are subdivided once, and pictures on a sheet are 256 pixels wide, unless you say otherwise.

    \b
    mien render head --set jaw.rotation=8 -o open.png
    mien render head --preset smile=0.6 --view side --size 512 -o smile.jpg
    mien render head --au 12=0.8,6=0.5 -o happy.png
    mien render head --preset sad --exaggerate 2 -o very_sad.png
    mien render head:ada --caricature 1.8 -o more_ada.png
    mien render head --random 7 --mix head:ada=0.3 -o someone.png
    mien render head:ada -o ada.glb
    mien render head --background transparent -o cutout.svg
    mien render head:parke1974 --light parke --diffuse 0.2 --cosine-power 2 -o plate.png
    mien render ada.keypose --phase 2.5 -o half_a_smile.png
    mien render toon:olav --preset thumbs_up --set ELU=0 -o olav.png
    mien render head --sheet presets -o presets.png
    mien render head --sheet facs --size 192 -o action_units.png
    """
    from mien import api
    from mien.core import Drawing, MienError
    from mien.core import exaggerate as exaggerate_pose
    from mien.formats.atomic import check_file

    from . import settings
    from .stages import Stages, format_time

    kind = _find_kind(out, sheet, view or position)
    check_file(out)
    subject = api.load_face(face)
    scene = settings.make_scene(
        _usual_scene(out, kind, sheet, subject),
        size=size,
        view=view,
        position=position,
        at=at,
        fov=fov,
        shading=shading,
        subdivide=subdivide,
        background=background,
        light=light,
        diffuse=diffuse,
        cosine_power=cosine_power,
    )
    settings.check_threads(threads)
    if phase is not None:
        if "phase" not in subject.parameters:
            raise MienError(f"--phase {phase:g}: {face} is not made of measured phases — keypose:… are")
        values = [f"phase={phase!r}", *(values or ())]
    pose = exaggerate_pose(settings.make_pose(subject, values, preset, units, mix, person, caricature), exaggerate)
    stages = Stages(quiet)
    if kind == "svg" and scene.shading not in ("polygon", "wire") and shading is not None:
        stages.say(f"{out}: an SVG has one shade a polygon; only pixels can be smooth")
    if kind in MESHES:
        pixels = {"--size": size, "--background": background, "--shading": shading, "--threads": threads}
        if unused := [option for option, given in pixels.items() if given is not None]:
            stages.say(f"{out}: a mesh has no pixels, so nothing is done about {', '.join(unused)}")
    elif sheet is None and isinstance(subject.shape(subject.neutral), Drawing):
        space = {
            "--view": view, "--from": position, "--at": at, "--fov": fov, "--shading": shading,
            "--subdivide": subdivide, "--light": light, "--diffuse": diffuse, "--cosine-power": cosine_power,
        }  # fmt: skip
        if pose["gaze.compensation"] > 0.0:  # Head and eyes then obey where the viewer stands.
            del space["--view"], space["--from"]
        if unused := [option for option, given in space.items() if given is not None]:
            stages.say(f"{face}: is a drawing, which no camera or light changes: no outline obeys {', '.join(unused)}")
    what = _write(out, kind, sheet, subject, pose, scene, threads, stages)
    stages.say(f"{out}: {what}; done in {format_time(stages.elapsed_s)}")


def _find_kind(out: Path, sheet: str | None, direction: str | None) -> str:
    """Name of the format of a picture or a sheet."""
    from mien.core import MienError
    from mien.formats.table import find_format

    kind = find_format(out, "picture").name
    if sheet is not None and "pixels" not in find_format(out, "picture").holds:
        raise MienError(f"{out}: a sheet is made of pixels — end the name in .png or .jpg")
    if sheet == "views" and direction is not None:
        raise MienError(f"--sheet views shows the face from all sides, not from {direction} — leave that out")
    return kind


def _usual_scene(out: Path, kind: str, sheet: str | None, face: Face) -> Scene:
    from mien import api
    from mien.formats.performances import usual_scene

    if sheet is not None:
        from mien.formats.face_sheets import sheet_scene

        return sheet_scene(sheet, face)
    usual = api.default_scene(face)
    return replace(usual, subdivide=1) if kind == "svg" else usual_scene(out, usual)


def _write(
    out: Path,
    kind: str,
    sheet: str | None,
    face: Face,
    pose: Pose,
    scene: Scene,
    threads: int | None,
    stages: Stages,
) -> str:
    """Writes it; what it was."""
    from mien import api

    from .writing import prepare

    if kind == "svg":
        paths = api.draw_paths(face, pose, scene)
        paths.write(out)
        return f"{len(paths.drawing.paths)} paths"
    if kind == "obj":
        model = api.make_model(face, pose, scene)
        model.write(out)
        return f"{model.mesh.topology.polygon_count} polygons"
    if kind == "glb":
        puppet = api.make_puppet(face, pose, scene)
        puppet.write(out)
        return f"{len(puppet.anatomy.names)} morph targets"
    prepare(stages)
    if sheet is None:
        picture = api.draw(face, pose, scene, threads=threads)
    else:
        with stages.progress("drawing") as report:
            picture = api.sheet(face, sheet, pose, scene, threads=threads, report=report)
    picture.write(out)
    return "{}x{} pixels".format(*picture.size_px)
