"""mien.vocab."""
