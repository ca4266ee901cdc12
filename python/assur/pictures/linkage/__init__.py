"""Mechanisms drawn by matplotlib: positions, paths, films."""
