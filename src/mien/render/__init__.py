"""Pictures of faces: viewing transform, clipping, hidden surfaces, light; plain and compiled, equal to the byte.

Nothing here imports Numba before the first picture is drawn.
"""

from .renderer import Renderer, draw, draw_drawing, draw_mesh

__all__ = ["Renderer", "draw", "draw_drawing", "draw_mesh"]
