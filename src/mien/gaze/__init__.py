"""What a face does beside speaking: blinks, glances, small movements of the head, brows on accented words."""

from .accents import Accent, find_accents
from .blinks import blinks
from .brows import brow_raises
from .eyes import saccades
from .head import head_sway, nods
from .looks import Glance, look_directions, looks

__all__ = [
    "Accent",
    "Glance",
    "blinks",
    "brow_raises",
    "find_accents",
    "head_sway",
    "look_directions",
    "looks",
    "nods",
    "saccades",
]
