"""The characters that ship."""
