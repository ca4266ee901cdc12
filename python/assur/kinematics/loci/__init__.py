"""Curves over the plane of two coordinates: singular loci, boundaries of workspaces, maps."""
