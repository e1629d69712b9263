"""Renderers side by side: what all of them draw, one module a renderer, and the process in which it draws.

Modules here import NumPy, and the one renderer that they are about; they run in the peers' environment.
"""
