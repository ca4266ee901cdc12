"""Motions of a machine in time, and where it rests."""
