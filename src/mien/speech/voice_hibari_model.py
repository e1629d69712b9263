"""hibari's model, opened so that it also says how long each phone lasts."""

from __future__ import annotations

import os
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from mien.core import MienError

HIBARI_VERSION = "0.2.1"
"""The release whose model we know how to ask for its durations."""

DURATIONS = "/Clip_output_0"
"""The tensor of the model that holds how long each letter lasts, and is no output of it until we say so."""


def check_version() -> None:
    """Nothing, when the release of hibari that we know is installed.

    Raises:
        MienError: otherwise.
    """
    hint = f"try: pip install 'hibari-tts=={HIBARI_VERSION}'"
    try:
        installed = version("hibari-tts")
    except PackageNotFoundError:
        raise MienError(f"voice 'hibari': the package hibari-tts is not installed — {hint}") from None
    if installed != HIBARI_VERSION:
        raise MienError(f"voice 'hibari': want hibari-tts {HIBARI_VERSION}, got {installed} — {hint}")


def open_model(model: bytes) -> Any:
    """The model, which also gives its durations; one thread, so that sums have one order."""
    # From its import on, onnxruntime 1.31 would keep an identifier of the machine in the user's cache folder, with a
    # store of events that it can send to its makers. What people let mien say is nobody's business.
    os.environ.setdefault("ORT_DISABLE_TELEMETRY", "1")
    import onnxruntime

    onnxruntime.disable_telemetry_events()
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 3
    options.enable_cpu_mem_arena = False  # an arena keeps the memory of the longest sentence
    # onnxruntime has many kinds of error, none public but their common ancestor.
    try:
        session = onnxruntime.InferenceSession(
            add_output(model, DURATIONS), options, providers=["CPUExecutionProvider"]
        )
    except (RuntimeError, ValueError, onnxruntime.capi.onnxruntime_pybind11_state.Fail) as error:
        raise MienError(
            f"voice 'hibari': its model does not open, or has no tensor {DURATIONS!r} with the lengths of its phones; "
            f"hibari-tts {HIBARI_VERSION} has — try: pip install --force-reinstall 'hibari-tts=={HIBARI_VERSION}'"
            f" ({str(error).splitlines()[0]})"
        ) from None
    return session


def add_output(model: bytes, tensor: str) -> bytes:
    """An ONNX model that also gives an inner tensor.

    The model is a protocol buffer, whose messages are joined by appending: one more ``graph`` (field 7) with one
    ``output`` (field 12) that has a ``name`` (field 1) adds to what is there.

    Source: Protocol Buffers, Encoding, "Last One Wins" (embedded messages are merged); onnx.proto.
    """

    def field(number: int, content: bytes) -> bytes:
        length, size = len(content), b""
        while length > 127:
            size += bytes([length & 127 | 128])
            length >>= 7
        return bytes([number << 3 | 2]) + size + bytes([length]) + content

    return model + field(7, field(12, field(1, tensor.encode())))
