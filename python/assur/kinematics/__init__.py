"""Positions and analogues of mechanisms."""
