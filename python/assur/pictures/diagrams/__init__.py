"""Diagrams: quantities over the driver or time, flywheels, runs."""
