"""Which modules have compiled code."""

KERNELS = (
    "mien.faces.head.carrying",
    "mien.faces.head.conformation",
    "mien.faces.head.contact",
    "mien.faces.head.posing",
    "mien.formats.palette",
    "mien.formats.yuv",
    "mien.render.bands",
    "mien.render.filling",
    "mien.render.lighting",
    "mien.render.placing",
    "mien.render.refining",
    "mien.render.spans",
    "mien.render.sweeping",
)
"""Modules with compiled code."""
