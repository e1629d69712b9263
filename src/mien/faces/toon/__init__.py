"""The drawn face: flat polygons on control points, after ToonFace (Thórisson 1996)."""
