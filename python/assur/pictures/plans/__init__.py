"""Plans of velocities and accelerations, hodographs."""

from assur.pictures.axes import pyplot

# Without matplotlib, any of these modules raises the error that says what to install.
pyplot()
