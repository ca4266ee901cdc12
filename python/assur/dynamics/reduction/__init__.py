"""Inertia and moment referred to the drivers."""
