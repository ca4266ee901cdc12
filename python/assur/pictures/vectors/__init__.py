"""Vectors with their names and values, and texts along lines."""
