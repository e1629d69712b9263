"""mien.speech."""
