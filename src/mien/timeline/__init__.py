"""mien.timeline."""
