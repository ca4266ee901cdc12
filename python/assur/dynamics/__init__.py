"""Machines: bodies, loads, motors, and their motion in time."""
