"""From kernels to machine code. Imports Numba: only where the cache lacks something."""

# Numba brings no types.
# mypy: disable-error-code="no-untyped-call,no-untyped-def"

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numba
from llvmlite import binding
from numba.core import types
from numba.extending import intrinsic
from numba.np.arrayobj import populate_array

from .kernel import Kernel
from .signature import Argument

WORD_BYTES = 8
HEADER_BYTES = object.__basicsize__
"""An array object begins like every object. The words that follow: its data, its number of dimensions, its shape, its
strides. Source: NumPy's C API, ``PyArrayObject``."""

C_LIBRARY = {"memset", "memcpy", "memmove", "ceil", "floor", "rint", "trunc", "sqrt"}
"""What compilers call on their own account; each of these has one right answer, whoever computes it."""

# No ``fastmath``: it would let the processor decide the last bit of a picture.
_OPTIONS: dict[str, Any] = {
    "nogil": True,
    "error_model": "numpy",
    "fastmath": False,
    "_nrt": False,
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}


def dispatcher(function: Callable[..., Any]) -> Any:
    """Numba's object for a function that kernels call."""
    return numba.njit(**_OPTIONS)(function)


def build(kernel: Kernel, target: binding.TargetMachine) -> tuple[str, bytes]:
    """The name under which a kernel with a signature is found in an object file, and that file.

    The function in it takes a place for the result and one for an exception, both of which are Numba's custom, then
    numbers, and addresses of array objects.
    """
    if kernel.signature is None:
        raise TypeError(f"{kernel.__name__} has no signature")
    given = kernel.signature.arguments
    kinds = [types.int64 if each.ndim else _element(each) for each in given]
    compiled = numba.njit(types.int64(*kinds), **_OPTIONS)(_entry(kernel, given, kernel.signature.returns))
    (signature,) = compiled.signatures
    module = binding.parse_assembly(compiled.inspect_llvm(signature))
    _check_alone(kernel, module)
    compilation: Any = compiled.overloads[signature]
    return compilation.fndesc.llvm_func_name, target.emit_object(module)


def _check_alone(kernel: Kernel, module: binding.ModuleRef) -> None:
    """Nothing, when a kernel calls nothing but what the C library has: Numba's own helpers are not there later."""
    called = {function.name for function in module.functions if function.is_declaration}
    foreign = sorted(name for name in called - C_LIBRARY if not name.startswith("llvm."))
    if foreign:
        raise TypeError(f"kernel {kernel.__name__} calls {', '.join(foreign)}: loops over numbers and slices need none")


def _entry(kernel: Kernel, arguments: Sequence[Argument], returns: bool) -> Callable[..., Any]:
    """A function that calls the kernel with the arrays whose addresses it is given."""
    scope: dict[str, Any] = {"kernel": kernel}
    names, values = [], []
    for number, argument in enumerate(arguments):
        names.append(f"a{number}")
        values.append(f"array{number}(a{number})" if argument.ndim else f"a{number}")
        if argument.ndim:
            scope[f"array{number}"] = _array_at(types.Array(_element(argument), argument.ndim, "C"))
    call = f"kernel({', '.join(values)})"
    body = f"return {call}" if returns else f"{call}; return 0"
    exec(f"def entry_{kernel.__name__}({', '.join(names)}): {body}", scope)
    entry: Callable[..., Any] = scope[f"entry_{kernel.__name__}"]
    return entry


def _element(argument: Argument) -> Any:
    return numba.from_dtype(argument.dtype)  # type: ignore[arg-type]


def _array_at(kind: Any) -> Any:
    """A function from the address of an array object to the array."""

    @intrinsic
    def array_at(typing_context, address):
        def generate(context, builder, signature, arguments):
            word = context.get_value_type(types.int64)

            def load(place, number, result=word):
                offset = builder.add(place, word(number * WORD_BYTES))
                return builder.load(builder.inttoptr(offset, result.as_pointer()))

            fields = builder.add(arguments[0], word(HEADER_BYTES))
            array = context.make_array(kind)(context, builder)
            shape = [load(load(fields, 2), side) for side in range(kind.ndim)]
            size = context.get_abi_sizeof(context.get_data_type(kind.dtype))
            strides = [word(size)]
            for side in reversed(shape[1:]):
                strides.insert(0, builder.mul(strides[0], side))
            data = load(fields, 0, array.data.type)
            populate_array(array, data=data, shape=shape, strides=strides, itemsize=word(size), meminfo=None)
            return array._getvalue()

        return kind(types.int64), generate

    return array_at
