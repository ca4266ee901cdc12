"""Forces in their places, force polygons, polar load diagrams."""
