"""What is printed of any object is a line or a small table, however much it holds."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Table, balance, events, files, flywheel, importers, laws, metric
from assur._arrays import as_number
from interface.public_interface import callables

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur.dynamics.forces.reactions import Reactions

LINES, COLUMNS = 25, 120
MANY = 100_000
PHI = np.linspace(0.0, 2.0 * np.pi, 10_001)
Q = np.linspace(0.0, 6.0, 1000)
HOOK = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]


def chain(links: int) -> assur.Mechanism:
    """A crank and as many dyads one after another: two joints each."""
    joints = {"A0": (0.0, 0.0), "B0": (1.0, 0.0)}
    members = {"ground": ["A0"], "crank0": ["A0", "B0"]}
    for k in range(1, links + 1):
        joints |= {f"A{k}": (3.0 * k, 0.0), f"B{k}": (3.0 * k + 0.3, 2.0)}
        members["ground"].append(f"A{k}")
        members[f"coupler{k}"] = [f"B{k - 1}", f"B{k}"]
        members[f"rocker{k}"] = [f"A{k}", f"B{k}"]
    return assur.Mechanism(joints, members, "crank0")


def force(t: float, q: float, speed: float) -> float:
    return t + q + speed


@functools.cache
def long_table() -> Table:
    return Table(PHI, np.sin(PHI))


@functools.cache
def batch(designs: int = MANY) -> assur.Mechanism:
    return assur.FourBar(1.0, np.linspace(2.9, 3.1, designs), 2.5, 3.2)


@functools.cache
def motion() -> assur.Motion:
    return assur.FourBar(1.0, 3.0, 2.5, 3.2).solve(np.linspace(0.0, 6.0, MANY))


@functools.cache
def press() -> assur.Machine:
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        loads=[assur.Torque("crank", -20.0)],
        motor=assur.LinearMotor(50.0, 15.0),
    )


@functools.cache
def run() -> assur.Run:
    """One of more than a thousand events."""
    speeds = np.linspace(6.0, 10.0, 40)
    watched = [events.Speed(float(speed), stop=False) for speed in speeds]
    return press().run(20.0, 0.0, 5.0, events=watched, rtol=1e-6)


@functools.cache
def forces() -> Reactions:
    return press().reactions(Q, 3.0)


@functools.cache
def measures() -> assur.Measures:
    asked = {f"swing of the rocker {k}": metric.span("rocker") for k in range(30)}
    return assur.sweep(batch(50), {}, Q[:20], metrics=asked)


@functools.cache
def searched() -> assur.Fits[assur.LinkageFit]:
    return assur.search({"the_traced_joint_of_the_path": HOOK}, evaluations=1)


@functools.cache
def fitted() -> assur.Fits[assur.DesignFit]:
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    return assur.fit(four_bar, {"P": HOOK}, evaluations=1)


def refusal() -> assur.StructureError:
    with pytest.raises(assur.StructureError) as refused:
        assur.Mechanism(
            {"A": (0, 0), "B": (1, 0), "C": (2, 1)}, {"ground": "A", "x": "AB", "y": "BC"}, "x"
        )
    return refused.value


@functools.cache
def machine() -> assur.Machine:
    mechanism = chain(12)
    links = [link for link in mechanism.links if link != "ground"]
    return assur.Machine(
        mechanism,
        bodies={link: assur.Body(mass=1.0, inertia=0.1) for link in links},
        loads=[assur.Gravity()] * 120,
        friction={f"B{k}": assur.JointFriction(0.1, 0.01) for k in range(12)},
    )


def many_assemblies() -> assur.Assemblies:
    found = assur.examples.triad().assemblies(0.5)
    return type(found)([*found] * 32, found.complex_count, (), True)


def sum_of_metrics() -> metric.Metric:
    total = metric.span("rocker") + 0.0
    for k in range(60):
        total = total + metric.span(f"rocker{k}")
    return total


def curve() -> assur.ConfigurationCurve:
    return assur.examples.klann_leg().configuration_curve()


@functools.cache
def front() -> assur.ParetoFront:
    return assur.pareto(
        assur.SliderCrank(0.1, 0.4),
        Q[:9],
        minimize={
            f"the greatest position {k} of the piston": assur.metric.max("bore") for k in range(9)
        },
        maximize={"angle": assur.metric.min_transmission_angle("B")},
        bounds={"*.length": (0.1, 0.4)},
        population=8,
        generations=2,
    )


# By the names of classes, those of what results hold after a dot.
MADE: dict[str, Callable[[], object]] = {
    "Analogues": lambda: motion().joint("C"),
    "Assemblies": many_assemblies,
    "Assembly": lambda: assur.Assembly({f"joint {k}": 1 for k in range(64)}),
    "Body": lambda: assur.Body(mass=1.0 / 3.0, inertia=0.1, at=(1.0 / 3.0, 0.2)),
    "ClassIV": assur.examples.loom,
    "ConfigurationCurve": curve,
    "ConfigurationCurve.branches": lambda: curve().branches[0],
    "ConfigurationCurve.circuits": lambda: curve().circuits[0],
    "ConfigurationCurve.folds": lambda: curve().folds[0],
    "ConstantTorque": lambda: assur.ConstantTorque(long_table()),
    "DeadPoint": lambda: assur.FourBar(3.0, 2.5, 2.0, 4.0).limits().dead_points[0],
    "DesignMap": lambda: assur.FourBar(1.0, 3.0, 2.5, 3.2).map(
        "full_rotation",
        {"coupler.length": np.linspace(2, 4, 9), "rocker.length": np.linspace(2, 4, 9)},
    ),
    "DesignFit": lambda: fitted()[0],
    "Fit": lambda: searched()[0],
    "LinkageFit": lambda: searched()[0],
    "Fits": searched,
    "Force": lambda: assur.Force("B", (long_table(), force)),
    "FourBar": batch,
    "Gas": lambda: assur.Gas(1e5, 0.001, at=0.1),
    "Grid": lambda: assur.Grid({f"link {k}.length": np.linspace(1.0, 2.0, MANY) for k in range(9)}),
    "Group": lambda: assur.examples.loom().structure.groups[0],
    "Limits": lambda: batch(1000).limits(),
    "Machine": machine,
    "Machine.duty": lambda: press().duty(Q, 3.0),
    "Machine.duty of designs": lambda: assur.Machine(
        batch(200), bodies={"rocker": assur.Body(inertia=1.0)}
    ).duty(Q[:50], 3.0),
    "Machine.impact": lambda: press().impact(assur.Force("B", (-1.0, 0.0)), Q, 2.0),
    "Machine.internal_loads": lambda: press().internal_loads("rod", Q, 3.0),
    "Machine.internal_loads.extremes": lambda: (
        press().internal_loads("rod", Q[:300], 3.0).extremes("moment")
    ),
    "Machine.internal_loads.peak": lambda: press().internal_loads("rod", Q[:9], 3.0).peak("axial"),
    "Machine.reactions": forces,
    "Machine.reactions.bearing": lambda: forces().bearing("A", on="rod"),
    "Machine.reactions.slide": lambda: forces().slide("bore"),
    "Machine.reduced_inertia": lambda: press().reduced_inertia(Q),
    "Measures": measures,
    "Mechanism": lambda: chain(20),
    "Mechanism.dimensions": lambda: chain(20).dimensions,
    "Mechanism.dimensions of designs": lambda: batch().dimensions,
    "Mechanism.extremes": lambda: assur.FourBar(1.0, 3.0, 2.5, 3.2).extremes("rocker"),
    "Mechanism.find": lambda: assur.SliderCrank(0.1, 0.4).find("bore", 0.4),
    "Mechanism.follow": lambda: chain(20).follow(laws.Uniform(0.0, 0.1, 1.0), Q / 10.0),
    "Motion": lambda: chain(20).solve(0.01 * Q[:9]),
    "ParetoFront": front,
    "Pressure": lambda: assur.Pressure("bore", 0.01, long_table(), "forward"),
    "Remedy": lambda: refusal().remedies[0],
    "Run": run,
    "Run.energy": lambda: run().energy,
    "Run.event": lambda: run().events[0],
    "Run.events": lambda: run().events,
    "Run.state": lambda: run().at(np.linspace(0.0, 1.0, MANY)),
    "Run.statistics": lambda: run().statistics,
    "Runs": lambda: press().run(0.1, np.linspace(0.0, 1.0, 20), 5.0, rtol=1e-6),
    "Sensitivity": lambda: assur.FourBar(1.0, 3.0, 2.5, 3.2).solve(Q).sensitivity("coupler.length"),
    "SingularLocus": lambda: assur.examples.five_bar().singular_loci(positions=12)[0],
    "SliderCrank": lambda: assur.SliderCrank(0.1, np.linspace(0.3, 0.4, MANY)),
    "SteadyState": lambda: press().steady_state(),
    "Structure": lambda: chain(12).structure,
    "Table": long_table,
    "Table of positions": lambda: Table(PHI, PHI, over="bore", ratio=1.0 / 3.0),
    "Torque": lambda: assur.Torque("crank", force, while_="forward"),
    "Torque of a table": lambda: assur.Torque("crank", long_table()),
    "Workspace": lambda: assur.examples.five_bar().workspace("P", positions=12),
    "balance.Harmonics": lambda: balance.harmonics(PHI[:-1], np.sin(PHI[:-1]), count=60),
    "balance.RotatingParts": lambda: balance.rotating_parts(
        PHI[:-1], np.stack([np.sin(PHI[:-1]), np.cos(PHI[:-1])], axis=-1), count=60
    ),
    "crank_rocker.JammingEvent": lambda: assur.crank_rocker.JammingEvent(
        "jam", 1.0 / 3.0, 2.0 / 3.0, 4.8, "outer", (0.1, 1.0 / 3.0), (0.2, 0.3), "the rod jams " * 9
    ),
    "crank_rocker.JammingRun": lambda: assur.crank_rocker.run(1.0, 4.5, 1.5, 4.8, 0.2),
    "crank_rocker.Solution": lambda: assur.crank_rocker.solve(Q, 1.0, 4.5, 1.5, 4.8),
    "crank_rocker.Table1": assur.crank_rocker.table1,
    "events.Crossing": lambda: events.Crossing(force),
    "events.Obstacle": lambda: events.Obstacle(events.Position(1.0 / 3.0), 0.5),
    "files.Contents": lambda: files.Contents(
        assur.SliderCrank(0.1, 0.4), wanted={"solve": {"q": PHI, "outputs": ["B"] * 99}}
    ),
    "flywheel.Extreme": lambda: flywheel.Extreme(as_number(np.sin(PHI)), as_number(PHI)),
    "flywheel.Flywheel": lambda: flywheel.from_table(
        PHI, 100.0 * np.sin(PHI), fluctuation=np.linspace(0.1, 0.2, 50), mean_speed=10.0
    ),
    "flywheel.ReducedTable": lambda: flywheel.ReducedTable(PHI, np.sin(PHI), PHI),
    "importers.Imported": lambda: importers.Imported(
        assur.SliderCrank(0.1, 0.4), "pmks", ("what was left out, in a sentence",) * 300, 5.0
    ),
    "laws.Sequence": lambda: laws.Sequence(
        tuple(laws.Uniform(float(k), k + 1.0, 1.0, begin=float(k)) for k in range(50))
    ),
    "laws.Tabulated": lambda: laws.Tabulated(PHI, PHI**2),
    "metric.Condition": lambda: sum_of_metrics() > 1.0,
    "adapters.scipy.Residuals": lambda: assur.adapters.scipy.Residuals(
        chain(12), {f"rocker{k}": np.zeros(9) for k in range(1, 13)}, np.linspace(0.0, 0.1, 9)
    ),
    "adapters.scipy.StateEquations": lambda: assur.adapters.scipy.StateEquations(press()),
    "metric.Metric": sum_of_metrics,
    "target.Function": lambda: assur.target.Function(np.zeros(50), np.zeros(50)),
    "target.Near": lambda: assur.target.Near(sum_of_metrics(), 1.0),
    "target.Path": lambda: assur.target.Path(np.zeros((50, 2)), timing=np.zeros(50)),
    "target.Poses": lambda: assur.target.Poses(np.zeros((50, 3))),
    "slider_crank.Deviation": lambda: assur.slider_crank.deviation(np.linspace(0.1, 0.3, 99), 2),
}
# Classes of a few numbers and names: nothing in them is long.
FEW = {
    *("Cylinder", "Damper", "Drive", "Gravity", "InductionMotor", "JointFriction", "LinearMotor"),
    *("Slide", "SlideFriction", "Spring", "TorsionDamper", "TorsionSpring", "files.Range"),
    *("balance.Counterweight", "balance.MomentBounds", "slider_crank.Extreme", "laws.Law"),
    *("events.Position", "events.Rest", "events.Speed", "events.TransmissionAngle"),
    *("laws.Cycloidal", "laws.Harmonic", "laws.ModifiedSine", "laws.Polynomial345"),
    *("laws.Polynomial4567", "laws.Trapezoidal", "laws.Uniform"),
}


@pytest.mark.parametrize("name", MADE)
def test_it_is_a_line_or_a_small_table(name: str) -> None:
    made = MADE[name]()
    for text in {repr(made), str(made)}:
        lines = text.splitlines()
        assert 1 <= len(lines) <= LINES, text
        assert max(map(len, lines)) <= COLUMNS, text
        assert "object at 0x" not in text


def test_every_public_class_is_tried() -> None:
    classes = {name for name in callables() if name.rpartition(".")[2][:1].isupper()}
    assert classes == {name for name in {*MADE, *FEW} if name in classes}


def test_what_users_write_can_be_typed_back() -> None:
    from assur import Body, Force, Torque

    names: dict[str, Any] = {"Body": Body, "Force": Force, "Torque": Torque, "Table": Table}
    names |= {"array": np.array, "Tabulated": laws.Tabulated, "Uniform": laws.Uniform}
    table = Table([0.0, 1.0 / 3.0, 1.0], [1.0, 2.0, 3.0], over="bore")
    for written in (
        Body(mass=1.0 / 3.0, at=(0.1, 0.2)),
        Force("B", (table, 1.0)),
        Torque("crank", 2.0 / 3.0),
        table,
        laws.Tabulated([0.0, 0.5, 2.0], [0.0, 1.0 / 7.0, 2.0]),
    ):
        again = eval(repr(written), names)
        assert repr(again) == repr(written)


def test_numbers_of_results_have_six_digits() -> None:
    text = repr(flywheel.Extreme(as_number(np.pi), as_number(2.0)))
    assert text == "Extreme(value=3.14159, q=2.0)"


def test_lists_in_each_other_end() -> None:
    deep: Any = []
    for _ in range(10_000):
        deep = [deep]
    with pytest.raises(assur.InputError, match=r"\[\[\[\[\[…\]"):
        press().run(1.0, 0.0, 1.0, events=[events.Crossing(deep)])
