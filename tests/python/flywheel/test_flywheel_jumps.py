"""Tables of a whole turn with jumps: two rows at one coordinate, as of `assur.Table`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Machine, Table, Torque, flywheel

if TYPE_CHECKING:
    from assur.flywheel import Spline

TURN = 2.0 * np.pi
PUNCH = [0.0, 1.0, 1.0, TURN], [-700.0, -700.0, 0.0, 0.0]


def shaft() -> assur.Mechanism:
    return assur.Mechanism({"A": (0, 0), "B": (1, 0)}, {"ground": "A", "crank": "AB"}, "crank")


@pytest.mark.parametrize("spline", ["linear", "pchip", "not-a-knot", "natural", "clamped"])
def test_a_punch(spline: Spline) -> None:
    """700 N·m over 1 rad: all but a part 1/2π of its work comes from the flywheel."""
    found = flywheel.from_table(*PUNCH, fluctuation=0.1, mean_speed=20.0, spline=spline)
    exact = 700.0 * (1.0 - 1.0 / TURN) / (20.0**2 * 0.1)
    assert exact == pytest.approx(14.7147884958918, rel=1e-14)
    assert found.inertia == pytest.approx(exact, rel=1e-13)
    assert found.motor_moment == pytest.approx(700.0 / TURN, rel=1e-14)
    assert (found.max.q, found.min.q) == (0.0, 1.0)
    again = flywheel.evaluate(*PUNCH, 0.0, flywheel=found.inertia, mean_speed=20.0, spline=spline)
    assert again.delta == pytest.approx(0.1, rel=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_as_the_machine_of_a_shaft(seed: int) -> None:
    """Any rows: the long way is a torque on a shaft, and `Machine.flywheel`."""
    rng = np.random.default_rng(seed)
    inner = np.sort(rng.uniform(0.3, 6.0, 7))
    phi = np.concatenate([[0.0], inner[:2], inner[1:5], inner[4:], [TURN]])
    moment = rng.uniform(-300.0, 300.0, phi.size)
    moment[-1] = moment[0]
    short = flywheel.from_table(
        phi, moment, 1.5, fluctuation=0.05, mean_speed=30.0, spline="linear"
    )
    load = Torque("crank", Table(phi, moment, spline="linear"))
    bodies = {"crank": assur.Body(inertia=1.5)}
    long = Machine(shaft(), bodies=bodies, loads=[load]).flywheel(0.05, mean_speed=30.0)
    assert short.inertia == pytest.approx(long.inertia, rel=1e-8)
    assert short.motor_moment == pytest.approx(long.motor_moment, rel=1e-9)
    assert short.delta == pytest.approx(0.05, rel=1e-10)


def test_a_jump_at_the_seam() -> None:
    """A saw from 100 to −100 N·m: the greatest work is that of half a turn."""
    phi, moment = [0.0, 0.0, TURN], [-100.0, 100.0, -100.0]
    found = flywheel.from_table(phi, moment, fluctuation=0.1, mean_speed=10.0, spline="linear")
    assert found.inertia == pytest.approx(50.0 * np.pi / 10.0, rel=1e-13)


def test_a_batch_of_tables() -> None:
    phi, moment = np.array(PUNCH[0]), np.array([PUNCH[1], [-300.0, -500.0, 20.0, -300.0]])
    batch = flywheel.from_table(phi, moment, 0.0, fluctuation=0.1, mean_speed=20.0, spline="linear")
    for own, row in zip(batch.inertia, moment, strict=True):
        assert (
            own
            == flywheel.from_table(
                phi, row, 0.0, fluctuation=0.1, mean_speed=20.0, spline="linear"
            ).inertia
        )


def test_a_machine_of_a_table_runs_over_jumps() -> None:
    """Between the jumps the speed follows from the energy."""
    machine = Machine.from_table(*PUNCH, inertia=2.0, spline="linear")
    run = machine.run(t_end=0.6, q0=0.0, speed0=40.0, rtol=1e-12)
    within = np.mod(run.q, TURN)
    done = np.floor(run.q / TURN) + np.minimum(within, 1.0)
    exact = np.sqrt(40.0**2 - 700.0 * done)
    np.testing.assert_allclose(run.speed, exact, rtol=1e-9)
    assert machine.reduced_moment([0.5, 1.0, 2.0]).tolist() == [-700.0, 0.0, 0.0]
    assert run.energy.error < 1e-9


def test_the_inertia_is_one_curve() -> None:
    """Jumps of the moment do not cut it: a table without them has the same."""
    phi = np.linspace(0.0, TURN, 13)
    inertia = 3.0 + np.sin(phi)
    inertia[-1] = inertia[0]
    rows = np.sort(np.append(phi, phi[4]))
    twice = np.insert(inertia, 4, inertia[4])
    moment = np.where(np.arange(14) < 5, -100.0, 20.0)
    moment[-1] = moment[0]
    cut = flywheel.evaluate(rows, moment, twice, flywheel=1.0, speed0=10.0)
    plain = flywheel.evaluate(phi, np.zeros(13), inertia, flywheel=1.0, speed0=10.0)
    x = np.linspace(0.0, TURN, 50)
    np.testing.assert_array_equal(cut.reduced_inertia(x), plain.reduced_inertia(x))


@pytest.mark.parametrize(
    ("rows", "spline", "message"),
    [
        (([0, 1, 1, 1, TURN], [1, 1, 2, 3, 1], 1.0), "linear", "three times"),
        (([0, 1, 1, TURN], [1, 1, 2, 1], 1.0), "periodic", 'spline="periodic" is one curve'),
        (
            ([0, 1, 1, TURN], [1, 1, 2, 1], [1, 1, 2, 1]),
            "linear",
            "the inertia jumps from 1 to 2 kg·m² at phi = 1 rad: only the moment may",
        ),
        (([0, 2, 1, TURN], [1, 1, 2, 1], 1.0), "linear", "phi goes from 2 to 1 rad"),
    ],
)
def test_refused(rows: Any, spline: Spline, message: str) -> None:
    wanted: Any = {"fluctuation": 0.1, "mean_speed": 10.0}
    with pytest.raises(assur.InputError, match=message.replace(".", r"\.")):
        flywheel.from_table(*rows, **wanted, spline=spline)
    with pytest.raises(assur.InputError, match=message.replace(".", r"\.")):
        Machine.from_table(rows[0], rows[1], rows[2], spline=spline)
