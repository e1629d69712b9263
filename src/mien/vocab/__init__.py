"""Other names for what a face can do: one sparse matrix between two sets of names, tables as data."""

from .loading import families, load_remap, next_step, parse_remap, targets
from .posing import pose_from, set_values
from .remap import Link, Remap, weigh
from .rules import Rule, load_rules, settle
from .vocabulary import vocabularies, vocabulary

__all__ = [
    "Link",
    "Remap",
    "Rule",
    "families",
    "load_remap",
    "load_rules",
    "next_step",
    "parse_remap",
    "pose_from",
    "set_values",
    "settle",
    "targets",
    "vocabularies",
    "vocabulary",
    "weigh",
]
