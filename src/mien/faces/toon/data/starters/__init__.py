"""Faces to start a drawing from, as files."""
