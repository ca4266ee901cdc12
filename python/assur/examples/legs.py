"""Legs of walking machines."""

from __future__ import annotations

from assur.kinematics.mechanism import Mechanism

__all__ = ["jansen_leg", "klann_leg"]


def jansen_leg() -> Mechanism:
    """Leg of Theo Jansen's beach animals; foot F.

    His "holy numbers" in cm (crank 15 cm, a 38 cm, b 41.5 cm, …), as a drawing rounded to a tenth
    of a millimetre. Look at the path of F, flat to 1 cm for two fifths of the turn. The lower dyad
    does not depend on the upper one.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    T. Jansen, *The Great Pretender* (2007).

    Examples
    --------
    >>> import assur, numpy as np
    >>> foot = assur.examples.jansen_leg().solve(np.linspace(0, 2 * np.pi, 361)).joint("F").value
    >>> np.ptp(foot, axis=0).round(3)                                   # stride and lift, m
    array([0.679, 0.225])
    """
    places = {
        "O": (0.0, 0.0),
        "M": (9.61, 11.52),
        "B": (-38.0, -7.8),
        "T": (-35.24, 33.61),
        "W": (-77.75, -2.54),
        "L": (-20.1, -42.79),
        "K": (-56.05, -35.42),
        "F": (-22.22, -91.74),
    }
    return Mechanism(
        joints={name: (x / 100, y / 100) for name, (x, y) in places.items()},
        links={
            "ground": "OB",
            "crank": "OM",
            "upper_rod": "MT",
            "upper": "BTW",
            "lower_rod": "ML",
            "lower_rocker": "BL",
            "link": "WK",
            "foot": "LKF",
        },
        driver="crank",
    )


def klann_leg() -> Mechanism:
    """Leg of Joe Klann's mechanical spider; foot F.

    The example of the patent, whose unit is the stride, with a stride of 0.5 m: drawn in its
    position X, with the foot at one end of the stride. E elbow, K knee, H hip. For half a turn the
    foot's height changes by 0.055 strides only; it is lifted by 0.53.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    J. C. Klann, "Walking device", US patent 6,260,862 (2001).

    Examples
    --------
    >>> import assur
    >>> foot = assur.examples.klann_leg().solve(deg=[180, 0]).joint("F").value / 0.5
    >>> foot.round(2) + 0.0                                             # both ends of a stride
    array([[0., 0.],
           [1., 0.]])
    """
    places = {
        "O": (1.599, 0.750),
        "U": (1.366, 1.366),
        "L": (1.009, 0.574),
        "M": (1.331, 0.750),
        "E": (0.741, 0.750),
        "K": (0.232, 0.866),
        "H": (0.866, 1.500),
        "F": (0.0, 0.0),
    }
    return Mechanism(
        joints={name: (x / 2, y / 2) for name, (x, y) in places.items()},
        links={
            "ground": "OUL",
            "crank": "OM",
            "rod": "MEK",
            "lower_rocker": "LE",
            "upper_rocker": "UH",
            "leg": "HKF",
        },
        driver="crank",
    )
