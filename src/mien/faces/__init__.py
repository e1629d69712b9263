"""Kinds of face, strangers to one another; the registry names them."""

from .batch import shapes
from .registry import face_names, load_face

__all__ = ["face_names", "load_face", "shapes"]
