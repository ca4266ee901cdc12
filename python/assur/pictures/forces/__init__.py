"""Forces in their places, force polygons, polar load diagrams."""

from assur.pictures.axes import pyplot

# Whoever lacks matplotlib reads what to install, whichever module of these comes first.
pyplot()
