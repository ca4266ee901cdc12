"""Bad arguments of one call each, and what the error says: the argument, the value, the remedy."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
import pytest

import assur
from assur import crank_rocker, files, flywheel, importers, pictures, slider_crank
from models.errors.refusals import MOTION, M, refused

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

mpl.use("Agg")

HALF = "\ud800"  # half of a surrogate pair: no encoding has it
RAGGED: Any = [[1.0], [2.0, 3.0]]
LOOPED: Any = []
LOOPED.append(LOOPED)
TABLE: Any = np.zeros((2, 3))
TURN = np.linspace(0.0, 6.0, 7)
LENGTHS = (1.0, 4.5, 1.5, 4.8)
PRESS = assur.SliderCrank(0.1, 0.4)
MACHINE = assur.Machine(PRESS, bodies={"crank": assur.Body(inertia=1.0)})
LOCKED = assur.Machine(
    PRESS,
    bodies={"crank": assur.Body(inertia=1.0)},
    friction={"B": assur.JointFriction(0.1, 0.02)},
)
WHEEL = flywheel.evaluate(TURN / 6.0 * 2.0 * np.pi, np.zeros(7), 2.0, flywheel=1.0, speed0=5.0)


def drawing(**given: Any) -> object:
    return M.to_drawing("never.svg", **given)


def curve() -> assur.ConfigurationCurve:
    return M.configuration_curve(positions=8)


def workspace() -> assur.Workspace:
    five = assur.examples.five_bar()
    (joint,) = set(five.links["left_rod"]) & set(five.links["right_rod"])
    return five.workspace(joint, positions=4)


def watched(name: Any, limit: float, **lines: Any) -> assur.Run:
    event = assur.events.TransmissionAngle(name, limit, **lines)
    return MACHINE.run(0.1, speed0=1.0, events=[event])


def measured() -> Any:
    return assur.sweep(M, {}, TURN, metrics={"swing": assur.metric.span("rocker")})


CALLS: dict[str, tuple[Callable[..., object], Any, str]] = {
    # Names.
    "extremes of half a letter": (M.extremes, HALF, r"coordinate '\ud800' Unicode"),
    "drawing of half a letter": (lambda x: drawing(link=x), HALF, r"link '\ud800' Unicode"),
    "drawing of an array": (lambda x: drawing(link=x), np.zeros(3), "link array name"),
    "paper": (lambda x: drawing(paper=x), [], "paper [] one of A4"),
    "labels": (lambda x: M.plot(labels=x), TABLE, "labels array 'first' 'all' 'none'"),
    "largest": (lambda x: measured().nlargest(1, by=x), [], "by=[] 'swing'"),
    "curvature of two": (MOTION.curvature, ["C", "D"], "curvature ['C', 'D'] string"),
    "curvature of one in a list": (MOTION.curvature, ["C"], "curvature ['C'] string"),
    "event": (lambda x: watched(x, 0.5), "Q", "event TransmissionAngle of 'Q': joint \"A\""),
    "lines of an event": (
        lambda x: watched("B", 0.5, between=x),
        ("A", "Q"),
        "event TransmissionAngle of 'B': joint \"Q\"",
    ),
    # Arrays.
    "page": (lambda x: M.to_html("never.html", q=x), RAGGED, "q [[1.0], [2.0, 3.0]] array"),
    "part of a motion": (lambda x: MOTION[x], RAGGED, "[[1.0], [2.0, 3.0]] slice"),
    "speed": (lambda x: MOTION.diagram("C", speed=x), RAGGED, "speed [[1.0], [2.0, 3.0]]"),
    "acceleration": (
        lambda x: MOTION.diagram("C", speed=1, acceleration=x),
        RAGGED,
        "acceleration [[1.0]",
    ),
    "orders": (lambda x: MOTION.diagram("C", orders=x), RAGGED, "orders [1.0] 0 1, 2 or 3"),
    "no orders": (lambda x: MOTION.diagram("C", orders=x), [], "orders empty from 1"),
    "many orders": (lambda x: MOTION.diagram("C", orders=x), [0] * 99, "orders more than 12"),
    "a speed too small": (lambda x: MOTION.diagram("C", speed=x), 1e-320, "values from 1e-300"),
    "a speed too great": (lambda x: MOTION.diagram("rocker", speed=x), 1e152, "values to 1e+300"),
    "its square": (lambda x: MOTION.diagram("C", speed=x), 1e152, "square 'C' greatest number"),
    "places": (lambda x: curve().defects(x), np.array(0.5), "places 0.5 pairs (q, assembly)"),
    "a mechanism for places": (lambda x: curve().defects(x), M, "places pairs (q, assembly)"),
    "speeds at a position": (
        lambda x: MOTION.plot("C", vectors="velocity", speed=x),
        np.ones((2, 3)),
        "speed shape (2, 3) one speed (3,)",
    ),
    "point of a coupler": (
        lambda x: assur.FourBar(1.0, 3.0, 2.5, 3.0, point=x),
        np.array(0.5),
        "point 0.5 (x, y)",
    ),
    "width of a link": (lambda x: drawing(width=x), 1e150, "width 1e+150 m 1e+100"),
    "far turns": (lambda x: M.to_html("never.html", q=x), [1e300] * 3, "1e+300 3.4e+38 page"),
    "duration": (lambda x: MOTION.to_html("never.html", duration=x), 1e-320, "duration 1e-09"),
    "impact": (
        lambda x: MACHINE.impact(assur.Force("B", (-1.0, 0.0)), 0.5, x, restitution=0.3),
        -1e300,
        "impact greatest number",
    ),
    # What is drawn, and where.
    "axes": (lambda x: MOTION.diagram("C", ax=x), LOOPED, "ax [[...]] matplotlib axes"),
    "axes of assemblies": (lambda x: M.assemblies(0.5).plot(ax=x), [None, 1.0], "ax NoneType"),
    "loci": (lambda x: workspace().plot(loci=x), 1.0, "loci 1.0 singular_loci()"),
    "other loci": (lambda x: workspace().plot(loci=x), "x", "loci 'x' singular_loci()"),
    "links": (lambda x: MACHINE.reactions(1.0).plot(links=x), 1.0, "links 1.0 list of names"),
    "a polygon's links": (lambda x: MACHINE.reactions(1.0).polygon(x), 1.0, "links 1.0 names"),
    "centres' links": (
        lambda x: pictures.instant_centres(MOTION, at=1, links=x),
        1.0,
        "links 1.0 names",
    ),
    "lines": (lambda x: pictures.instant_centres(MOTION, at=1, lines=x), TABLE, "lines True False"),
    "Bresse": (
        lambda x: pictures.inflection_circle(MOTION, "coupler", at=1, bresse=x),
        TABLE,
        "bresse array True False",
    ),
    "order": (lambda x: pictures.hodograph(MOTION, "C", order=x), TABLE, "order array 1 2"),
    "centrodes of what": (
        lambda x: pictures.centrodes(x, "coupler"),
        1.0,
        "motion 1.0 assur.Motion",
    ),
    "hodograph of what": (lambda x: pictures.hodograph(x, "C"), 1.0, "motion 1.0 assur.Motion"),
    "circle of what": (
        lambda x: pictures.inflection_circle(x, "rod"),
        1.0,
        "motion 1.0 assur.Motion",
    ),
    "centres of what": (pictures.instant_centres, 1.0, "motion 1.0 assur.Motion is needed"),
    "values of a condition": ((assur.metric.span("C.x") < 1.0).holds, "x", "values 'x' numbers"),
    # The papers' pictures.
    "convergence": (lambda x: slider_crank.plot_convergence(k=x), "y" * 5000, "k real numbers"),
    "no ratio": (lambda x: slider_crank.plot_convergence(k=x), (), "k empty from 1 to"),
    "deviation": (lambda x: slider_crank.plot_deviation(n=x), "y" * 5000, "n 1 to 1000"),
    "many deviations": (lambda x: slider_crank.plot_deviation(n=x), [1] * 99, "n more than 12"),
    "quantity": (lambda x: slider_crank.plot_deviation(quantity=x), 1.0, "quantity 1.0 'stroke'"),
    "rod": (lambda x: slider_crank.plot_positions(1.0, 0.1, x), "x", "rod 'x' numbers"),
    "rods": (lambda x: slider_crank.plot_positions(1.0, 0.1, x), [0.4, 0.5], "rod [0.4, 0.5]"),
    "along": (
        lambda x: slider_crank.plot_positions(1.0, 0.1, 0.4, along=0.2, across=x),
        "x",
        "across 'x'",
    ),
    "least angle": (
        lambda x: crank_rocker.plot_transmission(*LENGTHS, gamma_min=x),
        "x",
        "gamma_min 'x' numbers",
    ),
    "length": (lambda x: crank_rocker.plot_transmission(x, 4.5, 1.5, 4.8), [1.0, 2.0], "l1 [1.0"),
    "grounds": (lambda x: crank_rocker.plot_transmission(1.0, 4.5, 1.5, x), [], "l4 empty"),
    "axes of two pictures": (
        lambda x: crank_rocker.plot_push_and_pull(*LENGTHS, ax=x),
        [None, 1.0],
        "ax NoneType",
    ),
    "axes of curves": (
        lambda x: slider_crank.plot_convergence(count=2, ax=x),
        RAGGED,
        "ax list matplotlib axes",
    ),
    "coupler": (lambda x: crank_rocker.plot_zone(coupler=x), 1e308, "values 1e+308 to 1e+300"),
    "result of a file": (
        files.Contents(M, wanted={"solve": {"deg": [0.0]}}).result,
        [],
        "does not ask for [] solve",
    ),
    "greatest angle": (
        lambda x: crank_rocker.plot_transmission(*LENGTHS, gamma_min=x),
        1e308,
        "gamma_min 1e+308 angle",
    ),
    "margin": (lambda x: crank_rocker.plot_zone(margin=x), [], "margin [] a number two"),
    "zone's angle": (lambda x: crank_rocker.plot_zone(gamma_min=x), TABLE, "gamma_min array"),
    "angles": (lambda x: crank_rocker.plot_push_and_pull(*LENGTHS, phi1=x), "x", "phi1 'x'"),
    "lengths": (
        lambda x: crank_rocker.plot_push_and_pull(1.0, x, 1.5, 4.8),
        [4.5, 4.6],
        "l2 [4.5, 4.6] number",
    ),
    "crank that hardly turns": (
        lambda x: crank_rocker.run(1.0, 4.5, 1.5, 4.995, 0.2, speed=x),
        1e-320,
        "speed 1e-320 time greatest number",
    ),
    # Paths and texts.
    "path of a text": (lambda x: importers.detect(x, "x"), 1.0, "path 1.0 a path is needed"),
    "text": (lambda x: importers.detect(None, x), 1.0, "text 1.0 the text of a file"),
    "table": (flywheel.read_table, 1.0, "path 1.0 a path is needed"),
    "table of half a letter": (flywheel.read_table, HALF, r"\ud800 cannot be read"),
    # A rate without the speed that it belongs to.
    "rate of a table": (
        lambda x: MOTION.to_dataframe(acceleration=x),
        2.0,
        "acceleration 2.0 give speed",
    ),
    "rate of a workbook": (
        lambda x: MOTION.to_excel("never.xlsx", acceleration=x),
        "x",
        "acceleration 'x'",
    ),
    "rate of a file": (
        lambda x: MOTION.to_parquet("never", acceleration=x),
        2.0,
        "acceleration 2.0 give speed",
    ),
    "rate of a diagram": (lambda x: MOTION.diagram("C", jerk=x), 2.0, "jerk 2.0 give speed"),
    "rate of a picture": (
        lambda x: slider_crank.plot_motion("stroke", 0.1, 0.4, acceleration=x),
        2.0,
        "acceleration 2.0 give speed",
    ),
    # Counts.
    "samples": (lambda x: curve().motion(samples=x), 10**9, "samples from 2 to 10000000"),
    "positions": (
        lambda x: M.configuration_curve(positions=x),
        10**9,
        "positions from 2 to 100000",
    ),
    "steps": (
        lambda x: MACHINE.run(1.0, max_steps=x),
        1e30,
        "from 1 to 9223372036854775807",
    ),
    "places to lock": (lambda x: LOCKED.self_locking(sense=1, n=x), 10**18, "n from 2 to 10000000"),
    "points of a rod": (
        lambda x: MACHINE.internal_loads("rod", 1.0, n=x),
        10**18,
        "n from 2 to 10000000",
    ),
    "points of a diagram": (
        lambda x: WHEEL.energy_mass(points=x),
        10**18,
        "points from 2 to 10000000",
    ),
}


@pytest.mark.parametrize("name", list(CALLS))
def test_a_bad_argument_is_refused_by_name(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    call, value, words = CALLS[name]
    error = refused(assur.InputError, words, partial(call, value))
    assert len(str(error)) < 500
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", ["xlsx", "parquet", "html", "svg", "toml"])
@pytest.mark.parametrize("name", [".", "n" * 300, HALF, "a\0b"])
def test_a_file_that_cannot_be_written_is_named(
    name: str, ending: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    motion = assur.SliderCrank(1.0, 3.0).solve(TURN)
    write: dict[str, Callable[[str], object]] = {
        "xlsx": motion.to_excel,
        "parquet": motion.to_parquet,
        "html": motion.to_html,
        "svg": lambda path: M.to_drawing(f"{path}/no/folder.svg" if path == "." else f"{path}.svg"),
        "toml": M.save,
    }
    error = refused(assur.InputError, "cannot be written:", partial(write[ending], name))
    assert name.encode("utf-8", "backslashreplace").decode() in str(error)
    str(error).encode()  # it can be printed


def test_one_of_several_may_stand_alone() -> None:
    axes = slider_crank.plot_convergence(3.0, count=2)
    assert [len(one.lines) for one in axes] == [1, 1]
    assert slider_crank.plot_deviation(n=2, quantity="d1").shape == (1, 1)
    assert crank_rocker.plot_push_and_pull(*LENGTHS, phi1=1.6).shape == (1,)


@pytest.mark.parametrize(
    ("motors", "speeds", "name"),
    [
        ([None, "table"], (0.0, 1.0), "right"),
        (["table", "table"], (6.0, 30.0), "right"),
        (["table", None], (30.0, 0.0), "left"),
    ],
)
def test_the_driver_of_a_motor_that_cannot_start_is_named(
    motors: list[Any], speeds: tuple[float, float], name: str
) -> None:
    table = assur.Table([5.0, 10.0, 20.0], [3.0, 2.0, 1.0])
    five = assur.examples.five_bar()
    names = [str(one) for one in five.description.drivers]
    bodies = {link: assur.Body(inertia=1.0) for link in names}
    own = [table if motor else None for motor in motors]
    machine = assur.Machine(five, bodies=bodies, motor=own)
    named = dict(zip(("left", "right"), names, strict=True))[name]
    error = refused(
        assur.InputError,
        f"driver {named!r} motor's table 5 to 20 start within it",
        partial(machine.run, 0.1, speed0=speeds),
    )
    assert error.driver == named
    assert error.kind == "table_ends"
