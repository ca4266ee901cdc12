"""Straight lines: Chebyshev's, which is almost straight, and the exact ones of two inversors."""

from __future__ import annotations

from assur.kinematics.mechanism import Mechanism

__all__ = ["chebyshev_lambda", "hart", "peaucellier"]


def chebyshev_lambda() -> Mechanism:
    """Chebyshev's lambda linkage: P moves almost on a straight line for half a turn.

    Chebyshev's proportions: crank 1, ground 2, coupler half, its other half and rocker 2.5; unit
    50 mm. C is as far from B as from D and P, so that BD and DP are at right angles (Thales).
    During the half turn 90° … 270° P goes 4 units, and off the line by √1029/8 − 4 = 0.00975.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    I. I. Artobolevsky, *Mechanisms in Modern Engineering Design* (1975), Chebyshev's lambda
    mechanism.

    Examples
    --------
    >>> import assur, numpy as np
    >>> pen = assur.examples.chebyshev_lambda().solve(deg=np.linspace(90, 270, 181)).joint("P")
    >>> np.ptp(pen.value / 0.05, axis=0).round(5)                       # units
    array([4.     , 0.00975])
    """
    return Mechanism(
        joints={"A": (0, 0), "B": (-0.05, 0), "C": (0.025, 0.1), "D": (0.1, 0), "P": (0.1, 0.2)},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )


def peaucellier() -> Mechanism:
    """Peaucellier and Lipkin's inversor: the first planar linkage to draw an exact line (1864).

    Arms OA, OC 250 mm, rhombus A, B, C, P 170 mm: OB · OP = 0.25² − 0.17². B runs on a circle
    through O (crank QB = QO = 60 mm), so that P runs on the line x = 280 mm. It closes for
    cos(q/2) ≥ (0.25 − 0.17)/(2 · 0.06), q within ±96.4°.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    A. B. Kempe, *How to Draw a Straight Line* (1877); own dimensions.

    Examples
    --------
    >>> import assur
    >>> pen = assur.examples.peaucellier().solve(deg=[-90, -45, 0, 45, 90]).joint("P").value
    >>> pen.T.round(9) + 0.0                                            # y = 0.28 tan(q/2)
    array([[ 0.28   ,  0.28   ,  0.28   ,  0.28   ,  0.28   ],
           [-0.28   , -0.11598,  0.     ,  0.11598,  0.28   ]])
    """
    return Mechanism(
        joints={
            "O": (0, 0),
            "Q": (0.06, 0),
            "B": (0.12, 0),
            "A": (0.2, 0.15),
            "C": (0.2, -0.15),
            "P": (0.28, 0),
        },
        links={
            "ground": "OQ",
            "crank": "QB",
            "arm1": "OA",
            "arm2": "OC",
            "side1": "BA",
            "side2": "BC",
            "side3": "AP",
            "side4": "CP",
        },
        driver="crank",
    )


def hart() -> Mechanism:
    """Hart's inversor: the same line with four bars of a crossed parallelogram (1874).

    Bars AB = CD = 200 mm, AD = BC = 130 mm; O, P, Q in the middles of AD, AB, CD are in line and
    OP · OQ = (0.2² − 0.13²)/4. The crank MP = MO = 52.5 mm leads P round a circle through O, so
    that Q runs on x = 55 mm. It closes for cos(q/2) ≥ 1/3, q within ±141°.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    A. B. Kempe, *How to Draw a Straight Line* (1877); own dimensions.

    Examples
    --------
    >>> import assur
    >>> pen = assur.examples.hart().solve(deg=[-90, 0, 90]).joint("Q").value
    >>> pen.T.round(9) + 0.0                                            # y = 0.055 tan(q/2)
    array([[ 0.055,  0.055,  0.055],
           [-0.055,  0.   ,  0.055]])
    """
    return Mechanism(
        joints={
            "O": (0, 0),
            "M": (0.0525, 0),
            "P": (0.105, 0),
            "A": (0.025, 0.06),
            "B": (0.185, -0.06),
            "C": (0.135, 0.06),
            "D": (-0.025, -0.06),
            "Q": (0.055, 0),
        },
        links={
            "ground": "OM",
            "crank": "MP",
            "short1": "ADO",
            "long1": "ABP",
            "short2": "BC",
            "long2": "CDQ",
        },
        driver="crank",
    )
