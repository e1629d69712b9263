"""Speech and the life around it as one timeline: what a face does while it says something."""

from .corrected import correct, cues_for_speech
from .exaggeration import exaggerate
from .expressions import check_emotion, check_marks
from .marks import MarkedText
from .marks_reader import parse_marks
from .performance import Performance, listen, perform
from .script import Script, read_script
from .style import NamedStyle, Style, named_styles, parse_style, style_table
from .style_files import load_style, read_style

__all__ = [
    "MarkedText",
    "NamedStyle",
    "Performance",
    "Script",
    "Style",
    "check_emotion",
    "check_marks",
    "correct",
    "cues_for_speech",
    "exaggerate",
    "listen",
    "load_style",
    "named_styles",
    "parse_marks",
    "parse_style",
    "perform",
    "read_script",
    "read_style",
    "style_table",
]
