"""What a user writes: joints, links, slides and drivers, and what kind of mechanism they make."""
