"""Plans of velocities and accelerations, hodographs."""
