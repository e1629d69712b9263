"""``mien render``: a picture of one pose."""

from __future__ import annotations

from . import options


def render(
    face: options.FaceName,
    out: options.Out,
    values: options.Sets = None,
    preset: options.Presets = None,
    size: options.Size = None,
    view: options.View = None,
    position: options.From = None,
    at: options.At = None,
    fov: options.Fov = None,
    shading: options.Shading = None,
    subdivide: options.Subdivide = None,
    background: options.Background = None,
    threads: options.Threads = None,
    quiet: options.Quiet = False,
) -> None:
    """Draw one pose of a face, as PNG or JPEG.

    \b
    mien render head --set jaw.rotation=8 -o open.png
    mien render head --preset smile --view side --size 512 -o smile.jpg
    mien render head --background transparent -o cutout.png
    """
    from mien import api
    from mien.formats.atomic import check_file
    from mien.formats.table import find_format

    from . import settings
    from .stages import Stages, format_time
    from .writing import prepare

    find_format(out, "picture")
    check_file(out)
    scene = settings.make_scene(
        api.default_scene(),
        size=size,
        view=view,
        position=position,
        at=at,
        fov=fov,
        shading=shading,
        subdivide=subdivide,
        background=background,
    )
    settings.check_threads(threads)
    subject = api.load_face(face)
    pose = api.make_pose(subject, settings.parse_values(values), presets=preset or ())
    stages = Stages(quiet)
    prepare(stages)
    api.draw(subject, pose, scene, threads=threads).write(out)
    stages.say(f"{out}: {scene.size_px[0]}x{scene.size_px[1]} pixels; done in {format_time(stages.elapsed_s)}")
