"""Files: one module a format, listed in ``table``; each appears whole or not at all.

Nothing heavy is imported here: the codecs come when the first film or picture is written.
"""

from .performances import DEFAULT_FPS, check_performance, write_performance
from .table import FORMATS, Format, find_format

__all__ = ["DEFAULT_FPS", "FORMATS", "Format", "check_performance", "find_format", "write_performance"]
