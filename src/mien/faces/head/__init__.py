"""mien.head."""
