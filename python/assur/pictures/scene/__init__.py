"""Mechanisms as symbols, without a drawing library."""
