"""Tracks, layers and timelines: named parameter values over time. NumPy only."""

from .change import CHANGES
from .layers import BLENDS, STANDARD_LAYERS, Layer
from .timeline import Timeline
from .track import Segment, Track

__all__ = ["BLENDS", "CHANGES", "STANDARD_LAYERS", "Layer", "Segment", "Timeline", "Track"]
