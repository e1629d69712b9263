"""mien.faces."""
