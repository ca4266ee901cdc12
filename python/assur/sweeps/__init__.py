"""Sweeps over many designs: motions, or metrics of them."""
