"""The inverse question, one call: beside what a user would write with NumPy and SciPy."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from rivals import inverse
from subject import OURS, Case, Contender, Subject

if TYPE_CHECKING:
    from collections.abc import Callable

    from subject import Float

# Lengths of the four-bar: crank, coupler, rocker, ground; and the coupler's point.
BARS = (1.0, 3.0, 2.5, 3.0)
POINT = (1.5, 1.0)
# Base, both cranks, rod, arm of the five-bar.
FIVE = (1.0, 0.8, 0.8, 1.1, 1.1)
START = np.array([2.2, 1.0])


def case(quick: bool) -> Case:
    points = 100 if quick else 10_000
    subjects: dict[str | int, Callable[[], Subject]] = {
        "a rocker's angle": partial(of_four_bar, "rocker"),
        "a coupler point's x": partial(of_four_bar, "P.x"),
        "a five-bar's point": of_five_bar,
        "a five-bar's point near the last": near_five_bar,
        f"a five-bar's path of {points:,} points".replace(",", " "): partial(path, points),
    }
    return Case("find", "call or point", subjects, plotted=False, every_level=False)


def of_four_bar(name: str) -> Subject:
    m = assur.FourBar(*BARS, point=POINT)
    motion = m.solve(1.0)
    value = float(motion.link("rocker").value if name == "rocker" else motion.joint("P").value[0])
    own: Callable[[], Any] = partial(m.find, name, value)
    contenders = {
        OURS: Contender(own, _coordinates, every_level=False),
        "NumPy and SciPy's brentq": Contender(
            partial(inverse.four_bar_by_brentq, BARS, POINT, name, value), lambda q: [q]
        ),
    }
    return Subject(1, 1, contenders)


def five_bar() -> assur.Mechanism:
    b, d, p = inverse.five_bar_joints(FIVE, START)
    return assur.Mechanism(
        joints={"A": (0, 0), "B": tuple(b), "P": tuple(p), "D": tuple(d), "E": (FIVE[0], 0)},
        links={"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"},
        driver=("left", "right"),
    )


def of_five_bar() -> Subject:
    m = five_bar()
    x, y = (float(value) for value in inverse.five_bar_joints(FIVE, START)[2] + 0.01)
    contenders = {
        OURS: Contender(lambda: m.find("P", (x, y)), _coordinates, every_level=False),
        "NumPy, closed form": Contender(
            lambda: inverse.five_bar_closed(FIVE, np.array([x, y])), lambda q: [q]
        ),
    }
    return Subject(1, 1, contenders)


def near_five_bar() -> Subject:
    m = five_bar()
    x, y = (float(value) for value in inverse.five_bar_joints(FIVE, START)[2] + 0.01)
    contenders = {
        OURS: Contender(
            lambda: m.find("P", (x, y), near=START),
            lambda solution: [np.asarray(solution.q)],
            every_level=False,
        ),
        "NumPy and SciPy's root": Contender(
            lambda: inverse.five_bar_by_root(FIVE, np.array([x, y]), START), lambda q: [q]
        ),
    }
    return Subject(1, 1, contenders)


def path(points: int) -> Subject:
    m = five_bar()
    turn = np.linspace(0.0, 2.0 * np.pi, points)
    centre = inverse.five_bar_joints(FIVE, START)[2]
    line = centre + 0.1 * np.stack([np.cos(turn) - 1.0, np.sin(turn)], axis=-1)

    def by_root() -> Float:
        q = [START]
        for point in line:
            q.append(inverse.five_bar_by_root(FIVE, point, q[-1]))
        return np.array(q[1:])

    own: Callable[[], Any] = partial(m.find, "P", line, near=START)
    contenders = {
        OURS: Contender(own, lambda found: [found.q], every_level=False),
        "NumPy and SciPy's root": Contender(by_root, lambda q: [q]),
    }
    return Subject(1, points, contenders, units=points)


def _coordinates(found: list[Any]) -> list[Any]:
    return [np.array([solution.q for solution in found])]
