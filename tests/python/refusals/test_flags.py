"""Arguments that are True or False: anything else is refused by name, arrays among it."""

from __future__ import annotations

import inspect
import math
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import crank_rocker, events, flywheel, metric, slider_crank

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

pytest.importorskip("matplotlib").use("Agg")

PRESS = assur.SliderCrank(0.1, 0.4)
WHEEL = assur.FourBar(1.0, 3.0, 2.5, 3.0)
MOTION = WHEEL.solve([0.5, 1.0, 1.5], order=3)
MACHINE = assur.Machine(
    PRESS, bodies={"crank": assur.Body(inertia=0.5), "piston": assur.Body(mass=1.0)}
)
RUN = MACHINE.run(t_end=0.5, q0=0.0, speed0=3.0)
PHI, MOMENT = np.linspace(0.0, math.tau, 7), np.array([0.0, 4.0, 2.0, -3.0, 1.0, -4.0, 0.0])
LENGTHS = {"rocker.length": np.linspace(2.4, 2.6, 3)}
JOINTS = {"A": (0.0, 0.0), "B": (1.0, 0.0), "C": (3.0, 0.0)}
LINKS = {"ground": ["A"], "crank": ["A", "B"], "rod": ["B", "C"], "block": ["C"]}


def swept(**flags: Any) -> Any:
    wanted = {"span": metric.span("rocker")}
    return assur.sweep(WHEEL, LENGTHS, np.linspace(0.0, 6.0, 9), metrics=wanted, **flags)


def slide(**flags: Any) -> assur.Mechanism:
    bore = assur.Slide("block", on="ground", angle=0.0, origin="A", **flags)
    return assur.Mechanism(joints=JOINTS, links=LINKS, driver="crank", slides={"bore": bore})


def watched(event: Any) -> Any:
    return MACHINE.run(t_end=0.1, q0=0.0, speed0=3.0, events=[event])


@cache
def phase() -> Any:
    return crank_rocker.run(1.0, 4.5, 1.5, ground=4.995, gamma_min=0.2)


def of_table(**flags: Any) -> assur.Machine:
    return assur.Machine.from_table(PHI, MOMENT, np.full(7, 2.0), **flags)


@cache
def sized() -> Any:
    return flywheel.from_table(PHI, MOMENT, fluctuation=0.1, mean_speed=9.0)


@cache
def forces() -> Any:
    return MACHINE.reactions([0.1, 1.0, 2.0], speed=3.0)


@cache
def timed() -> Any:
    return WHEEL.follow(assur.laws.Cycloidal(0.5, 1.5, 2.0), [0.5, 1.0, 1.5])


@cache
def five_bar() -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)},
        links={"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"},
        driver=["left", "right"],
    )


@cache
def loci() -> Any:
    return five_bar().singular_loci()


@cache
def workspace() -> Any:
    return five_bar().workspace("C")


@cache
def found() -> Any:
    return assur.search({"P": [(0.0, 0.0), (1.0, 0.0)]}, joints=5, evaluations=1)


@cache
def front() -> Any:
    return fronts()


def fronts(**options: Any) -> Any:
    goals = {"swing": metric.span("rocker"), "angle": metric.min_transmission_angle("C")}
    few: dict[str, Any] = {
        "bounds": {"rocker.length": (2.4, 2.6)},
        "population": 4,
        "generations": 1,
    }
    return assur.pareto(WHEEL, [0.0, 1.0, 2.0], maximize=goals, **few, **options)


@cache
def design_map() -> Any:
    both = {"rocker.length": [2.4, 2.6], "coupler.length": [2.9, 3.1]}
    return WHEEL.map("assemblies", both)


# What has flags, called with them; `at`: a place for a file.
CALLS: dict[str, Callable[..., Any]] = {
    "Slide": lambda _, **f: slide(**f),
    "Table": lambda _, **f: assur.Table([0.0, 1.0, 2.0], [1.0, 2.0, 1.0], **f),
    "MachineModel.from_table": lambda _, **f: of_table(**f),
    "read_table": lambda at, **f: flywheel.read_table(at / "table.csv", **f),
    "deviation": lambda _, **f: metric.deviation("C", shape="line", **f),
    "Rest": lambda _, **f: watched(events.Rest(**f)),
    "Position": lambda _, **f: watched(events.Position(1.0, **f)),
    "Speed": lambda _, **f: watched(events.Speed(1.0, **f)),
    "Crossing": lambda _, **f: watched(events.Crossing(lambda _t, q, _w: q - 1.0, **f)),
    "TransmissionAngle": lambda _, **f: assur.Machine(
        WHEEL, bodies={"crank": assur.Body(inertia=1.0)}
    ).run(t_end=0.1, q0=0.0, speed0=3.0, events=[events.TransmissionAngle("C", 0.5, **f)]),
    "Measures.to_xarray": lambda _, **f: swept().to_xarray(**f),
    "Measures.plot": lambda _, **f: swept().plot("span", **f),
    "Motion.vjp": lambda _, **f: MOTION.vjp({"C": 1.0}, **f),
    "Motion.to_dataframe": lambda _, **f: MOTION.to_dataframe(**f),
    "Motion.to_excel": lambda at, **f: MOTION.to_excel(at / "m.xlsx", **f),
    "Motion.to_xarray": lambda _, **f: MOTION.to_xarray(**f),
    "Motion.to_parquet": lambda at, **f: MOTION.to_parquet(at / "m.parquet", **f),
    "Motion.diagram": lambda _, **f: MOTION.diagram("rocker", **f),
    "Motion.plot": lambda _, **f: MOTION.plot(**f),
    "Motion.animate": lambda at, **f: MOTION.animate(at / "m.gif", **f),
    "Motion.to_html": lambda at, **f: WHEEL.solve(np.linspace(0.0, 6.0, 9)).to_html(at / "m", **f),
    "Motion.polygon": lambda _, **f: MOTION.polygon("velocity", at=0, speed=1.0, **f),
    "TimedMotion.diagram": lambda _, **f: timed().diagram("rocker", **f),
    "TimedMotion.to_html": lambda at, **f: timed().to_html(at / "t", **f),
    "Mechanism.plot": lambda _, **f: WHEEL.plot(**f),
    "Mechanism.to_html": lambda at, **f: WHEEL.to_html(at / "w", **f),
    "Mechanism.to_drawing": lambda at, **f: WHEEL.to_drawing(at / "w.svg", **f),
    "Assemblies.plot": lambda _, **f: WHEEL.assemblies(1.0).plot(**f),
    "ConfigurationCurve.plot": lambda _, **f: WHEEL.configuration_curve().plot(**f),
    "DesignMap.plot": lambda _, **f: design_map().plot(**f),
    "SingularLocus.plot": lambda _, **f: loci()[0].plot("C", **f),
    "Workspace.plot": lambda _, **f: workspace().plot(**f),
    "pareto": lambda _, **f: fronts(**f),
    "ParetoFront.plot": lambda _, **f: front().plot(**f),
    "ParetoFront.to_html": lambda at, **f: front().to_html(at / "f", **f),
    "Run.plot": lambda _, **f: RUN.plot(**f),
    "Run.to_html": lambda at, **f: RUN.to_html(at / "r", **f),
    "Tabular.to_dataframe": lambda _, **f: RUN.to_dataframe(**f),
    "Tabular.to_excel": lambda at, **f: forces().to_excel(at / "f.xlsx", **f),
    "Tabular.to_parquet": lambda at, **f: sized().to_parquet(at / "f.parquet", **f),
    "Tabular.to_xarray": lambda _, **f: forces().to_xarray(**f),
    "SteadyState.plot": lambda _, **f: of_table().steady_state(9.0).plot(**f),
    "Flywheel.plot": lambda _, **f: sized().plot(**f),
    "Reactions.plot": lambda _, **f: forces().plot(at=0, **f),
    "Reactions.polygon": lambda _, **f: forces().polygon("rod", at=0, **f),
    "Bearing.plot": lambda _, **f: forces().bearing("A", on="rod").plot(**f),
    "JammingRun.plot": lambda _, **f: phase().plot("ground", **f),
    "least_transmission_angle": lambda _, **f: crank_rocker.least_transmission_angle(
        0.1, 0.5, 0.1, 1.5, 1.5, **f
    ),
    "plot_zone": lambda _, **f: crank_rocker.plot_zone(**f),
    "plot_push_and_pull": lambda _, **f: crank_rocker.plot_push_and_pull(1, 4.5, 1.5, 4.8, **f),
    "plot_transmission": lambda _, **f: crank_rocker.plot_transmission(1, 4.5, 1.5, 4.8, **f),
    "plot_least_angle": lambda _, **f: crank_rocker.plot_least_angle(**f),
    "plot_contour": lambda _, **f: slider_crank.plot_contour(1.0, 0.11, 0.407, **f),
    "plot_positions": lambda _, **f: slider_crank.plot_positions(1.0, 0.11, 0.407, **f),
    "plot_motion": lambda _, **f: slider_crank.plot_motion("stroke", 0.11, 0.407, **f),
    "plot_convergence": lambda _, **f: slider_crank.plot_convergence(count=2, **f),
    "plot_deviation": lambda _, **f: slider_crank.plot_deviation(**f),
    "sweep": lambda _, **f: swept(**f),
    "search": lambda _, **f: assur.search({"P": [(0.0, 0.0), (1.0, 0.0)]}, **f),
    "fit": lambda _, **f: assur.fit(
        assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0)),
        {"P": [(0.0, 0.0), (1.0, 0.0)]},
        evaluations=1,
        **f,
    ),
    "path_error": lambda _, **f: metric.path_error(
        "P", [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)], kind="chamfer", **f
    ),
    "LinkageFit.plot": lambda _, **f: found()[0].plot(**f),
    "Fits.resume": lambda _, **f: found().resume(**f),
}


MODULES = (assur, flywheel, events, metric, slider_crank, crank_rocker, assur.laws, assur.balance)
# The classes of results, which are not named in a module that users import.
RESULTS = (type(timed()), type(forces()), type(forces().bearing("A", on="rod")), type(phase()))


def flags_of(function: Any) -> list[str]:
    """Return the parameters of a function that are True or False."""
    parameters = inspect.signature(function).parameters.values()
    words = ("bool", "bool | None", "Progress")
    return [one.name for one in parameters if str(one.annotation) in words]


def members(owner: type) -> Iterator[tuple[str, Any]]:
    for one in owner.__mro__:
        for name, member in vars(one).items():
            plain = getattr(member, "__func__", member)
            if inspect.isfunction(plain) and not name.startswith("_"):
                yield f"{one.__name__}.{name}", plain


def public_flags() -> set[tuple[str, str]]:
    """Return the flags of all public functions, methods and classes that are made by calls."""
    found = set[tuple[str, str]]()
    owners = {one for module in MODULES for one in vars(module).values() if inspect.isclass(one)}
    # These are imported when they are asked for.
    owners |= {one for name in assur.__all__ if inspect.isclass(one := getattr(assur, name))}
    for owner in owners | set(RESULTS):
        if owner.__module__.startswith("assur"):
            found |= {(name, flag) for name, one in members(owner) for flag in flags_of(one)}
    for module in MODULES:
        for name in getattr(module, "__all__", ()):
            one = getattr(module, name)
            made = inspect.isclass(one) and name in CALLS
            if inspect.isfunction(one) or made:
                found |= {(name, flag) for flag in flags_of(one)}
    return found


FLAGS = sorted(public_flags())
WRONG: list[Any] = [np.array([True, False]), np.array([1.0]), "yes", 2, [True]]


def test_every_flag_is_tried() -> None:
    assert {name for name, _ in FLAGS} == set(CALLS)


@pytest.mark.parametrize(("name", "flag"), FLAGS)
def test_what_is_not_true_or_false_is_refused_by_name(name: str, flag: str, tmp_path: Path) -> None:
    rows = zip(PHI, MOMENT, np.full(7, 2.0), strict=True)
    lines = ["phi,moment,inertia", *(f"{x},{y},{z}" for x, y, z in rows)]
    (tmp_path / "table.csv").write_text("\n".join(lines))
    for wrong in WRONG:
        with pytest.raises(assur.InputError, match=rf"\b{flag}\b"):
            CALLS[name](tmp_path, **{flag: wrong})
    assert not [one for one in tmp_path.iterdir() if one.name != "table.csv"]
