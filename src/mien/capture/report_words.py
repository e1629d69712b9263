"""What a report says in words: how exact the points are, what was assumed, what to do better."""

from __future__ import annotations

import math
from collections.abc import Mapping

from .records import Solution
from .report_numbers import Exactness, Unit, count, significant

METHODS: Mapping[str, str] = {
    "metric": "Places and lenses of all cameras and all points were refined together until the clicks fit best.",
    "appendix-c": "Each camera is the transformation of eleven numbers of Parke 1974, Appendix C, from its references "
    "alone; lenses are taken to be free of distortion.",
    "pair": "Front and side photograph of 1972 with perspective: how far the cameras stood, and how the head turned in "
    "between, follow from heights that both photographs show.",
    "pair-1972": "Front and side photograph as in 1972, as if taken from very far away.",
}
"""What each method does."""

WELL_FITTING = (0.5, 1.5)
"""χ² per degree of freedom within which sigmas of clicks are taken for right."""


def lead(exactness: Exactness, unit: Unit) -> str:
    """The first sentence: how exact."""
    if not exactness.points:
        return "Cameras are solved; there is no point besides the references."
    known = f"{count(exactness.points, 'point')} measured, exact to {unit.length(exactness.point_rms_m)}"
    share = f" — {significant(100 * exactness.share, 2)} % of the {unit.length(exactness.span_m)} that "
    return known + (f"{share}the {exactness.spanned} span." if exactness.span_m > 0.0 else ".")


def explanations(solution: Solution, exactness: Exactness) -> tuple[str, ...]:
    """Sentences after the first: how the clicks fit, what was left out, how it was solved."""
    fit = f"Clicks fit to {significant(exactness.residual_rms_px, 2)} px (root mean square). "
    left_out = (
        f"{count(exactness.suspects, 'click')} of {exactness.clicks} "
        f"{'does' if exactness.suspects == 1 else 'do'} not fit the others and took no part."
        if exactness.suspects
        else f"None of the {exactness.clicks} clicks is suspect."
    )
    method = METHODS.get(solution.method, f"Method: {solution.method}.")
    return (fit + _chi2_words(exactness.chi2_per_dof), left_out, method)


def _chi2_words(chi2: float) -> str:
    told = f"χ² per degree of freedom is {significant(chi2)}: "
    low, high = WELL_FITTING
    if not math.isfinite(chi2):
        return "There is nothing left over to tell by whether the sigmas of the clicks are right."
    if chi2 > high:
        return (
            f"{told}they fit {significant(math.sqrt(chi2), 2)} times worse than their sigmas say. A remark tells where "
            "that is counted in how exact points are. Look at the largest arrows, at the references, at lens terms "
            "that are assumed."
        )
    if chi2 < low:
        return f"{told}they fit better than their sigmas say, so that points may be more exact than told here."
    return f"{told}as well as their sigmas say."
