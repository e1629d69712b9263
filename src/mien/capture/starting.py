"""Where everything may be, to begin refinement from: photographs are placed one after the other, and points from them.

A photograph that sees references of a target gets its place relative to it; targets and photographs are then joined
from the world outwards. Points seen in two placed photographs get places, and serve in turn to place photographs that
see too few references.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from mien.capture.homogeneous import FEWEST, homogeneous_matrix, metric_camera, nearest_to_rays
from mien.capture.networks import Network, State, unknown_state
from mien.capture.placing import FAR, Pose, focal_lenses, likely_poses, place_camera, refine_poses, sensible
from mien.capture.projecting import lens_array, rays, see
from mien.core.errors import MienError
from mien.core.mesh import Ints, Points

FEWEST_PLACED = 4
"""Points of known place that a photograph of known lens needs: three leave several places."""
GOOD = (0.004 / FAR) ** 2
"""Cost of a start that needs no better one: seen within 0.4 % of the picture."""
HOPELESS = 0.6
"""Cost of a pose that more than half of the clicks contradict."""
ENOUGH = 20
"""Points of a photograph that judge a guess, about."""
ENOUGH_FOR_CROPPED = 8
"""Points of a photograph that tell where its middle was before it was cropped."""
CROPPED = 0.05
"""Part of the cost that is left where a principal point far from the middle tells a photograph as nothing else does."""
JUDGES = 6
"""Photographs by which the lens of a camera is guessed, at most."""


@dataclass(frozen=True, eq=False)
class Sight:
    """Points of known place that a photograph sees on one body: (K, 3) m in its frame, (K, 2) px."""

    photo: int
    body: int
    places: Points
    pictures: Points

    @property
    def solid(self) -> bool:
        """Whether the points do not lie on one plane (nor nearly so)."""
        spread = np.linalg.svd(self.places - self.places.mean(axis=0), compute_uv=False)
        return len(self.places) > 3 and bool(spread[2] > 0.03 * spread[0])

    def thinned(self) -> Sight:
        """No more points than a guess needs."""
        step = max(1, len(self.places) // ENOUGH)
        return replace(self, places=self.places[::step], pictures=self.pictures[::step])


def begin(network: Network) -> tuple[State, Ints]:
    """A state from which refinement can begin, and numbers of bodies that stay where they are.

    What cannot be placed stays NaN.

    Raises:
        MienError: no photograph can be placed.
    """
    state = unknown_state(network)
    sights = [sight for sight in _sights(network) if len(sight.places) >= FEWEST_PLACED]
    _guess_lenses(network, state, sights)
    roots: list[int] = []
    poses: dict[tuple[int, int], Pose] = {}
    for sight in sights:
        pose = _best_pose(network, state, sight)
        if pose is not None:
            poses[sight.photo, sight.body] = pose
    if not poses:
        raise MienError(
            "no photograph can be placed: none shows six references (or four, of a camera whose lens other photographs"
            " tell) that agree with one another — click more corners of the cube, or look whether names of references"
            " are exchanged"
        )
    weights = {(sight.photo, sight.body): _worth(poses, sight) for sight in sights}
    while True:
        root = _next_root(network, state, poses)
        if root is None:
            break
        roots.append(root)
        state.body_rotations[root], state.body_places[root] = np.eye(3), 0.0
        _join(network, state, poses, weights)
        if len(roots) == 1:
            while _locate(network, state) and _resect(network, state):
                _join(network, state, poses, weights)
    _drop_behind(network, state)
    return state, np.array(sorted({0, *roots}), dtype=np.int64)


def _sights(network: Network) -> list[Sight]:
    """What each photograph sees of references, by body."""
    sights = []
    known = network.known[network.point_of]
    for photo, body in sorted(set(zip(network.photo_of[known].tolist(), network.body_of[known].tolist(), strict=True))):
        which = known & (network.photo_of == photo) & (network.body_of == body)
        sights.append(Sight(photo, body, network.told[network.point_of[which]], network.pictures[which]))
    return sights


def _size(network: Network, photo: int) -> tuple[int, int]:
    return network.survey.photographs[photo].size_px


def _guess_lenses(network: Network, state: State, sights: list[Sight]) -> None:
    """Writes a lens for every camera that has a photograph of six references."""
    for number in range(len(network.lenses)):
        own = [each for each in sights if network.lens_at[each.photo] == number and len(each.places) >= FEWEST]
        if own:
            state.lenses[number] = guess_lens(own, _size(network, own[0].photo))


def guess_lens(sights: list[Sight], size_px: tuple[int, int]) -> Points:
    """(8,) likely lens of a camera from what its photographs show.

    Points in space tell it directly (the homogeneous matrix); where that fails, and of boards, several focal lengths
    and bends are tried.
    """
    solid = [sight for sight in sights if sight.solid]
    starts = [pose for pose in (_direct(sight, size_px) for sight in solid[:JUDGES]) if pose is not None]
    good = [pose.lens for pose in starts if pose.cost < GOOD and sensible(pose, size_px)]
    if good and len(good) * 2 > len(solid[:JUDGES]):
        return np.median(good, axis=0)
    judges = sorted(sights, key=lambda sight: (not sight.solid, -len(sight.places), sight.photo))
    judges = [each.thinned() for each in judges[:: max(1, len(judges) // JUDGES)][:JUDGES]]
    best, cost = _cheapest(focal_lenses(size_px), judges, size_px)
    if cost > GOOD:
        bent = np.repeat(focal_lenses(size_px)[:5], 2, axis=0)
        bent[0::2, 3], bent[1::2, 3] = -0.12, -0.3
        other, other_cost = _cheapest(bent, judges, size_px)
        if other_cost < cost:
            best, cost = other, other_cost
    near = np.repeat(best[None], 4, axis=0)
    near[:, 0] *= (0.8, 0.9, 1.1, 1.2)
    other, other_cost = _cheapest(near, judges, size_px)
    return other if other_cost < cost else best


def _cheapest(lenses: Points, judges: list[Sight], size_px: tuple[int, int]) -> tuple[Points, float]:
    """The lens of least mean cost, and that cost."""
    costs = np.zeros(len(lenses))
    for each in judges:
        found = likely_poses(lenses, each.places, each.pictures, max(size_px), keep=2, rounds=6)
        costs += [min((pose.cost for pose in poses), default=1.0) for poses in found]
    return lenses[int(np.argmin(costs))], float(costs.min()) / len(judges)


def _direct(sight: Sight, size_px: tuple[int, int]) -> Pose | None:
    """The place and lens that the homogeneous matrix tells, mended by least squares; None if it tells none."""
    try:
        camera = metric_camera(homogeneous_matrix(sight.places, sight.pictures), sight.places)
    except MienError:
        return None
    if camera is None:
        return None
    lens = lens_array(camera.lens)
    centred = lens.copy()
    centred[1:3] = np.array(size_px) / 2.0
    pose = Pose(centred, camera.rotation, camera.place, 1.0)
    pose = refine_poses([pose], sight.places, sight.pictures, max(size_px), free=(0, 3), rounds=30)[0]
    if pose.cost < GOOD or len(sight.places) < ENOUGH_FOR_CROPPED:
        return pose
    free = Pose(lens, camera.rotation, camera.place, 1.0)
    cropped = refine_poses([free], sight.places, sight.pictures, max(size_px), free=(0, 1, 2), rounds=30)[0]
    return cropped if cropped.cost < CROPPED * pose.cost else pose


def _best_pose(network: Network, state: State, sight: Sight) -> Pose | None:
    """The likeliest place of a photograph relative to a body, where its lens is known."""
    lens = state.lenses[network.lens_at[sight.photo]]
    if not np.isfinite(lens[0]):
        return None
    poses = place_camera(sight.places, sight.pictures, lens, max(_size(network, sight.photo)))
    return poses[0] if poses and poses[0].cost < HOPELESS else None


def _worth(poses: dict[tuple[int, int], Pose], sight: Sight) -> float:
    """How little a pose is to be trusted: what is off, over how many points tell it."""
    pose = poses.get((sight.photo, sight.body))
    return np.inf if pose is None else (pose.cost + 1e-4) / len(sight.places)


def _next_root(network: Network, state: State, poses: dict[tuple[int, int], Pose]) -> int | None:
    """The body to begin the next island of photographs at: the world, else the first of which nothing is placed."""
    bodies = sorted({body for photo, body in poses if np.isnan(state.places[network.station_at[photo], 0])})
    free = [body for body in bodies if body == 0 or np.isnan(state.body_places[body, 0])]
    return free[0] if free else None


def _join(
    network: Network, state: State, poses: dict[tuple[int, int], Pose], weights: dict[tuple[int, int], float]
) -> None:
    """Places all that hangs together with what is placed, the surest first."""
    open_edges = sorted(poses, key=lambda edge: (weights[edge], edge))
    while True:
        for photo, body in open_edges:
            station = int(network.station_at[photo])
            stands, lies = np.isfinite(state.places[station, 0]), np.isfinite(state.body_places[body, 0])
            if stands == lies:
                continue
            pose = poses[photo, body]
            if lies:
                rotation = state.body_rotations[body]
                state.rotations[station] = pose.rotation @ rotation.T
                state.places[station] = rotation @ pose.place + state.body_places[body]
            else:
                rotation = state.rotations[station].T @ pose.rotation
                state.body_rotations[body] = rotation
                state.body_places[body] = state.places[station] - rotation @ pose.place
            break
        else:
            return


def _locate(network: Network, state: State) -> bool:
    """Gives places to measured points that two placed photographs see; whether there was one."""
    placed = np.isfinite(state.places[:, 0])[network.station_of]
    wanted = ~network.known[network.point_of] & np.isnan(state.points[network.point_of, 0])
    which = np.nonzero(placed & wanted)[0]
    if not len(which):
        return False
    origins = state.places[network.station_of[which]]
    directions = np.empty((len(which), 3))
    for photo in np.unique(network.photo_of[which]):
        here = network.photo_of[which] == photo
        directions[here] = rays(state.camera(network, int(photo)), network.pictures[which[here]])
    order = np.argsort(network.point_of[which], kind="stable")
    points, starts = np.unique(network.point_of[which][order], return_index=True)
    some = False
    for point, own in zip(points, np.split(order, starts[1:]), strict=True):
        if len(own) >= 2:
            place = _meet(network, state, which[own], origins[own], directions[own])
            if place is not None:
                state.points[point] = place
                some = True
    return some


def _meet(network: Network, state: State, seen: Ints, origins: Points, directions: Points) -> Points | None:
    """(3,) m where rays of observations ``seen`` meet: all of them, or else those two that most others agree with."""
    place = nearest_to_rays(origins, directions)
    best, most = None, 0.0
    if place is not None:
        near = _agreeing(network, state, seen, place)
        if near.all() or len(seen) == 2:
            return place
        best, most = place, near.sum()
    pairs = list(combinations(range(len(seen)), 2))
    for pair in pairs[:: max(1, len(pairs) // 40)]:
        place = nearest_to_rays(origins[list(pair)], directions[list(pair)])
        if place is not None:
            near = _agreeing(network, state, seen, place)
            if near.sum() > most:
                best, most = place, near.sum()
    return best


def _agreeing(network: Network, state: State, seen: Ints, place: Points) -> Points:
    """(n,) whether observations see a place within ``FAR`` of the picture."""
    station, lens = network.station_of[seen], network.lens_of[seen]
    frame = np.einsum("nij,nj->ni", state.rotations[station], place - state.places[station])
    before = frame[:, 2] > 1e-9
    frame[~before] = 1.0
    off = np.linalg.norm(see(state.lenses[lens], frame) - network.pictures[seen], axis=1)
    return before & (off < FAR * network.sizes[lens].max(axis=1))


def _resect(network: Network, state: State) -> bool:
    """Places photographs by points that are known by now; whether there was one."""
    some = False
    world = state.world_places(network)
    known = np.isfinite(world).all(axis=1)
    for photo in range(len(network.station_at)):
        station, number = network.station_at[photo], network.lens_at[photo]
        if np.isfinite(state.places[station, 0]):
            continue
        which = known & (network.photo_of == photo)
        lens_known = bool(np.isfinite(state.lenses[number, 0]))
        if which.sum() < (FEWEST_PLACED if lens_known else FEWEST):
            continue
        size_px = _size(network, photo)
        sight = Sight(photo, 0, world[which], network.pictures[which])
        lens = state.lenses[number] if lens_known else guess_lens([sight], size_px)
        poses = place_camera(sight.places, sight.pictures, lens, max(size_px))
        if poses and poses[0].cost < HOPELESS:
            state.lenses[number] = lens
            state.rotations[station], state.places[station] = poses[0].rotation, poses[0].place
            some = True
    return some


def _drop_behind(network: Network, state: State) -> None:
    """Drops points behind cameras that see them: what they are seen by is as good as not clicked."""
    seen = state.placed(network)
    station = network.station_of
    depths = np.einsum("nj,nj->n", state.rotations[station][:, 2], state.world_places(network) - state.places[station])
    behind = seen & ~(depths > 0.0) & ~network.known[network.point_of]
    state.points[network.point_of[behind]] = np.nan
