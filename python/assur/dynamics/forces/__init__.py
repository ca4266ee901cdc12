"""Forces in joints, slides and drives, and what follows from them."""
