"""A sample of the campaign on machines, its formulas, and proof that its checks detect faults."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from campaigns import campaign
from campaigns.checks.campaign_machines import Checked
from models.machines import machine_models
from oracles.dynamics.machine_energy import Balance, spline

if TYPE_CHECKING:
    from collections.abc import Callable

COUNT = 30  # `make campaign` asks 10 000
PARTS = 6


@pytest.mark.parametrize("part", range(PARTS))
def test_machines_keep_their_energy(part: int) -> None:
    report = campaign.run(campaign.work(COUNT, "machines")[part::PARTS], besides=False)
    assert not report.failures, "\n".join(report.failures[:10])
    assert report.counts["machines"] == COUNT // PARTS


# Dead points of long chains, trial positions, misleading step estimates: found in longer
# scans.
@pytest.mark.parametrize(
    "seed", [23, 29, 38, 67, 92, 231, 483, 710, 987, 1557, 6729, 6785, 7561, 9039]
)
def test_machines_that_once_lost_energy_keep_it(seed: int) -> None:
    assert not campaign.run([("machine", seed)], besides=False).failures


def test_every_load_motor_and_kind_of_place_is_drawn() -> None:
    kinds: Counter[str] = Counter()
    for seed in range(200):
        machine = machine_models.machine_case(seed).machine
        motors = machine.motor if isinstance(machine.motor, list | tuple) else [machine.motor]
        kinds.update(type(one).__name__ for one in (*machine.loads, *motors))
        for load in machine.loads:
            values = [*getattr(load, "force", ()), getattr(load, "torque", 0.0)]
            kinds.update(f"value {type(value).__name__}" for value in values)
            ends = [getattr(load, name, "") for name in ("at", "first", "second")]
            kinds["on the ground"] += any(end and end[0] == "ground" for end in ends)
            kinds["in a link"] += any(end and not isinstance(end, str) for end in ends)
            kinds["in link axes"] += getattr(load, "axes", None) is not None
    wanted = {
        *machine_models.DRAWN,
        *("ConstantTorque", "LinearMotor", "InductionMotor", "Table", "NoneType"),
        *("value float", "value Table", "value function"),
        *("on the ground", "in a link", "in link axes"),
    }
    assert {name for name in wanted if kinds[name] < 5} == set()


# -- the formulas, against a crank on a pivot -------------------------------------------------

PIVOT, LENGTH = (3.0, -1.0), 2.0
Q, SPEED = 0.7, 1.3
TURNED = np.array([np.cos(Q), np.sin(Q)])
ACROSS = np.array([-np.sin(Q), np.cos(Q)])
TIP = PIVOT + LENGTH * TURNED
HOOK = np.array([1.0, 4.0])
DISTANCE = float(np.hypot(*(HOOK - TIP)))
# Rate of the distance from the tip to the hook by q.
GROWS = float(-(HOOK - TIP) @ (LENGTH * ACROSS) / DISTANCE)


def crank(load: Any = None, motor: Any = None) -> Balance:
    m = assur.Mechanism(
        joints={"A": PIVOT, "B": (PIVOT[0] + LENGTH, PIVOT[1]), "C": (7, 1), "D": (7.5, -1)},
        links={"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"},
        driver="crank",
    )
    body = {"crank": assur.Body(mass=2.0, inertia=0.5, at=(1.0, 0.25))}
    machine = assur.Machine(m, bodies=body, loads=[load] if load else [], motor=motor)
    return Balance(machine, [0.3], [[Q]], [[SPEED]])


def test_kinetic_energy() -> None:
    own = crank(motor=assur.LinearMotor(4.0, 9.0, ratio=-3.0, rotor_inertia=0.2))
    expected = 0.5 * (0.5 + 2.0 * (1.0 + 0.0625) + 9.0 * 0.2) * SPEED**2
    assert own.kinetic() == pytest.approx([expected], rel=1e-14)


def test_weight() -> None:
    own = crank(assur.Gravity((1.5, -9.0)))
    centre = PIVOT + TURNED + 0.25 * ACROSS
    assert own.potentials().sum() == pytest.approx(-2.0 * centre @ (1.5, -9.0), rel=1e-14)
    slope = 2.0 * (ACROSS - 0.25 * TURNED) @ (1.5, -9.0)
    assert own.conservative().sum() == pytest.approx(slope, rel=1e-14)


FORCE, AXES = (5.0, 2.0), (5.0 * TURNED + 2.0 * ACROSS)
# A load, its potential, and its generalised force.
LOADS: dict[str, tuple[Any, float, float]] = {
    "force": (assur.Force("B", FORCE), 0.0, LENGTH * float(ACROSS @ FORCE)),
    "force in a link": (
        assur.Force(("crank", (0.0, 1.0)), FORCE),
        0.0,
        float(-TURNED @ FORCE),
    ),
    "force along a link": (
        assur.Force("B", FORCE, axes="crank"),
        0.0,
        LENGTH * float(ACROSS @ AXES),
    ),
    "force on the ground": (assur.Force(("ground", (1.0, 2.0)), FORCE), 0.0, 0.0),
    "torque": (assur.Torque("ground", 3.0, on="crank"), 0.0, -3.0),
    "spring to the ground": (
        assur.Spring("B", ("ground", (1.0, 4.0)), 20.0, 0.5, preload=3.0),
        10.0 * (DISTANCE - 0.5) ** 2 + 3.0 * (DISTANCE - 0.5),
        -(20.0 * (DISTANCE - 0.5) + 3.0) * GROWS,
    ),
    "torsion spring": (
        assur.TorsionSpring("crank", 6.0, angle=0.2, preload=-1.0),
        3.0 * (Q - 0.2) ** 2 - (Q - 0.2),
        -(6.0 * (Q - 0.2) - 1.0),
    ),
    "damper": (
        assur.Damper(("ground", (1.0, 4.0)), "B", 0.7),
        0.0,
        -0.7 * GROWS**2 * SPEED,
    ),
    "torsion damper": (assur.TorsionDamper("ground", 0.7, on="crank"), 0.0, -0.7 * SPEED),
    "function": (
        assur.Torque("crank", lambda t, q, v: t + 10.0 * q + 100.0 * v),
        0.0,
        0.3 + 10.0 * Q + 100.0 * SPEED,
    ),
}


@pytest.mark.parametrize("name", LOADS)
def test_a_load(name: str) -> None:
    load, potential, force = LOADS[name]
    own = crank(load)
    assert own.potentials().sum() == pytest.approx(potential, rel=1e-14)
    total = own.conservative().sum() + own.applied().sum()
    assert total == pytest.approx(force, rel=1e-13, abs=1e-14)


@pytest.mark.parametrize(
    ("motor", "torque"),
    [
        (assur.ConstantTorque(5.0, ratio=-3.0), 5.0),
        (assur.LinearMotor(4.0, 9.0, ratio=-3.0), 4.0 * (1.0 + 3.0 * SPEED / 9.0)),
        (assur.Table([-10.0, 10.0], [-20.0, 20.0], spline="linear", ratio=-3.0), -6.0 * SPEED),
    ],
)
def test_a_motor(motor: Any, torque: float) -> None:
    assert crank(motor=motor).powers().sum() == pytest.approx(torque * -3.0 * SPEED, rel=1e-14)


def test_an_induction_motor_has_its_greatest_torque_at_its_slip() -> None:
    speed = 3.0 * SPEED
    motor = assur.InductionMotor(7.0, 0.25, speed / 0.75, ratio=3.0)
    assert crank(motor=motor).powers().sum() == pytest.approx(7.0 * speed, rel=1e-14)


def test_a_periodic_table_goes_on_in_either_direction() -> None:
    table = assur.Table([1.0, 2.0, 3.0], [0.0, 4.0, 0.0], spline="linear")
    assert spline(table, periodic=True)(np.array([1.25, 3.25, -0.75])) == pytest.approx([1.0] * 3)


# -- the checks detect faults -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "name", "off"),
    [
        ("moment", "applied", 1e-6),
        ("moment", "conservative", 1e-6),
        ("inertia", "kinetic", 1e-6),
        ("potential", "potentials", 1e-6),
        ("balance", "powers", 1e-3),
    ],
)
def test_a_wrong_reduction_is_found(
    kind: str, name: str, off: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    def found() -> bool:
        reports = [Checked(machine_models.machine_case(seed)).report for seed in range(4)]
        return any(text.startswith(kind) for one in reports for text in one.failures)

    assert not found()
    own: Callable[[Balance], Any] = getattr(Balance, name)
    monkeypatch.setattr(Balance, name, lambda self: own(self) * (1.0 + off))
    assert found()
