"""Steps of ``tools/photograph.py``: people of a reference folder, dressed, marked with dots and photographed."""
