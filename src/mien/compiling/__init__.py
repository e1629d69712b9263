"""Loops over numbers, written in Python and run as machine code, which is compiled once and then read from a cache.

Importing a module with kernels is light: Numba, which compiles, is imported only when the cache lacks something.
"""

from .kernel import Kernel, kernel
from .library import Report, load_kernels, on_compile

__all__ = ["Kernel", "Report", "kernel", "load_kernels", "on_compile"]
