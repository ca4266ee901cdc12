"""Messages quote what was given: names as text, arrays in one short line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import metric

if TYPE_CHECKING:
    from collections.abc import Callable

# Names taken from an array are strings of NumPy.
A, B, C, D, X, GROUND, CRANK, ROD, ROCKER = np.array(
    ["A", "B", "C", "D", "X", "ground", "crank", "rod", "rocker"]
)
TABLE: Any = np.arange(300.0).reshape(30, 10)
WRONG: Any = 3
Q = np.linspace(0.0, 6.0, 9)


def four_bar() -> assur.Mechanism:
    return assur.Mechanism(
        joints={A: (0, 0), B: (1, 0), C: (4.1, 3.2), D: (4.8, 0)},
        links={GROUND: [A, D], CRANK: [A, B], ROD: [B, C], ROCKER: [D, C]},
        driver=CRANK,
        assembly={C: 1},
    )


def machine(*loads: Any, **options: Any) -> assur.Machine:
    return assur.Machine(
        four_bar(), bodies={ROD: assur.Body(mass=1.0, inertia=0.1, at=C)}, loads=loads, **options
    )


def swept(name: Any) -> Any:
    return assur.sweep(four_bar(), {}, Q, metrics={"a": metric.mean(name)})


def slides(**own: Any) -> Any:
    given = {"link": ROD, "on": GROUND, "angle": 0.0, "origin": None, **own}
    return assur.Mechanism(
        {A: (0, 0), B: (1, 0), C: (3, 0)},
        {GROUND: [A], CRANK: [A, B], ROD: [B]},
        CRANK,
        slides={X: assur.Slide(**given)},
    )


NAMES: dict[str, Callable[[], Any]] = {
    "solve outputs": lambda: four_bar().solve(0.5, outputs=[X]),
    "outputs alone": lambda: four_bar().solve(0.5, outputs=X),
    "motion": lambda: four_bar().solve(0.5)[X],
    "joint": lambda: four_bar().solve(0.5).joint(X),
    "not an output": lambda: four_bar().solve(0.5, outputs=["B"]).joint(C),
    "sensitivity": lambda: four_bar().solve(0.5).sensitivity("rod.length").joint(X),
    "transmission": lambda: four_bar().solve(0.5).transmission_angle(X),
    "between": lambda: four_bar().solve(0.5).transmission_angle(C, between=(C, X)),
    "find": lambda: four_bar().find(X, 1.0),
    "find a fixed joint": lambda: four_bar().find(str(A) + ".x", 1.0),
    "extremes": lambda: four_bar().extremes(X),
    "assembly": lambda: four_bar().solve(0.5, assembly={X: 1}),
    "sign": lambda: four_bar().solve(0.5, assembly={C: 3}),
    "dimension": lambda: four_bar().with_dimensions({np.str_("x.length"): 1.0}),
    "shape": lambda: four_bar().with_dimensions({np.str_("rod.length"): [1.0, 2.0]}).solve(TABLE),
    "member": lambda: assur.Mechanism({A: (0, 0)}, {GROUND: [A], CRANK: [A, X]}, CRANK),
    "driver": lambda: assur.Mechanism({A: (0, 0), B: (1, 0)}, {CRANK: [A, B]}, X),
    "drive": lambda: assur.Mechanism(
        {A: (0, 0), B: (1, 0)}, {CRANK: [A, B]}, assur.Drive(X, relative_to=X)
    ),
    "slide": lambda: slides(link=X),
    "along": lambda: slides(angle=float("nan"), along=(A, X)),
    "along itself": lambda: slides(angle=float("nan"), along=(A, A)),
    "cylinder": lambda: assur.Mechanism(
        {A: (0, 0)}, {GROUND: [A]}, "x", slides={"x": assur.Cylinder(A, X)}
    ),
    "body": lambda: assur.Machine(four_bar(), bodies={X: assur.Body(mass=1.0)}),
    "body at": lambda: assur.Machine(four_bar(), bodies={ROD: assur.Body(mass=1.0, at=D)}),
    "load": lambda: machine(assur.Force(X, (0, 1))),
    "on": lambda: machine(assur.Force(C, (0, 1), on=CRANK)),
    "torque": lambda: machine(assur.Torque(ROD, 1.0, on=ROD)),
    "axes": lambda: machine(assur.Force(C, (0, 1), axes=X)),
    "friction": lambda: machine(friction={X: assur.JointFriction(0.1, 0.1)}),
    "friction of what": lambda: machine(friction={C: 3}),
    "reaction": lambda: machine().reactions(0.5).joint(X, on=ROD),
    "reaction on": lambda: machine().reactions(0.5).joint(C, on=CRANK),
    "bearing": lambda: machine().reactions(Q).bearing(C, on=ROD, frame=X),
    "loads in": lambda: machine().internal_loads(X, Q),
    "loads in a ternary": lambda: machine().internal_loads(GROUND, Q),
    "loads along": lambda: machine().internal_loads(ROD, Q, along=(B, X)),
    "a couple": lambda: machine(assur.Torque(ROD, 1.0)).internal_loads(ROD, Q),
    "metric": lambda: swept(X),
    "metric of a joint": lambda: swept(C),
    "metrics": lambda: assur.sweep(four_bar(), {}, Q, metrics={X: WRONG}),
    "peak": lambda: assur.sweep(machine(), {}, Q, metrics={"a": metric.peak_reaction(X)}),
    "table over": lambda: machine(assur.Torque(ROD, assur.Table([0, 1], [0, 1], over=X))),
    "spline": lambda: assur.Table([0, 1], [0, 1], spline=X),
    "from lengths": lambda: assur.Mechanism.from_lengths(
        {A: (0, 0), B: (1, 0)}, {GROUND: [A], CRANK: [A, B]}, CRANK, {(A, X): 1.0}
    ),
    "diagram": lambda: four_bar().solve(Q).diagram(X),
    "loads along nothing": lambda: machine().internal_loads(ROD, Q, along=(B, B)),
    "centrodes": lambda: assur.pictures.centrodes(four_bar().solve(Q), CRANK, CRANK),
    "joints of a page": lambda: four_bar().to_html("m.html", joint=[X]),
    "diagrams of a page": lambda: four_bar().to_html("m.html", diagrams=[X]),
    "method": lambda: machine().run(1.0, method=X),
}


@pytest.mark.parametrize("name", NAMES)
def test_a_name_is_its_letters(name: str) -> None:
    with pytest.raises(assur.AssurError) as raised:
        NAMES[name]()
    assert "np." not in str(raised.value)
    assert "np." not in str(raised.value.hint)
    for field in ("joint", "link", "slide"):
        assert type(getattr(raised.value, field)) in (str, type(None))


def test_names_of_numpy_become_plain() -> None:
    own = four_bar()
    assert repr(list(own.joints)) == "['A', 'B', 'C', 'D']"
    assert repr(dict(own.links)) == repr(dict(four_bar().links))
    assert "np" not in repr(dict(own.links)) + repr(own.driver) + repr(own.assembly)
    plain = assur.Mechanism(
        {"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)},
        {"ground": "AD", "crank": "AB", "rod": "BC", "rocker": "DC"},
        "crank",
        assembly={"C": 1},
    )
    assert own == plain
    inside = assur.Machine(own).internal_loads(ROD, Q)
    assert "np.str_" not in repr(inside)


ARRAYS: dict[str, Callable[[], Any]] = {
    "body": lambda: assur.Body(mass=1.0, inertia=0.1, at=TABLE),
    "mass": lambda: assur.Body(mass=np.where(TABLE > 5, np.nan, TABLE)),
    "force": lambda: assur.Force("B", TABLE),
    "point": lambda: assur.Force(("rod", TABLE), (0, 1)),
    "gravity": lambda: assur.Gravity(TABLE),
    "joint": lambda: assur.Mechanism({"A": TABLE}, {"ground": "A"}, "x"),
    "angle": lambda: slides(angle=TABLE),
    "sense": lambda: machine().reactions(0.5, sense=TABLE),
    "speed": lambda: machine().reactions(0.5, speed=np.where(TABLE > 5, np.nan, TABLE)),
    "find": lambda: assur.examples.five_bar().find("P", TABLE),
    "near": lambda: four_bar().find("rod", 1.0, near=TABLE),
    "friction": lambda: machine(friction=TABLE),
    "motor": lambda: machine(motor=TABLE),
    "loads": lambda: machine(TABLE),
    "lengths": lambda: assur.Mechanism.from_lengths(
        {"A": (0, 0), "B": (1, 0)}, {"ground": "A", "c": "AB"}, "c", {"AB": TABLE}
    ),
    "design": lambda: four_bar().with_dimensions({"rod.length": [1.0, 2.0]}).design(TABLE),
    "entries": lambda: four_bar().solve(Q)[TABLE],
    "words": lambda: four_bar().solve(Q, on_error=TABLE),
    "order": lambda: four_bar().solve(Q, order=TABLE),
    "outputs": lambda: four_bar().solve(Q, outputs=[TABLE]),
    "limit": lambda: metric.mean("C.x") < TABLE,
    "over": lambda: metric.mean("C.x", over=TABLE),
    "law": lambda: assur.laws.Uniform(TABLE, 1.0, 1.0),
    "event": lambda: machine().run(1.0, events=[TABLE]),
    "places": lambda: assur.balance.fit(machine(), Q, {"crank": TABLE}),
}


@pytest.mark.parametrize("name", ARRAYS)
def test_an_array_is_one_short_line(name: str) -> None:
    with pytest.raises((assur.AssurError, TypeError)) as raised:
        ARRAYS[name]()
    if isinstance(raised.value, assur.AssurError):
        assert "\n" not in str(raised.value)
        assert len(str(raised.value)) < 300


def test_find_of_a_joint_that_rests_has_no_internal_words() -> None:
    with pytest.raises(assur.InputError, match="joint 'A' is on the ground and does not move"):
        four_bar().find("A.x", 1.0)
    lone = assur.Mechanism({"A": (0, 0), "B": (1, 0)}, {"ground": "A", "crank": "AB"}, "crank")
    for error in (four_bar(), lone):
        with pytest.raises(assur.InputError) as raised:
            error.find("A.x", 1.0)
        assert "cannot_drive" not in str(raised.value)


def test_a_batch_with_its_own_motor() -> None:
    batch = assur.SliderCrank(0.1, [0.4, 0.5])
    own = assur.Machine(
        batch, bodies={"rod": assur.Body(mass=1.0)}, motor=assur.ConstantTorque(9.0)
    )
    with pytest.raises(assur.InputError, match=r"^flywheel\(fluctuation\) .* is a batch \(2,\)"):
        own.flywheel(0.05)


def test_values_of_a_wrong_kind_are_refused_by_name() -> None:
    """Infinity in a table, one mechanism for a list, an array for a name."""
    crank = assur.SliderCrank(0.1, 0.4)
    bodies = {"crank": assur.Body(mass=1.0, inertia=1.0), "rod": assur.Body(mass=1.0, inertia=0.1)}
    machine = assur.Machine(
        crank, bodies=bodies, loads=[assur.Force("B", (-100.0, 0.0), on="piston")]
    )
    one: Any = crank
    pair: Any = np.zeros(2)
    number: Any = np.array(5.0)
    found = machine.reactions(1.0, speed=1.0)
    calls: list[tuple[str, Any]] = [
        ("phi is inf", lambda: assur.Machine.from_table([0.0, 1.0, np.inf], [0.0, 1.0, 0.0])),
        ("loads must be a sequence", lambda: assur.Machine(crank, loads=one)),
        ("events must be a sequence", lambda: machine.run(0.1, 1.0, 1.0, events=one)),
        ("weights must be a sequence", lambda: machine.with_counterweights(one)),
        (
            "density is array",
            lambda: machine.internal_loads("rod", 1.0, speed=1.0, density=number),
        ),
        ("frame is array", lambda: found.bearing("B", on="rod", frame=pair)),
        ("against is array", lambda: found.bearing("B", on="rod", against=pair)),
    ]
    for words, call in calls:
        with pytest.raises(assur.InputError, match=words):
            call()
