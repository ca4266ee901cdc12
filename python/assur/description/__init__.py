"""The description of a mechanism (joints, links, slides, drivers) and its structure."""
