"""Forces in their places, force polygons, polar load diagrams."""

from assur.pictures.axes import pyplot

# Without matplotlib, any of these modules raises the error that says what to install.
pyplot()
