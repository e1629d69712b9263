"""mien.render."""
