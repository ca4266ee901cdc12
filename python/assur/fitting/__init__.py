"""Linkages for a task: what is found, measured and proved."""
