"""Machines: bodies, loads and motors, and how they move."""
