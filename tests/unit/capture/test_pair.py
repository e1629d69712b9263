"""The pair of 1972: what it finds of simulated faces, with and without perspective, and how sure it says to be."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from mien.capture.pair import solve_pair
from mien.capture.pair_simulating import HEAD_M, Marks, PairSetup, marks_of_head, simulate_pair
from mien.capture.records import Observation, Photograph, Solution, Survey
from mien.core.mesh import Points

FRONT, SIDE = "front.jpg", "side.jpg"
TURNED = ((2.0, -1.5, 3.0), (1.5, 1.0, 0.0))


@cache
def marks(count: int = 60, both_sides: bool = False) -> Marks:
    return marks_of_head(count, seed=3, both_sides=both_sides)


def doubles(survey: Survey) -> list[str]:
    seen = [{each.point for each in survey.observations if each.photo == photo} for photo in (FRONT, SIDE)]
    return sorted(seen[0] & seen[1])


def told_length(survey: Survey, marked: Marks) -> tuple[str, str, float]:
    """The tallest length between points that both photographs show."""
    low, *_, high = sorted(doubles(survey), key=lambda name: marked.places[name][1])
    return low, high, float(np.linalg.norm(marked.places[low] - marked.places[high]))


def solve(survey: Survey, marked: Marks, **options: object) -> Solution:
    clicked = {each.point for each in survey.observations}
    midline = [name for name in marked.midline if name in clicked]
    options = {"scale": told_length(survey, marked), "midline": midline} | options
    return solve_pair(survey, front=FRONT, side=SIDE, **options)  # type: ignore[arg-type]


def aligned(solution: Solution, marked: Marks, kind: str = "measured") -> tuple[list[str], Points]:
    """Names (N,) of points of a kind, and their errors (N, 3) m when the points of the midline lie as they should."""
    by_name = {name: point for (_, name), point in solution.points.items() if name in marked.places}
    on = [name for name in marked.midline if name in by_name and by_name[name].kind == "measured"]
    shift = np.mean([by_name[name].place - marked.places[name] for name in on], axis=0)
    names = [name for name, point in by_name.items() if point.kind == kind]
    return names, np.array([by_name[name].place - marked.places[name] - shift for name in names]).reshape(-1, 3)


def share_of_head(solution: Solution, marked: Marks) -> float:
    _, off = aligned(solution, marked)
    return float(np.sqrt(np.mean(np.sum(off**2, axis=1)))) / HEAD_M


def test_as_in_1972_x_and_y_come_from_the_front_and_z_and_y_from_the_side() -> None:
    """A ruler's answer: the front at 10 px per cm, the side at 20, its picture from the face's own left."""
    front = {"top": (500, 400), "nose": (500, 500), "chin": (500, 600), "ear": (570, 500), "cheek": (540, 550)}
    side = {"top": (1000, 800), "nose": (960, 1000), "chin": (1010, 1200), "ear": (1200, 1000), "cheek": (1100, 1100)}
    clicks = [
        Observation(photo, name, u, v) for photo, at in ((FRONT, front), (SIDE, side)) for name, (u, v) in at.items()
    ]
    photographs = (Photograph(FRONT, (1000, 1000), "a"), Photograph(SIDE, (2000, 2000), "b"))
    solution = solve_pair(
        Survey(photographs, tuple(clicks), ()),
        front=FRONT,
        side=SIDE,
        scale=("top", "chin", 0.2000625),
        orthographic=True,
        midline=("top", "nose", "chin"),
        mirror=False,
    )
    nose = solution.points["rest", "nose"].place
    wanted = {"top": (0, 10, -2), "nose": (0, 0, 0), "chin": (0, -10, -2.5), "ear": (7, 0, -12), "cheek": (4, -5, -7)}
    for name, centimetres in wanted.items():
        found = solution.points["rest", name].place - nose
        np.testing.assert_allclose(found, 0.01 * np.array(centimetres), atol=2e-5, err_msg=name)
    assert solution.method == "pair-1972"
    assert solution.chi2_per_dof < 1e-6


@pytest.mark.parametrize("side_from", ["left", "right"])
def test_exact_clicks_give_the_face_and_the_distances_of_both_cameras(side_from: str) -> None:
    setup = PairSetup((1.0, 1.6), ((2.0, -1.5, 3.0), (1.5, 0.0, 0.0)), sigma_px=0.0, side_from=side_from)
    flip = np.array([1.0 if side_from == "left" else -1.0, 1.0, 1.0])
    survey, _ = simulate_pair(PairSetup(), marks())
    middle = np.mean([marks().places[name] for name in doubles(survey)], axis=0) * [0.0, 1.0, 1.0]
    marked = Marks(
        {name: (place - middle) * flip for name, place in marks().places.items()},
        {name: normal * flip for name, normal in marks().normals.items()},
        marks().midline,
    )
    survey, cameras = simulate_pair(setup, marked)
    survey = replace(survey, observations=tuple(replace(each, sigma_px=0.02) for each in survey.observations))
    solution = solve(survey, marked, side_turn_deg=0.01)
    assert f"own {side_from} side" in " ".join(solution.remarks)
    assert share_of_head(solution, marked) < 0.001
    for name, camera in cameras.items():
        apart = np.linalg.norm(solution.cameras[name].place) / np.linalg.norm(camera.place)
        assert apart == pytest.approx(1.0, abs=0.015)
        assert solution.cameras[name].lens.focal_px == pytest.approx(camera.lens.focal_px, rel=0.015)


def test_perspective_leaves_less_than_half_of_what_is_wrong_without_it() -> None:
    for distance in (1.0, 2.0):
        survey, _ = simulate_pair(PairSetup((distance, distance)), marks(), seed=1)
        flat, solved = (share_of_head(solve(survey, marks(), orthographic=each), marks()) for each in (True, False))
        assert solved < 0.005
        assert solved < flat / 2.0
        assert flat < 0.02


def test_pictures_of_other_sizes_scales_lenses_and_places_in_the_frame() -> None:
    setup = PairSetup(
        (1.2, 3.0),
        TURNED,
        sizes_px=((3000, 4000), (1920, 1080)),
        filled=(0.5, 0.8),
        offsets=((0.1, -0.1), (-0.05, 0.02)),
    )
    survey, _ = simulate_pair(setup, marks())
    solution = solve(survey, marks())
    assert share_of_head(solution, marks()) < 0.01
    assert solution.chi2_per_dof == pytest.approx(1.0, abs=0.5)
    assert not solution.suspects


def test_standard_deviations_are_honest_axis_by_axis() -> None:
    places: dict[str, list[Points]] = {"measured": [], "modelled": []}
    for seed in range(8):
        random = np.random.default_rng(seed)
        turns = random.normal(size=(2, 3)) * 2.0
        turns[1] = 2.0 * random.normal(), 3.0 * random.normal(), 0.0
        setup = PairSetup((1.2, 1.2), (tuple(turns[0]), tuple(turns[1])))
        survey, _ = simulate_pair(setup, marks(), seed)
        solution = solve(survey, marks())
        for kind, each in places.items():
            names, off = aligned(solution, marks(), kind)
            each += [
                d / np.sqrt(np.diag(solution.points["rest", name].covariance))
                for name, d in zip(names, off, strict=True)
            ]
    for kind, each in places.items():
        covered = np.mean(np.abs(each) < 1.96, axis=0)
        assert covered.min() > 0.85, (kind, covered)


def test_one_lens_and_a_tape_tell_more_of_the_cameras() -> None:
    setup = PairSetup((1.0, 1.3), TURNED, sigma_px=0.1)
    survey, _ = simulate_pair(setup, marks())
    one, _ = simulate_pair(replace(setup, one_lens=True, filled=(0.6, 0.6 / 1.3)), marks())
    depth = max(doubles(survey), key=lambda name: marks().places[name][0])

    def sigma(solution: Solution) -> float:
        return float(np.sqrt(solution.points["rest", depth].covariance[2, 2]))

    alone = sigma(solve(survey, marks()))
    tape = {FRONT: (1.0 - 0.08, 0.005), SIDE: (1.3 - 0.07, 0.005)}
    assert sigma(solve(one, marks())) < alone
    assert sigma(solve(survey, marks(), camera_distance_m=tape)) < alone
    sure = solve(survey, marks(), side_turn_deg=0.2)
    assert sigma(sure) < 0.3 * alone


def test_points_of_both_halves_help_one_another_and_say_so() -> None:
    marked = marks(60, both_sides=True)
    survey, _ = simulate_pair(PairSetup(), marked)
    solution = solve(survey, marked, midline=())
    kinds = {point.kind for point in solution.points.values()}
    assert kinds >= {"measured", "symmetric", "modelled"}
    names, off = aligned(solution, marked, "symmetric")
    assert names
    for name in names:
        assert solution.points["rest", name].photos in ((FRONT,), (SIDE,))
    assert np.sqrt(np.mean(off**2)) < 0.0015
    assert any(remark.startswith("taken for points of the symmetry plane") for remark in solution.remarks)


def test_the_other_half_is_the_mirror_image_less_surely_known() -> None:
    survey, _ = simulate_pair(PairSetup(), marks())
    solution = solve(survey, marks())
    alone = solve(survey, marks(), mirror=False)
    assert set(alone.points) < set(solution.points)
    images = [point for point in solution.points.values() if point.kind == "mirrored"]
    assert len(images) == sum(name not in marks().midline for _, name in alone.points)
    for image in images:
        assert image.name.endswith(".right")
        origin = solution.points[image.moment, image.name.removesuffix(".right")]
        np.testing.assert_array_equal(image.place, origin.place * [-1.0, 1.0, 1.0])
        assert (np.diag(image.covariance) > np.diag(origin.covariance)).all()


def test_a_click_at_a_wrong_height_is_named_and_takes_no_part() -> None:
    survey, _ = simulate_pair(PairSetup(), marks())
    low, high, _ = told_length(survey, marks())
    wrong = next(name for name in doubles(survey) if name not in (low, high, *marks().midline))
    moved = tuple(
        replace(each, v=each.v + 40.0) if (each.photo, each.point) == (SIDE, wrong) else each
        for each in survey.observations
    )
    solution = solve(replace(survey, observations=moved), marks())
    assert {each.observation.point for each in solution.suspects} == {wrong}
    assert any(repr(wrong) in remark for remark in solution.remarks)
    assert ("rest", wrong) not in solution.points
    assert len(solution.residuals) == len(survey.observations)
    assert share_of_head(solution, marks()) < 0.005


def test_a_far_camera_is_assumed_and_said_where_clicks_are_too_rough() -> None:
    survey, _ = simulate_pair(PairSetup((4.0, 4.0), sigma_px=8.0), marks())
    remarks = solve(survey, marks()).remarks
    assert any("hardly tell how far the camera" in remark and "assumed" in remark for remark in remarks)
    near, _ = simulate_pair(PairSetup((1.0, 1.0)), marks())
    assert any("stood 1.0" in remark or "stood 0.9" in remark for remark in solve(near, marks()).remarks)


def test_the_same_clicks_give_the_same_bytes() -> None:
    survey, _ = simulate_pair(PairSetup(), marks())
    shuffled = replace(survey, observations=survey.observations[::-1])
    one, other = solve(survey, marks()), solve(shuffled, marks())
    for key, point in one.points.items():
        np.testing.assert_array_equal(point.place, other.points[key].place)
