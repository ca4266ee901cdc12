"""Mechanisms drawn by matplotlib: positions, paths, films."""

from assur.pictures.axes import pyplot

# Whoever lacks matplotlib reads what to install, whichever module of these comes first.
pyplot()
