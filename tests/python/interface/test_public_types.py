"""What a user calls and reads has a type that is no `Any`, and it is true."""

from __future__ import annotations

import inspect
import typing
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import pytest

import assur
from interface.reachable import Hint, hints, is_union, members, of_class, of_function, parts
from interface.type_names import MISSING

if TYPE_CHECKING:
    from collections.abc import Iterable

Q = np.linspace(0.0, 6.0, 13)
# What says nothing of what is in it.
BARE = {dict, list, tuple, set, frozenset, type, Callable, object, Any, MISSING}
# Where a wide type is right, and why.
WIDE = {
    "Contents.wanted": "arguments of any method, as a file has them",
    "Engine.submit": "as `Executor.submit` of concurrent.futures and Dask have it",
    "Future.": "the same: the result of any call",
    "Source.": "what a file has in a number's place, for messages; fields of an error",
    "Fits.resume(progress)": "what a function of the user returns is not looked at",
    "fit(progress)": "the same",
    "fit(targets)": "points, pairs of arrays, or classes of assur.target: each is checked",
    "fit(ties)": "names, and a number that may follow",
    "pareto(progress)": "the same",
    "pareto(ties)": "names, and a number that may follow",
    "search(progress)": "the same",
    "sweep(progress)": "the same",
}
# Axes of several diagrams: NumPy has no arrays of axes, and those of object_ would have no methods.
PANELS = npt.NDArray[Any]


def wide(hint: Any) -> Any:
    """The part of an annotation that says too little, or None."""
    if hint in (npt.ArrayLike, PANELS) or typing.get_origin(hint) is typing.Literal:
        return None
    if inspect.isclass(hint) or not parts(hint):
        return hint if isinstance(hint, type | object) and is_bare(hint) else None
    if typing.get_origin(hint) is np.ndarray:
        return wide(parts(parts(hint)[1])[0])  # its shape is never told
    listed = parts(hint)
    if is_union(hint):  # that of `ArrayLike` is laid out in it
        listed = [part for part in listed if part not in parts(npt.ArrayLike)]
    return next((found for part in listed if (found := wide(part)) is not None), None)


def is_bare(hint: Any) -> bool:
    try:
        return hint in BARE
    except TypeError:
        return False


def is_excused(place: str) -> bool:
    return any(place.startswith(known) for known in WIDE)


def faults(listed: Iterable[Hint]) -> list[str]:
    return [
        f"{hint.place} {'is missing' if hint.type is MISSING else hint.type}"
        for hint in listed
        if wide(hint.type) is not None and not is_excused(hint.place)
    ]


def test_nothing_is_any() -> None:
    """Where a type is too wide, name the class; `Number` for what a batch has an array of."""
    found = hints()
    assert len(found) > 1500
    assert faults(found) == []


def test_every_excuse_is_needed() -> None:
    listed = [hint.place for hint in hints() if wide(hint.type) is not None]
    for known in WIDE:
        assert any(place.startswith(known) for place in listed), known


class Planted:
    """Everything that must not come back."""

    __module__ = "assur.planted"
    field: Any

    def plot(self, ax: Any = None, *, names: list = []) -> dict[str, Any]:  # type: ignore[type-arg] # noqa: B006
        raise NotImplementedError

    def bare(self, of, call: Callable = print) -> None:  # type: ignore[no-untyped-def, type-arg]
        raise NotImplementedError

    @property
    def value(self) -> float | Any:
        raise NotImplementedError

    def good(self, q: npt.ArrayLike | None, *rest: float) -> npt.NDArray[np.float64]:
        raise NotImplementedError


def test_a_planted_any_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("interface.reachable.is_ours", lambda _: True)
    monkeypatch.setattr("interface.type_names.names", lambda _: globals())
    listed = [fault.split(" ")[0] for fault in faults(of_class(Planted))]
    assert listed == [
        *("Planted.field", "Planted.bare(of)", "Planted.bare(call)", "Planted.plot(ax)"),
        *("Planted.plot(names)", "Planted.plot", "Planted.value"),
    ]


def press(friction: bool) -> assur.Machine:
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        loads=[assur.Torque("crank", -20.0)],
        motor=assur.LinearMotor(50.0, 15.0),
        friction={"A": assur.JointFriction(0.1, 0.01)} if friction else {},
    )


def results() -> dict[str, object]:
    """Results of one design, of a batch, of several drivers."""
    one, five = assur.FourBar(1.0, 3.0, 2.5, 3.2), assur.examples.five_bar()
    slider = assur.SliderCrank(0.1, 0.4)
    batch = assur.FourBar(1.0, [2.9, 3.0, 9.0], 2.5, 3.2)
    rubbing, free = press(True), press(False)
    phi = np.linspace(0.0, 2.0 * np.pi, 49)
    run = free.run(1.0, 0.0, 5.0, events=[assur.events.Position(1.5, stop=False)])
    tables = {
        name: assur.flywheel.from_table(
            phi, 100.0 * np.sin(phi), fluctuation=fluctuation, mean_speed=10.0
        )
        for name, fluctuation in (("one table", 0.1), ("tables", [0.1, 0.2]))
    }
    forces = {"reactions": rubbing.reactions(Q, 3.0), "reaction": rubbing.reactions(1.0, 3.0)}
    inside = free.internal_loads("rod", Q[:5], 3.0)
    wheel, duty = free.flywheel(0.02), rubbing.duty(Q, 3.0)
    struck = assur.Machine(one, bodies={"crank": assur.Body(inertia=0.5)})
    return {
        "mechanism": one,
        "batch": batch,
        "five-bar": five,
        "curve": one.configuration_curve(),
        "motion": one.solve(Q),
        "position": one.solve(1.0),
        "motions": five.solve(five.q0),
        "limits": one.limits(),
        "extremes": one.extremes("rocker"),
        "found": slider.find("bore", 0.4)[0],
        "two": five.find("P", five.joints["P"])[0],
        "many": slider.find("bore", [0.4, 0.41]),
        "path": slider.find("bore", [0.4, 0.41], near=0.5),
        "assemblies": one.assemblies(1.0),
        "assembly": one.assemblies(1.0)[0],
        "grashof": one.grashof,
        "types": batch.grashof,
        "structure": one.structure,
        "duty": duty,
        "duty's max": duty.max,
        "steady state": free.steady_state(),
        "run": run,
        "event": run.events[0],
        "state": run.at(0.3),
        "runs": free.run(0.1, [0.0, 1.0], 5.0),
        "energy": run.energy,
        "flywheel": wheel,
        "its max": wheel.max,
        **tables,
        **forces,
        "slide": forces["reaction"].slide("bore"),
        "peak": inside.peak("axial"),
        "bearing": forces["reactions"].bearing("A", on="rod"),
        "least": inside.extremes("axial"),
        "inertia": free.reduced_inertia(1.0),
        "inertias": free.reduced_inertia(Q),
        "impact": struck.impact(assur.Force("B", (-1.0, 0.0)), 1.0, 2.0),
        "greatest": assur.slider_crank.greatest_speed([3.0, 4.0]),
    }


def is_of(value: object, hint: Any) -> bool:
    """Whether a value is what its annotation says."""
    name, origin = getattr(hint, "__name__", ""), typing.get_origin(hint)
    if name in ("Number", "Point"):
        return isinstance(value, (float, np.ndarray) if name == "Number" else (tuple, np.ndarray))
    if is_union(hint):
        return any(is_of(value, part) for part in parts(hint))
    if origin is typing.Literal:
        return value in parts(hint)
    if origin is np.ndarray:
        (dtype,) = parts(parts(hint)[1])
        # Of one position it is NumPy's number.
        return isinstance(value, np.ndarray | np.generic) and np.issubdtype(value.dtype, dtype)
    if origin is list:
        return isinstance(value, list) and all(is_of(part, parts(hint)[0]) for part in value)
    return isinstance(value, (float, int) if hint is float else origin or hint)


def test_types_are_true() -> None:
    checked = 0
    for of, record in results().items():
        for name, hint in members(record).items():
            try:
                value = getattr(record, name)
            except assur.AssurError:
                continue  # that of one design, asked of a batch
            assert is_of(value, hint), (of, name, type(value), hint)
            checked += 1
    assert checked > 200


@pytest.mark.parametrize("q", [1.0, [0.5, 1.0]])
def test_results_of_calls_are_what_they_say(q: float | list[float]) -> None:
    machine, table = press(False), assur.Table([0.0, 1.0], [1.0, 2.0], over="bore")
    wheel, motion = machine.flywheel(0.02), assur.FourBar(1.0, 3.0, 2.5, 3.2).solve(q)
    calls: list[Callable[[Any], object]] = [
        *(wheel.speed, wheel.time, wheel.work, wheel.reduced_moment, wheel.reduced_inertia),
        *(machine.effort, machine.potential, machine.reduced_moment, machine.reduced_inertia),
        *(table.at, motion.joint("C").velocity, motion.link("rocker").acceleration),
    ]
    for call in calls:
        *_, (_, hint) = of_function("", call)
        assert is_of(call(q), hint), call
