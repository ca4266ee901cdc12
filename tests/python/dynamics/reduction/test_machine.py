"""Bodies and loads referred to the drivers: kinetic energy and power at 50 digits."""

from __future__ import annotations

import pickle
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import (
    Body,
    Damper,
    Force,
    Gravity,
    Machine,
    Spring,
    Table,
    Torque,
    TorsionDamper,
    TorsionSpring,
    flywheel,
    slider_crank,
)
from assur.examples import loom
from models.machines.machines import cylinder, five_bar, four_bar
from models.mechanisms.mechanism_data import described
from oracles.kinematics import oracle, oracle_guess
from oracles.kinematics.oracle_system import MP
from support.interruptions import is_heard

if TYPE_CHECKING:
    from collections.abc import Callable

# Of the greatest of what is compared: sums of some dozen terms, at conditions of some ten.
CLOSE = 1e-12


# Links with the masses, and pairs of points and of links for springs and dampers.
CASES: dict[str, tuple[Callable[[], assur.Mechanism], list[str], str, tuple[str, str]]] = {
    "four_bar": (four_bar, ["crank", "coupler", "rocker"], "P", ("coupler", "rocker")),
    "five_bar": (five_bar, ["c1", "b1", "b2", "c2"], "C", ("b1", "b2")),
    "cylinder": (cylinder, ["arm"], "P", ("arm", "ground")),
    "class IV": (loom, ["l234", "l365", "l48", "l876", "l107"], "6", ("l876", "l48")),
}


class Exact:
    """Masses, forces and energies from joints alone, complex, at 50 digits."""

    def __init__(self, m: assur.Mechanism, q: tuple[float, ...]) -> None:
        d = described(m)
        self.links = m.links
        self.solution = oracle.solve(d, q, oracle_guess.drawing_pose(d), 2)

    def joint(self, name: str, *drivers: int) -> Any:
        return MP.mpc(*self.solution.joints[name].partials[tuple(sorted(drivers))])

    def side(self, link: str, *drivers: int) -> Any:
        first, second = self.links[link][:2]
        return self.joint(second, *drivers) - self.joint(first, *drivers)

    def point(self, link: str, at: Any, *drivers: int) -> Any:
        """All that turns with a rigid link is linear in two of its joints."""
        along = MP.mpc(*at) / abs(self.side(link))
        return self.joint(self.links[link][0], *drivers) + self.side(link, *drivers) * along

    def angle(self, link: str, *drivers: int) -> Any:
        if link == "ground":
            return MP.mpf(0)
        side = self.side(link)
        if not drivers:
            return MP.arg(side)
        return (MP.conj(side) * self.side(link, *drivers)).imag / abs(side) ** 2

    def product(self, link: str, body: Body, one: tuple[int, ...], two: tuple[int, ...]) -> Any:
        """What two derivatives add to the kinetic energy (twice)."""
        moved = dot(self.point(link, body.at, *one), self.point(link, body.at, *two))
        return body.mass * moved + body.inertia * self.angle(link, *one) * self.angle(link, *two)


def dot(a: Any, b: Any) -> Any:
    return (MP.conj(a) * b).real


def positions(m: assur.Mechanism) -> list[tuple[float, ...]]:
    q0 = np.atleast_1d(m.q0)
    return [
        tuple(float(x) for x in q0 + step * (1 - 0.3 * np.arange(len(q0)))) for step in (0, 0.1)
    ]


def one(m: assur.Mechanism, q: tuple[float, ...]) -> Any:
    return q[0] if np.ndim(m.q0) == 0 else np.array(q)


@pytest.mark.parametrize("name", CASES)
def test_inertia_is_kinetic_energy(name: str) -> None:
    make, links, _, _ = CASES[name]
    m = make()
    bodies = {
        link: Body(mass=1.5 + i, inertia=0.2 + i / 7, at=(0.3 - i / 9, 0.1 * i))
        for i, link in enumerate(links)
    }
    machine = Machine(m, bodies=bodies)
    for q in positions(m):
        exact, n = Exact(m, q), len(q)
        value, d1 = machine.reduced_inertia(one(m, q))
        matrix, rates = np.zeros((n, n)), np.zeros((n, n, n))
        for a, b in np.ndindex(n, n):
            matrix[a, b] = sum(exact.product(x, body, (a,), (b,)) for x, body in bodies.items())
            for c in range(n):
                rates[a, b, c] = sum(
                    exact.product(x, body, (a, c), (b,)) + exact.product(x, body, (a,), (b, c))
                    for x, body in bodies.items()
                )
        assert np.abs(value - matrix.squeeze()).max() < CLOSE * np.abs(matrix).max()
        assert np.abs(d1 - rates.squeeze()).max() < CLOSE * np.abs(rates).max()


@pytest.mark.parametrize("name", CASES)
def test_moment_is_power(name: str) -> None:
    make, links, joint, (link, on) = CASES[name]
    m = make()
    ground = m.links["ground"][0]
    bodies = {
        name: Body(mass=2.0 + i, inertia=0.1, at=(0.2, -0.1 * i)) for i, name in enumerate(links)
    }
    loads: list[Any] = [
        Gravity((0.5, -9.81)),
        Force(
            joint,
            (30.0, Table([0.0, 2.0, 7.0], [1.0, 5.0, -3.0], spline="not-a-knot", periodic=False)),
        ),
        Force((links[0], (0.4, 0.2)), (7.0, -11.0), axes=links[-1]),
        # With several drivers q and speed are tuples.
        Torque(link, lambda t, q, v: t + 3.0 * np.ravel(q)[0] + np.ravel(v)[0], on=on),
        Spring(ground, joint, 40.0, 0.5, preload=6.0),
        TorsionSpring(link, 12.0, angle=0.3, on=on, preload=2.0),
        Damper(ground, (link, (0.3, 0.3)), 5.0),
        TorsionDamper(link, 4.0, on=on),
    ]
    machine = Machine(m, bodies=bodies, loads=loads)
    curve = np.polynomial.Polynomial.fit([0.0, 2.0, 7.0], [1.0, 5.0, -3.0], 2)
    for q in positions(m):
        exact, n = Exact(m, q), len(q)
        speed = np.array([1.7, -0.6])[:n]
        rates = [MP.mpf(float(s)) for s in speed]
        own = []
        bar = exact.joint(joint) - exact.joint(ground)
        arm = exact.point(link, (0.3, 0.3)) - exact.joint(ground)
        # Angles are those of first to second joint, as continued from the drawing.
        motion = m.solve(one(m, q), order=0, outputs=[x for x in (link, on) if x != "ground"])
        apart = sum(
            sign * motion.link(x).value for sign, x in ((1, link), (-1, on)) if x != "ground"
        )
        for a in range(n):
            power = sum(
                dot(MP.mpc(0.5, "-9.81") * body.mass, exact.point(x, body.at, a))
                for x, body in bodies.items()
            )
            power += dot(MP.mpc(30, float(curve(q[0]))), exact.joint(joint, a))
            axes = exact.side(links[-1]) / abs(exact.side(links[-1]))
            power += dot(MP.mpc(7, -11) * axes, exact.point(links[0], (0.4, 0.2), a))
            turning = [exact.angle(link, b) - exact.angle(on, b) for b in range(n)]
            power += (3 * MP.mpf(q[0]) + rates[0]) * turning[a]
            tension = 40 * (abs(bar) - MP.mpf("0.5")) + 6
            power -= tension * dot(bar / abs(bar), exact.joint(joint, a))
            power -= (12 * (MP.mpf(float(apart)) - MP.mpf(0.3)) + 2) * turning[a]
            growing = [dot(arm / abs(arm), exact.point(link, (0.3, 0.3), b)) for b in range(n)]
            power -= 5 * sum(r * g for r, g in zip(rates, growing, strict=True)) * growing[a]
            power -= 4 * sum(r * t for r, t in zip(rates, turning, strict=True)) * turning[a]
            own.append(float(power))
        found = np.atleast_1d(machine.reduced_moment(one(m, q), speed if n > 1 else speed[0]))
        assert np.abs(found - own).max() < CLOSE * np.abs(own).max() * 10


def test_moments_are_slopes_of_the_potential() -> None:
    m = four_bar()
    loads: list[Any] = [
        Gravity(),
        Spring("A", "P", 30.0, 1.0, preload=4.0),
        TorsionSpring("rocker", 9.0, angle=0.4),
    ]
    machine = Machine(m, bodies={"coupler": Body(mass=3.0, at="P")}, loads=loads)
    q, h = np.linspace(-7.0, 7.0, 57), 1e-5
    slope = (machine.potential(q + h) - machine.potential(q - h)) / (2 * h)
    assert np.abs(machine.reduced_moment(q) + slope).max() < 1e-7


def test_equations_one_and_two_of_p3() -> None:
    """Term by term: a slider-crank by the papers' own theory of it."""
    crank, rod = 0.1, 0.4
    bodies = {"crank": Body(inertia=0.5), "piston": Body(mass=20.0)}
    machine = Machine(
        assur.SliderCrank(crank, rod), bodies=bodies, loads=[Force("B", (-1000.0, 0.0))]
    )
    q = np.linspace(0.1, 6.1, 25)
    x = slider_crank.coordinate(q, crank, rod)
    value, d1 = machine.reduced_inertia(q)
    assert value == pytest.approx(0.5 + 20.0 * x.d1**2, rel=1e-14)
    assert d1 == pytest.approx(40.0 * x.d1 * x.d2, abs=1e-14)
    assert machine.reduced_moment(q) == pytest.approx(-1000.0 * x.d1, abs=1e-12)


def test_a_flywheel_from_the_machine_itself() -> None:
    crank, rod = 0.1, 0.4
    phi = np.linspace(0.0, 2 * np.pi, 73)
    work = Table(phi, 4000.0 * np.exp(-(((phi - 5.0) / 0.5) ** 2)) * np.sin(phi / 2) ** 2)
    bodies = {"crank": Body(inertia=0.5), "piston": Body(mass=20.0)}
    machine = Machine(assur.SliderCrank(crank, rod), bodies=bodies, loads=[Force("B", (work, 0.0))])
    f = machine.flywheel(0.05, mean_speed=20.0)
    q = np.linspace(0.0, 2 * np.pi, 5001)
    x = slider_crank.coordinate(q, crank, rod)
    force = 4000.0 * np.exp(-(((q - 5.0) / 0.5) ** 2)) * np.sin(q / 2) ** 2
    direct = flywheel.from_table(
        q, force * x.d1, 0.5 + 20.0 * x.d1**2, fluctuation=0.05, mean_speed=20.0
    )
    # The spline through 73 rows of the force is good to some 1e-5 of it.
    assert f.inertia == pytest.approx(direct.inertia, rel=1e-4)
    assert f.delta == pytest.approx(0.05, rel=1e-12)
    assert f.mean_speed == pytest.approx(20.0, rel=1e-12)
    with pytest.raises(assur.InputError, match="a flywheel needs a single driver that turns"):
        Machine(cylinder(), bodies={"arm": Body(mass=1.0)}).flywheel(0.1, mean_speed=10.0)
    swinging = Machine(assur.FourBar(3.0, 1.0, 2.0, 3.0), bodies={"crank": Body(inertia=1.0)})
    with pytest.raises(assur.PositionError, match=r"\"C\" cannot be assembled"):
        swinging.flywheel(0.1, mean_speed=10.0)


def test_shapes_and_places_without_a_position() -> None:
    m = five_bar()
    machine = Machine(m, bodies={"b1": Body(mass=1.0)}, loads=[Gravity()])
    q = np.broadcast_to(m.q0, (4, 3, 2))
    assert machine.reduced_inertia(q).value.shape == (4, 3, 2, 2)
    assert machine.reduced_inertia(q).d1.shape == (4, 3, 2, 2, 2)
    assert machine.reduced_moment(q, [1.0, 2.0]).shape == (4, 3, 2)
    assert machine.potential(q).shape == (4, 3)
    single = Machine(assur.FourBar(3.0, 1.0, 2.0, 3.0), bodies={"crank": Body(inertia=1.0)})
    assert np.shape(single.reduced_moment(0.6)) == ()
    value, d1 = single.reduced_inertia([0.6, np.pi], on_error="nan")
    assert np.isnan(value).tolist() == [False, True]
    assert np.isnan(d1).tolist() == [False, True]
    with pytest.raises(assur.PositionError, match=r"q = 3\.14"):
        single.reduced_inertia([0.6, np.pi])
    copy = pickle.loads(pickle.dumps(machine))
    assert np.array_equal(copy.potential(q), machine.potential(q))


ANY: Any = 3  # what types would not let pass


def pushed(t: float, q: float, speed: float) -> Any:
    return "hard" if t <= q + speed else 0.0


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (lambda _: Body(mass=-1.0), "mass is -1, it must not be negative"),
        (lambda _: Body(inertia=np.nan), "inertia is nan: a finite number"),
        (lambda m: Machine(m, bodies={"x": Body()}), 'there is no link "x"'),
        (
            lambda m: Machine(m, bodies={"crank": Body(at="C")}),
            "joint 'C' is not one of its joints A, B",
        ),
        (
            lambda m: Machine(m, bodies={"crank": ANY}),
            "bodies.'crank'. is 3: an assur.Body is needed",
        ),
        (lambda m: Machine(m, bodies={}, loads=[ANY]), "3 is not a load"),
        (lambda m: Machine(m, bodies={}, loads=[Force("Z", (1, 1))]), 'there is no joint "Z"'),
        (
            lambda m: Machine(m, bodies={}, loads=[Force("C", ANY)]),
            r"3 is not two components \(fx, fy\)",
        ),
        (lambda m: Machine(m, bodies={}, loads=[Force(ANY, (1, 1))]), "3 is not a location"),
        (lambda m: Machine(m, bodies={}, loads=[Torque("rockr", 1.0)]), 'did you mean "rocker"'),
        (
            lambda m: Machine(m, bodies={}, loads=[Torque("rocker", np.inf)]),
            "inf: a finite number is needed",
        ),
        (lambda m: Machine(m, bodies={}, loads=[Gravity(ANY)]), "two finite numbers"),
        (
            lambda m: Machine(m, bodies={}, loads=[Torque("rocker", Table([0, 1], [1, 2]))]),
            "not periodic",
        ),
        (
            lambda m: Machine(m, bodies={}, loads=[Torque("rocker", Table([1, 0], [1, 1]))]),
            r"is below q\[0\]",
        ),
        (
            lambda m: Machine(
                m.with_dimensions({"crank.length": [1.0, 1.1]}), bodies={}
            ).steady_state(1.0),
            r"steady_state is for one design, this is a batch \(2,\)",
        ),
        (lambda m: Machine(m, bodies={}, loads=(), motor=ANY), "3 is not a motor"),
        (
            lambda m: Machine(m, bodies={}, loads=(), motor=assur.LinearMotor(-1.0, 3.0)),
            "stall is -1, it must be pos",
        ),
        (
            lambda m: Machine(m, bodies={}, loads=(), motor=assur.LinearMotor(1.0, 3.0, ratio=0.0)),
            "ratio is 0",
        ),
        (
            lambda m: Machine(
                m, bodies={}, loads=(), motor=assur.ConstantTorque(1.0, rotor_inertia=-2.0)
            ),
            "rotor_inertia is -2, it must not be negative",
        ),
        (
            lambda m: Machine(m, bodies={}, loads=(), motor=assur.InductionMotor(1.0, 0.0, 9.0)),
            "slip is 0",
        ),
        (
            lambda m: Machine(m, bodies={}, loads=(), motor=assur.Table([2, 1], [1, 0])),
            r"is below q\[0\]",
        ),
        (
            lambda _: Machine(five_bar(), bodies={}, loads=(), motor=assur.ConstantTorque(1.0)),
            "2 drivers need",
        ),
        (lambda m: Machine(m, bodies={}).reduced_moment([0, 1], [1, 2, 3]), "they do not fit"),
        (lambda m: Machine(m, bodies={}).reduced_moment(0, on_error=ANY), "on_error is 3"),
        (
            lambda m: Machine(
                m, bodies={}, loads=[Torque("rocker", Table([0, 1], [1, 2], periodic=False))]
            ).reduced_moment([0.5, 2.0]),
            "a table over q covers 0 to 1: 2 is not in it",
        ),
        (
            lambda m: Machine(m, bodies={}, loads=[Torque("rocker", pushed)]),
            r"torque\(t, q, speed\) gives 'hard' at t = 0, q = 1.15.*: a number is needed",
        ),
    ],
)
def test_invalid_arguments_are_refused(
    make: Callable[[assur.Mechanism], Any], expected: str
) -> None:
    with pytest.raises(assur.InputError, match=expected):
        make(four_bar())


def test_designs_are_those_one_by_one() -> None:
    lengths = np.array([[0.95, 1.0, 1.05], [1.1, 1.15, 40.0]])
    m = four_bar().with_dimensions({"crank.length": lengths})
    bodies = {
        "crank": Body(inertia=0.5),
        "coupler": Body(mass=2.0, inertia=0.3, at=(1.0, 0.2)),
        "rocker": Body(mass=1.0),
    }
    machine = Machine(m, bodies=bodies, loads=[Gravity(), TorsionSpring("rocker", 3.0, angle=0.2)])
    assert machine.shape == (2, 3)
    q = np.linspace(0.0, 6.0, 7)
    value, d1 = machine.reduced_inertia(q, on_error="nan")
    moment = machine.reduced_moment(q, on_error="nan")
    potential = machine.potential(q, on_error="nan")
    assert value.shape == d1.shape == moment.shape == potential.shape == (2, 3, 7)
    for index in np.ndindex(2, 3):
        if index == (1, 2):
            assert np.isnan(value[index]).all()
            continue
        own = machine.design(index)
        assert np.array_equal(value[index], own.reduced_inertia(q).value)
        assert np.array_equal(d1[index], own.reduced_inertia(q).d1)
        assert np.array_equal(moment[index], own.reduced_moment(q))
        assert np.array_equal(potential[index], own.potential(q))
    with pytest.raises(assur.PositionError, match=r"design \(1, 2\)"):
        machine.reduced_inertia(q)
    each = np.arange(6.0).reshape(2, 3, 1) + np.array([0.0, 0.5])
    assert machine.reduced_inertia(each, on_error="nan").value.shape == (2, 3, 2)
    assert machine.reduced_inertia(1.0, on_error="nan").value.shape == (2, 3)
    with pytest.raises(assur.InputError, match="S \\+ \\(N,\\)"):
        machine.reduced_inertia(np.zeros((3, 2, 5)))


def test_flywheels_of_designs() -> None:
    rods = np.array([0.3, 0.4, 0.05, 0.6])
    m = assur.SliderCrank(0.1, 0.4).with_dimensions({"rod.length": rods})
    work = Table([0.0, 3.5, 5.0, 2 * np.pi], [0.0, 0.0, -1500.0, 0.0], spline="linear")
    machine = Machine(
        m,
        bodies={"crank": Body(inertia=0.5), "piston": Body(mass=20.0)},
        loads=[Force("B", (work, 0.0))],
    )
    many = machine.flywheel(
        0.05, mean_speed=[20.0, 20.0, 20.0, 25.0], mean="period", on_error="nan"
    )
    assert np.isnan(many.inertia).tolist() == [False, False, True, False]
    for i, speed in ((0, 20.0), (1, 20.0), (3, 25.0)):
        one = machine.design(i).flywheel(0.05, mean_speed=speed, mean="period")
        assert many.inertia[i] == pytest.approx(one.inertia, rel=1e-9)
        # And by another method: the flywheel of the integrated motion.
        steady = machine.design(i).steady_state(speed, flywheel=one.inertia, mean="period")
        assert steady.delta == pytest.approx(0.05, rel=1e-9)


def test_corners_of_tables_are_knots() -> None:
    """A force with corners: the same flywheel by the integrated motion."""
    work = Table([0.0, 3.5, 5.0, 5.2, 2 * np.pi], [0.0, 0.0, -1500.0, 0.0, 0.0], spline="linear")
    machine = Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"crank": Body(inertia=0.5), "piston": Body(mass=20.0)},
        loads=[Force("B", (work, 0.0))],
    )
    made = machine.flywheel(0.05, mean_speed=20.0, mean="period")
    steady = machine.steady_state(20.0, mean="period", flywheel=made.inertia)
    assert steady.delta == pytest.approx(0.05, rel=1e-9)
    assert steady.motor_moment == pytest.approx(made.motor_moment, rel=1e-9)
    assert steady.max.value == pytest.approx(made.max.value, rel=1e-9)

    def jump(_: float, q: float, __: float) -> float:
        return -1500.0 if 4.0 < q % (2 * np.pi) < 5.0 else 0.0

    rough = Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"crank": Body(inertia=0.5), "piston": Body(mass=20.0)},
        loads=[Force("B", (jump, 0.0))],
    )
    with pytest.warns(assur.AssurWarning, match="not smooth"):
        rough.flywheel(0.05, mean_speed=20.0)


def test_an_interrupt_is_heard() -> None:
    machine = Machine(four_bar(), bodies={"coupler": Body(mass=1.0)}, loads=[Gravity()])

    def work(size: int) -> Callable[[], object]:
        q = np.linspace(0.0, 6.0, size)
        return lambda: machine.reduced_inertia(q)

    assert is_heard(work, 1000)
