"""What names of one vocabulary mean to one another: some fight, some mean nothing alone."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache

from .tables import shipped_rows, shipped_tables


@dataclass(frozen=True)
class Rule:
    """What a name is worth beside another.

    Attributes:
        name: whose value changes.
        kind: ``gives way to``: at the other's full value all but ``share`` is left of it, so two names that give way
            to one another meet in the middle; ``is part of``: it counts as a part of the other's value and is nothing
            without it; ``is seen beside``: it keeps its value and is only seen beside the other.
        other: the name beside it, which does not change by this rule.
        share: of the name's value that the rule is about.
        source: where this comes from.
    """

    name: str
    kind: str
    other: str
    share: float
    source: str


def _give_way(value: float, other: float, share: float) -> float:
    return value * (1.0 - share * min(other, 1.0))


def _be_part(value: float, other: float, share: float) -> float:
    part = min(value / other, 1.0) if other > 0.0 else 0.0
    return value + share * (part - value)


def _keep(value: float, other: float, share: float) -> float:
    return value


KINDS: Mapping[str, Callable[[float, float, float], float]] = {
    "gives way to": _give_way,
    "is part of": _be_part,
    "is seen beside": _keep,
}


def _undo_way(value: float, other: float, share: float) -> float:
    left = 1.0 - share * min(other, 1.0)
    return value / left if left > 0.0 else value


def _undo_part(value: float, other: float, share: float) -> float:
    whole = other * (1.0 - share) + share
    return value * other / whole if whole > 0.0 else value


UNDO: Mapping[str, Callable[[float, float, float], float]] = {
    "gives way to": _undo_way,
    "is part of": _undo_part,
    "is seen beside": _keep,
}


@cache
def load_rules(vocabulary: str) -> tuple[Rule, ...]:
    """The rules of a vocabulary; many have none."""
    table = f"{vocabulary}_rules"
    if table not in shipped_tables():
        return ()
    return tuple(
        Rule(row["name"], row["rule"], row["other"], float(row["share"]), row["source"]) for row in shipped_rows(table)
    )


def companions(vocabulary: str, name: str) -> dict[str, float]:
    """The values without which a name is not seen, at their fullest: of ``mouthClose`` it is ``jawOpen``."""
    return {
        rule.other: 1.0
        for rule in load_rules(vocabulary)
        if rule.name == name and rule.kind in ("is part of", "is seen beside")
    }


def settle(values: Mapping[str, float], rules: Iterable[Rule]) -> dict[str, float]:
    """The values after all rules, each of which looks at the values as given, so that their order does not matter
    and a small change of a value is a small change of the result.
    """
    settled = dict(values)
    for rule in rules:
        if rule.name in settled:
            settled[rule.name] = KINDS[rule.kind](settled[rule.name], values.get(rule.other, 0.0), rule.share)
    return settled


def unsettle(values: Mapping[str, float], rules: Iterable[Rule]) -> dict[str, float]:
    """The values that ``settle`` makes into these, 0..1; the inverse where no name of a rule is beside another's."""
    given = dict(values)
    for rule in rules:
        if rule.name in given:
            value = UNDO[rule.kind](given[rule.name], given.get(rule.other, 0.0), rule.share)
            given[rule.name] = min(max(value, 0.0), 1.0)
    return given
