"""Other names for what a face can do: one sparse matrix between two sets of names, tables as data."""

from .posing import pose_from
from .remap import Remap, families, load_remap, next_step, parse_remap, targets, weigh
from .rules import Rule, load_rules, settle
from .vocabulary import vocabularies, vocabulary

__all__ = [
    "Remap",
    "Rule",
    "families",
    "load_remap",
    "load_rules",
    "next_step",
    "parse_remap",
    "pose_from",
    "settle",
    "targets",
    "vocabularies",
    "vocabulary",
    "weigh",
]
