"""mien.formats."""
