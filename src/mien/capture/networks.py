"""A survey in arrays: who is seen by whom, what is unknown, and the numbers of the unknowns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.capture.projecting import LENS_TERMS, lens_record
from mien.capture.records import WORLD, Camera, Observation, Photograph, Reference, Survey
from mien.core.errors import MienError, UnknownNameError
from mien.core.mesh import Ints, Points

Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Network:
    """What a survey connects. N observations, L lenses, S stations, B bodies, P points.

    A station is where a camera stood: of one photograph, or of all of a camera that is fixed. A body is a target at a
    moment; body 0 is the world. A point is a reference, told in the frame of its target, or what is measured at one
    moment.

    Attributes:
        survey: what it was made from.
        lenses, stations, bodies, points: their names. Of points (moment, name), the moment of references "".
        sizes: (L, 2) px of the photographs of each lens.
        lens_of, station_of, body_of, point_of: (N,) numbers.
        photo_of: (N,) number of the photograph.
        pictures: (N, 2) px.
        sigmas: (N,) px.
        known: (P,) whether the point is a reference.
        told: (P, 3) m where a reference is said to be, in the frame of its target.
        loose: (P,) m standard deviation of a reference; 0 of an exact one; infinite of what is measured.
        lens_at, station_at: (photographs,) numbers.
    """

    survey: Survey
    lenses: tuple[str, ...]
    stations: tuple[str, ...]
    bodies: tuple[tuple[str, str], ...]
    points: tuple[tuple[str, str], ...]
    sizes: Points
    lens_of: Ints
    station_of: Ints
    body_of: Ints
    point_of: Ints
    photo_of: Ints
    pictures: Points
    sigmas: Points
    known: Bools
    told: Points
    loose: Points
    lens_at: Ints
    station_at: Ints

    def photo_name(self, number: int) -> str:
        """Name of a photograph."""
        return self.survey.photographs[number].name


@dataclass(frozen=True, eq=False)
class State:
    """Numbers of all that is unknown; NaN where it is not known yet.

    Attributes:
        lenses: (L, 8).
        rotations, places: (S, 3, 3) and (S, 3) m of stations.
        body_rotations, body_places: (B, 3, 3) and (B, 3) m: x in the world = R x in the body + place.
        points: (P, 3) m, of references in the frame of their target.
    """

    lenses: Points
    rotations: Points
    places: Points
    body_rotations: Points
    body_places: Points
    points: Points

    def copy(self) -> State:
        """The same numbers, free to be changed."""
        return State(**{name: value.copy() for name, value in self.__dict__.items()})

    def camera(self, network: Network, photo: int, freed: tuple[str, ...] = ()) -> Camera:
        """The camera of a photograph by number."""
        station = network.station_at[photo]
        lens = lens_record(self.lenses[network.lens_at[photo]], freed)
        return Camera(lens=lens, rotation=self.rotations[station].copy(), place=self.places[station].copy())

    def placed(self, network: Network) -> Bools:
        """(N,) observations of which station, body and point have numbers."""
        stations = np.isfinite(self.places[:, 0])
        bodies = np.isfinite(self.body_places[:, 0])
        points = np.isfinite(self.points[:, 0])
        return stations[network.station_of] & bodies[network.body_of] & points[network.point_of]

    def world_places(self, network: Network) -> Points:
        """(N, 3) m where each observed point is in the world."""
        body = network.body_of
        return (
            np.einsum("nij,nj->ni", self.body_rotations[body], self.points[network.point_of]) + self.body_places[body]
        )


def connect(survey: Survey) -> Network:
    """The network of a survey.

    Raises:
        MienError: names that are told twice, numbers that are not finite, photographs of one camera of several sizes.
    """
    photo_numbers = _numbered([each.name for each in survey.photographs], "photograph")
    references = {each.name: each for each in survey.references}
    _numbered([each.name for each in survey.references], "reference")
    _check_numbers(survey.observations, survey.references)
    lenses = tuple(dict.fromkeys(each.camera for each in survey.photographs))
    station_names = [_station(each) for each in survey.photographs]
    stations = tuple(dict.fromkeys(station_names))
    bodies: dict[tuple[str, str], int] = {(WORLD, ""): 0}
    points: dict[tuple[str, str], int] = {("", name): number for number, name in enumerate(references)}
    body_of, point_of, photo_of = [], [], []
    told_before: dict[tuple[str, str], Observation] = {}
    for seen in survey.observations:
        if seen.photo not in photo_numbers:
            raise UnknownNameError("photograph", seen.photo, photo_numbers)
        if (seen.photo, seen.point) in told_before:
            raise MienError(
                f"point {seen.point!r} is told twice in photograph {seen.photo!r}{_lines(told_before, seen)}"
                " — keep one of them, or give the other its own name"
            )
        told_before[seen.photo, seen.point] = seen
        photo = photo_numbers[seen.photo]
        photo_of.append(photo)
        moment = survey.photographs[photo].moment
        reference = references.get(seen.point)
        if reference is None:
            body_of.append(0)
            point_of.append(points.setdefault((moment, seen.point), len(points)))
        else:
            body = (WORLD, "") if reference.target == WORLD else (reference.target, moment)
            body_of.append(bodies.setdefault(body, len(bodies)))
            point_of.append(points["", seen.point])
    lens_at = np.array([lenses.index(each.camera) for each in survey.photographs], dtype=np.int64)
    station_at = np.array([stations.index(name) for name in station_names], dtype=np.int64)
    photos = np.array(photo_of, dtype=np.int64)
    told = np.full((len(points), 3), np.nan)
    loose = np.full(len(points), np.inf)
    for number, reference in enumerate(survey.references):
        told[number] = reference.x, reference.y, reference.z
        loose[number] = reference.sigma_m
    return Network(
        survey=survey,
        lenses=lenses,
        stations=stations,
        bodies=tuple(bodies),
        points=tuple(points),
        sizes=_lens_sizes(survey.photographs, lenses),
        lens_of=lens_at[photos],
        station_of=station_at[photos],
        body_of=np.array(body_of, dtype=np.int64),
        point_of=np.array(point_of, dtype=np.int64),
        photo_of=photos,
        pictures=np.array([(each.u, each.v) for each in survey.observations], dtype=np.float64).reshape(-1, 2),
        sigmas=np.array([each.sigma_px for each in survey.observations], dtype=np.float64),
        known=np.isfinite(told).all(axis=1),
        told=told,
        loose=loose,
        lens_at=lens_at,
        station_at=station_at,
    )


def unknown_state(network: Network) -> State:
    """A state of a network in which only references, and the world, are known."""
    state = State(
        lenses=np.full((len(network.lenses), LENS_TERMS), np.nan),
        rotations=np.full((len(network.stations), 3, 3), np.nan),
        places=np.full((len(network.stations), 3), np.nan),
        body_rotations=np.full((len(network.bodies), 3, 3), np.nan),
        body_places=np.full((len(network.bodies), 3), np.nan),
        points=network.told.copy(),
    )
    state.body_rotations[0], state.body_places[0] = np.eye(3), 0.0
    return state


def _station(photograph: Photograph) -> str:
    return f"camera {photograph.camera}" if photograph.fixed else f"photograph {photograph.name}"


def _numbered(names: Sequence[str], kind: str) -> dict[str, int]:
    """Numbers of names, each of which is told once."""
    numbers = {name: number for number, name in enumerate(names)}
    if len(numbers) < len(names):
        twice = next(name for number, name in enumerate(names) if numbers[name] != number)
        raise MienError(f"{kind} {twice!r} is told twice — keep one of them, or give the other its own name")
    return numbers


def _lines(before: dict[tuple[str, str], Observation], seen: Observation) -> str:
    first = before[seen.photo, seen.point]
    return f" (lines {first.line} and {seen.line})" if seen.line else ""


def _check_numbers(observations: Sequence[Observation], references: Sequence[Reference]) -> None:
    for seen in observations:
        where = f" (line {seen.line})" if seen.line else ""
        if not np.isfinite([seen.u, seen.v]).all():
            raise MienError(f"point {seen.point!r} in photograph {seen.photo!r}{where}: u and v are not both numbers")
        if not (np.isfinite(seen.sigma_px) and seen.sigma_px > 0.0):
            raise MienError(
                f"point {seen.point!r} in photograph {seen.photo!r}{where}: sigma must be above 0 px,"
                f" got {seen.sigma_px} — 1 is usual for clicks"
            )
    for each in references:
        if not np.isfinite([each.x, each.y, each.z]).all():
            raise MienError(f"reference {each.name!r}: x, y and z are not all numbers")
        if not (np.isfinite(each.sigma_m) and each.sigma_m >= 0.0):
            raise MienError(f"reference {each.name!r}: sigma must be 0 or above, got {each.sigma_m}")


def _lens_sizes(photographs: Sequence[Photograph], lenses: Sequence[str]) -> Points:
    """(L, 2) px; a camera takes photographs of one size."""
    sizes: dict[str, tuple[int, int]] = {}
    for each in photographs:
        before = sizes.setdefault(each.camera, each.size_px)
        if before != each.size_px:
            raise MienError(
                f"camera {each.camera!r}: photograph {each.name!r} is {each.size_px[0]} × {each.size_px[1]} px, others"
                f" of it are {before[0]} × {before[1]} — give it a camera of its own (another crop is another lens)"
            )
    return np.array([sizes[name] for name in lenses], dtype=np.float64).reshape(-1, 2)
