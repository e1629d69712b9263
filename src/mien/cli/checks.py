"""What ``mien doctor`` looks at: each check gives lines that say what there is, and what to do where it is not well."""

from __future__ import annotations

import os
import platform
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from mien.core import MienError

if TYPE_CHECKING:
    from mien.live.serving.runtime import Running

OK, NOTE, PROBLEM = "ok", "note", "problem"

PYTHON = ((3, 11), (3, 14))
"""The first version that mien runs on, and the first one that it does not."""

ANSWER_S = 2.0

PACKAGES: Mapping[str, str] = MappingProxyType(
    {
        "numpy": "numpy",
        "numba": "",  # is imported only where something has to be compiled
        "llvmlite": "llvmlite.binding",
        "av": "av",
        "pillow": "PIL.Image",
        "typer": "typer",
        "rich": "rich",
        "hibari-tts": "",  # the check of voices imports it
        "onnxruntime": "onnxruntime",
        "matplotlib": "",
        "scipy": "",
        "opencv-python-headless": "cv2",
        "pocketsphinx": "",
        "starlette": "starlette",
        "uvicorn": "uvicorn",
        "websockets": "websockets",
    }
)
"""What mien needs, and which module shows quickly that it can be used."""


@dataclass(frozen=True)
class Line:
    """Something that was looked at.

    Attributes:
        about: what it is.
        status: ``OK``, ``NOTE`` or ``PROBLEM``, which means that mien cannot be used.
        text: what was found.
        advice: what to do about it.
    """

    about: str
    status: str
    text: str
    advice: str = ""


def check_packages(load: Callable[[str], object] = import_module) -> Iterator[Line]:
    """Versions, and whether what is installed can be used."""
    low, high = PYTHON
    fits = low <= sys.version_info[:2] < high
    wanted = "mien runs on Python " + " to ".join(f"{a}.{b}" for a, b in (low, (high[0], high[1] - 1)))
    system = f"{platform.python_version()} on {platform.system()} {platform.machine()}"
    yield Line("python", OK if fits else PROBLEM, system, "" if fits else wanted)
    for name, module in {"mien": "mien", **PACKAGES}.items():
        try:
            found = version(name)
            if module:
                load(module)
        except PackageNotFoundError:
            yield Line(name, PROBLEM, "is not installed", "pip install --force-reinstall mien")
        except (ImportError, OSError) as error:
            reason = str(error).splitlines()[0] if str(error) else type(error).__name__
            yield Line(name, PROBLEM, f"{found} cannot be used: {reason}", f"pip install --force-reinstall {name}")
        else:
            yield Line(name, OK, found)


def check_faces() -> Iterator[Line]:
    """Faces and voices."""
    from mien import api

    try:
        names = [name for name, _ in api.face_names()]
        api.load_face()
        heads = sum(name.startswith("head") for name in names)
        yield Line("faces", OK, f"{heads} heads, {len(names) - heads} drawn; mien faces lists them")
    except (MienError, OSError) as error:
        yield Line("faces", PROBLEM, str(error), "pip install --force-reinstall mien")
    try:
        voices = api.voices()
        yield Line("voices", OK, f"{len(voices)}; mien voices lists them")
    except (MienError, ImportError, OSError) as error:
        yield Line(
            "voices", NOTE, str(error), "faces can be seen, and moved by sound files, but not speak by themselves"
        )


def check_folders(cache: Callable[[], Path]) -> Iterator[Line]:
    """Where things are kept."""
    from mien.compiling.folders import can_write

    folder = cache()
    files = [path for path in folder.glob("*.objects") if path.is_file()]
    text = f"{folder}: {len(files)} files, {sum(path.stat().st_size for path in files) / 1e6:.1f} MB"
    if folder.parent == Path(tempfile.gettempdir()):
        yield Line(
            "compiled code", NOTE, "cannot be kept: no folder for it can be written to", "set NUMBA_CACHE_DIR to one"
        )
    elif not files:
        yield Line("compiled code", NOTE, text, "the first picture takes half a minute longer, or: mien warmup")
    else:
        yield Line("compiled code", OK, text)
    temporary = Path(tempfile.gettempdir())
    fits = can_write(temporary)
    advice = "" if fits else "free some space, or set TMPDIR to a folder that can be written to"
    yield Line("temporary files", OK if fits else PROBLEM, str(temporary), advice)


def check_servers(environment: Mapping[str, str] = os.environ) -> Iterator[Line]:
    """What listens: servers of this user, and whether the usual port is free for another one."""
    from mien.live.link import DEFAULT_PORT
    from mien.live.serving.runtime import running_servers, runtime_folders

    servers = running_servers(environment)
    for server in servers:
        yield _check_server(server)
    if not servers:
        yield Line("live faces", OK, "none runs")
    if not runtime_folders(environment):
        yield Line("live faces", NOTE, "are not found by clients without a link", "set XDG_RUNTIME_DIR or HOME")
    if DEFAULT_PORT in (port for server in servers for port in server.ports.values()):
        yield Line("usual port", OK, f"{DEFAULT_PORT} is that of a live face; another one needs --port 0")
    elif _is_free(DEFAULT_PORT):
        yield Line("usual port", OK, f"{DEFAULT_PORT} is free")
    else:
        yield Line("usual port", NOTE, f"{DEFAULT_PORT} is taken by another program", "mien live --port 0")


def _check_server(server: Running) -> Line:
    """A server that runs: where, what it says of itself. Its token is nobody else's business."""
    from mien.live.reaching import fetch

    address, about = server.address, f"{server.face}, live"
    others = [f"{name} port {port}" for name, port in server.ports.items() if name != "page"]
    place = ", ".join((f"http://{address.place}", *others, f"process {server.pid}"))
    try:
        told: dict[str, Any] = fetch(address, "/about", ANSWER_S)
        clients, loops = told["clients"], told["loops"]
        watching = sum(bool(client.get("frames")) for client in clients)
        text = f"{place}; {told['rate_hz']:g} loops/s, {watching} watching, {len(clients)} connected"
        late = loops["late"] + loops["dropped"]
    except MienError as error:
        reason = str(error).removeprefix(f"{address.place}: ").partition(" — ")[0]
        return Line(about, NOTE, f"{place}; {reason}", f"if it stays so, end it: kill {server.pid}")
    except (KeyError, TypeError, AttributeError):
        return Line(about, NOTE, f"{place}; is of another version: {server.version}", "end it and start it again")
    if late > loops["run"] / 100:
        return Line(about, NOTE, f"{text}; {late} of {loops['run']} loops came late", "--rate 30 takes half as much")
    return Line(about, OK, text)


def _is_free(port: int) -> bool:
    import socket

    try:
        socket.create_server(("127.0.0.1", port)).close()
    except OSError:
        return False
    return True


def check_needless() -> Iterator[Line]:
    """What people look for that mien does without."""
    yield Line("not needed", OK, "network, GPU, fonts, ffmpeg, Chromium; a live face is seen in any recent browser")


def check_all() -> Iterator[tuple[str, list[Line]]]:
    """All checks under their headings."""
    from mien.compiling.folders import cache_folder

    yield "Versions", [*check_packages()]
    yield "Faces", [*check_faces()]
    yield "Folders", [*check_folders(cache_folder)]
    yield "Live", [*check_servers()]
    yield "Besides", [*check_needless()]
