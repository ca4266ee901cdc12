"""A press, and the squeezer of the benchmarks with its masses, spring and motor."""

from __future__ import annotations

import math

from assur._trig import sin_cos
from assur.description.words import Slide
from assur.dynamics.loads.loads import Body, Spring
from assur.dynamics.loads.motors import ConstantTorque
from assur.dynamics.machine import Machine
from assur.kinematics.mechanism import Mechanism

__all__ = ["andrews_squeezer", "toggle_press"]


def toggle_press() -> Mechanism:
    """Toggle press: crank, rod and two toggle links; at the toggle the ram's force has no bound.

    Crank 50 mm, rod 250 mm, toggle links 200 mm. Drawn at its toggle, q = π: crank and rod are
    stretched where both toggle links are in line with the ram, so that the ram's distance from its
    lowest place is of the fourth order: it dwells. Look at ``mechanical_advantage("guide")``.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    J. J. Uicker, G. R. Pennock and J. E. Shigley, *Theory of Machines and Mechanisms*, toggle
    positions; own dimensions.

    Examples
    --------
    >>> import assur
    >>> motion = assur.examples.toggle_press().solve(deg=[90, 150, 175])
    >>> motion.mechanical_advantage("guide").round(0)                   # N per N·m
    array([   38.,   431., 83835.])
    """
    return Mechanism(
        joints={"O": (0.3, -0.2), "A": (0.25, -0.2), "B": (0, -0.2), "C": (0, -0.4), "D": (0, 0)},
        links={
            "ground": "OD",
            "crank": "OA",
            "rod": "AB",
            "upper": "DB",
            "lower": "BC",
            "ram": "C",
        },
        slides={"guide": Slide("ram", on="ground", angle=-math.pi / 2, origin="D")},
        driver="crank",
    )


def andrews_squeezer() -> Machine:
    """Andrews' squeezer: the multibody benchmark of seven bodies, with its data.

    Seven bodies K1 … K7 of 4 to 71 g on the pivots O, A and B, the largest 40 mm long; a spring of
    4530 N/m from C to D on K3; a motor with the constant torque 0.033 N·m on K1; no weight. From
    rest it makes two and a half turns in 0.03 s. As the sources solve it, it has seven coordinates
    and six constraints; here it is a crank with three dyads, one equation of motion. At 0.03 s the
    angles agree with the printed reference to 10 digits, and with a solution of the sources'
    equations by another program to 12.

    Returns
    -------
    Machine
        Class II; q is the angle β of K1, rad, and starts at ``mechanism.q0`` with the speed 0.

    References
    ----------
    W. Schiehlen (ed.), *Multibody Systems Handbook* (1990); E. Hairer and G. Wanner, *Solving
    Ordinary Differential Equations II* (1996), section VII.7; reference solution: F. Mazzia and
    C. Magherini, *Test Set for Initial Value Problem Solvers* (2008).

    Examples
    --------
    >>> import assur
    >>> squeezer = assur.examples.andrews_squeezer()
    >>> run = squeezer.run(t_end=0.03, q0=squeezer.mechanism.q0, speed0=0.0)
    >>> print(f"{run.q[-1]:.6f} rad, {run.speed[-1]:.4f} rad/s")
    15.810771 rad, 1139.9203 rad/s
    """
    # The source's letters: lengths, pivots and the initial angles β, γ, δ, ε. Θ, Φ, Ω and the
    # lengths d, e, zf follow from these: the angles have the digits for it.
    rr, ss, sc, sd, e, zt, zf, u = 7e-3, 35e-3, 18e-3, 2e-2, 2e-2, 4e-2, 2e-2, 4e-2
    xa, ya, xb, yb = -0.06934, -0.00227, -0.03635, 0.03273
    angles = [-0.0617138900142764496, 0.455279819163070380, 0.487364979543842550]
    sines, cosines = sin_cos([*angles, 1.23054744454982119])
    s, c = dict(zip("βγδε", sines, strict=True)), dict(zip("βγδε", cosines, strict=True))
    mechanism = Mechanism(
        joints={
            "O": (0, 0),
            "A": (xa, ya),
            "B": (xb, yb),
            "C": (0.014, 0.072),
            "D": (xb + sc * s["γ"] + sd * c["γ"], yb - sc * c["γ"] + sd * s["γ"]),
            "E": (xb + ss * s["γ"], yb - ss * c["γ"]),
            "F": (rr * c["β"], rr * s["β"]),
            "G": (xa + zt * c["δ"], ya + zt * s["δ"]),
            "H": (xa + u * s["ε"], ya - u * c["ε"]),
        },
        links={
            "ground": "OABC",
            "K1": "OF",
            "K2": "FE",
            "K3": "BED",
            "K4": "GE",
            "K5": "AG",
            "K6": "HE",
            "K7": "AH",
        },
        driver="K1",
    )
    return Machine(
        mechanism,
        bodies={
            "K1": Body(mass=0.04325, inertia=2.194e-6, at=(0.00092, 0.0)),
            "K2": Body(mass=0.00365, inertia=4.410e-7, at=(0.0115, 0.0)),
            "K3": Body(mass=0.02373, inertia=5.255e-6, at=(0.01874, 0.01043)),
            "K4": Body(mass=0.00706, inertia=5.667e-7, at=(e - 0.01421, 0.0)),
            "K5": Body(mass=0.07050, inertia=1.169e-5, at=(0.02308, 0.00916)),
            "K6": Body(mass=0.00706, inertia=5.667e-7, at=(zf - 0.01421, 0.0)),
            "K7": Body(mass=0.05498, inertia=1.912e-5, at=(0.01228, -0.00449)),
        },
        loads=[Spring("C", "D", stiffness=4530.0, length=0.07785)],
        motor=ConstantTorque(0.033),
    )
