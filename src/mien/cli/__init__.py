"""mien.cli."""
