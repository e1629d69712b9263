"""Other names for what a face can do: one sparse matrix between two sets of names, tables as data."""

from .channels import channel_table
from .remap import Remap, families, load_remap, parse_remap, weigh

__all__ = ["Remap", "channel_table", "families", "load_remap", "parse_remap", "weigh"]
