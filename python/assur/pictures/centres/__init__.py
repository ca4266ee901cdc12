"""Instant centres, centrodes, the inflection circle."""
