"""Constructors of named mechanisms."""
