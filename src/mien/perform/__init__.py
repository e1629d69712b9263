"""Speech and the life around it as one timeline: what a face does while it says something."""

from .performance import Performance, check_emotion, listen, perform
from .style import Style, parse_style

__all__ = ["Performance", "Style", "check_emotion", "listen", "parse_style", "perform"]
