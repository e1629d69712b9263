"""What a program calls: load a face, draw it, let it speak."""

from .faces import (
    DEFAULT_FACE,
    default_scene,
    face_names,
    find_voice,
    load_face,
    make_pose,
    pose_from,
    voices,
    warmup,
)
from .pictures import (
    draw,
    draw_paths,
    make_model,
    make_puppet,
    sheet,
)
from .playing import (
    hear,
    perform,
    play,
    say,
    speak,
)

__all__ = [
    "DEFAULT_FACE",
    "default_scene",
    "draw",
    "draw_paths",
    "face_names",
    "find_voice",
    "hear",
    "load_face",
    "make_model",
    "make_pose",
    "make_puppet",
    "perform",
    "play",
    "pose_from",
    "say",
    "sheet",
    "speak",
    "voices",
    "warmup",
]
