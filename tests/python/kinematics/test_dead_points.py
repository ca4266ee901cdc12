"""Dead points against their closed forms at 40 digits: solved within, unreachable beyond.

Linkages of three kinds whose crank cannot turn fully: a dyad is flat where it stops. Beyond such
a gap the assembly is the same as before it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

import assur
from assur import Status
from oracles.kinematics import agreement

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    Float = npt.NDArray[np.float64]

MP = mpmath.MPContext()
MP.dps = 40
COUNT = 300  # of each kind
BESIDE = 1e-9  # rad; κ is about 1/√BESIDE there, so that a position is good to 1e-10
CLEAR = 0.01  # from 0° and 180° (90° and 270°), where two dead points meet: of cos (sin)
TURNS = (0, -3, 1000)
GRID = np.linspace(-2.5 * math.tau, 2.5 * math.tau, 601)


@dataclass(frozen=True)
class Linkage:
    """A linkage with gaps in the turn of its crank."""

    mechanism: assur.Mechanism
    size: float
    dead: list[Any]  # crank angles, MP
    discriminant: Callable[[Any], Any]  # of the dyad, squared, at an angle: negative in the gaps
    exact: Callable[[Any], Any]  # one output at an angle, MP
    found: Callable[[assur.Motion], Float]  # the same of a motion
    side: Callable[[assur.Motion], Float]  # sign of the dyad


def clear(values: list[Any]) -> list[Any]:
    """Those between −1 and 1; none at all unless all of them are clear of these."""
    inner = [v for v in values if abs(v) < 1]
    return inner if all(abs(abs(v) - 1) > CLEAR for v in values) else []


def four_bar(rng: np.random.Generator) -> Linkage | None:
    """The coupler and the rocker are in line: BD = b + c or |b − c|."""
    a, b, c, d = (MP.mpf(x) for x in rng.uniform(0.3, 3.0, 4).tolist())
    sign = -1 if rng.random() < 0.5 else 1  # C to the right or to the left of the ray D → B

    def square(q: Any) -> Any:
        return a * a + d * d - 2 * a * d * MP.cos(q)

    def discriminant(q: Any) -> Any:
        e = square(q)
        return ((b + c) ** 2 - e) * (e - (b - c) ** 2)

    def exact(q: Any) -> Any:
        e = square(q)
        x, y = a * MP.cos(q) - d, a * MP.sin(q)  # D → B
        along, up = (e + c * c - b * b) / (2 * e), sign * MP.sqrt(discriminant(q)) / (2 * e)
        return d + along * x - up * y, along * y + up * x

    def side(motion: assur.Motion) -> Float:
        (bx, by), (x, y) = motion.joint("B").value.T, motion.joint("C").value.T
        return np.asarray(sign * np.sign((bx - float(d)) * y - by * (x - float(d))))

    cosines = clear([(a * a + d * d - (b + s * c) ** 2) / (2 * a * d) for s in (1, -1)])
    return Linkage(
        assur.FourBar(
            *(float(a), float(b), float(c), float(d)), mode="open" if sign < 0 else "crossed"
        ),
        float(a + b + c + d),
        [s * MP.acos(x) for x in cosines for s in (1, -1)],
        discriminant,
        exact,
        lambda motion: motion.joint("C").value,
        side,
    )


def slider_crank(rng: np.random.Generator) -> Linkage | None:
    """The rod is square to the bore: |r sin q − offset| = rod."""
    r, rod, offset = (MP.mpf(x) for x in rng.uniform([0.5, 0.3, -1.5], [3.0, 3.0, 1.5]).tolist())

    def discriminant(q: Any) -> Any:
        return rod**2 - (r * MP.sin(q) - offset) ** 2

    def exact(q: Any) -> Any:
        return (r * MP.cos(q) + MP.sqrt(discriminant(q)),)

    def side(motion: assur.Motion) -> Float:
        return np.asarray(np.sign(motion.slide("bore").value - motion.joint("A").value[:, 0]))

    sines = clear([(offset + s * rod) / r for s in (1, -1)])
    return Linkage(
        assur.SliderCrank(float(r), float(rod), float(offset)),
        float(r + rod + abs(offset)),
        [x for s in sines for x in (MP.asin(s), MP.pi - MP.asin(s))],
        discriminant,
        exact,
        lambda motion: motion.slide("bore").value[:, None],
        side,
    )


def turning_guide(rng: np.random.Generator) -> Linkage | None:
    """The guide, `offset` from its pivot, is square to the line from there to the pin."""
    r, d, offset = (MP.mpf(x) for x in rng.uniform([0.5, 0.5, -1.5], [3.0, 3.0, 1.5]).tolist())
    sign = -1 if rng.random() < 0.5 else 1  # of the pin along the guide

    def square(q: Any) -> Any:
        return r * r + d * d - 2 * r * d * MP.cos(q)

    def discriminant(q: Any) -> Any:
        return square(q) - offset**2

    def exact(q: Any) -> Any:
        return (sign * MP.sqrt(discriminant(q)),)

    cosine = clear([(r * r + d * d - offset**2) / (2 * r * d)])
    drawn = assur.Mechanism(
        joints={"O": (0, 0), "A": (0, 1), "D": (1, 0), "E": (0, 1)},
        links={"ground": "OD", "crank": "OA", "block": "A", "lever": "DE"},
        slides={
            "slot": assur.Slide(
                "block", "lever", angle=math.radians(135 - (sign < 0) * 180), origin="D"
            )
        },
        driver="crank",
    )
    lengths = {"crank.length": float(r), "ground.D.x": float(d), "slot.offset": float(offset)}
    return Linkage(
        drawn.with_dimensions(lengths),
        float(r + d + abs(offset)),
        [s * MP.acos(x) for x in cosine for s in (1, -1)],
        discriminant,
        exact,
        lambda motion: motion.slide("slot").value[:, None],
        lambda motion: np.sign(sign * motion.slide("slot").value),
    )


def check(linkage: Linkage) -> None:
    m = linkage.mechanism
    beside = [MP.mpf(BESIDE) * s for s in (1, -1)]
    q = np.array(
        [float(x + s + 2 * k * MP.pi) for x in linkage.dead for k in TURNS for s in beside]
    )
    motion = m.solve(q, on_error="nan")
    discriminant = [linkage.discriminant(MP.mpf(x)) for x in q.tolist()]
    within = np.array([s > 0 for s in discriminant])
    assert within.sum() * 2 == len(q)  # one side each
    assert (motion.status[~within] == Status.UNREACHABLE).all(), q[~within]
    assert (motion.status[within] <= Status.SINGULAR).all(), q[within]
    assert (linkage.side(motion)[within] == 1).all(), q[within]
    exact = [[float(v) for v in linkage.exact(MP.mpf(x))] for x in q[within].tolist()]
    error = np.abs(linkage.found(motion)[within] - np.array(exact)).max(axis=1)
    assert (error <= agreement.POSITION * motion.condition[within] * linkage.size).all()
    # over five turns, through the gaps: the same assembly wherever there is one
    motion = m.solve(GRID, on_error="nan")
    within = np.array([linkage.discriminant(MP.mpf(x)) > 0 for x in GRID[:121].tolist()])
    within = np.append(np.tile(within[:-1], 5), within[0])  # the grid has 120 steps a turn
    assert 0 < within.sum() < len(GRID)
    assert ((motion.status == Status.UNREACHABLE) == ~within).all()
    assert (linkage.side(motion)[within] == 1).all()


@pytest.mark.parametrize("part", range(3))
@pytest.mark.parametrize("kind", [four_bar, slider_crank, turning_guide])
def test_dead_points(kind: Callable[[np.random.Generator], Linkage | None], part: int) -> None:
    rng, done = np.random.default_rng(part), 0
    while done < COUNT // 3:
        linkage = kind(rng)
        if linkage is not None and linkage.dead:
            check(linkage)
            done += 1
