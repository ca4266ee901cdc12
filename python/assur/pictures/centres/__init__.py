"""Instant centres, centrodes, the inflection circle."""

from assur.pictures.axes import pyplot

# Whoever lacks matplotlib reads what to install, whichever module of these comes first.
pyplot()
