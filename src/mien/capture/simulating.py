"""Set-ups of which all is known: references, cameras and points of a face, photographed and clicked with errors.

The world is the frame of faces: x to the face's own left, y up, z forward, m, its origin amid the references.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Literal

import numpy as np

from mien.capture.projecting import project, turn
from mien.capture.records import REST, WORLD, Camera, Lens, Observation, Photograph, Reference, Survey
from mien.core.mesh import Points

INCH_M = 0.0254
FILLED = 0.95
"""Share of the picture's width or height that the references fill."""

Noise = Literal["normal", "uniform", "rounded"]


def cube(side_m: float = 10 * INCH_M, count: int = 8) -> tuple[Reference, ...]:
    """References on a cube: its 8 corners, or fewer; beyond 8 also middles of edges, 20 in all.

    Corners are named ``c000`` to ``c111`` (digits of x, y and z), middles ``c0m1``.
    """
    digits = {"0": -0.5, "m": 0.0, "1": 0.5}
    names = sorted(map("".join, product(digits, repeat=3)), key=lambda name: name.count("m"))
    chosen = names[max(8 - count, 0) : max(count, 8)]
    places = {name: [side_m * digits[digit] for digit in name] for name in chosen}
    return tuple(Reference(f"c{name}", x, y, z) for name, (x, y, z) in places.items())


def board(columns: int = 9, rows: int = 6, square_m: float = 0.025, target: str = "board") -> tuple[Reference, ...]:
    """References on a chessboard: its inner corners in a frame of its own, named ``board 0 0`` by column and row."""
    return tuple(
        Reference(f"{target} {column} {row}", column * square_m, row * square_m, 0.0, target=target)
        for row, column in product(range(rows), range(columns))
    )


def scattered(count: int, side_m: float = 10 * INCH_M, seed: int = 0) -> tuple[Reference, ...]:
    """References anywhere in a cube, as surveyed marks are."""
    places = np.random.default_rng(seed).uniform(-0.5 * side_m, 0.5 * side_m, (count, 3))
    return tuple(Reference(f"r{number:02d}", x, y, z) for number, (x, y, z) in enumerate(places.tolist()))


def face_points(count: int, height_m: float = 0.21) -> tuple[Points, Points]:
    """Places (N, 3) and normals (N, 3) of points spread evenly over a front half of a head with a nose."""
    axes = height_m * np.array([0.36, 0.5, 0.42])
    turn = math.pi * (3.0 - math.sqrt(5.0))
    z = (np.arange(count) + 0.5) / count
    radius, angle = np.sqrt(1.0 - z * z), turn * np.arange(count)
    ball = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1)
    nose = 0.12 * height_m * np.exp(-((ball[:, 0] / 0.2) ** 2) - (ball[:, 1] / 0.25) ** 2)
    places = ball * axes - np.array([0.0, 0.0, 0.5 * axes[2]])
    places[:, 2] += nose
    normals = ball / axes
    return places, normals / np.linalg.norm(normals, axis=1, keepdims=True)


@dataclass(frozen=True)
class Setup:
    """What is photographed, from where, and how well it is clicked.

    Attributes:
        references: of the world, and of boards, which are held before the cameras anew at each moment.
        points: how many points of the face.
        views: how many cameras.
        moments: how many times all of it is photographed; the face holds still, boards do not.
        size_px: of each photograph.
        spread_deg: angle between the outermost cameras, seen from the middle of the references.
        distance_m: of the cameras from there.
        k1, k2, p1, p2, aspect: of the lenses.
        off_centre: how far principal points may lie off the middle, as a share of the width.
        one_lens: one camera is carried about; else each view has a camera of its own.
        fixed: cameras stand still from moment to moment.
        noise: how clicks err: normally, evenly within limits, or by being rounded to a grid.
        sigma_px: standard deviation of a click.
        reference_sigma_m: how well the references are surveyed.
        mis_clicks: share of clicks that go wrong, once at most for each point.
        mis_click_sigmas: by how much they do.
        turned_deg: a point whose skin is turned further than this from a camera is hidden from it.
    """

    references: tuple[Reference, ...] = cube()
    points: int = 40
    views: int = 4
    moments: int = 1
    size_px: tuple[int, int] = (4000, 3000)
    spread_deg: float = 90.0
    distance_m: float = 1.5
    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    aspect: float = 1.0
    off_centre: float = 0.0
    one_lens: bool = True
    fixed: bool = False
    noise: Noise = "normal"
    sigma_px: float = 1.0
    reference_sigma_m: float = 0.0
    mis_clicks: float = 0.0
    mis_click_sigmas: float = 15.0
    turned_deg: float = 180.0


@dataclass(frozen=True, eq=False)
class Simulated:
    """A survey and what is true.

    Attributes:
        survey: as it would come from photographs.
        cameras: by name of the photograph.
        places: (3,) m, of points and references, by (moment, name).
        mis_clicks: (photograph, point) of the clicks that went wrong.
    """

    survey: Survey
    cameras: Mapping[str, Camera]
    places: Mapping[tuple[str, str], Points]
    mis_clicks: frozenset[tuple[str, str]]


def simulate(setup: Setup, seed: int) -> Simulated:
    """A survey of that set-up; cameras, clicks and boards are another's for every seed."""
    random = np.random.default_rng(seed)
    moments = [REST] if setup.moments == 1 else [f"m{number + 1:02d}" for number in range(setup.moments)]
    photographs = tuple(_photographs(setup, moments))
    face, normals = face_points(setup.points)
    names = [f"p{number + 1:03d}" for number in range(setup.points)]
    still = [reference for reference in setup.references if reference.target == WORLD]
    places = {(moment, each.name): np.array([each.x, each.y, each.z]) for moment in moments for each in still}
    places |= {(moment, name): place for moment in moments for name, place in zip(names, face, strict=True)}
    places |= _held_boards(setup, moments, random)
    cameras = _cameras(setup, photographs, places, random)
    clicks = []
    for photograph in photographs:
        camera = cameras[photograph.name]
        towards = camera.place - face
        facing = (normals * towards).sum(axis=1) / np.linalg.norm(towards, axis=1)
        hidden = {name for name, cosine in zip(names, facing, strict=True) if cosine < _cosine(setup.turned_deg)}
        there = [name for moment, name in places if moment == photograph.moment and name not in hidden]
        seen = project(camera, np.array([places[photograph.moment, name] for name in there]))
        clicks += [(photograph, name, place) for name, place in zip(there, seen, strict=True)]
    observations, wrong = _clicked(setup, clicks, random)
    survey = Survey(photographs, observations, tuple(_surveyed(setup, random)))
    return Simulated(survey, cameras, places, wrong)


def _photographs(setup: Setup, moments: Sequence[str]) -> Iterator[Photograph]:
    for moment, view in product(moments, range(setup.views)):
        name = f"view{view + 1}.jpg" if moment == REST else f"{moment}-view{view + 1}.jpg"
        camera = "a" if setup.one_lens else f"camera{view + 1}"
        yield Photograph(name, setup.size_px, camera, moment, setup.fixed)


def _cosine(angle_deg: float) -> float:
    return math.cos(math.radians(angle_deg))


def _held_boards(setup: Setup, moments: Sequence[str], random: np.random.Generator) -> dict[tuple[str, str], Points]:
    """Places of the corners of boards, which face the cameras about evenly and lie about the origin."""
    held: dict[tuple[str, str], Points] = {}
    for moment, target in product(moments, sorted({each.target for each in setup.references} - {WORLD})):
        corners = [each for each in setup.references if each.target == target]
        places = np.array([[each.x, each.y, each.z] for each in corners])
        places = (places - places.mean(axis=0)) @ turn(random.uniform(-0.6, 0.6, 3)).T
        places = places * [1.0, -1.0, -1.0] + random.uniform(-0.04, 0.04, 3)
        held |= {(moment, each.name): place for each, place in zip(corners, places, strict=True)}
    return held


def _cameras(
    setup: Setup,
    photographs: Sequence[Photograph],
    places: Mapping[tuple[str, str], Points],
    random: np.random.Generator,
) -> dict[str, Camera]:
    """Cameras on an arc about the origin, a little out of line; their lenses show all that is there."""
    spread = math.radians(setup.spread_deg)
    angles = [spread * (view / (setup.views - 1) - 0.5) if setup.views > 1 else 0.3 for view in range(setup.views)]
    cameras: dict[str, Camera] = {}
    placed: dict[int, tuple[Points, Points]] = {}
    for number, photograph in enumerate(photographs):
        view = number % setup.views
        if not (setup.fixed and view in placed):
            raised = math.radians(18.0) * (0.7 if view % 2 else -0.3) + random.uniform(-0.05, 0.05)
            placed[view] = _placed(setup, angles[view] + random.uniform(-0.05, 0.05), raised, random)
        cameras[photograph.name] = Camera(Lens(1.0, (0.0, 0.0)), *placed[view])
    lenses: dict[str, Lens] = {}
    width, height = setup.size_px
    for name in sorted({photograph.camera for photograph in photographs}):
        principal = np.array([0.5 * width, 0.5 * height]) + setup.off_centre * width * random.uniform(-1.0, 1.0, 2)
        room = np.minimum(principal, setup.size_px - principal)
        reach = np.zeros(2)
        for photograph in photographs:
            if photograph.camera == name:
                there = np.array([place for (moment, _), place in places.items() if moment == photograph.moment])
                reach = np.maximum(reach, np.abs(project(cameras[photograph.name], there)).max(axis=0))
        focal = FILLED * float((room / reach).min())
        middle = float(principal[0]), float(principal[1])
        lenses[name] = Lens(focal, middle, setup.k1, setup.k2, (), setup.p1, setup.p2, setup.aspect)
    return {each.name: replace(cameras[each.name], lens=lenses[each.camera]) for each in photographs}


def _placed(setup: Setup, angle: float, raised: float, random: np.random.Generator) -> tuple[Points, Points]:
    """Rotation and place of a camera that looks nearly at the origin."""
    place = np.array([math.sin(angle) * math.cos(raised), math.sin(raised), math.cos(angle) * math.cos(raised)])
    place *= setup.distance_m * random.uniform(0.95, 1.05)
    forward = random.uniform(-0.01, 0.01, 3) - place
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    upright = np.stack([right, np.cross(forward, right), forward])
    return turn(np.array([0.0, 0.0, random.uniform(-0.05, 0.05)])) @ upright, place


def _clicked(
    setup: Setup, clicks: Sequence[tuple[Photograph, str, Points]], random: np.random.Generator
) -> tuple[tuple[Observation, ...], frozenset[tuple[str, str]]]:
    """Clicks with their errors, and which of them went wrong."""
    count, sigma = len(clicks), setup.sigma_px
    exact = np.array([place for *_, place in clicks])
    step = sigma * math.sqrt(12.0)
    if setup.noise == "normal":
        seen = exact + random.normal(0.0, sigma, (count, 2)) if sigma else exact.copy()
    elif setup.noise == "uniform":
        seen = exact + random.uniform(-0.5 * step, 0.5 * step, (count, 2))
    else:
        seen = np.round(exact / step) * step
    wrong: dict[str, str] = {}
    for index in random.permutation(count):
        if len(wrong) >= round(setup.mis_clicks * count):
            break
        photograph, name, _ = clicks[index]
        if name not in wrong:
            wrong[name] = photograph.name
            angle = random.uniform(0.0, 2.0 * math.pi)
            seen[index] += setup.mis_click_sigmas * sigma * np.array([math.cos(angle), math.sin(angle)])
    observations = tuple(
        Observation(photograph.name, name, float(place[0]), float(place[1]), sigma or 1.0)
        for (photograph, name, _), place in zip(clicks, seen, strict=True)
    )
    return observations, frozenset((photo, name) for name, photo in wrong.items())


def _surveyed(setup: Setup, random: np.random.Generator) -> Iterator[Reference]:
    """The references as their survey has them."""
    for each in setup.references:
        dx, dy, dz = setup.reference_sigma_m * random.normal(size=3)
        yield replace(each, x=each.x + dx, y=each.y + dy, z=each.z + dz, sigma_m=setup.reference_sigma_m)
