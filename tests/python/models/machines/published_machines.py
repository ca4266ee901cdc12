"""Machines whose reactions others have published, and what they print."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import assur
from assur import Body, Force, Gravity

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

TENTH_DIGIT = 1e-10  # of the number: published from float64 programs, conditions of some hundred


@dataclass(frozen=True)
class Printed:
    """What is printed: ("driver",), ("joint", name, on), ("normal", slide) and so on.

    "size" instead of "joint" is the force's size; `signed` False: the source gives no sign.
    """

    what: tuple[str, ...]
    value: Any
    within: float
    signed: bool = True


@dataclass(frozen=True)
class Published:
    """A machine at one position, and the numbers of a source."""

    name: str
    machine: assur.Machine
    q: float
    speed: float
    printed: Sequence[Printed]


def digits(what: tuple[str, ...], value: Any) -> Printed:
    """A number printed by a float64 program to all of its digits."""
    size = math.hypot(*value) if isinstance(value, tuple) else abs(value)
    return Printed(what, value, TENTH_DIGIT * size)


# -- Marghitu ---------------------------------------------------------------------------------


def marghitu() -> list[Published]:
    """D. B. Marghitu, Mechanisms and Robots Analysis with MATLAB, 2009, p. 144 (R-RRT).

    Crank and rod of 1 m and 1 kg, slider of 1 kg, 45°, n = 30/π rpm, g = 10, 100 N on the slider:
    F12 = −¼ (400 + 7√2) i + 5/4 (84 + √2) j, the force of the crank on the rod.
    """
    inertia = (1.0**2 + 0.01**2) / 12
    machine = assur.Machine(
        assur.SliderCrank(1.0, 1.0),
        bodies={
            "crank": Body(mass=1.0, inertia=inertia, at=(0.5, 0.0)),
            "rod": Body(mass=1.0, inertia=inertia, at=(0.5, 0.0)),
            "piston": Body(mass=1.0),
        },
        loads=[Gravity((0.0, -10.0)), Force("B", (100.0, 0.0))],
    )
    root = math.sqrt(2.0)
    force = (-(400.0 + 7.0 * root) / 4.0, 5.0 * (84.0 + root) / 4.0)
    return [
        Published(
            "Marghitu R-RRT", machine, math.pi / 4, 1.0, [digits(("joint", "A", "rod"), force)]
        )
    ]


# -- linkage_sim ------------------------------------------------------------------------------


def linkage_sim() -> list[Published]:
    """GitHub coleas33/linkage_sim, data/benchmarks/golden, fourbar_statics, slidercrank_statics.

    Static only: its inverse dynamics leaves out the centripetal force of an eccentric mass.
    """
    four_bar = assur.Machine(
        assur.FourBar(1.0, 3.0, 2.0, 4.0),
        bodies={
            "crank": Body(mass=2.0, inertia=0.01, at=(0.5, 0.0)),
            "coupler": Body(mass=3.0, inertia=0.05, at=(1.5, 0.0)),
            "rocker": Body(mass=2.0, inertia=0.02, at=(1.0, 0.0)),
        },
        loads=[Gravity()],
    )
    rows = (
        (30.0, 21.085597076442088, (5.552977629114837, 37.36356342518907)),
        (50.0, 12.433684921347353, (6.658533811928459, 37.088711479590906)),
    )
    out = [
        Published(
            f"linkage_sim four-bar {degrees:.0f}",
            four_bar,
            math.radians(degrees),
            0.0,
            [digits(("driver",), torque), digits(("joint", "A", "crank"), force)],
        )
        for degrees, torque, force in rows
    ]
    crank_slider = assur.Machine(
        assur.SliderCrank(1.0, 3.0),
        bodies={
            "crank": Body(mass=1.0, inertia=0.01, at=(0.5, 0.0)),
            "rod": Body(mass=2.0, inertia=0.1, at=(1.5, 0.0)),
            "piston": Body(mass=0.5),
        },
        loads=[Gravity()],
    )
    torques = ((15.0, 14.213598533843658), (55.0, 8.440177260905646), (95.0, -1.282496754531813))
    out += [
        Published(
            f"linkage_sim slider-crank {degrees:.0f}",
            crank_slider,
            math.radians(degrees),
            0.0,
            [digits(("driver",), torque)],
        )
        for degrees, torque in torques
    ]
    return out


# -- PMKS -------------------------------------------------------------------------------------


def pmks() -> list[Published]:
    """GitHub PMKS-Web/PMKS_Verification, reference-data/v1/cases: six-bars at 10 rpm, weights.

    stephenson_iii_example_2 and watt_i, matlab/dynamics/newton_gravity, rows 0 and 10.
    """
    stephenson = assur.Mechanism(
        joints={
            "A": (7, 4),
            "B": (5, 16),
            "C": (25, 25),
            "D": (23, 10),
            "E": (18, 35),
            "F": (43, 32),
            "G": (45, 17),
            "sAB": (6, 10),
            "sBCE": (16, 76 / 3),
            "sCD": (24, 17.5),
            "sEF": (30.5, 33.5),
            "sFG": (44, 24.5),
        },
        links={
            "ground": ["A", "D", "G"],
            "AB": ["A", "B", "sAB"],
            "BCE": ["B", "C", "E", "sBCE"],
            "CD": ["D", "C", "sCD"],
            "EF": ["E", "F", "sEF"],
            "FG": ["G", "F", "sFG"],
        },
        driver="AB",
    )
    six_bar = six_bar_machine(stephenson, ("BCE", "EF"), Force("sFG", (50.0, 0.0)))
    rows: tuple[tuple[float, float, tuple[float, float], tuple[float, float]], ...] = (
        (
            0.0,
            -243.8543929532343,
            (25.76368118820246, -8.12989065259763),
            (-18.446342964345817, -33.69780797218996),
        ),
        (
            10.0,
            -499.6811511091006,
            (49.18743329471924, 8.607912676663963),
            (-9.867902854328298, -37.650034737003594),
        ),
    )
    out = [
        Published(
            f"PMKS Stephenson III {degrees:.0f}",
            six_bar,
            float(stephenson.q0) + math.radians(degrees),
            math.pi / 3,
            [
                digits(("driver",), torque),
                digits(("joint", "A", "AB"), a),
                digits(("joint", "G", "FG"), g),
            ],
        )
        for degrees, torque, a, g in rows
    ]
    watt = assur.Mechanism(
        joints={
            "A": (-3.74, -2.41),
            "B": (-2.72, 0.91),
            "C": (1.58, 0.43),
            "D": (-0.24, 4.01),
            "E": (5.08, 5.31),
            "F": (8.14, 3.35),
            "G": (7.32, -3.51),
            "sAB": (-3.23, -0.75),
            "sBCD": (-0.46, 1.7833333333333334),
            "sDE": (2.42, 4.66),
            "sEF": (6.61, 4.33),
            "sCFG": (5.68, 0.09),
        },
        links={
            "ground": ["A", "G"],
            "AB": ["A", "B", "sAB"],
            "BCD": ["B", "C", "D", "sBCD"],
            "DE": ["D", "E", "sDE"],
            "EF": ["E", "F", "sEF"],
            "CFG": ["G", "C", "F", "sCFG"],
        },
        driver="AB",
    )
    other = six_bar_machine(watt, ("BCD", "EF"), Force("sCFG", (50.0, 25.0)))
    printed = [
        digits(("driver",), 1844.317472993056),
        digits(("joint", "A", "AB"), (-617.2887070878846, -176.5348377830598)),
        digits(("joint", "C", "CFG"), (-417.9028063245323, 49.763470876510645)),
    ]
    out.append(Published("PMKS Watt I", other, float(watt.q0), math.pi / 3, printed))
    return out


def six_bar_machine(m: assur.Mechanism, heavy: Sequence[str], load: assur.Force) -> assur.Machine:
    bodies = {
        link: Body(mass=10.0, inertia=0.2, at="s" + link)
        if link in heavy
        else Body(mass=5.0, inertia=0.1, at="s" + link)
        for link in m.links
        if link != "ground"
    }
    return assur.Machine(m, bodies=bodies, loads=[Gravity(), load])


# -- a six-bar with a slider ------------------------------------------------------------------


def coupler_dwell() -> list[Published]:
    """GitHub OutliersTeam/Kinematic-Analysis-Koppelrastgetriebe, src/Static Force Analysis/SFA.m.

    A slider-crank whose extended rod moves a rocker; 10 N on the middle of the rocker. Graphical,
    printed to four decimals (here in N and mm), from which the sizes are known.
    """
    crank, rod, extension, link, rocker = 7.138, 21.354, 12.354, 18.011, 22.198
    a1 = crank * complex(math.cos(math.radians(-50)), math.sin(math.radians(-50)))
    b1 = complex(a1.real + math.sqrt(rod**2 - a1.imag**2), 0.0)
    c1 = a1 + extension * (a1 - b1) / rod
    d0 = complex(-30.464, -20.972)
    apart = abs(c1 - d0)
    along = (rocker**2 - link**2 + apart**2) / (2 * apart)
    d = d0 + (c1 - d0) / apart * complex(along, math.sqrt(rocker**2 - along**2))
    places = {"A0": 0j, "A1": a1, "B1": b1, "C1": c1, "D": d, "D0": d0, "M": (d + d0) / 2}
    m = assur.Mechanism(
        joints={n: (p.real, p.imag) for n, p in places.items()},
        links={
            "ground": ["A0", "D0"],
            "crank": ["A0", "A1"],
            "rod": ["A1", "B1", "C1"],
            "slider": ["B1"],
            "bar": ["C1", "D"],
            "rocker": ["D0", "D", "M"],
        },
        slides={"way": assur.Slide("slider", on="ground", angle=0.0)},
        driver="crank",
    )
    machine = assur.Machine(m, loads=[Force("M", (10.0, 0.0))])
    half = 0.51e-4
    printed = [
        Printed(("driver",), 3.4246, 0.51e-3, signed=False),
        Printed(("size", "D", "rocker"), 4.7865, half),
        Printed(("size", "D0", "rocker"), 6.2343, half),
        Printed(("size", "A1", "rod"), 5.9850, half),
    ]
    return [Published("Koppelrastgetriebe", machine, float(m.q0), 0.0, printed)]


# -- Khurmi -----------------------------------------------------------------------------------


def khurmi() -> list[Published]:
    """R. S. Khurmi and J. K. Gupta, Theory of Machines, chapter 15, examples 15.7, 15.9, 15.12.

    Numbers as in FOSSEE's Python companion.  The book's inertia force has two terms,
    m ω² r (cos θ + cos 2θ / n): taken as a load, the rest holds to the printed digits; with the
    true acceleration within 1 %, which is the next term of the series.
    """
    area = math.pi / 4
    examples: tuple[tuple[str, float, float, float, float, float, float, list[Printed]], ...] = (
        # name, crank, rod, mass, rpm, degrees, load; printed
        (
            "15.7",
            0.3,
            1.2,
            250.0,
            250.0,
            60.0,
            0.35e6 * area * 0.5**2,
            [
                Printed(("normal", "bore"), 10970.0, 6.0, signed=False),
                Printed(("size", "A", "rod"), 50650.0, 6.0),
                Printed(("driver",), 14491.0, 0.6, signed=False),
            ],
        ),
        (
            "15.9",
            0.05,
            0.2,
            1.0,
            1800.0,
            33.0,
            0.7e6 * area * 0.08**2,
            [
                Printed(("normal", "bore"), 254.0, 0.6, signed=False),
                # the book rounds the load of 3518.58 N to 3519
                Printed(("size", "A", "rod"), 1865.8, 0.6),
            ],
        ),
        (
            "15.12",
            0.2,
            0.6,
            60.0,
            120.0,
            45.0,
            0.55e6 * area * 0.25**2 - 0.07e6 * area * (0.25**2 - 0.05**2),
            [
                Printed(("driver",), 3929.026139, 6e-7, signed=False),
            ],
        ),
    )
    out = []
    for name, crank, rod, mass, rpm, degrees, load, printed in examples:
        omega, theta = 2 * math.pi * rpm / 60, math.radians(degrees)
        m = assur.SliderCrank(crank, rod)
        terms = math.cos(theta) + math.cos(2 * theta) * crank / rod
        inertia = mass * omega**2 * crank * terms
        static = assur.Machine(m, loads=[Force("B", (inertia - load, 0.0))])
        out.append(Published(f"Khurmi {name}", static, theta, 0.0, printed))
        true = assur.Machine(
            m, bodies={"piston": Body(mass=mass)}, loads=[Force("B", (-load, 0.0))]
        )
        near = [Printed(p.what, p.value, 0.01 * p.value, p.signed) for p in printed]
        out.append(Published(f"Khurmi {name}, true motion", true, theta, omega, near))
    return out


SOURCES: tuple[Callable[[], list[Published]], ...] = (
    marghitu,
    linkage_sim,
    pmks,
    coupler_dwell,
    khurmi,
)


def published() -> list[Published]:
    return [one for source in SOURCES for one in source()]
