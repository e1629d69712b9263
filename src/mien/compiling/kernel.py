"""A function on arrays and numbers that runs as machine code."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from .signature import Signature, parse_signature

_PASSED = {"f8": (float, ctypes.c_double), "i8": (int, ctypes.c_int64)}


class Kernel:
    """A function to be compiled. One with a signature can be called from Python, any from other kernels.

    Attributes:
        function: the function as it was written; it can be run as it is, slowly.
        signature: what it takes, None for one that only kernels call.
    """

    def __init__(self, function: Callable[..., Any], signature: Signature | None) -> None:
        self.function, self.signature = function, signature
        self.__name__, self.__doc__, self.__module__ = function.__name__, function.__doc__, function.__module__

    def __call__(self, *arguments: Any) -> Any:
        """Run the machine code, beside other threads; what it gives back, or 0.

        Raises:
            TypeError: an argument is not what the signature says; nothing was run.
        """
        native, wanted = self._native
        if len(arguments) != len(wanted):
            raise TypeError(f"{self.__name__}: want {len(wanted)} arguments, got {len(arguments)}")
        passed = []
        for number, (value, (dtype, ndim, convert)) in enumerate(zip(arguments, wanted, strict=True)):
            if not ndim:
                passed.append(convert(value))
                continue
            if value.dtype != dtype or value.ndim != ndim or not value.flags.c_contiguous:
                raise TypeError(
                    f"{self.__name__}: argument {number} must be a C-contiguous array of {ndim} dimensions of "
                    f"{dtype}, got {value.dtype} {value.shape} with strides {value.strides}"
                )
            passed.append(id(value))
        result = ctypes.c_int64(0)
        # The second place is where Numba's code would leave an exception; kernels raise none.
        native(ctypes.byref(result), None, *passed)
        return result.value

    @cached_property
    def _native(self) -> tuple[Any, tuple[tuple[np.dtype[np.generic], int, Any], ...]]:
        """The machine code, with dtype, dimensions and conversion of each argument."""
        from .library import find_address

        if self.signature is None:
            raise TypeError(f"{self.__name__} has no signature: only other kernels can call it")
        kinds: list[Any] = [ctypes.c_void_p, ctypes.c_void_p]
        wanted = []
        for argument in self.signature.arguments:
            convert, kind = (id, ctypes.c_int64) if argument.ndim else _PASSED[argument.dtype.str[1:]]
            kinds.append(kind)
            wanted.append((argument.dtype, argument.ndim, convert))
        return ctypes.CFUNCTYPE(ctypes.c_int32, *kinds)(find_address(self)), tuple(wanted)

    @cached_property
    def dispatcher(self) -> Any:
        """Numba's own object for it; imports Numba."""
        from .build import dispatcher

        return dispatcher(self.function)

    @property
    def _numba_type_(self) -> Any:
        """What Numba takes this for where the source of another kernel names it."""
        from numba import types

        return types.Dispatcher(self.dispatcher)


def kernel(signature: str | None = None) -> Callable[[Callable[..., Any]], Kernel]:
    """Decorator: the function as a kernel.

    A kernel loops over numbers: it makes no arrays, raises nothing, and its arrays are C-contiguous.

    Args:
        signature: what it takes, such as ``f8[:,:], i8[:], i8 -> i8``; None for one that only other kernels call.
    """
    parsed = None if signature is None else parse_signature(signature)
    return lambda function: Kernel(function, parsed)
