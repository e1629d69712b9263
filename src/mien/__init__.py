"""Faces you can play."""
