"""Steps of ``tools/measure_head.py``: what people and expressions do to our skin, measured on reference heads."""
