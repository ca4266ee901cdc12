"""What a user writes, checked by mypy (`make types`): every expression has a type of its own.

`assert_type` does nothing when it runs; mypy refuses it where a type is another one, or `Any`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from typing_extensions import assert_type

import assur
from assur._extreme import Extreme
from assur.dynamics.forces.duty import Duty
from assur.dynamics.forces.reactions import Reactions
from assur.dynamics.motion.run import Energy, EventRecord, State
from assur.kinematics.curve.design_defects import Defect
from assur.kinematics.inverse.find import InverseSolution

if TYPE_CHECKING:
    from pathlib import Path

    from assur._arrays import Number, Point
else:
    Number = Point = object  # two things each, for type checkers alone

Float = npt.NDArray[np.float64]


def four_bar() -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4)},
        links={
            "ground": ["A", "D"],
            "crank": ["A", "B"],
            "coupler": ["B", "C", "P"],
            "rocker": ["D", "C"],
        },
        driver="crank",
    )


def resistance(t: float, q: float, speed: float) -> float:
    return -20.0 - 0.1 * speed - 0.0 * (t + q)


def press() -> assur.Machine:
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        loads=[assur.Gravity(), assur.Torque("crank", resistance)],
        motor=assur.LinearMotor(stall=50.0, no_load=15.0),
    )


def test_describe() -> None:
    m = four_bar()
    assert_type(m.structure.mobility, int)
    assert_type(m.structure.groups[0].kind, str | None)
    assert_type(m.dimensions["coupler.length"], Number)
    assert_type(m.joints["P"], Point)
    assert_type(m.q0, Number)
    assert_type(m.with_dimensions({"coupler.length": [2.9, 3.0]}), assur.Mechanism)
    assert_type(m.with_dimensions(pd.DataFrame({"coupler.length": [2.9]})), assur.Mechanism)
    assert_type(m.with_driver("rocker"), assur.Mechanism)
    # A number of one mechanism is passed on as it is.
    again = assur.FourBar(1.0, 3.0, 2.5, m.dimensions["ground.D.x"])
    assert_type(again.grashof.s_plus_l, Number)
    x, y = m.joints["P"]
    assert_type(x, float)
    assert y > x


def test_structure_and_limits() -> None:
    m = four_bar()
    assert_type(m.assemblies(1.0), assur.Assemblies)
    assert_type(m.assemblies(m.q0)[0], assur.Assembly)
    assert_type(m.assemblies(deg=30.0).complex_count, tuple[int, ...])
    assert_type(assur.SliderCrank(0.1, 0.4).find("bore", 0.4), list[InverseSolution])
    assert_type(assur.SliderCrank(0.1, 0.4).find("bore", 0.4, near=0.5), InverseSolution)
    place = assur.examples.five_bar().find("P", (0.1, 0.45))
    assert_type(place, list[InverseSolution])
    for q, assembly in assur.SliderCrank(0.1, 0.4).find("bore", 0.4):
        assert_type(q, Number)
        assert_type(assembly, assur.Assembly)
    limits = m.limits()
    assert_type(limits.intervals, Float)
    assert_type(limits.full_rotation, bool | npt.NDArray[np.bool_])
    assert_type([point.q for point in limits.dead_points], list[float])
    extremes = m.extremes("rocker")
    assert_type(extremes.max, Extreme)
    assert_type(extremes.stroke, float)
    assert round(extremes.max.value - extremes.min.value, 6) == round(extremes.stroke, 6)
    assert_type(m.configuration_curve().mechanism, assur.Mechanism)
    assert_type(m.defects([0.0], {"C": m.joints["C"]}), Defect | npt.NDArray[np.uint8])


def test_move() -> None:
    motion = four_bar().solve(np.linspace(0.0, 6.0, 7), order=2)
    assert_type(motion, assur.Motion)
    assert_type(motion.mechanism, assur.Mechanism)
    assert_type(motion.joint("P"), assur.Analogues)
    assert_type(motion.joint("P").value, Float)
    assert_type(motion.link("rocker").velocity(speed=10.0), Float)
    assert_type(motion["rocker"], assur.Analogues)
    assert_type(motion[0:3], assur.Motion)
    assert_type(motion.status, npt.NDArray[np.uint8])
    assert_type(motion.transmission_angle("C"), Float)
    assert_type(motion.to_dataframe(), pd.DataFrame)
    assert_type(motion.to_xarray(), xr.Dataset)
    assert_type(motion.plot("P"), Axes)
    assert_type(motion.diagram("rocker", orders=1), Axes)
    assert_type(motion.diagram("rocker", speed=10.0).size, int)
    assert_type(motion.polygon("velocity", at=2), Axes)
    assert_type(motion.mechanism.plot(1.0), Axes)


def test_drive() -> None:
    machine = press()
    run = machine.run(t_end=0.2, q0=0.0, speed0=5.0)
    assert_type(run, assur.Run)
    many: assur.Runs = machine.run(t_end=0.2, q0=[0.0, 1.0], speed0=5.0)
    assert_type(many.t_end, Float)
    assert_type(many.at(0.1), State)
    assert_type(run.t, Float)
    assert_type(run.at(0.1), State)
    assert_type(run.at(0.1).q, Float)
    assert_type(run.energy, Energy)
    assert_type(run.events, list[EventRecord])
    assert_type(run.plot(), Axes)
    assert_type(run.to_dataframe(), pd.DataFrame)
    forces = machine.reactions([0.5, 1.0], speed=10.0)
    assert_type(forces, Reactions)
    assert_type(forces.joint("A", on="rod"), Float)
    assert_type(forces.slide("bore").normal, Float)
    assert_type(forces.driver, Float)
    assert_type(forces.mechanism, assur.Mechanism)
    assert_type(forces.plot(at=0), Axes)
    assert_type(machine.duty(np.linspace(0.0, 6.0, 73), speed=10.0), Duty)
    assert_type(machine.effort(1.0, speed=10.0), Float)
    assert_type(machine.reduced_inertia(1.0).value, Float)


def test_a_flywheel_is_handed_on() -> None:
    table = assur.flywheel.from_table(
        [0.0, 3.0, 2.0 * np.pi], [1.0, -1.0, 1.0], fluctuation=0.1, mean_speed=10.0
    )
    assert_type(table.delta, float)
    assert_type(table.max.q, Number)
    assert_type(table.plot("speed"), Axes)
    assert_type(table.plot("reduced").size, int)
    assert assur.Body(inertia=table.inertia).inertia > 0.0


def test_search(tmp_path: Path) -> None:
    found = assur.search({"P": [(0.0, 0.0), (1.0, 0.2), (2.0, 0.0)]}, joints=6, evaluations=1)
    assert_type(found, assur.Fits[assur.LinkageFit])
    assert_type(found.resume(evaluations=1), assur.Fits[assur.LinkageFit])
    assert_type(found[0], assur.LinkageFit)
    assert_type(found[0].mechanism, assur.Mechanism)
    assert_type(found[0].error, float)
    assert_type(found[0].mechanism.solve(found[0].q), assur.Motion)
    assert found.save(tmp_path)[0].parent == tmp_path
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    wanted = assur.target.Path([(0.0, 0.0), (1.0, 0.2), (2.0, 0.0)], ordered=False)
    where = [assur.metric.min_transmission_angle("C") > 0.1]
    fits = assur.fit(m, {"P": wanted}, vary="*", where=where, evaluations=1)
    assert_type(fits, assur.Fits[assur.DesignFit])
    assert_type(fits[0].errors["P"], float)
    assert_type(fits[0].report(), str)


def test_pareto(tmp_path: Path) -> None:
    front = assur.pareto(
        four_bar(),
        np.linspace(0.0, 6.0, 13),
        minimize={"swing": assur.metric.span("rocker")},
        maximize={"angle": assur.metric.min_transmission_angle("C")},
        where=[assur.metric.reachable()],
        bounds={"coupler.length": (4.0, 4.6)},
        population=4,
        generations=2,
    )
    assert_type(front, assur.ParetoFront)
    assert_type(front[0], assur.Mechanism)
    assert_type(front.designs, assur.Mechanism)
    assert_type(front.values["swing"], npt.NDArray[np.float64])
    assert_type(front.plot("swing", "angle"), Axes)
    front.to_html(tmp_path / "front.html")
    assert len(front) >= 1


def test_sweep(tmp_path: Path) -> None:
    m, q = four_bar(), np.linspace(0.0, 6.0, 13)
    found = assur.sweep(
        m,
        {"coupler.length": np.linspace(4.0, 4.6, 3)},
        q,
        metrics={"swing": assur.metric.span("rocker") / 2.0},
        where=[assur.metric.min_transmission_angle("C") > 0.1],
    )
    assert_type(found, assur.Measures)
    assert_type(found["swing"], Float)
    assert_type(found.nsmallest(2, "swing"), npt.NDArray[np.intp])
    assert_type(found.designs(0), assur.Mechanism)
    assert_type(found.to_dataframe(), pd.DataFrame)
    assert_type(found.plot("swing"), Axes)
    assert_type(assur.sweep(m, {"coupler.length": [4.0, 4.5]}, q), assur.Motion)
    m.save(tmp_path / "m.toml")
    loaded = assur.load(tmp_path / "m.toml")
    assert_type(loaded, assur.Mechanism | assur.Machine)
    assert_type(assur.files.read(tmp_path / "m.toml").mechanism, assur.Mechanism)


def asked(name: Literal["solve"], contents: assur.files.Contents) -> assur.Motion:
    return contents.result(name)
