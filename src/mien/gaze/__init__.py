"""mien.gaze."""
