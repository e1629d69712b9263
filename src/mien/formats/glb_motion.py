"""A timeline as glTF can play it: weights of morph targets, and joints, at every frame.

A performance moves parameters of a face, of which there are more than morph targets. So each frame is given the
weights, 0..1, whose sum of targets comes nearest to its form: least squares over the points that targets move.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from mien.core import Pose, Rigged, Scene, fill_rows
from mien.timeline import Timeline
from mien.vocab import pose_from, vocabulary

from .glb_targets import STILL_M, VOCABULARY, Anatomy

Floats = NDArray[np.float64]

RIDGE = 1e-3
"""What a full weight costs, as a share of what its target moves: of two targets that do nearly the same one acts."""

SWEEPS = 400
SETTLED = 1e-5
"""A fit ends when no weight changes by more."""

CHUNK = 128
"""Frames fitted at once."""


@dataclass(frozen=True, eq=False)
class Recording:
    """N frames of T targets and J joints.

    Attributes:
        times_s: (N,).
        weights: (N, T).
        turns: (N, J, 4) unit quaternions as their parents see them, each next to the one before.
        places: (N, J, 3) m.
    """

    times_s: Floats
    weights: Floats
    turns: Floats
    places: Floats


def resting_pose(face: Rigged, timeline: Timeline, scene: Scene, rate: Fraction) -> Pose:
    """The pose on which a timeline's targets act: what never changes and is out of their reach, else the defaults.

    So a person's colours and proportions are in the mesh, and an expression is in the weights. The eyes look where the
    scene has them look.
    """
    table = face.parameters
    chunks = [values for _, values, _ in timeline.chunks(table, rate)]
    low, high = (np.array([getattr(c, end)(axis=0) for c in chunks]) for end in ("min", "max"))
    moved = {name for joint in face.rig(face.neutral).joints for name in joint.parameters}
    played = (pose_from(VOCABULARY, {name: 1.0}, face).changed() for name in vocabulary(VOCABULARY).names)
    reached = moved.union(*played)
    keep = (low.min(axis=0) == high.max(axis=0)) & [name not in reached for name in table.names]
    return fill_rows(face, Pose(table, np.where(keep, low[0], table.defaults)), scene)


def record(anatomy: Anatomy, timeline: Timeline, scene: Scene, rate: Fraction) -> Recording:
    """A timeline as a recording; the eyes look where they do in a film of the scene."""
    base, _ = anatomy.bring_to_rest(anatomy.base)
    fit = Fit(np.array([_field(anatomy, name) for name in anatomy.names]))
    weights, steps = [], []
    poses = (fill_rows(anatomy.face, pose, scene) for pose in timeline.poses(anatomy.face.parameters, rate))
    while some := [anatomy.bring_to_rest(pose) for pose in islice(poses, CHUNK)]:
        weights.append(fit.weights(np.array([(points - base).ravel() for points, _ in some])))
        steps += [anatomy.rig.steps(motion) for _, motion in some]
    turns, places = (np.array(values) for values in zip(*steps, strict=True))
    return Recording(timeline.frame_times(rate), np.concatenate(weights), join_turns(turns), places)


def join_turns(turns: Floats) -> Floats:
    """Quaternions (N, J, 4) with signs that make each the nearer one to the one before: q and -q turn alike."""
    along = (turns[1:] * turns[:-1]).sum(axis=2)
    signs = np.cumprod(np.where(along < 0.0, -1.0, 1.0), axis=0)
    return np.concatenate([turns[:1], turns[1:] * signs[:, :, None]])


def _field(anatomy: Anatomy, name: str) -> Floats:
    """(3 V,) m, what a name adds to the points that are not subdivided."""
    before, after = (anatomy.bring_to_rest(pose)[0] for pose in anatomy.poses_of(name))
    moves = (after - before).ravel()
    return np.where(np.abs(moves) > STILL_M, moves, 0.0)


class Fit:
    """Weights of targets that come nearest to given forms.

    Args:
        fields: (T, K) m, what each target adds to K coordinates at its fullest.
    """

    def __init__(self, fields: Floats) -> None:
        self._support = [np.flatnonzero(field) for field in fields]
        self._fields = [field[where] for field, where in zip(fields, self._support, strict=True)]
        products = [_sums(fields[:, where] * field) for field, where in zip(self._fields, self._support, strict=True)]
        self._products = np.array(products)
        sizes = self._products.diagonal().copy()
        self._active = np.flatnonzero(sizes)
        self._costs = sizes * (1.0 + RIDGE)

    def weights(self, moves: Floats) -> Floats:
        """(N, T) weights 0..1 for forms that differ from the base by ``moves`` (N, K) m.

        One weight after the other is set to its best until none changes: the sum to be made small is convex.
        """
        slopes = np.array(
            [_sums(moves[:, where] * field) for field, where in zip(self._fields, self._support, strict=True)]
        )
        weights = np.zeros_like(slopes)
        for _ in range(SWEEPS):
            most = 0.0
            for k in self._active.tolist():
                best = (slopes[k] + self._products[k, k] * weights[k]) / self._costs[k]
                change = np.minimum(np.maximum(best, 0.0), 1.0) - weights[k]
                if change.any():
                    weights[k] += change
                    slopes -= self._products[:, k, None] * change
                    most = max(most, float(np.abs(change).max()))
            if most < SETTLED:
                break
        return weights.T


def _sums(products: Floats) -> Floats:
    """(N,) sums of rows (N, K), from first to last: the same bits on every machine."""
    if not products.shape[1]:
        return np.zeros(len(products))
    return np.add.accumulate(products, axis=1)[:, -1]
