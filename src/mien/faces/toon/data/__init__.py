"""Tables and characters of drawn faces."""
