"""Machine code of the kernels of a module: read from the cache, or compiled and kept there.

A cached file is found by a digest of everything that decides its bytes: the source, the versions of the compilers, the
processor. It holds object files, which are linked here into the running process.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

from .folders import cache_folder
from .kernel import Kernel

Report = Callable[[str], None]

MESSAGE = "compiling what poses and draws, once, about half a minute"

_lock = threading.RLock()
_report: list[Report] = []
_libraries: dict[str, Library] = {}


def on_compile(report: Report | None) -> None:
    """Have ``report`` called with one line before something is compiled for the first time; None: nobody."""
    _report[:] = [] if report is None else [report]


@dataclass(frozen=True)
class Library:
    """Linked machine code of a module.

    Attributes:
        addresses: where each kernel with a signature begins.
        engines: hold the code in memory.
    """

    addresses: dict[str, int]
    engines: tuple[Any, ...]


def find_address(kernel: Kernel) -> int:
    """Where the machine code of a kernel begins in this process."""
    return _load(sys.modules[kernel.__module__]).addresses[kernel.__name__]


def load_kernels(names: Sequence[str]) -> None:
    """Load every kernel of the modules of these names; what must be compiled is shared out among processes."""
    modules = [import_module(name) for name in names]
    cold = [module.__name__ for module in modules if not _path(module).is_file()]
    workers = min(len(cold), os.cpu_count() or 1)
    if workers > 1:
        from concurrent.futures import ThreadPoolExecutor

        _tell()
        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(_compile_elsewhere, cold))
    for module in modules:
        _load(module)


def _compile_elsewhere(name: str) -> None:
    """Have another process compile a module into the cache; where that fails, it is compiled here when it is used."""
    import subprocess

    code = f"from mien.compiling import load_kernels; load_kernels([{name!r}])"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache_folder()), "PYTHONPATH": os.pathsep.join(sys.path)}
    subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, check=False)


def _load(module: ModuleType) -> Library:
    with _lock:
        name = module.__name__
        if name not in _libraries:
            path = _path(module)
            objects = _read(path)
            if objects is None:
                objects = _compile(module)
                _write(path, objects)
            _libraries[name] = _link(objects)
        return _libraries[name]


def _path(module: ModuleType) -> Path:
    return cache_folder() / f"{module.__name__}-{_digest(module)}.objects"


def _tell() -> None:
    if _report:
        _report[0](MESSAGE)
        _report.clear()


def _kernels(module: ModuleType) -> list[Kernel]:
    """The kernels of a module that can be called from Python."""
    mine = [value for value in vars(module).values() if isinstance(value, Kernel)]
    return [kernel for kernel in mine if kernel.signature and kernel.__module__ == module.__name__]


def _compile(module: ModuleType) -> dict[str, tuple[str, bytes]]:
    """Kernel -> its name in an object file, and that file."""
    _tell()
    from .build import build

    return {kernel.__name__: build(kernel, _target()) for kernel in _kernels(module)}


def _link(objects: dict[str, tuple[str, bytes]]) -> Library:
    from llvmlite import binding

    addresses, engines = {}, []
    for name, (symbol, code) in objects.items():
        # One engine a file: the files of two processes may give two functions the same name.
        engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _target())
        engine.add_object_file(binding.ObjectFileRef.from_data(code))
        engine.finalize_object()
        addresses[name] = engine.get_function_address(symbol)
        engines.append(engine)
    return Library(addresses, tuple(engines))


def _processor() -> tuple[str, str]:
    """Name and features of the processor that is compiled for; Numba's own settings rule."""
    from llvmlite import binding

    name = os.environ.get("NUMBA_CPU_NAME") or binding.get_host_cpu_name()
    generic = name == "generic"
    features = "" if generic else binding.get_host_cpu_features().flatten()
    return name, os.environ.get("NUMBA_CPU_FEATURES", features)


def _target() -> Any:
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    name, features = _processor()
    target = binding.Target.from_triple(binding.get_process_triple())
    return target.create_target_machine(cpu=name, features=features, opt=3, reloc="default", codemodel="jitdefault")


def _digest(module: ModuleType) -> str:
    """Sixteen letters that change with anything that decides the machine code of a module."""
    text = json.dumps([_processor(), object.__basicsize__])
    digest = hashlib.sha256(text.encode())
    for source in (_version("numba"), _version("llvmlite"), *sorted(_sources(module))):
        digest.update(source)
    return digest.hexdigest()[:16]


def _sources(module: ModuleType) -> set[bytes]:
    """The source of a module and of all modules whose kernels it uses, their constants, and the compiler's front."""
    found: dict[str, bytes] = {}

    def visit(each: ModuleType) -> None:
        if each.__name__ in found:
            return
        constants = sorted(
            (name, value) for name, value in vars(each).items() if isinstance(value, int | float | tuple)
        )
        found[each.__name__] = Path(each.__file__ or "").read_bytes() + repr(constants).encode()
        for value in vars(each).values():
            if isinstance(value, Kernel) and value.__module__ != each.__name__:
                visit(sys.modules[value.__module__])

    visit(module)
    front = Path(__file__).with_name("build.py").read_bytes()
    return {*found.values(), front}


@cache
def _version(package: str) -> bytes:
    """The file in which a package says its version: asking ``importlib.metadata`` takes tens of milliseconds."""
    spec = find_spec(package)
    return Path(spec.origin).with_name("_version.py").read_bytes() if spec and spec.origin else b""


def _read(path: Path) -> dict[str, tuple[str, bytes]] | None:
    """What ``_write`` wrote, None where there is no such file or it is damaged."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    checksum, content = data[:32], data[32:]
    if hashlib.sha256(content).digest() != checksum:
        return None
    line, _, codes = content.partition(b"\n")
    objects, place = {}, 0
    for name, symbol, size in json.loads(line):
        objects[name] = (symbol, codes[place : place + size])
        place += size
    return objects


def _write(path: Path, objects: dict[str, tuple[str, bytes]]) -> None:
    """Writes a file in one step, so that nobody reads half of it; a folder that has no room is no reason to stop."""
    index = [(name, symbol, len(code)) for name, (symbol, code) in objects.items()]
    content = json.dumps(index).encode() + b"\n" + b"".join(code for _, code in objects.values())
    try:
        handle, temporary = tempfile.mkstemp(dir=path.parent)
    except OSError:
        return
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(hashlib.sha256(content).digest() + content)
        os.replace(temporary, path)
    except OSError:
        Path(temporary).unlink(missing_ok=True)
