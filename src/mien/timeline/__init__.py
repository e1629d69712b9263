"""Tracks, layers and timelines: named parameter values over time. NumPy only."""

from .change import CHANGES
from .commands import command_list, format_commands
from .csv_form import format_csv, parse_csv
from .exaggeration import exaggerate_timeline
from .json_form import StoredTimeline, from_json, json_text, to_json
from .layers import BLENDS, STANDARD_LAYERS, Layer
from .rates import Rate, exact_rate
from .settings import with_settings
from .specification import Mark, Specification, Specifications, format_specifications, parse_specifications
from .timeline import Timeline
from .track import Segment, Track

__all__ = [
    "BLENDS",
    "CHANGES",
    "STANDARD_LAYERS",
    "Layer",
    "Mark",
    "Rate",
    "Segment",
    "Specification",
    "Specifications",
    "StoredTimeline",
    "Timeline",
    "Track",
    "command_list",
    "exact_rate",
    "exaggerate_timeline",
    "format_commands",
    "format_csv",
    "format_specifications",
    "from_json",
    "json_text",
    "parse_csv",
    "parse_specifications",
    "to_json",
    "with_settings",
]
