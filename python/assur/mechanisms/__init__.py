"""Mechanisms that have names."""
