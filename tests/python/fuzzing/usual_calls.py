"""Public functions with arguments that they take, to be spoiled one at a time.

A call is named as the user types it, ``Class.method`` or ``module.function``; arguments that are
not given are the defaults.
"""

from __future__ import annotations

import functools
import inspect
import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import assur
from assur import (
    balance,
    crank_rocker,
    events,
    files,
    flywheel,
    importers,
    laws,
    metric,
    pictures,
    slider_crank,
)
from fuzzing.fuzz_kinematics import CLASS_IV

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

MODULES = (
    *(balance, crank_rocker, events, files, flywheel, importers, laws, metric, pictures),
    slider_crank,
)
TURN = np.linspace(0.0, math.tau, 7)
MOMENT = np.array([0.0, 40.0, 20.0, -30.0, 10.0, -40.0, 0.0])
SPACE = {"coupler.length": [2.9, 3.0], "rocker.length": [2.4, 2.5]}
DRAWN: dict[str, Any] = {
    "joints": {"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)},
    "links": {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"},
    "driver": "crank",
}
PMKS = "ground crank R 0 0 0 ffft|crank rod R 0 1|rod block R 3 0|ground block P 3 0 0"
# Carried by a cylinder, and by a slide.
BOOM: dict[str, Any] = {
    "joints": {"O": (0, 0), "B": (1, 1), "E": (2, 0)},
    "links": {"ground": "OE", "boom": "OB"},
    "driver": "lift",
}
SLOT: dict[str, Any] = {
    "joints": {"O": (0, 0), "B": (1, 1)},
    "links": {"ground": "O", "crank": "OB", "block": "B", "lever": "O"},
    "driver": "crank",
}
LENGTHS = {"l1": 1.0, "l2": 4.5, "l3": 1.5, "l4": 4.8}
PRESS = {"crank": 0.11, "rod": 0.407}
COLUMNS = {"phi": TURN, "moment": MOMENT, "inertia": 2.0}
AT = {"q": 0.5, "speed": 1.0}
QUICK = {"max_steps": 300, "max_seconds": 1.0}


class Call(NamedTuple):
    """A function, and what it takes."""

    function: Callable[..., Any]
    usual: dict[str, Any]


def call(function: Callable[..., Any], /, **needed: Any) -> Call:
    """Return the call with these arguments, the others as they are by default."""
    kinds = (inspect.Parameter.VAR_KEYWORD, inspect.Parameter.VAR_POSITIONAL)
    own = [one for one in inspect.signature(function).parameters.values() if one.kind not in kinds]
    return Call(function, {one.name: needed.get(one.name, one.default) for one in own})


def named(owner: str, home: Any, /, **calls: dict[str, Any]) -> Iterable[tuple[str, Call]]:
    """Return calls of methods, or of functions of a module, by their names."""
    for name, needed in calls.items():
        yield f"{owner}.{name}", call(getattr(home, name), **needed)


@functools.cache
def machine(rubs: bool = False) -> assur.Machine:
    press = assur.SliderCrank(0.1, 0.4)
    bodies = {
        "crank": assur.Body(inertia=0.5),
        "rod": assur.Body(mass=1.0, inertia=0.4**2 / 12.0, at=(0.2, 0.0)),
    }
    force = assur.Force("B", (-100.0, 0.0), on="piston")
    rubbing = {"B": assur.JointFriction(0.1, 0.02)} if rubs else {}
    motor = None if rubs else assur.LinearMotor(50.0, 15.0)
    return assur.Machine(press, bodies=bodies, loads=[force], motor=motor, friction=rubbing)


def _of_mechanisms() -> Iterable[tuple[str, Call]]:
    m, five, page = assur.FourBar(1.0, 3.0, 2.5, 3.0), assur.examples.five_bar(), {"path": "m.html"}
    (joint,) = set(five.links["left_rod"]) & set(five.links["right_rod"])
    curve, space = m.configuration_curve(positions=8), five.workspace(joint, positions=4)
    yield "Mechanism", call(assur.Mechanism, **DRAWN)
    yield "FourBar", call(assur.FourBar, crank=1.0, coupler=3.0, rocker=2.5, ground=3.0)
    yield "SliderCrank", call(assur.SliderCrank, **PRESS)
    yield from named(
        "Mechanism",
        m,
        from_lengths={**DRAWN, "lengths": {"AD": 4.9}},
        assemblies=AT,
        configuration_curve={"positions": 8},
        defects={"q": TURN[:2], "joints": {"C": m.solve(TURN[:2]).joint("C").value}},
        design={"index": ()},
        extremes={"name": "C.x"},
        find={"name": "C.x", "value": 3.0},
        follow={"laws": laws.Cycloidal(0.5, 1.5, 1.0), "t": [0.0, 0.5]},
        limits={},
        map={"of": "full_rotation", "dimensions": SPACE},
        plot={},
        save={"path": "m.toml"},
        solve=AT,
        to_drawing={"path": "m.dxf"},
        to_html=page,
        with_assembly={"assembly": m.assembly},
        with_dimensions={"dimensions": {"rocker.length": 2.5}},
        with_driver={"driver": "rocker"},
    )
    few = {"joint": joint, "positions": 4}
    yield from named("Mechanism", five, singular_loci=few, workspace=few)
    batch = m.with_dimensions({"rocker.length": [2.4, 2.5]})
    yield "Mechanism.__getitem__", call(batch.__getitem__, index=0)
    yield "Limits.__getitem__", call(batch.limits().__getitem__, index=0)
    yield from named("Assemblies", m.assemblies(0.5), plot={})
    places = {"places": [(0.5, m.assembly)]}
    yield from named("ConfigurationCurve", curve, defects=places, motion={"samples": 5}, plot={})
    yield from named("DesignMap", m.map("assemblies", SPACE), plot={})
    yield from named("Extremes", m.extremes("C.x"), dwells={"tolerance": 0.01})
    yield from named("SingularLocus", five.singular_loci(positions=8)[0], plot={"joint": joint})
    yield from named("Workspace", space, contains={"points": [(0.5, 1.0)]}, plot={})


def _of_motions() -> Iterable[tuple[str, Call]]:
    m, rates = assur.FourBar(1.0, 3.0, 2.5, 3.0), {"speed": 1.0, "acceleration": 1.0}
    motion, press = m.solve(TURN, order=3), assur.SliderCrank(0.1, 0.4).solve(TURN)
    timed = m.follow(laws.Cycloidal(0.5, 1.5, 1.0), [0.0, 0.5, 1.0])
    point = {"link": "coupler", "local": (1.0, 0.0)}
    sensitive = motion.sensitivity("coupler.length")
    drawn = {"motion": motion, "link": "coupler", "joint": "C", "at": 1, **rates}
    yield from named(
        "Motion",
        motion,
        __getitem__={"index": 0},
        animate={"path": "m.gif", "frames": 2},
        coordinate={"index": 0},
        curvature={"joint": "C"},
        diagram={"name": "rocker", "orders": 1, **rates},
        explain={"index": 0},
        instant_centre={"link": "coupler"},
        mechanical_advantage={"name": "rocker"},
        plot={"joint": "C", "vectors": "velocity", **rates},
        point=point,
        polygon={"what": "velocity", "at": 0},
        sensitivity={"dimension": "coupler.length"},
        d_transmission_angle={"name": "C"},
        jacobian={"name": "C", "by": "coupler.length"},
        jvp={"name": "C", "rates": {"coupler.length": 1.0}},
        vjp={"weights": {"C": 1.0}},
        to_dataframe=rates,
        to_excel={"path": "m.xlsx", **rates},
        to_parquet={"path": "m.parquet", **rates},
        to_xarray=rates,
        to_html={"path": "m.html"},
        transmission_angle={"name": "C"},
    )
    yield from named("MotionModel", motion, joint={"name": "C"}, link={"name": "crank"})
    yield from named("MotionModel", press, slide={"name": "bore"})
    pin = motion.joint("C")
    yield from named("Analogues", pin, velocity=rates, acceleration=rates, jerk=rates)
    yield from named("Sensitivity", sensitive, joint={"name": "C"}, link={"name": "rocker"})
    bore = press.sensitivity("rod.length")
    yield from named("Sensitivity", bore, slide={"name": "bore"})
    yield from named(
        "TimedMotion",
        timed,
        diagram={"name": "rocker", "orders": 1},
        joint={"name": "C"},
        link={"name": "rocker"},
        point=point,
        to_html={"path": "m.html"},
    )
    sliding = assur.SliderCrank(0.1, 0.4).follow(laws.Cycloidal(0.5, 1.5, 1.0), [0.0, 1.0])
    yield from named("TimedMotion", sliding, slide={"name": "bore"})
    names = ("centrodes", "hodograph", "inflection_circle", "instant_centres")
    yield from named("pictures", pictures, **dict.fromkeys(names, drawn))


def _of_machines() -> Iterable[tuple[str, Call]]:
    own, rubbing, four_bar = machine(), machine(rubs=True), assur.FourBar(1.0, 3.0, 2.5, 3.0)
    table = assur.Machine.from_table(TURN, MOMENT, 2.0)
    yield "Machine", call(assur.Machine, mechanism=own.mechanism)
    yield from named(
        "Machine",
        own,
        duty={**AT, "q": TURN},
        effort=AT,
        dynamics=AT,
        acceleration=AT,
        d_acceleration=AT,
        d_effort=AT,
        linearize=AT,
        step={**AT, "effort": 1.0, "dt": 1e-3, "method": "RK45"},
        equilibria={"between": (0.0, 3.0)},
        flywheel={"fluctuation": 0.1},
        impact={"load": assur.Force("B", (-1.0, 0.0)), "q": 0.5, "speed": -5.0, "restitution": 0.3},
        internal_loads={**AT, "link": "rod", "n": 5},
        run={"t_end": 0.1, "speed0": 1.0, "rtol": 1e-6, "keep": "all", **QUICK},
        potential=AT,
        reduced_inertia=AT,
        reduced_moment=AT,
        steady_state={"rtol": 1e-6, **QUICK},
        with_counterweights={"weights": []},
    )
    yield from named("Machine", rubbing, reactions=AT, self_locking={"sense": 1, "n": 20})
    yield from named(
        "MachineModel",
        own,
        from_table={**COLUMNS, "spline": "linear"},
        design={"index": ()},
        of={"mechanism": own.mechanism},
        save={"path": "m.toml"},
    )
    run, steady = own.run(0.1, speed0=1.0), table.steady_state(9.0)
    found, wheel = own.reactions(TURN, 2.0), table.flywheel(0.1, mean_speed=9.0)
    rod = {"name": "B", "on": "rod"}
    yield from named("Run", run, at={"t": 0.05}, plot={}, to_html={"path": "m.html"})
    many: assur.Runs = own.run(0.1, q0=TURN, speed0=1.0, rtol=1e-6)
    yield from named("Runs", many, at={"t": 0.05}, explain={"index": 0})
    yield from named("SteadyState", steady, at=AT, plot={})
    yield from named(
        "Reactions",
        found,
        bearing=rod,
        joint=rod,
        joint_moment=rod,
        slide={"name": "bore"},
        plot={"at": 1},
        polygon={"links": "rod", "at": 1},
    )
    files_of = {"to_dataframe": {}, "to_excel": {"path": "t.xlsx"}, "to_xarray": {}}
    yield from named("Tabular", found, **files_of, to_parquet={"path": "t.parquet"})
    size = {"diameter": 0.1, "width": 0.1}
    yield from named("Bearing", found.bearing("B", on="rod"), plot={}, pressure=size, pv=size)
    angle, time = {"q": 0.5}, {"t": 0.1}
    over_q = ("reduced_inertia", "reduced_moment", "speed", "time", "work")
    yield from named("Flywheel", wheel, **dict.fromkeys(over_q, angle))
    yield from named("Flywheel", wheel, coordinate=time, speed_at=time)
    yield from named("Flywheel", wheel, energy_mass={"points": 5}, explain={"index": ()}, plot={})
    yield from named(
        "balance",
        balance,
        fit={"machine": own, "q": TURN, "places": {"crank": (-0.1, 0.0)}, "speed": 1.0},
        four_bar={
            "machine": assur.Machine(
                four_bar, bodies={"coupler": assur.Body(mass=1.0, inertia=0.1)}
            )
        },
        slider_crank={"machine": own},
        harmonics={"q": TURN[:-1], "values": MOMENT[:-1], "count": 2},
        rotating_parts={"q": TURN[:-1], "force": np.ones((6, 2)), "count": 2},
        Counterweight={"link": "crank", "moment": 1.0, "angle": 0.0, "about": "A"},
    )
    weight = balance.Counterweight("crank", 1.0, angle=0.0, about="A")
    yield from named("Counterweight", weight, with_mass={"mass": 1.0}, with_radius={"radius": 1.0})


def _of_sweeps() -> Iterable[tuple[str, Call]]:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    design = {"coupler.length": [2.9, 3.0, 9.0]}
    found = assur.sweep(m, design, TURN, metrics={"a": metric.span("C.x")})
    of = {"of": "C.x"}
    usual = {"mechanism": m, "dimensions": design, "q": TURN, "metrics": {"a": metric.span("C.x")}}
    yield "sweep", call(assur.sweep, **usual)
    yield "Grid", call(assur.Grid, dimensions=design)
    yield from named(
        "Measures",
        found,
        __getitem__={"name": "a"},
        nsmallest={"n": 1, "by": "a"},
        nlargest={"n": 1, "by": "a"},
        designs={"indices": 0},
        explain={"index": 2},
        get={"name": "a"},
        plot={"name": "a"},
        to_xarray={},
    )
    plain = ("max", "min", "mean", "argmax", "argmin", "rms", "span")
    yield from named("metric", metric, **dict.fromkeys((*plain, "time_ratio"), of))
    drive, joint = {"speed": 1.0}, {"joint": "B", "on": None}
    yield from named(
        "metric",
        metric,
        deviation={"of": "C", "shape": "line"},
        flywheel_inertia={"fluctuation": 0.1},
        function={"of_motion": lambda motion: np.zeros(len(motion))},
        function_error={"of": "rocker", "theta": TURN[:3], "value": [2.0, 2.1, 2.2]},
        min_transmission_angle={"at": "C"},
        path_error={"of": "C", "points": [(1.0, 1.0), (2.0, 1.5)]},
        pose_error={"link": "coupler", "poses": [(1.0, 0.0, 0.5)], "length": 1.0},
        peak_effort=drive,
        rms_effort=drive,
        peak_reaction=joint,
        rms_reaction=joint,
    )
    yield from named("Condition", metric.span("C.x") > 0.0, holds={"values": [1.0]})


def _of_searches() -> Iterable[tuple[str, Call]]:
    hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
    few = {"evaluations": 1, "time_limit": 0.5}
    yield "search", call(assur.search, targets={"P": hook}, joints=5, **few)
    found = assur.search({"P": hook}, joints=5, evaluations=1)
    yield from named("LinkageFit", found[0], plot={})
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    yield "fit", call(assur.fit, mechanism=four_bar, targets={"P": hook}, **few)
    yield from named("Fit", assur.fit(four_bar, {"P": hook}, evaluations=1)[0])
    yield from named("Fits", found, resume=few, save={"folder": "found"})


def _of_fronts() -> Iterable[tuple[str, Call]]:
    goals = {"stroke": metric.span("bore"), "angle": metric.min_transmission_angle("B")}
    given: dict[str, Any] = {
        "mechanism": assur.SliderCrank(0.1, 0.4),
        "q": TURN,
        "maximize": goals,
        "bounds": {"crank.length": (0.05, 0.2)},
        "population": 4,
        "generations": 2,
        "time_limit": 0.5,
    }
    yield "pareto", call(assur.pareto, **given)
    front = assur.pareto(**given)
    page = {"path": "front.html"}
    yield from named("ParetoFront", front, plot={}, to_html=page)


def _of_parts() -> Iterable[tuple[str, Call]]:
    rows: dict[str, Any] = {"q": [0.0, 1.0], "value": [1.0, 1.0]}
    shaft = {"link": "crank", "torque": 1.0, "stiffness": 1.0, "damping": 1.0}
    ends = {"first": "O", "second": "B", "stiffness": 1.0, "length": 0.1, "damping": 1.0}
    yield from named(
        "assur",
        assur,
        Assembly={"signs": {"C": 1}},
        Body={"mass": 1.0, "inertia": 0.1, "at": (0.0, 0.0)},
        ClassIV={"joints": CLASS_IV},
        ConstantTorque={"torque": 1.0},
        Damper=ends,
        Force={"at": "B", "force": (1.0, 2.0)},
        Gas={"pressure": 1e5, "volume": 1.0, "at": 0.1},
        Gravity={},
        InductionMotor={"breakdown": 1.0, "slip": 0.1, "synchronous": 1.0},
        JointFriction={"coefficient": 0.1, "radius": 0.1},
        LinearMotor={"stall": 1.0, "no_load": 1.0},
        Pressure={"slide": "bore", "area": 1.0, "pressure": 1e5, "expands": "forward"},
        SlideFriction={"coefficient": 0.1, "length": 0.1},
        Spring=ends,
        Table=rows,
        Torque=shaft,
        TorsionDamper=shaft,
        TorsionSpring=shaft,
        rpm={"turns": 1500.0},
    )
    plate = {"power": 7500.0, "rpm": 1450.0, "poles": 4, "breakdown": 2.5}
    yield from named("InductionMotor", assur.InductionMotor, from_plate=plate)
    yield from named("Table", assur.Table(**rows), at={"x": 0.5})
    rise = {"start": 0.0, "end": 1.0, "duration": 1.0}
    rises = ("Cycloidal", "Harmonic", "ModifiedSine", "Polynomial345", "Polynomial4567")
    yield from named("laws", laws, **dict.fromkeys((*rises, "Trapezoidal", "Uniform"), rise))
    cycloid = laws.Cycloidal(0.0, 1.0, 1.0)
    joined: dict[str, Any] = {"t": [0.0, 0.5, 1.0], "value": [0.0, 1.0, 2.0]}
    yield from named("laws", laws, Sequence={"laws": [cycloid]}, Tabulated=joined)
    for law in (cycloid, laws.Sequence((cycloid,)), laws.Tabulated(**joined)):
        owner = "Rise" if law is cycloid else type(law).__name__
        yield from named(owner, law, at={"t": 0.5})


def _used(made: Callable[..., Any], use: Callable[[Any], Any]) -> Callable[..., Any]:
    """Return a function that makes something and uses it: its arguments are checked then."""

    def function(**given: Any) -> Any:
        return use(made(**given))

    vars(function)["__signature__"] = inspect.signature(made)
    return function


def _watched(event: Any) -> assur.Run:
    m = assur.Machine(assur.FourBar(1.0, 3.0, 2.5, 3.0), bodies={"crank": assur.Body(inertia=1.0)})
    return m.run(0.1, speed0=1.0, events=[event])


def _drawn(drawing: dict[str, Any], **more: Any) -> assur.Mechanism:
    return assur.Mechanism(**{**drawing, **more})


def _of_modules() -> Iterable[tuple[str, Call]]:
    position = events.Position(1.0, direction="rising")
    watched: dict[str, dict[str, Any]] = {
        "Rest": {},
        "Position": {"q": 0.1},
        "Speed": {"speed": 0.1},
        "TransmissionAngle": {"name": "C", "limit": 0.1},
        "Crossing": {"function": lambda *_: 1.0},
        "Obstacle": {"at": position, "restitution": 0.5},
    }
    for name, needed in watched.items():
        yield f"events.{name}", call(_used(getattr(events, name), _watched), **needed)
    driven = _used(assur.Drive, lambda one: _drawn(DRAWN, driver=one))
    lifted = _used(assur.Cylinder, lambda one: _drawn(BOOM, slides={"lift": one}))
    guided = _used(assur.Slide, lambda one: _drawn(SLOT, slides={"lift": one}))
    yield "Drive", call(driven, link="crank")
    yield "Cylinder", call(lifted, base="E", end="B")
    yield "Slide", call(guided, link="block", on="lever", angle=0.0, origin="O")
    assur.FourBar(1.0, 3.0, 2.5, 3.0).save("saved.toml")
    rows = zip(TURN, MOMENT, strict=True)
    text = "".join(f"{phi},{moment},2\n" for phi, moment in rows)
    with open("table.csv", "w", encoding="utf-8") as file:  # noqa: PTH123
        file.write(text)
    saved = {"path": "saved.toml"}
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    yield "load", call(assur.load, **saved)
    contents = files.Contents(m, wanted={"solve": {"deg": [0.0, 1.0]}})
    yield from named("files", files, load=saved, read=saved, save={"what": m, "path": "m.toml"})
    yield from named("files", files, Range={"start": 0.0, "stop": 1.0, "count": 3})
    yield from named("Contents", contents, result={"name": "solve"})
    yield from named(
        "importers", importers, read={"source": PMKS}, detect={"path": None, "text": "x"}
    )
    quick = {**COLUMNS, "mean_speed": 10.0, "spline": "linear", "threads": 1}
    sizes = {"from_table": {**quick, "fluctuation": 0.1}, "evaluate": {**quick, "flywheel": 1.0}}
    yield from named("flywheel", flywheel, **sizes, read_table={"path": "table.csv"})
    yield from _of_papers()


def _of_papers() -> Iterable[tuple[str, Call]]:
    rocker = {"coupler": 4.0, "rocker": 2.0}
    joints = {"f_c": 0.1, "r_c": 0.1, "f_d": 0.1, "r_d": 0.1, "rocker": 1.5}
    plain = ("crank_turns", "grashof", "plot_push_and_pull", "plot_transmission")
    yield from named(
        "crank_rocker",
        crank_rocker,
        **dict.fromkeys((*plain, "transmission_extremes"), LENGTHS),
        blocked={**LENGTHS, "gamma_min": 0.2},
        ground_range=rocker,
        least_transmission_angle=joints,
        plot_least_angle={},
        plot_zone={},
        run={**LENGTHS, "ground": 4.995, "gamma_min": 0.2},
        solve={**LENGTHS, "phi1": 0.5},
    )
    phase = crank_rocker.run(1.0, 4.5, 1.5, ground=4.995, gamma_min=0.2)
    yield from named("JammingRun", phase, plot={"what": "ground"})
    at = {"phi": 0.5, **PRESS, "along": 0.2, "across": 0.0}
    lengths = ("contour", "coordinate", "plot_contour", "plot_positions", "rod_angle", "rod_point")
    k = {"k": 3.0}
    yield from named("slider_crank", slider_crank, **dict.fromkeys((*lengths, "stroke"), at))
    yield from named(
        "slider_crank",
        slider_crank,
        fourier=k,
        greatest_acceleration=k,
        greatest_speed=k,
        deviation={"lam": 0.3, "n": 2},
        plot_convergence={"count": 2},
        plot_deviation={},
        plot_motion={"quantity": "stroke", "speed": 1.0, "orders": 1, **PRESS},
    )


@functools.cache
def usual_calls() -> dict[str, Call]:
    """Return the calls by name; those that read or write do so in the working directory."""
    parts = (
        _of_mechanisms,
        _of_motions,
        _of_machines,
        _of_sweeps,
        _of_searches,
        _of_fronts,
        _of_parts,
        _of_modules,
    )
    return {name: one for part in parts for name, one in part()}
