"""Mechanisms drawn by matplotlib: positions, paths, films."""

from assur.pictures.axes import pyplot

# Without matplotlib, any of these modules raises the error that says what to install.
pyplot()
