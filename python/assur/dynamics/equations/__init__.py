"""The equations of motion at given positions and speeds: mass matrices and accelerations."""
