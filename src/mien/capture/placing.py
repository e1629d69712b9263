"""Where a camera stood, from three or more points of known place: guesses that mis-clicks cannot spoil.

Three points leave up to four places. Many triples are tried at once, over several focal lengths where the lens is
unknown; each place is judged by all points, none of which counts for more than ``FAR`` of the picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.capture.projecting import LENS_TERMS, lens_record, see, see_slopes, turn, turn_slopes, undistort
from mien.capture.records import Camera
from mien.core.mesh import Points

FAR = 0.01
"""Of the picture's size: how far off a point may be seen before it counts no further."""
TRIPLES = 60


@dataclass(frozen=True, eq=False)
class Pose:
    """A rotation (3, 3) and a place (3,) m of a camera, with the (8,) lens that it was found with.

    ``cost`` is the mean over all points of the square of what is off, of ``FAR`` at most: 0 perfect, 1 hopeless.
    """

    lens: Points
    rotation: Points
    place: Points
    cost: float

    def camera(self) -> Camera:
        """The camera that stood so."""
        return Camera(lens=lens_record(self.lens), rotation=self.rotation, place=self.place)


def three_point_poses(places: Points, directions: Points) -> tuple[Points, Points, NDArray[np.int64]]:
    """Rotations (M, 3, 3) and places (M, 3) m to see three places along three directions from, and of which triple.

    Args:
        places: (T, 3, 3) m, three points of each triple.
        directions: (T, 3, 3) in the frame of the camera, of length 1.

    Source: Grunert 1841, after Haralick, Lee, Ottenberg and Nölle 1994, "Review and analysis of solutions of the three
    point perspective pose estimation problem".
    """
    first, second, third = places[:, 0], places[:, 1], places[:, 2]
    aa = ((second - third) ** 2).sum(axis=1)
    bb = ((first - third) ** 2).sum(axis=1)
    cc = ((first - second) ** 2).sum(axis=1)
    alpha = (directions[:, 1] * directions[:, 2]).sum(axis=1)
    beta = (directions[:, 0] * directions[:, 2]).sum(axis=1)
    gamma = (directions[:, 0] * directions[:, 1]).sum(axis=1)
    less, more, ratio = (aa - cc) / bb, (aa + cc) / bb, cc / bb
    quartic = np.stack(
        [
            (less - 1.0) ** 2 - 4.0 * ratio * alpha**2,
            4.0 * (less * (1.0 - less) * beta - (1.0 - more) * alpha * gamma + 2.0 * ratio * alpha**2 * beta),
            2.0
            * (
                less**2
                - 1.0
                + 2.0 * less**2 * beta**2
                + 2.0 * (1.0 - ratio) * alpha**2
                - 4.0 * more * alpha * beta * gamma
                + 2.0 * (1.0 - aa / bb) * gamma**2
            ),
            4.0 * (-less * (1.0 + less) * beta + 2.0 * aa / bb * gamma**2 * beta - (1.0 - more) * alpha * gamma),
            (1.0 + less) ** 2 - 4.0 * aa / bb * gamma**2,
        ],
        axis=1,
    )
    lead = np.where(np.abs(quartic[:, :1]) < 1e-14, 1e-14, quartic[:, :1])
    companion = np.zeros((len(places), 4, 4))
    companion[:, 0] = -quartic[:, 1:] / lead
    companion[:, [1, 2, 3], [0, 1, 2]] = 1.0
    roots = np.linalg.eigvals(companion)
    # A double root is seldom found real: what is off then, refinement mends.
    triple, which = np.nonzero((np.abs(roots.imag) < 1e-3 * np.abs(roots)) & (roots.real > 0.0))
    v = roots[triple, which].real
    less, alpha, beta, gamma, bb = less[triple], alpha[triple], beta[triple], gamma[triple], bb[triple]
    below = 2.0 * (gamma - v * alpha)
    below = np.where(np.abs(below) < 1e-12, 1e-12, below)
    u = ((less - 1.0) * v**2 - 2.0 * less * beta * v + 1.0 + less) / below
    apart = 1.0 + v**2 - 2.0 * v * beta
    good = (u > 0.0) & (apart > 1e-12)
    triple, u, v, apart, bb = triple[good], u[good], v[good], apart[good], bb[good]
    distance = np.sqrt(bb / apart)
    frame = directions[triple] * np.stack([distance, u * distance, v * distance], axis=1)[:, :, None]
    rotations = _triads(frame) @ _triads(places[triple]).transpose(0, 2, 1)
    centres = places[triple].mean(axis=1) - np.einsum("nji,nj->ni", rotations, frame.mean(axis=1))
    return rotations, centres, triple


def _triads(triangles: Points) -> Points:
    """(M, 3, 3) right-handed axes, as columns, that lie in triangles (M, 3, 3) alike."""
    along = triangles[:, 1] - triangles[:, 0]
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    normal = np.cross(along, triangles[:, 2] - triangles[:, 0])
    normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    return np.stack([along, normal, np.cross(along, normal)], axis=2)


def spread_triples(places: Points, pictures: Points, count: int = TRIPLES) -> NDArray[np.int64]:
    """(T, 3) points by number, of at most ``count`` triples that are spread well in space and in the picture.

    Drawn by chance from a fixed seed; triples nearly on a line are left out.
    """
    number = len(places)
    if number < 3:
        return np.empty((0, 3), dtype=np.int64)
    generator = np.random.default_rng(number)
    keys = generator.random((6 * count, number))
    triples = np.unique(np.sort(np.argpartition(keys, 2, axis=1)[:, :3], axis=1), axis=0)
    first, second, third = (places[triples[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(second - first, third - first), axis=1)
    one, two = pictures[triples[:, 1]] - pictures[triples[:, 0]], pictures[triples[:, 2]] - pictures[triples[:, 0]]
    seen = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    worth = area / (area.max() + 1e-300) * np.sqrt(seen / (seen.max() + 1e-300))
    # Half of the best, half of the others: mis-clicks like to be among the best spread.
    order = np.argsort(-worth, kind="stable")
    order = order[worth[order] > 1e-3]
    best, others = order[: count // 2], order[count // 2 :]
    return triples[np.concatenate([best, generator.permutation(others)[: count - len(best)]])]


def place_camera(places: Points, pictures: Points, lens: Points, size_px: float) -> list[Pose]:
    """Where a camera of a (8,) lens may have stood to see places (N, 3) m at (N, 2) px, the likeliest first."""
    found = likely_poses(lens[None], places, pictures, size_px)
    return sorted(found[0], key=lambda pose: pose.cost)


def likely_poses(
    lenses: Points, places: Points, pictures: Points, size_px: float, *, keep: int = 3, rounds: int = 15
) -> list[list[Pose]]:
    """Likely poses of a camera for each of several lenses (L, 8), none where three points do not tell one.

    Args:
        lenses: (L, 8) lenses to try.
        places: (N, 3) m.
        pictures: (N, 2) px.
        size_px: the greater side of the photograph.
        keep: how many likely poses of each lens are refined.
        rounds: of refinement.
    """
    triples = spread_triples(places, pictures)
    if not len(triples):
        return [[] for _ in lenses]
    starts: list[Pose] = []
    numbers: list[int] = []
    for number, lens in enumerate(lenses):
        flat = undistort(lens_record(lens), pictures)
        directions = np.column_stack([flat, np.ones(len(flat))])
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        rotations, centres, _ = three_point_poses(places[triples], directions[triples])
        costs = _costs(np.broadcast_to(lens, (len(centres), LENS_TERMS)), rotations, centres, places, pictures, size_px)
        chosen: list[Pose] = []
        for which in np.argsort(costs, kind="stable")[: 12 * keep]:
            rotation = rotations[which]
            if len(chosen) < keep and not any(np.trace(rotation.T @ each.rotation) > 2.98 for each in chosen):
                chosen.append(Pose(lens, rotation, centres[which], float(costs[which])))
        starts += chosen
        numbers += [number] * len(chosen)
    found: list[list[Pose]] = [[] for _ in lenses]
    for number, pose in zip(numbers, refine_poses(starts, places, pictures, size_px, rounds=rounds), strict=True):
        found[number].append(pose)
    return found


def _costs(
    lenses: Points, rotations: Points, centres: Points, places: Points, pictures: Points, size_px: float
) -> Points:
    """(M,) costs of poses as ``Pose`` has them; a point behind the camera counts as far off."""
    cap = (FAR * size_px) ** 2
    frame = np.einsum("mij,mnj->mni", rotations, places[None] - centres[:, None])
    behind = ~(frame[..., 2] > 1e-9)
    frame[behind] = 1.0
    off = ((see(lenses[:, None], frame) - pictures) ** 2).sum(axis=2)
    off[behind | ~(off < cap)] = cap
    return off.mean(axis=1) / cap


def refine_poses(
    poses: Sequence[Pose],
    places: Points,
    pictures: Points,
    size_px: float,
    *,
    free: tuple[int, ...] = (),
    rounds: int = 15,
) -> list[Pose]:
    """Poses nearby of least cost, each by itself, with the lens terms of numbers ``free`` let go too (0: focal length).

    Points that are far off weigh less and less (Geman and McClure 1987), so that mis-clicks do not pull.
    """
    if not poses:
        return []
    cap, count, terms = (FAR * size_px) ** 2, len(poses), list(free)
    lenses = np.array([pose.lens for pose in poses])
    rotations = np.array([pose.rotation for pose in poses])
    centres = np.array([pose.place for pose in poses])
    costs = _costs(lenses, rotations, centres, places, pictures, size_px)
    damping = np.full(count, 1e-3)
    for _ in range(rounds):
        frame = np.einsum("mij,mnj->mni", rotations, places[None] - centres[:, None])
        behind = ~(frame[..., 2] > 1e-9)
        frame[behind] = 1.0
        seen, by_lens, by_frame = see_slopes(np.repeat(lenses, len(places), axis=0), frame.reshape(-1, 3))
        off = pictures - seen.reshape(count, -1, 2)
        weight = 1.0 / (1.0 + (off * off).sum(axis=2) / cap) ** 2
        weight[behind] = 0.0
        by_turn = turn_slopes(frame.reshape(-1, 3), by_frame)
        by_place = -by_frame @ np.repeat(rotations, len(places), axis=0)
        jacobian = np.concatenate([by_turn, by_place, by_lens[:, :, terms]], axis=2).reshape(count, 2 * len(places), -1)
        weighed = (jacobian * np.repeat(weight, 2, axis=1)[:, :, None]).transpose(0, 2, 1)
        normal = weighed @ jacobian
        scale = np.einsum("mii->mi", normal)
        scale = damping[:, None] * scale + 1e-12 * scale.sum(axis=1, keepdims=True) + 1e-300
        damped = normal + scale[:, :, None] * np.eye(normal.shape[1])
        steps = np.linalg.solve(damped, weighed @ off.reshape(count, -1, 1))[:, :, 0]
        new_lenses = lenses.copy()
        new_lenses[:, terms] += steps[:, 6:]
        new_rotations, new_centres = turn(steps[:, :3]) @ rotations, centres + steps[:, 3:6]
        new_costs = _costs(new_lenses, new_rotations, new_centres, places, pictures, size_px)
        better = (new_costs < costs) & (new_lenses[:, 0] > 0.0)
        gain = np.where(better, costs - new_costs, 0.0)
        lenses[better], rotations[better] = new_lenses[better], new_rotations[better]
        centres[better], costs[better] = new_centres[better], new_costs[better]
        damping = np.where(better, damping * 0.1, damping * 10.0)
        if (np.where(better, gain < 1e-6 * costs + 1e-14, damping > 1e3)).all():
            break
    return [Pose(lenses[k], rotations[k], centres[k], float(costs[k])) for k in range(count)]


def focal_lenses(size_px: tuple[int, int], count: int = 11) -> Points:
    """(count, 8) lenses to try for a photograph: from 0.35 to 11 times its greater side, no distortion."""
    lenses = np.zeros((count, LENS_TERMS))
    lenses[:, 0] = max(size_px) * np.geomspace(0.35, 11.0, count)
    lenses[:, 1], lenses[:, 2] = size_px[0] / 2.0, size_px[1] / 2.0
    return lenses


def sensible(pose: Pose, size_px: tuple[int, int]) -> bool:
    """Whether a lens could be one: focal length and principal point within reason of the photograph."""
    focal, u, v, k1, *_ = pose.lens
    greater = max(size_px)
    centred = abs(u - size_px[0] / 2.0) < 1.5 * greater and abs(v - size_px[1] / 2.0) < 1.5 * greater
    return bool(0.2 * greater < focal < 40.0 * greater and centred and abs(k1) < 5.0)
