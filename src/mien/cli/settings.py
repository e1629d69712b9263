"""From the texts of options to values, poses and scenes."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

from mien.core import Face, MienError, Pose, RangeError, Scene, UnknownNameError, exact
from mien.core.drawing import Rgba
from mien.core.scene import VIEWS, Vector
from mien.formats.rates import check_rate
from mien.timeline import Rate

THREADS_HIGH = 256
LIGHTS = ("studio", "parke")


def parse_values(texts: Sequence[str] | None) -> dict[str, float]:
    """Values by name, from texts such as ``jaw.rotation=8``.

    Raises:
        MienError: a text is not of that form.
    """
    values = {}
    for text in texts or ():
        name, equals, number = text.partition("=")
        if not (name and equals):
            raise MienError(f"--set {text}: want NAME=VALUE, as in --set jaw.rotation=8")
        values[name.strip()] = parse_number(number, f"--set {text}")
    return values


def parse_presets(texts: Sequence[str] | None) -> dict[str, float]:
    """How much of each preset, from texts such as ``smile`` or ``smile=0.6``.

    Raises:
        MienError: a text is not of that form.
    """
    return dict(_name_and_amount(text, "--preset") for text in texts or ())


def parse_emotion(text: str | None) -> tuple[str | None, float]:
    """Name and amount, from ``sad`` or ``sad=0.6``.

    Raises:
        MienError: the text is not of that form.
    """
    return (None, 1.0) if text is None else _name_and_amount(text, "--emotion")


def parse_mix(texts: Sequence[str] | None) -> dict[str, float]:
    """Shares of other people by address, from texts such as ``head:ada=0.3``.

    Raises:
        MienError: a text is not of that form.
    """
    shares = {}
    for text in texts or ():
        name, equals, number = text.rpartition("=")
        if not (name and equals):
            raise MienError(f"--mix {text}: want FACE=SHARE, as in --mix head:ada=0.3")
        if name.strip() in shares:
            raise MienError(f"--mix {text}: {name.strip()} is mixed in already — give one share of each person")
        shares[name.strip()] = parse_number(number, f"--mix {text}")
    return shares


def make_pose(
    face: Face,
    values: Sequence[str] | None,
    presets: Sequence[str] | None,
    units: Sequence[str] | None,
    mix: Sequence[str] | None = None,
    seed: int | None = None,
    caricature: float = 1.0,
) -> Pose:
    """The pose of a face that ``--random``, ``--mix``, ``--caricature``, ``--preset``, ``--au`` and ``--set`` ask for,
    in this order.

    Raises:
        MienError: one of them cannot be understood, is unknown or out of range.
    """
    from mien import api
    from mien.vocab.facs import parse_units

    given = {name: amount for text in units or () for name, amount in parse_units(text, f"--au {text}").items()}
    return api.make_pose(
        face,
        parse_values(values),
        presets=parse_presets(presets),
        units=given,
        mix=parse_mix(mix),
        seed=seed,
        caricature=caricature,
    )


def parse_size(text: str) -> tuple[int, int]:
    """(width, height), from ``1024`` or ``1280x720``."""
    sides = text.lower().split("x")
    if len(sides) not in (1, 2) or not all(side.strip().isdecimal() for side in sides):
        raise MienError(f"--size {text}: want one side or two, as in --size 1024 or --size 1280x720")
    return int(sides[0]), int(sides[-1])


def parse_rate(text: str) -> Rate:
    """Frames a second, from ``24``, ``23.976`` or ``30000/1001``.

    Raises:
        MienError: it is none of these, or not from 1 to 240.
    """
    try:
        rate = Fraction(text) if "/" in text else parse_number(text, f"--fps {text}")
    except (ValueError, ZeroDivisionError):
        raise MienError(f"--fps {text}: want a number or a fraction, as in --fps 29.97 or --fps 30000/1001") from None
    check_rate(rate)
    return rate


def parse_vector(text: str, option: str) -> Vector:
    """(x, y, z), from ``0.2,0,1.1``."""
    numbers = text.split(",")
    if len(numbers) != 3:
        raise MienError(f"{option} {text}: want three numbers, as in {option} 0.2,0,1.1")
    x, y, z = (parse_number(number, f"{option} {text}") for number in numbers)
    return x, y, z


def parse_background(text: str) -> tuple[Rgba, Rgba]:
    """Linear colours at the bottom and at the top, from ``white``, ``#336699``, ``transparent`` or two with a colon."""
    colors = text.split(":")
    if len(colors) > 2:
        raise MienError(f"--background {text}: want one colour, or two as bottom:top")
    return _color(colors[0]), _color(colors[-1])


def make_scene(
    scene: Scene,
    *,
    size: str | None = None,
    view: str | None = None,
    position: str | None = None,
    at: str | None = None,
    fov: float | None = None,
    shading: str | None = None,
    subdivide: int | None = None,
    background: str | None = None,
    light: str | None = None,
    diffuse: float | None = None,
    cosine_power: int | None = None,
) -> Scene:
    """The scene with what the options say; None leaves it as it is.

    Raises:
        MienError: an option cannot be understood, is unknown or out of range.
    """
    if view is not None and position is not None:
        raise MienError(f"--view {view} and --from {position} both say where the camera stands — leave one out")
    if view is not None and view not in VIEWS:
        raise UnknownNameError("view", view, VIEWS)
    changes: dict[str, object] = {
        "size_px": None if size is None else parse_size(size),
        "at": None if at is None else parse_vector(at, "--at"),
        "position": None if position is None else parse_vector(position, "--from"),
        "fov_deg": fov,
        "shading": shading,
        "subdivide": subdivide,
        "background": None if background is None else parse_background(background),
        "cosine_power": cosine_power,
    }
    scene = replace(scene, **_lighting(light, diffuse))  # type: ignore[arg-type]
    scene = replace(scene, **{key: value for key, value in changes.items() if value is not None})  # type: ignore[arg-type]
    return scene if view is None else scene.seen(view)


def _lighting(light: str | None, diffuse: float | None) -> dict[str, object]:
    """The fields of a scene that a light by name decides; none without a name."""
    if diffuse is not None and light != "parke":
        raise MienError(f"--diffuse {diffuse:g} is of Parke's light alone — add --light parke")
    if light is None:
        return {}
    if light not in LIGHTS:
        raise UnknownNameError("light", light, LIGHTS)
    scene = Scene() if light == "studio" else Scene.parke() if diffuse is None else Scene.parke(diffuse)
    return {name: getattr(scene, name) for name in ("lights", "ambient", "cosine_power", "gloss", "background")}


def check_threads(threads: int | None) -> None:
    """Nothing, when so many threads can be had."""
    if threads is not None and not 1 <= threads <= THREADS_HIGH:
        raise RangeError(f"--threads {threads} is out of range — it goes from 1 to {THREADS_HIGH}")


def read_text(text: str) -> str:
    """What to say: the text itself, of ``@FILE`` what is in the file, of ``-`` what comes on standard input.

    Raises:
        MienError: the file cannot be read, is not UTF-8, or there is nothing to say.
    """
    place = {"-": "standard input", "@": text[1:] or text}.get(text if text == "-" else text[:1], "the text")
    try:
        if text == "-":
            text = sys.stdin.buffer.read().decode("utf-8-sig")
        elif text.startswith("@"):
            text = Path(text[1:]).read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise MienError(f"{place}: is not UTF-8 text (byte {error.start}) — save it as a text file in UTF-8") from None
    except OSError as error:
        raise MienError(
            f"{place}: cannot be read ({error.strerror}) — after @ comes the name of a text file; words that begin "
            "with @ can be said from standard input: mien say -"
        ) from error
    if not text.strip():
        raise MienError(f'{place} is empty — give something to say, as in mien say "Hello there." -o hello.mp4')
    return text


def _name_and_amount(text: str, option: str) -> tuple[str, float]:
    name, equals, number = text.partition("=")
    return name.strip(), parse_number(number, f"{option} {text}") if equals else 1.0


def parse_number(text: str, place: str) -> float:
    """A number; ``place`` is told where it is none."""
    try:
        return float(text)
    except ValueError:
        raise MienError(f"{place}: {text!r} is not a number") from None


def _color(text: str) -> Rgba:
    from PIL import ImageColor

    if text.strip().lower() == "transparent":
        return 0.0, 0.0, 0.0, 0.0
    try:
        red, green, blue, alpha = ImageColor.getcolor(text.strip(), "RGBA")  # type: ignore[misc]
    except ValueError:
        raise _unknown_color(text) from None
    if max(red, green, blue) > 255:
        raise MienError(f"--background {text}: want red, green and blue from 0 to 255")
    return _linear(red), _linear(green), _linear(blue), round(alpha / 255.0, 6)


def _unknown_color(text: str) -> MienError:
    from PIL import ImageColor

    if text.startswith("#"):
        return MienError(f"--background {text}: want # and 3, 6 or 8 hexadecimal digits, as in #336699")
    return UnknownNameError("colour", text, [*ImageColor.colormap, "transparent"])


def _linear(value: int) -> float:
    """Linear light 0..1 of an sRGB byte, to six places."""
    return round(exact.srgb_to_linear(value / 255.0), 6)
