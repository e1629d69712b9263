"""Measured geometry (from ICT-FaceKit Light, MIT; notice beside it) and tables of the head."""
