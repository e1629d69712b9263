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
from .phases import film_phases, load_phases, order_phases
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
    "film_phases",
    "find_voice",
    "hear",
    "load_face",
    "load_phases",
    "make_model",
    "make_pose",
    "make_puppet",
    "order_phases",
    "perform",
    "play",
    "pose_from",
    "say",
    "sheet",
    "speak",
    "voices",
    "warmup",
]
