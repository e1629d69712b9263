"""Parke's face of 1972: measured phases of one topology, interpolated."""

from .face import KeyposeFace

__all__ = ["KeyposeFace"]
