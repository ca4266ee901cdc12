"""Vectors with their names and values, and texts along lines."""

from assur.pictures.axes import pyplot

# Without matplotlib, any of these modules raises the error that says what to install.
pyplot()
