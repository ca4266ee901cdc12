"""Theory specific to the papers: slider-crank and crank-rocker formulas."""
