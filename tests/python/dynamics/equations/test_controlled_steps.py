"""Steps with error control against SciPy's integrator, runs, closed forms and energy.

As a program it prints a digest: vector instructions are read from ASSUR_SIMD once in a process.
"""

from __future__ import annotations

import hashlib
import math
import os
import sys
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import assur
from models.machines.stepping_machines import (
    arm,
    dead_ends,
    engine,
    five_bar,
    flywheel,
    pulled,
)
from net import bits

if TYPE_CHECKING:
    import numpy.typing as npt

Pair = Literal["RK45", "DOP853"]
PAIRS: tuple[Pair, ...] = ("RK45", "DOP853")
BOTH = pytest.mark.parametrize("method", PAIRS)


def block(stiffness: float = 50.0, mass: float = 2.0) -> assur.Machine:
    """A driven slide with a spring: x = x0 cos ωt."""
    mechanism = assur.Mechanism(
        joints={"O": (0, 0), "B": (0.3, 0.0)},
        links={"ground": "O", "block": "B"},
        driver="bore",
        slides={"bore": assur.Slide("block", on="ground", angle=0.0, origin="O")},
    )
    spring = assur.Spring("B", ("ground", (-50.0, 0.0)), stiffness, 50.0)
    return assur.Machine(mechanism, bodies={"block": assur.Body(mass=mass)}, loads=[spring])


def motored() -> assur.Machine:
    """A motor against a table of forces, a spring and a damper."""
    work = assur.Table([0.0, 2.0, 4.0, 2.0 * math.pi], [0.0, -300.0, 100.0, 0.0], spline="periodic")
    loads = [
        assur.Force("B", (work, 0.0)),
        assur.Spring("O", "B", 200.0, 0.4),
        assur.Damper("A", "B", 3.0),
        assur.Gravity(),
    ]
    motor = assur.LinearMotor(stall=50.0, no_load=15.0, rotor_inertia=0.02)
    return engine(loads=loads, motor=motor)


def states(machine: assur.Machine, count: int, seed: int = 2) -> tuple[Any, Any]:
    rng = np.random.default_rng(seed)
    q0 = np.asarray(machine.mechanism.q0)  # type: ignore[union-attr]
    q = q0 + rng.uniform(-0.2, 0.2, (count, *q0.shape))
    return q, rng.normal(size=q.shape)


def by_scipy(machine: assur.Machine, q: Any, speed: Any, effort: Any, t: float) -> Any:
    """The state after some time, by SciPy's own pair and control."""
    n = machine.driver_count

    def slope(_: float, state: npt.NDArray[np.float64]) -> Any:
        at = state.reshape(2, *np.shape(q))
        return np.stack([at[1], machine.acceleration(at[0], at[1], effort)]).ravel()

    start = np.stack([q, speed]).ravel()
    found = solve_ivp(slope, (0.0, t), start, method="DOP853", rtol=2.3e-14, atol=1e-14)
    assert found.success, (n, found.message)
    return found.y[:, -1].reshape(2, *np.shape(q))


@BOTH
@pytest.mark.parametrize("make", [five_bar, engine, flywheel, pulled, arm, block, motored])
@pytest.mark.parametrize("dt", [0.05, -0.03])
def test_it_is_the_motion_that_scipy_finds(make: Any, dt: float, method: Pair) -> None:
    machine = make()
    q, speed = states(machine, 9)
    effort = None if make is motored else np.linspace(-1.0, 1.0, q.size).reshape(q.shape)
    after = machine.step(q, speed, effort, dt, n=3, method=method, rtol=1e-12)
    assert after.status.tolist() == [0] * 9
    for row in range(9):
        own = effort if effort is None else effort[row]
        wanted = by_scipy(machine, q[row], speed[row], own, 3 * dt)
        assert after.q[row] == pytest.approx(wanted[0], abs=1e-10)
        assert after.speed[row] == pytest.approx(wanted[1], rel=1e-9, abs=1e-9)


@BOTH
def test_runs_go_the_same_way(method: Pair) -> None:
    machine = motored()
    starts, speeds = np.linspace(0.0, 6.0, 7), np.linspace(2.0, 9.0, 7)
    after = machine.step(starts, speeds, None, 0.1, n=7, method=method, rtol=1e-11)
    for row, (q, speed) in enumerate(zip(starts, speeds, strict=True)):
        run = machine.run(0.7, q0=q, speed0=speed, rtol=1e-13)
        # Steps of runs end at the knots of the table.
        assert after.q[row] == pytest.approx(float(run.q[-1]), abs=1e-8)
        assert after.speed[row] == pytest.approx(float(run.speed[-1]), abs=1e-7)


@BOTH
@pytest.mark.parametrize("make", [five_bar, engine, block])
def test_the_error_follows_the_tolerance(make: Any, method: Pair) -> None:
    """Whatever the steps, it is some tolerances for each of them."""
    machine = make()
    q, speed = states(machine, 40, seed=5)
    times: dict[str, Any] = {"dt": 0.1, "n": 2 if make is five_bar else 10}
    best = machine.step(q, speed, 0.0, **times, method="DOP853", rtol=1e-13)
    tolerances = 10.0 ** -np.arange(4, 12)
    errors = []
    for rtol in tolerances:
        after = machine.step(q, speed, 0.0, **times, method=method, rtol=rtol, atol=rtol)
        errors.append(max(np.abs(after.q - best.q).max(), np.abs(after.speed - best.speed).max()))
    parts = np.array(errors) / tolerances
    assert (parts < 300.0).all(), parts
    assert errors[0] > 1e3 * errors[-1], errors
    # No order of magnitude is lost from one tolerance to the next.
    assert (np.diff(np.log10(errors)) < 0.5).all(), errors


@BOTH
def test_energy_is_kept(method: Pair) -> None:
    machine = engine(loads=[assur.Gravity((9.81, 0.0)), assur.Spring("O", "B", 900.0, 0.4)])
    q, speed = np.linspace(0.0, 6.0, 33), np.linspace(-9.0, 9.0, 33)

    def energy(at: Any, rate: Any) -> Any:
        kinetic = 0.5 * machine.reduced_inertia(at).value * rate**2
        return kinetic + machine.potential(at)

    before = energy(q, speed)
    after = machine.step(q, speed, 0.0, 0.02, n=100, method=method, rtol=1e-11)
    assert energy(after.q, after.speed) == pytest.approx(before, rel=1e-8)


@BOTH
def test_a_stiff_spring_is_kept_where_even_steps_diverge(method: Pair) -> None:
    """ω dt is 20, far beyond the 2.8 of the classical method."""
    omega, x = 2e4, 1e-3
    machine = block(stiffness=omega**2, mass=1.0)
    even = machine.step(x, 0.0, 0.0, 1e-3, n=20)
    assert even.status == assur.Status.BAD_INPUT or abs(even.q) > 1.0
    for n in (1, 20):
        t = n * 1e-3
        after = machine.step(x, 0.0, 0.0, 1e-3, n=n, method=method, rtol=1e-10, atol=(1e-13, 1e-9))
        assert after.status == 0
        assert after.q == pytest.approx(x * math.cos(omega * t), abs=1e-7 * x)
        assert after.speed == pytest.approx(-x * omega * math.sin(omega * t), abs=1e-7 * x * omega)


def test_a_step_of_many_periods_is_cut() -> None:
    """A crank that turns by itself goes round 100 times in one dt, at most a radian in a step."""
    after = engine(bodies={"crank": assur.Body(inertia=0.5)}).step(
        0.3, 200.0 * math.pi, 0.0, 1.0, method="RK45", rtol=1e-6
    )
    assert after.status == 0
    assert after.q == pytest.approx(0.3 + 200.0 * math.pi, rel=1e-13)


def mixed() -> tuple[assur.Machine, Any, Any]:
    """Environments with few steps beside others with many, and some that end early."""
    q, speed = states(five_bar(), 700, seed=4)
    speed[::3] *= 8.0
    speed[5::50] *= 40.0
    q[17] = np.nan
    return five_bar(), q, speed


@BOTH
def test_an_environment_has_the_bits_that_it_has_alone(method: Pair) -> None:
    machine, q, speed = mixed()
    steps: dict[str, Any] = {"dt": 0.01, "n": 3, "method": method, "rtol": 1e-8, "on_error": "hold"}
    every = machine.step(q, speed, [0.1, -0.1], threads=2, **steps)
    again = machine.step(q, speed, [0.1, -0.1], threads=1, **steps)
    assert np.array_equal(every.q, again.q, equal_nan=True)
    assert np.array_equal(every.speed, again.speed)
    assert np.array_equal(every.status, again.status)
    assert np.count_nonzero(every.status > 1) > 3
    assert np.count_nonzero(every.status <= 1) > 600
    for row in (0, 5, 17, 127, 128, 255, 256, 505, 698, 699):
        alone = machine.step(q[row], speed[row], [0.1, -0.1], **steps)
        assert np.array_equal(alone.q, every.q[row], equal_nan=True)
        assert np.array_equal(alone.speed, every.speed[row])
        assert alone.status == every.status[row]
    # In another place, beside others.
    order = np.random.default_rng(1).permutation(700)
    moved = machine.step(q[order], speed[order], [0.1, -0.1], **steps)
    assert np.array_equal(moved.q, every.q[order], equal_nan=True)


@BOTH
def test_each_environment_its_own_machine(method: Pair) -> None:
    """Light ones need many steps, heavy ones few: those that leave take their numbers with them."""
    rng = np.random.default_rng(8)
    masses, stalls, rates = rng.uniform(0.05, 30.0, (3, 200))
    machine = engine(
        bodies={"crank": assur.Body(inertia=0.02), "piston": assur.Body(mass=masses)},
        loads=[assur.Spring("O", "B", 50.0 * rates, 0.4)],
        motor=assur.LinearMotor(stall=stalls, no_load=40.0),
    )
    q, speed = rng.uniform(0.0, 6.0, 200), rng.uniform(0.0, 9.0, 200)
    every = machine.step(q, speed, None, 0.1, method=method, rtol=1e-7)
    assert every.status.max() == 0
    for row in (0, 1, 77, 130, 199):
        one = machine.design(row)
        alone = one.step(q[row], speed[row], None, 0.1, method=method, rtol=1e-7)
        assert (alone.q, alone.speed) == (every.q[row], every.speed[row])
    efforts = rng.normal(size=200)
    pushed = machine.step(q, speed, efforts, 0.1, method=method, rtol=1e-7)
    alone = machine.design(77).step(q[77], speed[77], efforts[77], 0.1, method=method, rtol=1e-7)
    assert (alone.q, alone.speed) == (pushed.q[77], pushed.speed[77])


@BOTH
def test_designs_have_environments_of_their_own(method: Pair) -> None:
    mechanism = assur.SliderCrank([0.1, -1.0, 0.12], [0.4, 0.4, 0.45])
    machine = assur.Machine(mechanism, bodies={"piston": assur.Body(mass=2.0)})
    q = np.array([[0.3, 0.8], [0.3, 0.8], [0.4, 0.9]])
    after = machine.step(q, 1.0, 0.1, 1e-2, n=3, method=method)
    assert after.status[:, 0].tolist() == [0, int(assur.Status.BAD_DIMENSION), 0]
    assert np.isnan(after.q[1]).all()
    alone = machine.of(mechanism.design(2)).step(q[2], 1.0, 0.1, 1e-2, n=3, method=method)
    assert np.array_equal(alone.q, after.q[2])


@BOTH
def test_environments_that_reach_a_dead_point_say_so(method: Pair) -> None:
    """The crank stops at 1.37156 rad, whose cosine follows from the triangle of the other links."""
    machine = dead_ends()
    end = math.acos((3.0**2 + 4.0**2 - 4.5**2) / 24.0)
    q, speed = np.array([0.2, 1.3, -0.4, math.nan, 1.5]), np.array([0.1, 3.0, 0.2, 0.0, 1.0])
    for dt, n in ((1e-3, 100), (0.1, 1)):
        times: dict[str, Any] = {"dt": dt, "n": n, "method": method, "rtol": 1e-9}
        after = machine.step(q, speed, 0.0, **times)
        assert after.status.tolist() == [0, 3, 0, 7, 3]
        assert np.isfinite(after.q).tolist() == [True, False, True, False, False]
        held = machine.step(q, speed, 0.0, **times, on_error="hold")
        assert held.status.tolist() == [0, 3, 0, 7, 3]
        assert held.q[2] == after.q[2]
        # The nearest state that exists; one that does not begin stays where it is.
        assert end - 1e-6 < held.q[1] <= end
        assert machine.dynamics(held.q[1], held.speed[1], on_error="nan").status <= 2
        assert (held.q[4], held.speed[4]) == (1.5, 1.0)
        with pytest.raises(assur.InputError, match=r"environment 1: UNREACHABLE .*q = \[1\.3\]"):
            machine.step(q, speed, 0.0, **times, on_error="raise")


@BOTH
@pytest.mark.filterwarnings("ignore::assur.AssurWarning")
@pytest.mark.parametrize("rtol", [1e-6, 1e-9])
@pytest.mark.parametrize("make", [dead_ends, five_bar])
def test_no_step_leads_over_a_dead_point(make: Any, rtol: float, method: Pair) -> None:
    """Their coordinates turn back there as smoothly as anywhere, but into another assembly."""
    machine = make()
    rng = np.random.default_rng(0)
    q, speed = states(machine, 40)
    speed = 4.0 * speed
    if make is dead_ends:
        q, speed = rng.uniform(0.5, 1.3, 40), rng.uniform(-2.0, 5.0, 40)
    runs = machine.run(
        0.3, q0=q, speed0=speed, rtol=1e-10, keep="ends", on_error="nan", max_steps=3000
    )
    after = machine.step(q, speed, 0.0, 0.06, n=5, method=method, rtol=rtol, on_error="hold")
    is_dead, has_failed = runs.end == "dead point", after.status > 1
    assert is_dead.sum() > 5
    assert has_failed[is_dead].all()
    assert not has_failed[runs.end == "reached"].any()
    ends = after.status[is_dead]
    assert (ends == assur.Status.UNREACHABLE).mean() > 0.8
    # Runs of several drivers end some 1e-7 before, which is a way of 1e-3 along the dead points.
    errors = np.abs(after.q - runs.q_end)[is_dead & (after.status == assur.Status.UNREACHABLE)]
    assert errors.max() < (2e-3 if make is five_bar else 1e-6 + 100.0 * rtol)


@BOTH
def test_steps_end_before_what_has_no_value(method: Pair) -> None:
    table = assur.Table([0.0, 1.0], [1.0, 2.0], periodic=False)
    machine = engine(loads=[assur.Torque("crank", table)])
    after = machine.step([0.9, 0.5], 1.0, 0.0, 0.2, method=method)
    assert after.status.tolist() == [int(assur.Status.NO_VALUE), 0]
    held = machine.step(0.9, 1.0, 0.0, 0.2, method=method, on_error="hold")
    assert held.q == pytest.approx(1.0, abs=1e-9)
    with pytest.raises(assur.InputError, match=r"NO_VALUE .* a load has no finite value there"):
        machine.step(0.9, 1.0, 0.0, 0.2, method=method, on_error="raise")
    assert engine(bodies={}).step(0.9, 1.0, 1.0, 0.2, method=method).status == 8


@BOTH
def test_a_jump_of_a_load_is_stepped_over(method: Pair) -> None:
    """A constant torque that begins at 1 rad: ½ J v² = M (q − 1), q − 1 = M t²/(2 J) + v₀ t."""
    jump = ([0.0, 1.0, 1.0, 9.0], [0.0, 0.0, 3.0, 3.0])
    table = assur.Table(*jump, spline="linear", periodic=False)
    bodies = {"crank": assur.Body(inertia=0.5)}
    machine = engine(bodies=bodies, loads=[assur.Torque("crank", table)])
    after = machine.step(0.5, 1.0, 0.0, 1.0, method=method, rtol=1e-9)
    assert after.status == 0
    assert after.q == pytest.approx(1.0 + 0.5 + 3.0 * 0.5**2 / (2.0 * 0.5), abs=1e-6)
    assert after.speed == pytest.approx(1.0 + 3.0 / 0.5 * 0.5, abs=1e-6)


def test_a_tolerance_that_takes_too_many_steps_is_given_up() -> None:
    """ω dt = 10⁶ in one dt; shorter ones have more steps together."""
    omega = 1e6
    machine = block(stiffness=omega**2, mass=1.0)
    after = machine.step(0.1, 0.0, 0.0, 1.0, method="RK45", rtol=1e-6, on_error="hold")
    assert after.status == assur.Status.NOT_CONVERGED
    assert abs(after.q) < 0.11
    assert np.isnan(machine.step(0.1, 0.0, 0.0, 1.0, method="RK45", rtol=1e-6).q)
    with pytest.raises(assur.InputError, match=r"NOT_CONVERGED .*rtol = 1e-06 is not met"):
        machine.step(0.1, 0.0, 0.0, 1.0, method="RK45", rtol=1e-6, on_error="raise")
    more = machine.step(0.1, 0.0, 0.0, 1e-4, n=300, method="RK45", rtol=1e-9)
    assert more.q == pytest.approx(0.1 * math.cos(omega * 0.03), abs=1e-3)


@BOTH
@pytest.mark.parametrize("speed", [math.nan, math.inf, 1e300, -1e200])
def test_speeds_beyond_all_steps(speed: float, method: Pair) -> None:
    after = engine().step([1.0, 1.0], [1.0, speed], 0.0, 1e-3, method=method)
    assert after.status.tolist() == [0, int(assur.Status.BAD_INPUT)]
    assert np.isnan(after.q[1])


def test_no_time_step_is_too_strange() -> None:
    for dt, n in ((1e300, 10**15), (5e-324, 1), (1e-300, 10**15)):
        after = engine().step(1.0, 1.0, 0.0, dt, n=n, method="RK45")
        assert after.status in tuple(assur.Status)


def test_a_change_point_is_stepped_through() -> None:
    machine = assur.Machine(
        assur.FourBar(4.0, 1.0, 4.0, 1.0),
        bodies={"rocker": assur.Body(inertia=0.1), "crank": assur.Body(inertia=0.1)},
    )
    after = machine.step([-0.05, 0.0], 1.0, 0.0, 0.1, method="RK45", rtol=1e-9)
    assert (after.status <= 1).all()
    assert after.speed == pytest.approx(np.ones(2), rel=1e-8)


REFUSED: list[tuple[str, str, Any, str]] = [
    ("RK45", "rtol", 0.0, "rtol is 0.0: it must be from"),
    ("RK45", "rtol", -1e-6, "rtol is -1e-06: it must be from"),
    ("DOP853", "rtol", math.nan, "rtol"),
    ("RK45", "rtol", 1.0, "rtol is 1.0: it must be from .* below 1"),
    ("RK45", "rtol", "fine", "rtol"),
    ("RK45", "atol", 0.0, "atol is 0.0: positive numbers are needed"),
    ("RK45", "atol", (1e-9, -1.0), "positive numbers are needed"),
    ("DOP853", "atol", math.inf, "atol"),
    ("RK45", "atol", (1e-9, 1e-9, 1e-9), "one for the coordinate and one for the speed"),
    ("rk4", "rtol", 1e-6, "rtol is 1e-06, but 'rk4' has even steps: give method='RK45' or"),
    ("rk4", "atol", 1e-6, "atol is 1e-06, but 'rk4' has even steps"),
    ("rk45", "rtol", 1e-6, "method is 'rk45': one of 'rk4', 'RK45', 'DOP853' is needed"),
]


@pytest.mark.parametrize(("method", "name", "value", "message"), REFUSED)
def test_refusals(method: Any, name: str, value: Any, message: str) -> None:
    given: dict[str, Any] = {name: value}
    with pytest.raises(assur.InputError, match=message):
        engine().step(0.1, 1.0, 0.0, 1e-3, method=method, **given)


def digest() -> str:
    """Of the bits of many steps."""
    machine, q, speed = mixed()
    found = hashlib.blake2b()
    for method in PAIRS:
        for stepped, state in ((machine, (q, speed)), (motored(), (q[:, 0], speed[:, 1]))):
            after = stepped.step(*state, None, 0.02, method=method, on_error="hold")
            for array in after:
                found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


def test_vector_instructions() -> None:
    assert "ASSUR_SIMD" not in os.environ, "there would be nothing to compare with"
    with (
        bits.elsewhere(__file__, 0, ASSUR_SIMD="baseline") as baseline,
        bits.elsewhere(__file__, 0, ASSUR_SIMD="avx2") as avx2,
    ):
        found = {process.communicate()[0].strip() for process in (baseline, avx2)}
    assert found == {digest()}


if __name__ == "__main__":
    sys.stdout.write(digest())
