"""Resting values that a mechanism needs by name, read from the table."""

from .table import head_table

REST_ARCH = head_table()["eyebrow.arch.left"].default
REST_OPENING = head_table()["eyelid.opening.left"].default
