"""Derivatives of motions by drivers and dimensions."""
