"""Photographs -> cameras -> points -> faces."""
