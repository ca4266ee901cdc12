"""What leads to a motion that is given: coordinates, dimensions."""
