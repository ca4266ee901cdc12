"""Every property and method of the results of random machines answers, or refuses with a reason."""

from __future__ import annotations

import inspect
import warnings
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from models.machines.rubbing_machines import rubbing_case
from models.mechanisms.rigid_parts import RigidParts

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# They write files, need packages that a user may not have, or are no results; and parameters of
# those that draw.
OUTSIDE = {"explore", "save", "to_csv", "to_pandas", "mechanism", "machine"}
PICTURES = {"ax", "axes", "dark", "path"}
DEPTH = 2
COUNT = 6


def answer(call: Callable[[], Any], where: str) -> Any:
    """What a call gives; None if it refuses. No fault of the package passes."""
    try:
        return call()
    except assur.AssurError as refusal:
        if "a fault of assur" in str(refusal):
            pytest.fail(f"{where}: {refusal}")
    except ImportError:
        pass
    return None


def calls(result: Any, mechanism: assur.Mechanism) -> Iterator[tuple[str, Callable[[], Any]]]:
    """All that can be asked of a result: by name of a joint, link or slide where it wants one."""
    for name in dir(result):
        if name.startswith("_") or name in OUTSIDE:
            continue
        kind = inspect.getattr_static(result, name)
        if inspect.isfunction(kind):
            yield from calls_of_method(name, getattr(result, name), mechanism)
        elif not callable(kind) and not isinstance(kind, classmethod | staticmethod):
            yield name, partial(getattr, result, name)


def calls_of_method(
    name: str, method: Callable[..., Any], mechanism: assur.Mechanism
) -> Iterator[tuple[str, Callable[[], Any]]]:
    parameters = inspect.signature(method).parameters
    needed = [one.name for one in parameters.values() if one.default is one.empty]
    if PICTURES & parameters.keys():
        return
    if not needed:
        yield f"{name}()", method
    elif needed[0] in ("name", "joint", "slide", "link") and set(needed[1:]) <= {"on"}:
        for given in (*mechanism.joint_names, *mechanism.links, *mechanism.slides):
            if "on" not in needed:
                yield f"{name}({given})", partial(method, given)
            if "on" in parameters:
                for on in mechanism.links:
                    yield f"{name}({given}, on={on})", partial(method, given, on=on)


def ask(result: Any, mechanism: assur.Mechanism, where: str, depth: int = DEPTH) -> None:
    for name, call in calls(result, mechanism):
        found = answer(call, f"{where}.{name}")
        parts = found if isinstance(found, tuple | list) else (found,)
        for part in parts[:3]:
            if depth > 1 and type(part).__module__.startswith("assur.") and part is not result:
                ask(part, mechanism, f"{where}.{name}", depth - 1)


def results(machine: assur.Machine, q: Any, speed: Any) -> Iterator[tuple[str, Callable[[], Any]]]:
    mechanism = machine.mechanism
    assert mechanism is not None
    yield "reactions", lambda: machine.reactions(q, speed, on_error="nan")
    yield "reactions at rest", lambda: machine.reactions(q, sense=1.0, on_error="nan")
    yield "self_locking", lambda: machine.self_locking(n=8)
    yield "duty", lambda: machine.duty(q, speed)
    yield "equilibria", machine.equilibria
    yield "run", lambda: machine.run(t_end=0.02, q0=q[0], speed0=speed, max_steps=200)
    yield "steady_state", lambda: machine.steady_state(speed=3.0, max_steps=200)
    yield "flywheel", lambda: machine.flywheel(0.1, mean_speed=3.0)
    yield "motion", lambda: mechanism.solve(q, on_error="nan")
    yield "limits", mechanism.limits
    link = next(name for name in mechanism.links if name != "ground")
    yield "extremes", lambda: mechanism.extremes(link)
    yield "sweep", lambda: assur.sweep(mechanism, {}, q, on_error="drop")


def cases(seed: int) -> Iterator[tuple[assur.Machine, Any, Any]]:
    case, machine = rubbing_case(seed)
    yield machine, case.q, case.speed[0]
    parts = RigidParts(seed, 2)
    try:
        mechanism = parts.mechanism()
    except assur.AssurError:
        return
    friction: dict[str, Any] = {
        name: assur.JointFriction(0.1, 0.05, viscous=0.1 * (seed % 2))
        for name in mechanism.joint_names
        if sum(name in joints for joints in mechanism.links.values()) > 1
    }
    # All of them, or those that rest alone.
    inner = {name: one for name, one in friction.items() if name not in "ABCD"}
    for some in (friction, inner):
        q = mechanism.q0 + np.linspace(-0.1, 0.1, 2)
        loads = [assur.Torque("crank", -1.0)] if seed % 3 else []
        bodies = {"rocker": assur.Body(mass=2.0, inertia=0.3)}
        yield assur.Machine(mechanism, bodies=bodies, loads=loads, friction=some), q, 1.0


@pytest.mark.parametrize("seed", range(COUNT))
def test_every_result_answers_or_refuses(seed: int) -> None:
    for machine, q, speed in cases(seed):
        mechanism = machine.mechanism
        assert mechanism is not None
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", assur.AssurWarning)
            for name, call in results(machine, q, speed):
                found = answer(call, f"{seed}: {name}")
                if found is not None:
                    ask(found, mechanism, f"{seed}: {name}")
