"""A face that moves while one looks at it: sessions, messages, motions. No sockets, no clock."""

from .logs import Log, load_log, read_log
from .loop import CATCH_UP, Deadlines, Report, run_loops
from .messages import IDLE_PARTS, KINDS, LAYERS, Message, check_message, json_schema, parse_batch
from .motions import Motion, fit_motion, parse_motions, standard_motions
from .replay import perform_log, replay
from .session import Frame, Session
from .slices import Motors, Way, count_slices

__all__ = [
    "CATCH_UP",
    "IDLE_PARTS",
    "KINDS",
    "LAYERS",
    "Deadlines",
    "Frame",
    "Log",
    "Message",
    "Motion",
    "Motors",
    "Report",
    "Session",
    "Way",
    "check_message",
    "count_slices",
    "fit_motion",
    "json_schema",
    "load_log",
    "parse_batch",
    "parse_motions",
    "perform_log",
    "read_log",
    "replay",
    "run_loops",
    "standard_motions",
]
