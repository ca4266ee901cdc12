"""Vectors with their names and values, and texts along lines."""

from assur.pictures.axes import pyplot

# Whoever lacks matplotlib reads what to install, whichever module of these comes first.
pyplot()
