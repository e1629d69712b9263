"""Speech and the life around it as one timeline: what a face does while it says something."""

from .performance import Performance, perform
from .style import Style, parse_style

__all__ = ["Performance", "Style", "parse_style", "perform"]
