"""Loads inside a link."""
