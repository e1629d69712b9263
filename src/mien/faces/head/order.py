"""The order in which the parameters act, as data: Parke's figure of the structure of his model.

Source: Parke 1974, figure 3.1 and chapter 3.
"""

from __future__ import annotations

from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cache

from .shipped import shipped_rows

MECHANISMS = ("interpolation", "scaling", "translation", "rotation", "procedure", "colour")


@dataclass(frozen=True)
class Act:
    """Parameters that act together.

    Attributes:
        function: what carries them out.
        node: the part of the head that they change, from the head down to it.
        mechanism: one of ``MECHANISMS``.
        parameters: their names, where ``*`` stands for the rest of a name.
    """

    function: str
    node: tuple[str, ...]
    mechanism: str
    parameters: tuple[str, ...]

    def takes(self, parameter: str) -> bool:
        """Whether a parameter is one of these."""
        return any(fnmatchcase(parameter, pattern) for pattern in self.parameters)

    @property
    def titles(self) -> tuple[str, ...]:
        """The names without sides and axes, an interpolation with the asterisk of Parke's figure."""
        star = "*" if self.mechanism == "interpolation" else ""
        return tuple(pattern.removesuffix(".*").removeprefix("*.") + star for pattern in self.parameters)


def titles_by_mechanism(node: tuple[str, ...]) -> dict[str, tuple[str, ...]]:
    """What changes a part of the head itself, not a part of it: mechanism -> titles, in the order of the first acts."""
    out: dict[str, tuple[str, ...]] = {}
    for act in acts():
        if act.node == node:
            out[act.mechanism] = (*out.get(act.mechanism, ()), *act.titles)
    return out


@cache
def acts() -> tuple[Act, ...]:
    """Rows of ``data/order.csv``, first to last."""
    return tuple(
        Act(row["function"], tuple(row["node"].split()), row["mechanism"], tuple(row["parameters"].split()))
        for row in shipped_rows("order")
    )


def nodes() -> tuple[tuple[str, ...], ...]:
    """Every part of the head, each after what it is part of and before what follows that."""
    found = list(dict.fromkeys(act.node[:depth] for act in acts() for depth in range(1, len(act.node) + 1)))
    return tuple(sorted(found, key=lambda node: [found.index(node[: depth + 1]) for depth in range(len(node))]))
