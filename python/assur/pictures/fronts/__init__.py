"""Designs between several goals: their values as a picture, and a page that opens each."""
