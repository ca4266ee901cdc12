"""Places in frames of links: where loads act, whatever the drawing's origin and the listing order.

The ground's frame is the drawing's. Places of other links are found by hand here: rotation by the
link's angle about its first joint.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Damper, Force, Gravity, Spring, Torque, TorsionSpring

DRAWING = {"A": (10.0, 0.0), "B": (10.0, 1.0), "C": (12.5, 2.0), "D": (13.0, 0.0)}
Q = np.linspace(0.0, 6.0, 13)


def four_bar(ground: str = "AD", shift: tuple[float, float] = (0.0, 0.0)) -> assur.Mechanism:
    joints = {name: (x + shift[0], y + shift[1]) for name, (x, y) in DRAWING.items()}
    links = {"ground": ground, "crank": "AB", "coupler": "BC", "rocker": "DC"}
    return assur.Mechanism(joints=joints, links=links, driver="crank")


def loads(shift: tuple[float, float] = (0.0, 0.0)) -> list[Any]:
    """Everything that can be fixed to the ground, at its places after a shift."""
    x, y = shift
    return [
        Gravity(),
        Spring("C", ("ground", (11.0 + x, 5.0 + y)), 300.0, 0.7, preload=20.0),
        Spring(("ground", (9.0 + x, -1.0 + y)), ("coupler", (1.0, 0.5)), 50.0, 1.0),
        Damper(("ground", (14.0 + x, 2.0 + y)), "B", 5.0),
        Force(("ground", (12.0 + x, 1.0 + y)), (40.0, 7.0)),
        Force("C", (3.0, -8.0), axes="ground"),
        TorsionSpring("rocker", 10.0, angle=0.3),
        Torque("coupler", 2.0),
    ]


def machine(ground: str = "AD", shift: tuple[float, float] = (0.0, 0.0)) -> assur.Machine:
    bodies = {
        "crank": Body(mass=2.0, inertia=0.5, at=(0.4, 0.1)),
        "coupler": Body(mass=3.0, inertia=0.2, at=(1.2, 0.3)),
        "ground": Body(mass=7.0, inertia=0.0, at=(11.0 + shift[0], 3.0 + shift[1])),
    }
    return assur.Machine(four_bar(ground, shift), bodies=bodies, loads=loads(shift))


def test_a_spring_to_a_place_on_the_ground_has_the_length_of_the_drawing() -> None:
    """B is at (10, 1) in the drawing and 2 m below (10, 3)."""
    for ground in ("AD", "DA"):
        spring = Spring("B", ("ground", (10.0, 3.0)), 100.0, 0.0)
        m = four_bar(ground)
        own = assur.Machine(m, bodies={"crank": Body(inertia=1.0)}, loads=[spring])
        assert own.potential(m.q0) == pytest.approx(200.0, rel=1e-14)


def test_a_place_on_a_link_turns_with_it() -> None:
    m = four_bar("DA")
    motion = m.solve(Q)
    anchor = np.array([9.5, 4.0])
    for link, first in (("crank", "A"), ("coupler", "B"), ("rocker", "D")):
        own = assur.Machine(
            m, bodies={}, loads=[Spring((link, (0.6, -0.4)), ("ground", (9.5, 4.0)), 80.0, 1.5)]
        )
        angle = motion.link(link).value
        turn = np.stack([np.cos(angle), np.sin(angle), -np.sin(angle), np.cos(angle)], -1)
        place = motion.joint(first).value + 0.6 * turn[..., :2] - 0.4 * turn[..., 2:]
        length = np.linalg.norm(place - anchor, axis=-1)
        np.testing.assert_allclose(own.potential(Q), 40.0 * (length - 1.5) ** 2, rtol=1e-13)


def test_a_place_on_a_link_of_one_joint_is_along_its_guide() -> None:
    """The piston's frame is at its joint, x along the bore."""
    slope = 0.4
    joints = {"O": (3.0, 1.0), "A": (3.0, 1.5), "B": (5.0, 2.0)}
    links = {"ground": "O", "crank": "OA", "rod": "AB", "piston": "B"}
    bore = assur.Slide("piston", on="ground", angle=slope)
    m = assur.Mechanism(joints=joints, links=links, slides={"bore": bore}, driver="crank")
    along = np.array([math.cos(slope), math.sin(slope)])
    across = np.array([-along[1], along[0]])
    own = assur.Machine(
        m, bodies={}, loads=[Spring(("piston", (0.2, 0.1)), ("ground", (1.0, -2.0)), 10.0, 0.0)]
    )
    place = m.solve(Q).joint("B").value + 0.2 * along + 0.1 * across
    squared = np.square(place - [1.0, -2.0]).sum(axis=-1)
    np.testing.assert_allclose(own.potential(Q), 5.0 * squared, rtol=1e-13)


def test_a_place_on_a_disc_without_joints_is_where_its_guides_cross() -> None:
    joints = {"O1": (2.0, 1.0), "O2": (2.3, 1.1)}
    links: dict[str, list[str]]
    links = {"ground": ["O1", "O2"], "shaft1": ["O1"], "disc": [], "shaft2": ["O2"]}
    slides = {
        "tongue1": assur.Slide("disc", on="shaft1", angle=0.4, origin="O1"),
        "tongue2": assur.Slide("disc", on="shaft2", angle=0.4 + math.pi / 2, origin="O2"),
    }
    m = assur.Mechanism(joints=joints, links=links, slides=slides, driver="shaft1")
    own = assur.Machine(
        m, bodies={}, loads=[Spring(("disc", (0.3, 0.0)), ("ground", (2.5, 2.5)), 10.0, 0.0)]
    )
    motion = m.solve(Q)
    angle = motion.link("disc").value
    along = np.stack([np.cos(angle), np.sin(angle)], -1)
    # The centre is on the line through O1 along the first guide, s from O1.
    centre = [2.0, 1.0] + motion.slide("tongue1").value[:, np.newaxis] * along
    squared = np.square(centre + 0.3 * along - [2.5, 2.5]).sum(axis=-1)
    np.testing.assert_allclose(own.potential(Q), 5.0 * squared, rtol=1e-13)


def test_the_order_of_the_grounds_joints_does_not_matter() -> None:
    one, other = machine("AD"), machine("DA")
    for quantity in ("potential", "reduced_moment"):
        a, b = (getattr(own, quantity)(Q) for own in (one, other))
        np.testing.assert_array_equal(a, b)
    np.testing.assert_array_equal(one.reduced_moment(Q, 2.0), other.reduced_moment(Q, 2.0))


def test_moving_the_drawing_changes_only_positions() -> None:
    shift = (-37.0, 64.0)
    one, other = machine(), machine(shift=shift)
    moments = [own.reduced_moment(Q, 2.0) for own in (one, other)]
    np.testing.assert_allclose(moments[0], moments[1], rtol=1e-12)
    # Weights are higher by the shift, 12 kg in all.
    potentials = [own.potential(Q) for own in (one, other)]
    np.testing.assert_allclose(potentials[0] + 12.0 * 9.81 * shift[1], potentials[1], rtol=1e-12)
    runs = [own.run(2.0, 0.3, 4.0) for own in (one, other)]
    assert runs[0].at(2.0).q == pytest.approx(runs[1].at(2.0).q, rel=1e-8)


def test_springs_push_as_their_energy_falls() -> None:
    springs = [load for load in loads() if isinstance(load, Spring | TorsionSpring | Gravity)]
    bodies = {
        "coupler": Body(mass=3.0, inertia=0.2, at=(1.2, 0.3)),
        "ground": Body(mass=7.0, inertia=0.0, at=(11.0, 3.0)),
    }
    own = assur.Machine(four_bar("DA"), bodies=bodies, loads=springs)
    step = 1e-4
    rise = (own.potential(Q + step) - own.potential(Q - step)) / (2.0 * step)
    # Differences are good to their curvature, step² of it, and to rounding, 1e-16 / step.
    np.testing.assert_allclose(own.reduced_moment(Q), -rise, rtol=1e-6, atol=1e-4)


def test_a_force_on_the_ground_does_no_work() -> None:
    force = Force(("ground", (12.0, 1.0)), (40.0, 7.0))
    own = assur.Machine(four_bar("DA"), bodies={}, loads=[force])
    np.testing.assert_array_equal(own.reduced_moment(Q), np.zeros(Q.size))


def test_a_damper_to_the_ground_dissipates_by_its_rate_of_length() -> None:
    own = assur.Machine(
        four_bar("DA"), bodies={}, loads=[Damper(("ground", (14.0, 2.0)), "B", 5.0)]
    )
    pin = four_bar().solve(Q).joint("B")
    span = pin.value - [14.0, 2.0]
    rate = (span * pin.velocity(2.0)).sum(axis=-1) / np.linalg.norm(span, axis=-1)
    # Power at the driver: M ω = −d (dl/dt)².
    np.testing.assert_allclose(2.0 * own.reduced_moment(Q, 2.0), -5.0 * rate**2, rtol=1e-12)
