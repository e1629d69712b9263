"""What a face does beside speaking: blinks, glances, small movements of the head, brows on accented words."""

from .accents import Accent, find_accents
from .blinks import blinks
from .brows import brow_raises
from .eyes import saccades
from .head import head_sway, nods

__all__ = ["Accent", "blinks", "brow_raises", "find_accents", "head_sway", "nods", "saccades"]
