"""Every kind of load keeps the same laws, whatever it is: no kind is left out anywhere."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Gravity, Machine
from models.machines.every_load import BODIES, EVERY_LOAD, KINDS, PRESS, missing

if TYPE_CHECKING:
    from assur.dynamics.loads.loads import Load

# Within the first turn, and beyond it either way.
Q = np.array([0.3, 1.9, 4.0, -7.7, 16.2])
SPEED = 3.0
# Two ways to the same moment, in the greatest: rounding (1e-15) times conditions of some ten.
CLOSE = 1e-13
# Differences of the fourth order over 1e-3 rad of some 10 J: what is left is 1e-10.
SLOPE = 1e-9
# A change of the speed by 1e-4 leaves its square, and the steady state is good to its own rtol.
CHANGED = 1e-8

each = pytest.mark.parametrize("load", EVERY_LOAD.values(), ids=lambda one: type(one).__name__)


def machine(*loads: Load, **parts: Any) -> Machine:
    return Machine(PRESS, bodies=BODIES, loads=loads, **parts)


def test_there_is_one_of_every_kind() -> None:
    assert not missing(EVERY_LOAD.values())


def test_the_machines_docstring_names_every_kind() -> None:
    text = Machine.__doc__ or ""
    assert not [kind.__name__ for kind in KINDS if f"`{kind.__name__}`" not in text]


@each
def test_its_moment_is_that_of_the_forces_on_links(load: Load) -> None:
    """The moment of the reduction; that of the drive that holds what acts on links."""
    # Masses would ask for velocities and angles that a load must ask for itself.
    own = machine(load) if isinstance(load, Gravity) else Machine(PRESS, loads=[load])
    moment = own.reduced_moment(Q, SPEED)
    # Driven at constant speed.
    inertia = 0.5 * own.reduced_inertia(Q).d1 * SPEED**2
    drive = own.reactions(Q, SPEED).driver
    assert np.abs(moment).max() > 0.1
    assert np.abs(inertia - moment - drive).max() < CLOSE * np.abs(moment).max()


@each
def test_what_has_a_potential_acts_by_its_slope(load: Load) -> None:
    own, h = machine(load), 1e-3
    v = own.potential(Q[:, None] + h * np.array([-2, -1, 1, 2]))
    if np.ptp(v) > 0.0:
        # A difference of the fourth order.
        slope = (v @ [1, -8, 8, -1]) / (12.0 * h)
        assert np.abs(own.reduced_moment(Q) + slope).max() < SLOPE * np.abs(slope).max()


@each
def test_a_steady_state_knows_how_it_depends_on_the_speed(load: Load) -> None:
    """A small change of the energy, after a turn of a run, against the multiplier."""
    swings: Any = load
    # A torsion spring on a link that turns winds up: its load has no period.
    swings = replace(swings, link="rod", on="ground") if hasattr(load, "link") else load
    own = machine(swings, motor=assur.LinearMotor(12.0, 40.0, rotor_inertia=0.5))
    steady = own.steady_state()
    q0, speed = steady.q[0], steady.speed[0]
    part = 1e-4
    ends = []
    for begin in (speed * (1.0 - part), speed * (1.0 + part)):
        run = own.run(q_end=q0 + math.tau, q0=q0, speed0=begin, rtol=1e-12)
        ends.append(run.speed[-1] ** 2)
    change = (ends[1] - ends[0]) / (4.0 * part * speed**2)
    assert steady.multiplier == pytest.approx(change, rel=CHANGED)


@each
def test_errors_count_and_name_it(load: Load) -> None:
    """What has no value is the load behind it."""
    short = assur.Table([0.0, 1.0], [1.0, 2.0], periodic=False)
    own = machine(Gravity(), load, assur.Torque("crank", short))
    with pytest.raises(assur.InputError, match=re.escape("loads[2], the Torque on 'crank': a ta")):
        own.reduced_moment(2.0, SPEED)
