"""A run is copied by its arrays: to the bit, and only from a valid state."""

from __future__ import annotations

import copy
import gc
import pickle
import weakref
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Machine, events
from models.errors.refusals import refused

CRANK_ROCKER = assur.FourBar(1.0, 3.0, 2.5, 3.0)
BODIES = {"crank": Body(inertia=0.5), "rocker": Body(inertia=1.0)}


@cache
def runs() -> dict[str, assur.Run]:
    """Runs with each part that a state may have, and with several ends."""
    machine = Machine(CRANK_ROCKER, bodies=BODIES, loads=[assur.Torque("crank", 3.0)])
    lever = Machine(assur.FourBar(1.0, 3.0, 3.0, 3.0).with_driver("rocker"), bodies=BODIES)
    joints = {"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)}
    links = {"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"}
    two = assur.Mechanism(joints=joints, links=links, driver=["left", "right"])
    near = Machine(assur.FourBar(1.0, 3.0, 2.0 + 1e-10, 4.0), bodies={"rocker": Body(inertia=1.0)})
    with pytest.warns(assur.AssurWarning):
        limited = machine.run(2.0, speed0=1.0, max_steps=3)
    return {
        "time": machine.run(2.0, speed0=1.0, events=[events.Position(0.5, stop=False)]),
        "coordinate": machine.run(q_end=9.0, speed0=1.0),
        "event": machine.run(2.0, speed0=1.0, events=[events.Speed(1.5)]),
        "no steps": machine.run(0.0, speed0=1.0),
        "dead point": lever.run(9.0, speed0=1.0),
        "near change point": near.run(q_end=4.0, q0=1.0, speed0=1.0),
        "two drivers": Machine(
            two, bodies={n: Body(mass=1.0, inertia=0.1) for n in ("l2", "l3")}
        ).run(0.2, speed0=[0.3, 0.1]),
        "limit": limited,
    }


def state(run: Any) -> dict[str, Any]:
    """The state of a run's core."""
    fields: dict[str, Any] = run._core.__reduce__()[1][0]
    return fields


def bits(part: Any) -> Any:
    if isinstance(part, dict):
        return {key: bits(value) for key, value in part.items()}
    if isinstance(part, list):
        return [bits(one) for one in part]
    return part.tobytes() if isinstance(part, np.ndarray) else repr(part)


def test_the_runs_end_differently() -> None:
    assert {one.end for one in runs().values()} == {
        "reached",
        "event",
        "dead point",
        "near_change_point",
        "step limit",
    }


@pytest.mark.parametrize("name", list(runs()))
def test_a_copy_is_the_same_run_to_the_bit(name: str) -> None:
    run = runs()[name]
    along_q = name in ("coordinate", "near change point")
    whole = run.q if along_q else run.t
    x = np.linspace(whole[0], whole[-1], 50)
    for other in (pickle.loads(pickle.dumps(run)), copy.copy(run), copy.deepcopy(run)):
        assert bits(state(other)) == bits(state(run))
        assert (other.end, other.message, repr(other)) == (run.end, run.message, repr(run))
        own, theirs = (one.at(**{"q" if along_q else "t": x}) for one in (run, other))
        assert [a.tobytes() for a in own] == [a.tobytes() for a in theirs]


# Parts that may be None.
OPTIONAL = ("tail", "smallest", "largest")


def wrong_values(value: Any) -> list[Any]:
    """Values that are invalid in place of one of a state."""
    wrong: list[Any] = ["text", object()]
    if isinstance(value, np.ndarray):
        longer = np.append(value, 0.0)
        wrong += [longer, value.astype(np.float32), np.vstack([value, value]), value.tolist()]
        wrong += [value[:-1]] if value.size else []
    if isinstance(value, dict | int | float):
        wrong += [None, [0.0]]
    if isinstance(value, int):
        wrong += [-1, 2**64]
    return wrong


@pytest.mark.parametrize("name", list(runs()))
def test_a_bad_state_is_refused(name: str) -> None:
    run = runs()[name]
    make: Any = type(run._core)
    good = state(run)
    near = good["stop_reason"]["near_change_point"]
    parts = [good, *(value for value in good.values() if isinstance(value, dict))]
    for part in parts if near is None else [*parts, near]:
        for key, value in list(part.items()):
            del part[key]
            refused(assur.InputError, "not the state of a run", lambda: make(good))
            for wrong in wrong_values(value):
                if key == "dyad" and isinstance(wrong, str):
                    continue  # the name of a dyad may be any text
                if wrong is None and key in OPTIONAL:
                    continue
                part[key] = wrong
                refused(assur.InputError, "not the state of a run", lambda: make(good))
            part[key] = value
    for wrong in (None, b"...", [], {}):
        refused(assur.InputError, "not the state of a run", partial(make, wrong))
    reason = good["stop_reason"]
    for kind in ("edge", "near_change_point", "anything"):
        good["stop_reason"] = {**reason, "kind": kind, "event": 99}
        refused(assur.InputError, "not the state of a run", lambda: make(good))


def test_a_machine_that_its_own_load_refers_to_is_freed() -> None:
    class Brake:
        machine: Machine | None = None

        def __call__(self, _t: float, q: Any, _speed: Any) -> float:
            # It is tried when the machine is made, which it does not know yet.
            return -float(self.machine.reduced_inertia(q).value) if self.machine else 0.0

    brake = Brake()
    brake.machine = machine = Machine(
        CRANK_ROCKER, bodies=BODIES, loads=[assur.Torque("crank", brake)]
    )
    gone = weakref.ref(machine)
    del machine, brake
    gc.collect()
    assert gone() is None
