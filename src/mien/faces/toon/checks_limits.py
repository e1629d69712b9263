"""Control points and limits of motors that do not fit together, and tables out of order."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from .checks_faults import Fault, Place
from .checks_sheet import Sheet
from .lines import ENDS, EYES
from .motors import motors

NEAR = 1e-6
"""Drawing units that nobody sees."""

MEETS = 0.15
"""Share of an eye's opening by which its lids may miss one another when it is shut: our choice."""

Points = Mapping[str, Sequence[float]]


def find_wrong_limits(sheet: Sheet) -> Iterator[Fault]:
    """All faults of control points, limits and tables."""
    points = {name: found for name in ENDS if (found := sheet.sound("features", name, "points")) is not None}
    for name, each in points.items():
        yield from _points(name, each, sheet.strict)
    yield from _sides(sheet)
    for code in sheet.members("motors"):
        if code in motors():
            yield from _limits(sheet, code)
    for eye in EYES:
        if eye in points:
            yield from _lids(sheet, eye, points[eye])
    if "M" in points:
        yield from _lips(sheet, points["M"])
    yield from _tables(sheet)


def _points(feature: str, points: Points, strict: bool) -> Iterator[Fault]:
    place: Place = ("features", feature, "points")
    left, upper, lower, right = ENDS[feature]
    if points[left][0] > points[right][0]:
        what = f"{left} is to the right of {right} as one sees the picture"
        yield Fault("order", (*place, left), what, f"{left} left of {right}")
        return
    for one, other in dict.fromkeys(pair for middle in (upper, lower) for pair in pairwise((left, middle, right))):
        (x, y), (u, v) = points[one], points[other]
        if abs(x - u) <= NEAR and abs(y - v) <= NEAR:
            yield Fault("coincide", (*place, other), f"is where {one} is, and the line between them has no direction")
        elif abs(x - u) <= NEAR and not strict:
            yield Fault("coincide", (*place, other), f"is straight above or below {one}", severity="warning")
        elif x > u:
            yield Fault("order", (*place, other), f"is to the left of {one} as one sees it", severity="warning")
    if points[upper][1] > points[lower][1]:
        yield Fault("order", (*place, upper), f"{upper} is below {lower}; y grows downwards", f"{upper} above {lower}")


def _sides(sheet: Sheet) -> Iterator[Fault]:
    """Features whose right one is to the right in the picture."""
    for right, left, code in (("ER", "EL", "U"), ("PR", "PL", ""), ("BR", "BL", "C"), ("AR", "AL", "")):
        one, other = (sheet.sound("features", name, "points", name + code) for name in (right, left))
        if one is not None and other is not None and one[0] >= other[0]:
            what = f"is to the right of {left} in the picture; right and left are the face's own"
            yield Fault("order", ("features", right, "points", right + code), what, f"{right} left of {left}")


def _limits(sheet: Sheet, code: str) -> Iterator[Fault]:
    place: Place = ("motors", code)
    given = {key: sheet.value(*place, key) for key in ("min", "max", "min_deg", "max_deg")}
    numbers = {key: value for key, value in given.items() if type(value) in (int, float)}
    for low, high in (("min", "max"), ("min_deg", "max_deg")):
        if low not in numbers or high not in numbers:
            continue
        least, most = numbers[low], numbers[high]
        if least > most:
            yield Fault("limits", (*place, low), f"the minimum is above the maximum, {most:g}", got=f"{least:g}")
        elif least > 0.0 or most < 0.0:
            key, value = (low, least) if least > 0.0 else (high, most)
            yield Fault("limits", (*place, key), f"rest, 0, is not between {least:g} and {most:g}", got=f"{value:g}")
        elif least == most and motors()[code].paper:
            yield Fault("still", (*place, low), "minimum and maximum are the same, so that nothing moves")
    for offset, angle in (("min", "min_deg"), ("max", "max_deg")):
        if offset in numbers and angle in numbers and bool(numbers[offset]) != bool(numbers[angle]):
            zero, other = (angle, offset) if numbers[offset] else (offset, angle)
            yield Fault("limits", (*place, zero), f"is 0, but {other} is {numbers[other]:g}", "both 0 or neither")


def _lids(sheet: Sheet, eye: str, points: Points) -> Iterator[Fault]:
    low = sheet.sound("motors", eye + "U", "min")
    gap = points[eye + "L"][1] - points[eye + "U"][1]
    if low is not None and low < 0.0 < gap and abs(low + gap) > MEETS * gap:
        what = "the upper lid stops short of the lower one" if -low < gap else "the upper lid goes past the lower one"
        yield Fault("shut", ("motors", eye + "U", "min"), what, f"about {-gap:g}", f"{low:g}")


def _lips(sheet: Sheet, points: Points) -> Iterator[Fault]:
    low = sheet.sound("motors", "MB", "min")
    gap = points["MB"][1] - points["MT"][1]
    if low is not None and low <= 0.0 and gap + low > 1.0:
        what = "the lips do not meet when MB is at its minimum"
        yield Fault("shut", ("motors", "MB", "min"), what, f"{-gap:g} or below", f"{low:g}")


def _tables(sheet: Sheet) -> Iterator[Fault]:
    places: list[Place] = [("features", name, "shape") for name in sheet.members("features")]
    places += [("polygons", number, "width") for number, _ in sheet.polygons]
    places += [(*place, "offset") for place, _ in sheet.lines()]
    for place in places:
        table = sheet.sound(*place)
        if isinstance(table, list):
            wrong = next((row for row, (one, other) in enumerate(pairwise(table), 1) if one[0] >= other[0]), None)
            if wrong is not None:
                before, got = table[wrong - 1][0], table[wrong][0]
                yield Fault("table", (*place, wrong), "comes before the row above it", f"above {before:g}", f"{got:g}")
    for name in sheet.members("hand", "moves"):
        times = [key["time"] for key in sheet.sound("hand", "moves", name) or ()]
        for row, (before, got) in enumerate(pairwise(times), 1):
            if before >= got:
                moment: Place = ("hand", "moves", name, row, "time")
                yield Fault("table", moment, "is not after the key above it", f"above {before:g}", f"{got:g}")
    for place, line in sheet.lines():
        start, end = line.get("range", (-1.0, 1.0))
        if start >= end:
            yield Fault("table", (*place, "range"), "ends before it begins", f"above {start:g}", f"{end:g}")
    for place, driver in sheet.drivers():
        for key in ("min", "max"):
            state = driver.get(key)
            ramp = state.get("ramp") if isinstance(state, dict) else None
            if ramp and ramp[0] == ramp[1]:
                yield Fault("table", (*place, key, "ramp"), "ends where it begins", "two heights", f"{ramp[0]:g} twice")
