"""Flywheels of machines."""
