"""Balancing: harmonics of shaking forces, counterweights of any linkage."""

from assur.balance.fit import MomentBounds, fit
from assur.balance.harmonics import Harmonics, RotatingParts, harmonics, rotating_parts
from assur.balance.weights import four_bar, slider_crank
from assur.dynamics.forces.counterweight import Counterweight

__all__ = [
    "Counterweight",
    "Harmonics",
    "MomentBounds",
    "RotatingParts",
    "fit",
    "four_bar",
    "harmonics",
    "rotating_parts",
    "slider_crank",
]
