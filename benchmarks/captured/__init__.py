"""What ``benchmarks/capture.py`` measures and whom it measures against."""
