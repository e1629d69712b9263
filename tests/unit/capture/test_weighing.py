"""Corners of boards and clicks are judged each by its own scatter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mien.capture.records import Survey
from mien.capture.simulating import Setup, Simulated, board, simulate
from mien.capture.solving import solve


def rig(sigma_px: float, seed: int = 3) -> Simulated:
    """A board held before fixed cameras, found to 0.05 px and told to be, and a face clicked less well."""
    setup = Setup(references=board(7, 5), points=25, views=3, moments=4, fixed=True, one_lens=False, sigma_px=0.05,
                  size_px=(1600, 1200))  # fmt: skip
    simulated = simulate(setup, seed)
    random = np.random.default_rng(seed)
    names = {each.name for each in simulated.survey.references}
    observations = []
    for each in simulated.survey.observations:
        if each.point in names:
            observations.append(each)
        elif each.photo.startswith("m04"):
            du, dv = sigma_px * random.normal(size=2)
            observations.append(replace(each, u=each.u + du, v=each.v + dv, sigma_px=sigma_px))
    survey = Survey(simulated.survey.photographs, tuple(observations), simulated.survey.references)
    return replace(simulated, survey=survey)


def told(simulated: Simulated, *, boards: float, clicks: float) -> Survey:
    """The survey with standard deviations of corners and of clicks so many times larger than they are."""
    names = {each.name for each in simulated.survey.references}
    return replace(
        simulated.survey,
        observations=tuple(
            replace(each, sigma_px=each.sigma_px * (boards if each.point in names else clicks))
            for each in simulated.survey.observations
        ),
    )


@pytest.mark.parametrize(("boards", "clicks"), [(1.0, 1.0), (3.0, 1.0), (3.0, 0.5)])
def test_either_kind_is_as_exact_as_it_scatters(boards: float, clicks: float) -> None:
    simulated = rig(0.5)
    right, solution = (solve(told(simulated, boards=b, clicks=c)) for b, c in ((1.0, 1.0), (boards, clicks)))
    assert not solution.suspects
    assert 0.8 < solution.chi2_per_dof < 1.25
    said = " ".join(solution.remarks)
    assert ("corners of boards scatter" in said) == (boards != 1.0)
    assert ("clicks scatter" in said) == (clicks != 1.0)
    ratios = [
        np.trace(point.covariance) / np.trace(right.points[key].covariance)
        for key, point in solution.points.items()
        if point.kind == "measured"
    ]
    assert len(ratios) == 25
    assert 0.6 < np.median(ratios) < 1.7
