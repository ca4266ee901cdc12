"""Every public function that takes arrays, with numbers that it takes.

An entry is called `module.function.parameter` or `Class.method.parameter`, as the guard finds them.
"""

from __future__ import annotations

import inspect
import math
import tempfile
import types
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

import assur
from assur import balance, crank_rocker, flywheel, slider_crank

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy.typing as npt

TURN = 2.0 * math.pi
MODULES = (assur, balance, flywheel, slider_crank, crank_rocker, assur.events)

PHI = np.arange(7.0)
MOMENT = np.array([0.0, 40.0, 20.0, -30.0, 10.0, -50.0, 0.0])
INERTIA = np.array([2.0, 3.0, 4.0, 2.0, 3.0, 4.0, 2.0])
FOUR_BAR = assur.FourBar(1.0, 3.0, 2.5, 3.0)
MOTION = FOUR_BAR.solve([0.5, 1.0, 1.5], order=3)
TRACED = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
SWING = {"swing": assur.metric.span("rocker")}
FIVE_BAR = assur.Mechanism(
    joints={"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)},
    links={"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"},
    driver=["left", "right"],
)
MACHINE = assur.Machine(
    FOUR_BAR,
    bodies={"crank": assur.Body(inertia=2.0), "rocker": assur.Body(mass=1.0, inertia=0.5)},
    loads=[assur.Gravity(), assur.TorsionDamper("rocker", 0.5)],
)
OF_TABLE = assur.Machine.from_table(PHI * (TURN / 6.0), MOMENT, INERTIA, spline="linear")
RUN = MACHINE.run(4.0, 0.5, 5.0, rtol=1e-6)
MANY: assur.Runs = MACHINE.run(0.5, [0.5, 1.0], 5.0, rtol=1e-6)
MANY_ALONG: assur.Runs = MACHINE.run(q_end=8.0, q0=[0.5, 1.0], speed0=5.0, rtol=1e-6)
ALONG = MACHINE.run(q_end=8.0, q0=0.5, speed0=5.0, rtol=1e-6)
STEADY = OF_TABLE.steady_state(9.0, mean="period")
EVEN = np.arange(8.0) * (TURN / 8.0)
FORCE = np.stack([np.arange(8.0), np.arange(8.0)[::-1]], axis=-1)
WHEEL = flywheel.evaluate(PHI * (TURN / 6.0), MOMENT, INERTIA, flywheel=20.0, speed0=9.0)


def reactions(
    q: npt.ArrayLike, speed: npt.ArrayLike, acceleration: npt.ArrayLike, t: npt.ArrayLike
) -> Any:
    return MACHINE.reactions(q, speed, acceleration, t=t).joint("C", on="rocker")


def fitted(q: npt.ArrayLike, speed: npt.ArrayLike, acceleration: npt.ArrayLike) -> Any:
    return balance.fit(MACHINE, q, {"rocker": (-1.0, 0.5)}, speed, acceleration)


PUSH = assur.Torque("crank", 1.0)
PARTS = np.array(0.5)


def struck(q: npt.ArrayLike, speed: npt.ArrayLike, restitution: npt.ArrayLike) -> Any:
    return MACHINE.impact(PUSH, q, speed, restitution=restitution).speed


def inside(
    q: npt.ArrayLike, speed: npt.ArrayLike, acceleration: npt.ArrayLike, t: npt.ArrayLike
) -> Any:
    return MACHINE.internal_loads("coupler", q, speed, acceleration, t=t).moment


def inside_rod(x: npt.ArrayLike) -> Any:
    density = x, [2.0] * 4
    rod = {"coupler": assur.Body(mass=6.0, inertia=4.5, at=(1.5, 0.0))}
    return assur.Machine(FOUR_BAR, bodies=rod).internal_loads("coupler", 0.3, density=density)


@dataclass(frozen=True)
class Entry:
    """A function of one array, and arrays that it takes."""

    call: Callable[[Any], Any]
    arrays: tuple[Any, ...]


def front(q: npt.ArrayLike | None = None, deg: npt.ArrayLike | None = None) -> Any:
    return assur.pareto(
        FOUR_BAR,
        q,
        deg=deg,
        maximize={"angle": assur.metric.min_transmission_angle("C"), **SWING},
        bounds={"rocker.length": (2.3, 2.7)},
        population=4,
        generations=1,
    ).designs.values


def numbers(first: float) -> tuple[Any, ...]:
    """Numbers from the first on: one of them, in a row, in rows, and no numbers at all."""
    row = first + np.arange(4.0)
    return np.array(first), row, row.reshape(2, 2), row[:0], first + np.arange(4.0) / 4.0


def each_of(name: str, function: Callable[..., Any], **usual: Any) -> dict[str, Entry]:
    """An entry for each parameter that is a list of numbers, the others as usual."""

    def entry(parameter: str) -> Entry:
        own = usual[parameter]
        arrays = (own,) if isinstance(own, np.ndarray) else numbers(own)
        return Entry(lambda value: function(**{**usual, parameter: value}), arrays)

    listed = [one for one in array_parameters(function) if one in usual]
    return {f"{name}.{parameter}": entry(parameter) for parameter in listed}


def array_parameters(function: Callable[..., Any]) -> list[str]:
    every = inspect.signature(function).parameters.values()
    return [one.name for one in every if "ArrayLike" in str(one.annotation)]


# Pictures hand coordinates and speeds on to `solve`, `velocity` and the like, which are entries.
PICTURES = ("plot", "diagram", "polygon", "to_html", "to_drawing", "hodograph")


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Every public function, method and constructor, by its name."""
    for module in MODULES:
        for name in module.__all__:
            thing = getattr(module, name)
            if isinstance(thing, types.FunctionType):
                # As users type it: the papers' modules are at the top.
                yield f"{module.__name__.replace('assur.papers', 'assur')}.{name}", thing
            elif inspect.isclass(thing):
                for key, member in inspect.getmembers(thing, inspect.isroutine):
                    is_own = (getattr(member, "__module__", None) or "").startswith("assur")
                    if is_own and (key == "__init__" or not key.startswith("_")):
                        # Where it is defined; a method inherited is the same one.
                        yield member.__qualname__, member


def with_lengths(value: Any) -> Any:
    return FOUR_BAR.with_dimensions({"coupler.length": value}).solve(1.0, on_error="nan")


def written(kind: str) -> Callable[..., Any]:
    """A table of a motion, from a file too."""

    def table(speed: npt.ArrayLike, acceleration: npt.ArrayLike, jerk: npt.ArrayLike) -> Any:
        if kind == "dataset":
            data = MOTION.to_xarray(speed=speed, acceleration=acceleration, jerk=jerk)
            return data.to_array("name").values
        if kind == "frame":
            return MOTION.to_dataframe(speed=speed, acceleration=acceleration, jerk=jerk).to_numpy()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"motion.{kind}"
            if kind == "xlsx":
                MOTION.to_excel(path, speed=speed, acceleration=acceleration, jerk=jerk)
                return pd.read_excel(path, "C", skiprows=[1]).to_numpy()
            MOTION.to_parquet(path, speed=speed, acceleration=acceleration, jerk=jerk)
            return pd.read_parquet(path).to_numpy()

    return table


TIMES = np.array([0.5, 1.0])
PLACES = FOUR_BAR.solve(TIMES).joint("C").value
ENDS = [2.0, 3.0]
SPACE = FIVE_BAR.workspace("C", positions=4)


def machine_in_degrees(name: str) -> Callable[[Any], Any]:
    return lambda deg: getattr(MACHINE, name)(deg=deg)


def wheel_in_degrees(name: str) -> Callable[[Any], Any]:
    return lambda deg: getattr(WHEEL, name)(deg=deg)


OVER = {"rocker.length": [2.4, 2.6], "ground.D.x": [3.1, 3.3]}
CURVES = ("speed", "time", "work", "reduced_moment", "reduced_inertia")
QUESTIONS = (
    "reactions",
    "effort",
    "acceleration",
    "d_acceleration",
    "d_effort",
    "dynamics",
    "linearize",
    "reduced_inertia",
    "reduced_moment",
    "potential",
)
IN_DEGREES = {
    **{f"Machine.{name}.deg": Entry(machine_in_degrees(name), numbers(30.0)) for name in QUESTIONS},
    "Machine.duty.deg": Entry(
        lambda deg: MACHINE.duty(deg=deg, speed=1.0), (np.linspace(0.0, 360.0, 7),)
    ),
    "Machine.internal_loads.deg": Entry(
        lambda deg: MACHINE.internal_loads("coupler", deg=deg).moment, numbers(30.0)
    ),
    "assur.fit.targets": Entry(
        lambda points: assur.fit(TRACED, {"P": points}, closed=False, evaluations=1)[0].q,
        (np.array([[0.0, 2.0], [0.0, 0.5], [0.4, 0.0], [1.2, 0.2]]),),
    ),
    "assur.fit.timing": Entry(
        lambda timing: (
            assur.fit(
                TRACED, {"P": [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0)]}, timing=timing, evaluations=1
            )[0].q
        ),
        (np.array([0.1, 0.4, 0.7]),),
    ),
    "assur.pareto.q": Entry(front, (np.linspace(0.0, 5.0, 6),)),
    "assur.pareto.deg": Entry(lambda deg: front(deg=deg), (np.linspace(0.0, 300.0, 6),)),
    "assur.search.targets": Entry(
        lambda points: assur.search({"P": points}, joints=5, evaluations=1)[0].q,
        (np.array([[0.0, 2.0], [0.0, 0.5], [0.4, 0.0], [1.2, 0.2]]),),
    ),
    "assur.sweep.deg": Entry(
        lambda deg: dict(assur.sweep(FOUR_BAR, {}, deg=deg, metrics=SWING)), numbers(30.0)
    ),
    "Mechanism.assemblies.deg": Entry(lambda deg: FOUR_BAR.assemblies(deg=deg), numbers(60.0)),
    "Mechanism.with_driver.deg": Entry(
        lambda deg: FOUR_BAR.with_driver("rocker", deg=deg).q0, numbers(60.0)
    ),
    "Mechanism.find.value": Entry(
        lambda at: [solution.q for solution in FIVE_BAR.find("C", at)], (np.array([1.0, 2.0]),)
    ),
    "Mechanism.find.deg": Entry(lambda deg: FOUR_BAR.find("rocker", deg=deg), numbers(100.0)),
    "Mechanism.find.near": Entry(
        lambda near: FIVE_BAR.find("C", (1.4, 1.9), near=near).q, (np.array([1.3, 1.1]),)
    ),
    "Mechanism.map.deg": Entry(
        lambda deg: FOUR_BAR.map("assemblies", OVER, deg=deg).values, (np.array(60.0),)
    ),
    "Machine.impact.deg": Entry(
        lambda deg: MACHINE.impact(PUSH, deg=deg, speed=-20.0, restitution=0.5).speed, numbers(30.0)
    ),
    "Machine.run.q_end": Entry(
        lambda q: MACHINE.run(q_end=q, q0=1.0, speed0=5.0), (np.array(2.0), PHI[:3] + 2.0)
    ),
    "Machine.run.deg_end": Entry(
        lambda deg: MACHINE.run(deg_end=deg, deg0=30.0, speed0=5.0), (np.array(60.0),)
    ),
    "Machine.run.deg0": Entry(
        lambda deg: MACHINE.run(0.25, deg0=deg, speed0=2.0), (np.array(60.0),)
    ),
    "Runs.at.deg": Entry(lambda deg: MANY_ALONG.at(deg=deg), numbers(60.0)),
    "Run.at.deg": Entry(lambda deg: ALONG.at(deg=deg), numbers(60.0)),
    "SteadyState.at.deg": Entry(lambda deg: STEADY.at(deg=deg), numbers(60.0)),
    **{f"Flywheel.{name}.deg": Entry(wheel_in_degrees(name), numbers(60.0)) for name in CURVES},
}
LENGTHS = {"l1": 1.0, "l2": 9.0, "l3": 6.0, "l4": 10.0}
SLIDER = {"phi": 0.0, "crank": 1.0, "rod": 5.0}
COLUMNS = {"phi": PHI, "moment": MOMENT, "inertia": INERTIA}
ENTRIES: dict[str, Entry] = {
    "assur.rpm.turns": Entry(assur.rpm, numbers(1500.0)),
    "Mechanism.solve.q": Entry(FOUR_BAR.solve, numbers(0.0)),
    "Mechanism.solve.q of two": Entry(
        lambda q: FIVE_BAR.solve(q, on_error="nan"), (np.ones((3, 2)), np.ones(2), np.ones((0, 2)))
    ),
    "Mechanism.with_dimensions.dimensions": Entry(with_lengths, numbers(3.0)),
    "Motion.jvp.rates": Entry(lambda rate: MOTION.jvp("C", {"coupler.length": rate}), numbers(1.0)),
    "Motion.vjp.weights": Entry(lambda weight: MOTION.vjp({"C": weight}), numbers(1.0)),
    "Mechanism.with_dimensions.by_name": Entry(
        lambda x: FOUR_BAR.with_dimensions(**{"coupler.length": x}).dimensions, numbers(3.0)
    ),
    "Grid.__init__.dimensions": Entry(
        lambda x: FOUR_BAR.with_dimensions(assur.Grid({"coupler.length": x})).dimensions,
        numbers(3.0),
    ),
    "Grid.__init__.by_name": Entry(
        lambda x: dict(assur.Grid(**{"coupler.length": x})), numbers(3.0)
    ),
    "assur.sweep.dimensions": Entry(
        lambda x: dict(assur.sweep(FOUR_BAR, {"coupler.length": x}, PHI, metrics=SWING)),
        numbers(3.0),
    ),
    "assur.sweep.q": Entry(
        lambda q: dict(assur.sweep(FOUR_BAR, {}, q, metrics=SWING)), numbers(0.5)
    ),
    "Mechanism.assemblies.q": Entry(FOUR_BAR.assemblies, numbers(1.0)),
    "Mechanism.solve.deg": Entry(lambda deg: FOUR_BAR.solve(deg=deg), numbers(0.0)),
    **IN_DEGREES,
    "Mechanism.follow.t": Entry(
        lambda t: FOUR_BAR.follow(assur.laws.Cycloidal(0.5, 1.5, 2.0), t).joint("C"),
        (np.array(0.5), np.array([0.0, 0.5, 1.0])),
    ),
    "Tabulated.t": Entry(lambda t: assur.laws.Tabulated(t, PLACES[0]).at(0.5), (TIMES[:2],)),
    "Tabulated.value": Entry(
        lambda value: assur.laws.Tabulated(TIMES[:2], value).at(0.5), (PLACES[0],)
    ),
    "Mechanism.defects.q": Entry(lambda q: FOUR_BAR.defects(q, {"C": PLACES}), (TIMES,)),
    "Mechanism.defects.joints": Entry(lambda c: FOUR_BAR.defects(TIMES, {"C": c}), (PLACES,)),
    "Mechanism.map.dimensions": Entry(
        lambda one: FOUR_BAR.map("assemblies", {"rocker.length": one, "ground.D.x": [2.0, 3.0]}),
        (np.array([1.0, 2.0, 3.0]),),
    ),
    "Mechanism.map.q": Entry(
        lambda q: FOUR_BAR.map("assemblies", {"rocker.length": ENDS, "ground.D.x": ENDS}, q=q),
        (np.array(1.0),),
    ),
    "Workspace.contains.points": Entry(SPACE.contains, (np.ones((3, 2)), np.ones(2))),
    "Motion.point.local": Entry(
        lambda at: MOTION.point("coupler", at).arrays, (np.ones(2), np.ones((3, 2)))
    ),
    **each_of("Motion.to_dataframe", written("frame"), speed=2.0, acceleration=1.0, jerk=0.5),
    **each_of("Motion.to_excel", written("xlsx"), speed=2.0, acceleration=1.0, jerk=0.5),
    **each_of("Motion.to_xarray", written("dataset"), speed=2.0, acceleration=1.0, jerk=0.5),
    **each_of("Motion.to_parquet", written("parquet"), speed=2.0, acceleration=1.0, jerk=0.5),
    "FourBar.__init__.point": Entry(
        lambda point: assur.FourBar(1.0, 3.0, 2.5, 3.2, point=point),
        (np.ones(2), np.ones((2, 3))),
    ),
    "Mechanism.with_driver.q": Entry(
        lambda q: FOUR_BAR.with_driver("rocker", q=q).q0, numbers(1.0)
    ),
    **each_of(
        "FourBar.__init__",
        assur.FourBar,
        crank=1.0,
        coupler=3.0,
        rocker=2.0,
        ground=3.0,
        ground_angle=0.3,
    ),
    **each_of("SliderCrank.__init__", assur.SliderCrank, crank=1.0, rod=5.0, offset=0.0),
    **each_of("Analogues.velocity", MOTION.joint("C").velocity, speed=1.0),
    **each_of(
        "Analogues.acceleration", MOTION.joint("C").acceleration, speed=1.0, acceleration=2.0
    ),
    **each_of("Analogues.jerk", MOTION.link("rocker").jerk, speed=1.0, acceleration=2.0, jerk=3.0),
    **each_of("Machine.reduced_inertia", MACHINE.reduced_inertia, q=0.0),
    **each_of("Machine.reduced_moment", MACHINE.reduced_moment, q=0.0, speed=1.0),
    **each_of("Machine.potential", MACHINE.potential, q=0.0),
    **each_of("Machine.reactions", reactions, q=0.0, speed=1.0, acceleration=2.0, t=0.5),
    **each_of("Machine.internal_loads", inside, q=0.0, speed=1.0, acceleration=2.0, t=0.5),
    "Machine.internal_loads.density": Entry(
        lambda x: inside_rod(x).axial, (np.array([0.0, 1.0, 1.0, 3.0]),)
    ),
    **each_of("Machine.dynamics", MACHINE.dynamics, q=0.0, speed=1.0, t=0.5),
    **each_of("Machine.acceleration", MACHINE.acceleration, q=0.0, speed=1.0, effort=2.0, t=0.5),
    **each_of("Machine.d_effort", MACHINE.d_effort, q=0.0, speed=1.0, acceleration=2.0, t=0.5),
    **each_of(
        "Machine.d_acceleration", MACHINE.d_acceleration, q=0.0, speed=1.0, effort=2.0, t=0.5
    ),
    **each_of("Machine.linearize", MACHINE.linearize, q=0.0, speed=1.0, effort=2.0, t=0.5),
    **each_of("Machine.step", partial(MACHINE.step, dt=1e-3), q=0.0, speed=1.0, effort=2.0),
    **each_of("Machine.effort", MACHINE.effort, q=0.0, speed=1.0, acceleration=2.0, t=0.5),
    **each_of("assur.balance.fit", fitted, q=0.5, speed=1.0, acceleration=2.0),
    **each_of("assur.balance.harmonics", partial(balance.harmonics, count=3), q=EVEN, values=EVEN),
    **each_of(
        "assur.balance.rotating_parts",
        partial(balance.rotating_parts, count=3),
        q=EVEN,
        force=FORCE,
    ),
    **each_of("Machine.impact", struck, q=0.5, speed=-20.0, restitution=PARTS),
    "Machine.impact.impulse": Entry(
        lambda p: MACHINE.impact(PUSH, 0.5, -20.0, impulse=p).speed, (np.array(2.0),)
    ),
    **each_of("Machine.duty", MACHINE.duty, q=PHI, speed=1.0, acceleration=2.0, t=0.5),
    "Machine.equilibria.between": Entry(
        lambda p: MACHINE.equilibria(between=p), (np.array([-1.0, 4.0]), np.array([0.0, 5.0]))
    ),
    **each_of("Machine.flywheel", OF_TABLE.flywheel, fluctuation=0.125, mean_speed=4.0),
    **each_of("Machine.run", MACHINE.run, t_end=0.5, q0=1.0, speed0=2.0, breaks=0.0, rtol=1e-6),
    "Machine.step.atol": Entry(
        lambda x: MACHINE.step(0.5, 1.0, 2.0, 1e-3, method="RK45", atol=x),
        (np.array([1.0, 2.0]) / 1024.0, np.array(0.125)),
    ),
    "Machine.run.atol": Entry(
        lambda x: MACHINE.run(0.5, 1.0, 2.0, atol=x),
        (np.array([1.0, 2.0]) / 1024.0, np.array(0.125)),
    ),
    "Machine.steady_state.breaks": Entry(
        lambda x: OF_TABLE.steady_state(9.0, breaks=x, mean="period"), (np.array([1.0, 2.0]),)
    ),
    **each_of("MachineModel.from_table", assur.Machine.from_table, **COLUMNS),
    "Run.at.t": Entry(RUN.at, numbers(0.0)),
    "Runs.at.t": Entry(MANY.at, numbers(0.0)),
    "Runs.at.q": Entry(lambda q: MANY_ALONG.at(q=q), numbers(1.0)),
    "Run.at.q": Entry(lambda q: ALONG.at(q=q), numbers(1.0)),
    **each_of("SteadyState.at", STEADY.at, q=0.0),
    **each_of("Table.__init__", assur.Table, q=PHI, value=MOMENT),
    **each_of("Flywheel.coordinate", WHEEL.coordinate, t=0.0),
    **each_of("Flywheel.reduced_moment", WHEEL.reduced_moment, q=0.0),
    **each_of("Flywheel.reduced_inertia", WHEEL.reduced_inertia, q=0.0),
    **each_of("Table.at", assur.Table([0.0, 1.0], [0.0, 1.0], periodic=False).at, x=0.5),
    **each_of("Flywheel.speed", WHEEL.speed, q=0.0),
    **each_of("Flywheel.speed_at", WHEEL.speed_at, t=0.0),
    **each_of("Flywheel.time", WHEEL.time, q=0.0),
    **each_of("Flywheel.work", WHEEL.work, q=0.0),
    **each_of(
        "assur.flywheel.from_table",
        flywheel.from_table,
        **COLUMNS,
        fluctuation=0.125,
        mean_speed=4.0,
    ),
    **each_of("assur.flywheel.evaluate", flywheel.evaluate, **COLUMNS, flywheel=8.0, speed0=9.0),
    **each_of(
        "assur.flywheel.evaluate", flywheel.evaluate, **COLUMNS, flywheel=8.0, mean_speed=9.0
    ),
    **each_of("assur.slider_crank.stroke", slider_crank.stroke, **SLIDER),
    **each_of("assur.slider_crank.coordinate", slider_crank.coordinate, **SLIDER),
    **each_of("assur.slider_crank.rod_angle", slider_crank.rod_angle, **SLIDER),
    **each_of(
        "assur.slider_crank.rod_point", slider_crank.rod_point, **SLIDER, along=2.0, across=1.0
    ),
    "assur.slider_crank.fourier.k": Entry(slider_crank.fourier, numbers(2.0)),
    "assur.slider_crank.greatest_speed.k": Entry(slider_crank.greatest_speed, numbers(2.0)),
    "assur.slider_crank.greatest_acceleration.k": Entry(
        slider_crank.greatest_acceleration, numbers(2.0)
    ),
    "assur.slider_crank.deviation.lam": Entry(
        lambda lam: slider_crank.deviation(lam, 2), (np.array([0.25, 0.5]), np.array(0.125))
    ),
    **each_of(
        "assur.crank_rocker.solve",
        crank_rocker.solve,
        phi1=0.0,
        **LENGTHS,
        speed=1.0,
        ground_speed=0.0,
    ),
    **each_of("assur.crank_rocker.grashof", crank_rocker.grashof, **LENGTHS),
    **each_of("assur.crank_rocker.crank_turns", crank_rocker.crank_turns, **LENGTHS),
    **each_of(
        "assur.crank_rocker.transmission_extremes", crank_rocker.transmission_extremes, **LENGTHS
    ),
    **each_of(
        "assur.crank_rocker.ground_range",
        crank_rocker.ground_range,
        coupler=9.0,
        rocker=6.0,
        gamma_min=0.5,
    ),
    **each_of(
        "assur.crank_rocker.least_transmission_angle",
        crank_rocker.least_transmission_angle,
        f_c=6.0,
        r_c=1.0,
        f_d=8.0,
        r_d=2.0,
        rocker=5.0,
    ),
    **each_of(
        "assur.crank_rocker.least_transmission_angle",
        partial(
            crank_rocker.least_transmission_angle,
            *(0.1, 1.0, 0.2, 1.0, 15.0),
            exact=True,
        ),
        f_b=0.5,
        r_b=1.0,
        coupler=20.0,
    ),
}
