"""Diagrams: quantities over the driver or time, flywheels, runs."""

from assur.pictures.axes import pyplot

# Whoever lacks matplotlib reads what to install, whichever module of these comes first.
pyplot()
