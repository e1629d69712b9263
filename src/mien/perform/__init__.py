"""mien.perform."""
