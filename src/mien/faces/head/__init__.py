"""Parke's parametric head of 1974, and what he wished for."""

from .head import Head

__all__ = ["Head"]
