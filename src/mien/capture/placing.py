"""Where a camera stood, from three or more points of known place: guesses that mis-clicks cannot spoil.

Three points leave up to four places. Many triples are tried at once, over several focal lengths where the lens is
unknown; each place is judged by all points, none of which counts for more than ``FAR`` of the picture.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.capture.projecting import lens_array, lens_record, see, see_slopes, turn, undistort
from mien.capture.records import Camera
from mien.core.mesh import Points

FAR = 0.01
"""Of the picture's size: how far off a point may be seen before it counts no further."""
TRIPLES = 60


@dataclass(frozen=True, eq=False)
class Pose:
    """A rotation (3, 3) and a place (3,) m of a camera, with the (5,) lens that it was found with.

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


def place_camera(lenses: Points, places: Points, pictures: Points, size_px: float, *, keep: int = 3) -> list[Pose]:
    """Where a camera may have stood to see places (N, 3) m at pictures (N, 2) px, the likeliest first.

    Args:
        lenses: (L, 5) lenses to try.
        places: (N, 3) m, three or more.
        pictures: (N, 2) px.
        size_px: the greater side of the photograph.
        keep: how many likely poses of each lens are refined.
    """
    triples = spread_triples(places, pictures)
    found: list[Pose] = []
    if not len(triples):
        return found
    cap = (FAR * size_px) ** 2
    for lens in lenses:
        flat = undistort(lens_record(lens), pictures)
        directions = np.column_stack([flat, np.ones(len(flat))])
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        rotations, centres, _ = three_point_poses(places[triples], directions[triples])
        costs = _costs(lens, rotations, centres, places, pictures, cap)
        poses: list[Pose] = []
        for number in np.argsort(costs, kind="stable")[: 12 * keep]:
            if not np.isfinite(costs[number]) or len(poses) == keep:
                break
            rotation = rotations[number]
            if any(np.trace(rotation.T @ each.rotation) > 2.98 for each in poses):
                continue
            poses.append(Pose(lens, rotation, centres[number], float(costs[number])))
        found += [refine_pose(pose, places, pictures, size_px) for pose in poses]
    return sorted(found, key=lambda pose: pose.cost)


def _costs(lens: Points, rotations: Points, centres: Points, places: Points, pictures: Points, cap: float) -> Points:
    """(M,) costs of poses as ``Pose`` has them; a point behind the camera counts as far off."""
    frame = np.einsum("mij,mnj->mni", rotations, places[None] - centres[:, None])
    behind = ~(frame[..., 2] > 1e-9)
    frame[behind] = 1.0
    off = ((see(lens, frame) - pictures) ** 2).sum(axis=2)
    off[behind | ~(off < cap)] = cap
    return off.mean(axis=1) / cap


def refine_pose(
    pose: Pose, places: Points, pictures: Points, size_px: float, *, free: tuple[int, ...] = (), rounds: int = 15
) -> Pose:
    """The pose nearby of least cost, with the lens terms of numbers ``free`` let go too (0: focal length, 3: k1).

    Points that are far off weigh less and less (Geman and McClure 1987), so that mis-clicks do not pull.
    """
    cap = (FAR * size_px) ** 2
    best, damping = pose, 1e-3
    terms = list(free)
    for _ in range(rounds):
        frame = (places - best.place) @ best.rotation.T
        before = frame[:, 2] > 1e-9
        if before.sum() < 3:
            return best
        seen, by_lens, by_frame = see_slopes(np.tile(best.lens, (int(before.sum()), 1)), frame[before])
        off = pictures[before] - seen
        weight = 1.0 / (1.0 + (off * off).sum(axis=1) / cap) ** 2
        by_turn = np.cross(frame[before][:, None, :], by_frame)
        jacobian = np.concatenate([by_turn, -by_frame @ best.rotation, by_lens[:, :, terms]], axis=2)
        flat = (jacobian * weight[:, None, None]).reshape(-1, jacobian.shape[2])
        normal = flat.T @ jacobian.reshape(-1, jacobian.shape[2])
        gradient = flat.T @ off.reshape(-1)
        scale = np.diag(normal) + 1e-12 * np.trace(normal)
        better = None
        for _ in range(6):
            step = np.linalg.lstsq(normal + damping * np.diag(scale), gradient, rcond=None)[0]
            lens = best.lens.copy()
            lens[terms] += step[6:]
            rotation = turn(step[:3]) @ best.rotation
            place = best.place + step[3:6]
            cost = float(_costs(lens, rotation[None], place[None], places, pictures, cap)[0]) if lens[0] > 0 else np.inf
            if cost < best.cost:
                better = Pose(lens, rotation, place, cost)
                break
            damping *= 10.0
        if better is None:
            return best
        gain = best.cost - better.cost
        best, damping = better, damping * 0.1
        if gain < 1e-6 * best.cost + 1e-14:
            break
    return best


def focal_lenses(size_px: tuple[int, int], count: int = 11) -> Points:
    """(count, 5) lenses to try for a photograph: from 0.35 to 11 times its greater side, no distortion."""
    lenses = np.zeros((count, 5))
    lenses[:, 0] = max(size_px) * np.geomspace(0.35, 11.0, count)
    lenses[:, 1], lenses[:, 2] = size_px[0] / 2.0, size_px[1] / 2.0
    return lenses


def sensible(pose: Pose, size_px: tuple[int, int]) -> bool:
    """Whether a lens could be one: focal length and principal point within reason of the photograph."""
    focal, u, v, k1, _ = pose.lens
    greater = max(size_px)
    centred = abs(u - size_px[0] / 2.0) < 0.3 * greater and abs(v - size_px[1] / 2.0) < 0.3 * greater
    return bool(0.2 * greater < focal < 40.0 * greater and centred and abs(k1) < 5.0)


__all__ = ["Pose", "focal_lenses", "lens_array", "place_camera", "refine_pose", "sensible", "three_point_poses"]
