"""Four-bars: the crank-rocker, and the parallelograms of a locomotive's rods."""

from __future__ import annotations

import math

from assur.description.words import Slide
from assur.kinematics.mechanism import Mechanism

__all__ = ["crank_rocker", "locomotive"]

# C is 120 mm from B and 80 mm from D; all digits, so that the drawing is the same everywhere.
FOUR_BAR = {
    "A": (0.0, 0.0),
    "B": (0.0, 0.04),
    "D": (0.1, 0.0),
    "C": (0.11353844749371159, 0.07884611873427894),
}
COUPLER_POINT = (0.03, 0.12)


def crank_rocker() -> Mechanism:
    """Crank-rocker four-bar with a coupler point P.

    Crank 40 mm, coupler 120 mm, rocker 80 mm, ground 100 mm: a textbook's round numbers. By
    Grashof 40 + 120 < 80 + 100, and the shortest link is the crank: it turns fully, the rocker
    swings. Look at the path of P, and at the rocker's limits, where crank and coupler are in line.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    F. Freudenstein, "Approximate Synthesis of Four-Bar Linkages", *Transactions of the ASME* 77
    (1955); own dimensions.

    Examples
    --------
    >>> import assur, numpy as np
    >>> swing = assur.examples.crank_rocker().extremes("rocker").stroke
    >>> round(float(np.degrees(swing)), 3)                  # by the law of cosines
    73.782
    """
    return Mechanism(
        joints={**FOUR_BAR, "P": COUPLER_POINT},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )


def locomotive() -> Mechanism:
    """A locomotive's rods: three wheels on one coupling rod, one wheel more than it needs.

    Crank pins 330 mm from the axles (stroke 660 mm), axles 2.2 m apart, main rod 3 m: round
    numbers of an express engine. Counted, the mobility is 0: the third wheel's pin is a redundant
    constraint, which fits because all three parallelograms are equal. Look at
    ``structure.redundant``, and at the change points q = 0 and π, where the rods are flat and the
    parallelograms could become crossed: the motion goes through them.

    Returns
    -------
    Mechanism
        Class II, overconstrained; q is the angle of the driving wheel's crank (wheel2), rad.

    References
    ----------
    I. I. Artobolevsky, *Theory of Mechanisms and Machines* (1988), redundant constraints; own
    dimensions.

    Examples
    --------
    >>> import assur, numpy as np
    >>> m = assur.examples.locomotive()
    >>> m.structure.mobility_counted, m.structure.mobility, m.structure.redundant
    (0, 1, ('wheel3',))
    >>> bool(np.ptp(m.solve([1.0, 3.0, 5.0]).link("coupling_rod").value) < 1e-14)   # never turns
    True
    """
    pin, axles, rod = 0.33, 2.2, 3.0
    return Mechanism(
        joints={
            "O1": (0, 0),
            "O2": (axles, 0),
            "O3": (2 * axles, 0),
            "A1": (0, pin),
            "A2": (axles, pin),
            "A3": (2 * axles, pin),
            "X": (axles - math.sqrt(rod * rod - pin * pin), 0),
        },
        links={
            "ground": ["O1", "O2", "O3"],
            "wheel1": ["O1", "A1"],
            "wheel2": ["O2", "A2"],
            "wheel3": ["O3", "A3"],
            "coupling_rod": ["A1", "A2", "A3"],
            "main_rod": ["A2", "X"],
            "crosshead": ["X"],
        },
        slides={"guide": Slide("crosshead", on="ground", angle=0.0, origin="O2")},
        driver="wheel2",
    )
